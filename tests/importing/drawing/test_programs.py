"""Drawings as other programs write them: as motifs they cover what resvg shows, by name, colour and order."""

from __future__ import annotations

import io
import itertools
from pathlib import Path

import numpy as np
import pytest
import shapely
from PIL import Image

from batik_vector import Artwork, Placement, Recipe, TileSpec, compile_recipe
from batik_vector.importing.document import parse
from batik_vector.importing.drawing.carried import carried
from batik_vector.importing.page import page_of
from batik_vector.recipe.drawing import Svg

FOLDER = Path(__file__).parent / "programs"
TOLERANCE = 0.02
WIDE = 600
"""Pixels across the page."""


def compiled(motif: Svg, width: float, height: float) -> Artwork:
    """Compile a drawing at its own size, its page in the middle of a larger tile."""
    tile = TileSpec(size=(round(width) + 8.0, round(height) + 8.0))
    place = Placement(motif="drawing", scale=1.0)
    return compile_recipe(Recipe(motif={"drawing": motif}, place=(place,), tile=tile, tolerance=TOLERANCE))


def shown(text: str, colours: list[str], page: tuple[float, float]) -> dict[str, float]:
    """Return the area (mm²) in which resvg shows each colour; a pixel on a border is shared by its sides."""
    from resvg_py import svg_to_bytes

    png = bytes(svg_to_bytes(svg_string=text, width=WIDE, dpi=96))
    pixels = np.asarray(Image.open(io.BytesIO(png)).convert("RGBA"), np.float64)
    # resvg rounds the height to pixels.
    pixel = page[0] / pixels.shape[1] * page[1] / pixels.shape[0]
    pixels = np.pad(pixels, ((2, 2), (2, 2), (0, 0)))
    pixels[..., :3] *= pixels[..., 3:] / 255
    # The last of them is what shows nothing.
    solid = [[int(each[i : i + 2], 16) for i in (1, 3, 5)] + [255] for each in colours]
    known = np.array([*solid, [0, 0, 0, 0]], float)
    pure = (pixels[:, :, None] == known).all(axis=3)
    area = pure.reshape(-1, len(known)).sum(axis=0).astype(float)
    row, column = np.nonzero(~pure.any(axis=2))
    mixed = pixels[row, column]
    near = np.any([pure[row + i, column + j] for i in range(-2, 3) for j in range(-2, 3)], axis=0)
    best, share, pair = np.full(len(row), np.inf), np.zeros(len(row)), np.zeros((len(row), 2), int)
    for one, other in itertools.combinations(range(len(known)), 2):
        way = known[one] - known[other]
        part = np.clip((mixed - known[other]) @ way / (way @ way), 0, 1)
        off = np.abs(mixed - known[other] - part[:, None] * way).sum(axis=1)
        off += np.where(near[:, one] & near[:, other], 0, 1000)
        better = off < best
        best[better], share[better], pair[better] = off[better], part[better], (one, other)
    np.add.at(area, pair[:, 0], share)
    np.add.at(area, pair[:, 1], 1 - share)
    return {colour: float(n) * pixel for colour, n in zip(colours, area[:-1], strict=True)}


# What each draws, bottom first: names where it has any, and colours. Alike neighbours stand there once.
KNOWN = {
    "affinity": "ring #1d2f5f; stem #2f5d3a; stem #8f5a2c",
    "batik": "#8f5a2c; #f4efe2",
    "cairo": "surface1 #1c2e5e; surface1 #f5f0e3; surface1 #8f3b2b",
    "canva": "#a0322b; #1d2f5f",
    "coreldraw": "heart #e31e24; heart.line #2b2a29; Layer 1 #2b2a29; sun #ffcc29",
    "cricut": "Layer0001 #a0322b; Layer0002 #000000",
    "d3": "#1f77b4; #ff7f0e; #2ca02c; #4682b4",
    "feather": "#000000",
    "figma": "Vector #2f5d3a; Vector 2 #f4efe2; Rectangle 1 #c9a227; Rectangle 1.line #1d2f5f; "
    "Union #a0322b",
    "fontawesome": "#000000",
    "fonttools": "B #000000; ampersand #000000",
    "graphviz": "node1 #add8e6; node1.line #000000; node2 #daa520; node2.line #000000; edge1 #000000; "
    "edge1.line #000000",
    "illustrator-cc": "the petals #a0322b; heart #c9a227; frame #1d2f5f",
    "illustrator-cs": "body #1d2f5f; tail_fin #1d2f5f; gill #8f5a2c; eye #f4efe2",
    "inkscape-paths": "leaf #2f5d3a; vein #f4efe2; berry #8f3a2c; berry #3d1510; box #c9a227; star #1d2f5f",
    "inkscape-plain": "leaf #2f5d3a; vein #f4efe2; berry #8f3a2c; berry.line #3d1510; box #c9a227; "
    "star #1d2f5f",
    "inkscape": "leaf one #2f5d3a; vein #f4efe2; berry #8f3a2c; berry.line #3d1510; box #c9a227; "
    "star #1d2f5f",
    "libreoffice": "id3 #729fcf; id3 #3465a4; id4 #a0322b",
    "linearity": "Layer-1 #8f5a2c; Layer-1 #1d2f5f",
    "material": "#5f6368",
    "matplotlib": "disc #8f5a2c; disc.line #1d2f5f; wedge #2f5d3a; box #a0322b",
    "nested": "sun #c9a227; bud one #a0322b; bud two #a0322b; grass #2f5d3a; sail.line #1d2f5f; "
    "sail #f4efe2",
    "openscad": "#d3d3d3; #000000",
    "ours": "leaf #a5b8d8; dot #f4efe2",
    "pdftocairo": "surface1 #1d2f5f; glyph0-0 #a0322b; surface1 #000000",
    "potrace-flat": "#000000",
    "potrace-group": "#000000",
    "potrace": "#000000",
    "qgis": "#beb297; #232323; #a0322b",
    "sketch": "bud-left #a0322b; bud-right #8f5a2c; Star #1d2f5f",
    "svglite": "#f8766d; #000000; #00bfc4; #7cae00",
    "svgo": "#1d2f5f; #c9a227",
    "svgwrite": "petal0 #a0322b; petal0.line #1d2f5f; petal1 #a0322b; petal1.line #1d2f5f; petal2 #a0322b; "
    "petal2.line #1d2f5f; petal3 #a0322b; petal3.line #1d2f5f; petal4 #a0322b; "
    "petal4.line #1d2f5f; petal5 #a0322b; petal5.line #1d2f5f; core #c9a227",
    "vtracer-cutout": "#f4efe2; #1d2f5f; #8f5a2c; #2f5d3a",
    "vtracer": "#1d2f5f; #8f5a2c; #2f5d3a",
    "xd": "#2f5d3a; #1d2f5f; #f4efe2",
}  # fmt: skip
GROUNDS = {
    "ours": "#1d2f5f",
    "canva": "#ffffff",
    "svglite": "#ffffff",
    "matplotlib": "#ffffff",
    "vtracer": "#f4efe2",
}
"""The colour of a ground that is left out."""


def test_every_drawing_is_known() -> None:
    assert {path.stem for path in FOLDER.glob("*.svg")} == set(KNOWN)
    assert len(KNOWN) > 30


@pytest.mark.parametrize("name", KNOWN)
def test_a_drawing_covers_what_is_shown_of_it_by_name_and_colour(name: str) -> None:
    path = FOLDER / f"{name}.svg"
    motif = Svg.read(path, colours=True, centre="page")
    drawn = dict.fromkeys(f"{part.name} {part.ink}".strip() for part in motif.parts())
    assert "; ".join(drawn) == KNOWN[name]
    page = page_of(parse(path.read_bytes()))
    artwork = compiled(motif, page.width, page.height)
    colours = [layer.ink.colour for layer in artwork.layers]
    assert colours == list(dict.fromkeys(part.ink for part in motif.parts()))
    grounds = [GROUNDS[name]] if name in GROUNDS else []
    expected = shown(path.read_text(encoding="utf-8"), colours + grounds, (page.width, page.height))
    for layer in artwork.layers:
        area, length = (float(measure(layer.areas).sum()) for measure in (shapely.area, shapely.length))
        allowed = (TOLERANCE + page.width / WIDE / 50) * length
        assert area == pytest.approx(expected[layer.ink.colour], abs=allowed)


@pytest.mark.parametrize("name", KNOWN)
def test_what_a_file_carries_of_a_drawing_gives_the_same_marks_to_the_bit(name: str) -> None:
    motif = Svg.read(FOLDER / f"{name}.svg")
    text = motif.drawing.text
    document = parse(text.encode())
    again = motif.read_from(document, None, carried(document, None))
    assert again.drawing == motif.drawing
    for one, other in zip(again.marks, motif.marks, strict=True):
        assert np.array_equal(one.outline.points, other.outline.points)
        assert {**vars(one), "outline": None} == {**vars(other), "outline": None}
    assert not set(text) & {"'", "\x7f"}
