"""Drawings as motifs: read from the recipe's folder once, picked by name, dressed, and carried in files."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import shapely

from batik_vector import RecipeError, certify, compile_recipe, load_recipe, read_recipe, write_artwork
from batik_vector.artwork import Artwork
from batik_vector.compiling.compiler import inspect
from batik_vector.export.provenance import read_provenance
from batik_vector.recipe.drawing import Svg
from batik_vector.recipe.model import Recipe

BIRD = """<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
 width="60mm" height="40mm" viewBox="0 0 60 40">
 <g inkscape:groupmode="layer" inkscape:label="notes"><text x="3">hello</text></g>
 <g inkscape:groupmode="layer" inkscape:label="wax" id="layer2">
  <rect id="body" x="10" y="10" width="40" height="20" fill="#8f5a2c"/>
  <g inkscape:label="head">
   <rect id="eye" x="42" y="12" width="4" height="4" fill="#fff"/>
   <path id="beak" d="M50 12h5" fill="none" stroke="#000" stroke-width="2"/>
  </g>
 </g>
</svg>
"""
RECIPE = """
[[place]]
motif = "bird"
scale = 1
[tile]
size = ["70 mm", "50 mm"]
"""


def desk(folder: Path, motif: str, drawing: str = BIRD, name: str = "bird.svg", more: str = "") -> Path:
    """Write a drawing and a recipe of it; return the recipe's path."""
    (folder / name).write_text(drawing, encoding="utf-8")
    path = folder / "k.toml"
    path.write_text(f'[motif.bird]\nkind = "svg"\nfile = "{name}"\n{motif}{RECIPE}{more}', encoding="utf-8")
    return path


def compiled(folder: Path, motif: str = 'layer = "wax"\n', **said: Any) -> Artwork:
    return compile_recipe(load_recipe(desk(folder, motif, **said)))


def covers(artwork: Artwork) -> dict[str, float]:
    return {layer.ink.name: float(shapely.area(layer.areas).sum()) for layer in artwork.layers}


def svg_of(recipe: Recipe) -> Svg:
    motif = recipe.motif["bird"]
    assert isinstance(motif, Svg)
    return motif


def test_a_layer_is_a_motif_in_its_own_millimetres_about_its_middle(tmp_path: Path) -> None:
    artwork = compiled(tmp_path)
    (layer,) = artwork.layers
    assert covers(artwork) == {"ink": pytest.approx(40 * 20 + 5 * 2)}
    # What is drawn reaches from 10 to 55, 10 to 30; its middle comes to lie in that of the tile.
    assert shapely.total_bounds(layer.areas).tolist() == [12.5, 15.0, 57.5, 35.0]


@pytest.mark.parametrize(
    ("motif", "area"),
    [
        ('layer = "wax"\nelements = "body"\n', 800),
        ('elements = ["ey*", "beak"]\n', 16 + 10),
        ('elements = "head"\n', 16 + 10),
        ('layer = ["w*"]\n[[motif.bird.dress]]\nelements = "eye"\ntreatment = "cut"\n', 800 - 16 + 10),
        ('layer = "wax"\n[[motif.bird.dress]]\ncolour = "#fff"\ntreatment = "cut"\n', 800 - 16 + 10),
        ('elements = "body"\nunit = "10 mm"\n', 8),
        ('elements = "beak"\ntreatment = "stroke"\n', 5 * 1 + 3.14 / 4),
    ],
)
def test_elements_are_picked_and_dressed_by_name(tmp_path: Path, motif: str, area: float) -> None:
    assert covers(compiled(tmp_path, motif)) == {"ink": pytest.approx(area, rel=1e-2)}


def test_names_are_kept_in_the_order_of_painting(tmp_path: Path) -> None:
    recipe = load_recipe(desk(tmp_path, 'layer = "wax"\n'))
    assert [part.name for part in svg_of(recipe).parts()] == ["body", "eye", "beak"]


def test_colours_are_inks_when_asked_in_the_order_of_painting(tmp_path: Path) -> None:
    motif = 'layer = "wax"\ncolours = true\n'
    assert covers(compiled(tmp_path, motif)) == {
        "#8f5a2c": pytest.approx(800 - 16),
        "#ffffff": pytest.approx(16),
        "#000000": pytest.approx(10),
    }
    declared = '[ink.cotton]\ncolour = "#fff"\n[ink.night]\ncolour = "#112233"\n'
    inks = covers(compiled(tmp_path, motif, more=declared))
    assert list(inks) == ["cotton", "#8f5a2c", "#000000"]
    assert inks["cotton"] == pytest.approx(16)


def test_what_lies_in_the_origin_can_be_told(tmp_path: Path) -> None:
    for centre, low in (("page", (35 - 20, 25 - 10)), ("eye", (35 - 34, 25 + 14 - 30))):
        (layer,) = compiled(tmp_path, f'elements = "body"\ncentre = "{centre}"\n').layers
        assert shapely.total_bounds(layer.areas)[:2].tolist() == list(low)


@pytest.mark.parametrize("suffix", ["svg", "pdf", "dxf", "gcode", "png"])
def test_a_compiled_file_compiles_from_itself_alone(tmp_path: Path, suffix: str) -> None:
    first = tmp_path / f"first.{suffix}"
    write_artwork(compiled(tmp_path), first)
    (tmp_path / "bird.svg").unlink()
    second = tmp_path / f"second.{suffix}"
    write_artwork(compile_recipe(load_recipe(first)), second)
    assert first.read_bytes() == second.read_bytes()
    carried = read_provenance(first).recipe
    assert carried.startswith((tmp_path / "k.toml").read_text())
    assert "hello" not in carried
    # What is set from outside is read from the carried drawing too.
    assert covers(compile_recipe(load_recipe(first, ["motif.bird.elements=body"]))) == {"ink": 800}


def test_a_recipe_reads_its_drawing_once(tmp_path: Path) -> None:
    recipe = load_recipe(desk(tmp_path, 'layer = "wax"\n'))
    (tmp_path / "bird.svg").write_text("<svg")
    assert covers(compile_recipe(recipe))


def test_two_motifs_may_share_a_drawing(tmp_path: Path) -> None:
    more = '[motif.eye]\nkind = "svg"\nfile = "bird.svg"\nelements = "eye"\n'
    more += '[[place]]\nmotif = "eye"\nscale = 3\nat = [0, 0]\n'
    path = desk(tmp_path, 'elements = "beak"\n', more=more)
    recipe = load_recipe(path)
    assert recipe.source.count("[drawing]") == recipe.source.count("bird.svg") - 2 == 1
    again = read_recipe(recipe.source)
    assert again == recipe
    assert covers(compile_recipe(again)) == covers(compile_recipe(recipe))


def test_python_reads_a_drawing_too(tmp_path: Path) -> None:
    desk(tmp_path, "")
    motif = Svg.read(tmp_path / "bird.svg", elements=["body"])
    assert [part.name for part in motif.parts()] == ["body"]
    with pytest.raises(RecipeError, match='has no element of that name: did you mean "body"'):
        Svg.read(tmp_path / "bird.svg", elements="bodies")


def complaint(path: Path) -> str:
    with pytest.raises(RecipeError) as found:
        load_recipe(path)
    (fault,) = found.value.faults
    return str(fault).removeprefix(f"{path}:")


@pytest.mark.parametrize(
    ("motif", "words"),
    [
        ('elements = ["body", "eya*"]\n',
         '4: motif.bird.elements[1]: "eya*", and the drawing has no element of that name: did you mean "ey'),
        ('layer = "wox"\n',
         '4: motif.bird.layer: "wox", and the drawing has no layer of that name: did you mean "wax"?'),
        ('layer = "notes"\nelements = "eye"\n', "5: motif.bird.elements: none of the elements lies in"),
        ('layer = "wax"\ncentre = "eyes"\n', '5: motif.bird.centre: "eyes", and the drawing has no element'),
        ('elements = "eye"\n[[motif.bird.dress]]\nelements = "beak"\n',
         '6: motif.bird.dress[0].elements: "beak", and the drawing has no element of that name'),
        ('layer = "wax"\n[[motif.bird.dress]]\ncolour = "#123456"\n',
         '6: motif.bird.dress[0].colour: "#123456", and the drawing has no colour of that name'),
        ('', '3: motif.bird.file: bird.svg:3: <text>: text hangs on a font; convert it to outlines first'),
        ('px_per_inch = 0\n', '4: motif.bird.px_per_inch: 0, expected 1 to 10000'),
        ('dress = [{ elements = "eye", treatment = "dotted" }]\n', "4: motif.bird.dress[0].treatment:"),
        ('[[motif.bird.dress]]\nelements = "eye"\nink = "red"\n',
         '6: motif.bird.dress[0].ink: unknown ink "red"'),
    ],
)  # fmt: skip
def test_what_picks_nothing_or_is_no_geometry_is_told_with_line_and_key(
    tmp_path: Path, motif: str, words: str
) -> None:
    assert complaint(desk(tmp_path, motif)).startswith(words)


@pytest.mark.parametrize(
    ("file", "words"),
    [
        ("brid.svg", '"brid.svg": no such file: did you mean "bird.svg"?'),
        ("../k/bird.svg", 'expected a file in the recipe\'s folder or below it, such as "bird.svg"'),
        ("/etc/passwd", '"/etc/passwd", expected a file in the recipe\'s folder or below it'),
        ("C:bird.svg", '"C:bird.svg", expected a file in the recipe\'s folder'),
        ("a\\\\bird.svg", "expected a file in the recipe's folder"),
        ("", '"", expected the name of an SVG file'),
        ("a/bird.svg", '"a/bird.svg": no such file: there is no folder "a"'),
        ("out.svg", '"out.svg": is a link that leads out of the recipe\'s folder'),
        ("away/bird.svg", '"away/bird.svg": is a link that leads out of the recipe\'s folder'),
        ("round.svg", "Too many levels of symbolic links"),
        ("pipe.svg", '"pipe.svg": is no ordinary file'),
        ("folder.svg", '"folder.svg": is a folder'),
        ("\\u0000.svg", "expected the name of an SVG file"),
    ],
)  # fmt: skip
def test_a_drawing_lies_in_the_folder_of_its_recipe(tmp_path: Path, file: str, words: str) -> None:
    here, away = tmp_path / "k", tmp_path / "away"
    for folder in (here, away, here / "folder.svg"):
        folder.mkdir()
    desk(away, "")
    path = desk(here, 'layer = "wax"\n')
    path.write_text(path.read_text().replace("bird.svg", file))
    (here / "out.svg").symlink_to(away / "bird.svg")
    (here / "away").symlink_to(away)
    (here / "round.svg").symlink_to(here / "round.svg")
    os.mkfifo(here / "pipe.svg")
    found = complaint(path)
    assert found.startswith("3: motif.bird.file: ")
    assert words in found


def test_links_within_the_folder_are_followed(tmp_path: Path) -> None:
    path = desk(tmp_path, 'layer = "wax"\n')
    (tmp_path / "birds").mkdir()
    (tmp_path / "bird.svg").rename(tmp_path / "birds" / "one.svg")
    (tmp_path / "bird.svg").symlink_to(tmp_path / "birds" / "one.svg")
    assert covers(compile_recipe(load_recipe(path)))


def test_a_text_without_a_folder_says_what_it_lacks(tmp_path: Path) -> None:
    text = desk(tmp_path, "").read_text()
    with pytest.raises(RecipeError, match=r"recipe:4?3: motif.bird.file: .*has no folder"):
        read_recipe(text)
    assert read_recipe(text.replace('file = "bird.svg"', 'file = "bird.svg"\nlayer = "wax"'), folder=tmp_path)


def test_a_drawing_is_never_replaced_by_what_is_made_of_it(tmp_path: Path) -> None:
    path = desk(tmp_path, 'layer = "wax"\n', name="k.svg")
    call = [sys.executable, "-m", "batik_vector", "compile", str(path), "-o", str(tmp_path)]
    done = subprocess.run(call, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "would replace the drawing that it is made of" in done.stderr
    assert (tmp_path / "k.svg").read_text() == BIRD


LEAF = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 40">
<path id="leaf" fill="#222" d="M5 20C15 5 40 5 55 20C40 35 15 35 5 20Z"/>
<path id="vein" fill="none" stroke="#fff" stroke-width="2" stroke-dasharray="6 3"
 d="M10 20C20 14 40 26 50 20"/>
<path id="stem" fill="none" stroke="#222" stroke-linecap="round" stroke-width="3" transform="skewX(20)"
 d="M55 20h-60"/></svg>"""
VEIN = '[[motif.bird.dress]]\nelements = "vein"\ntreatment = "cut"\n'


@pytest.mark.parametrize(
    ("layout", "repeat"),
    [
        ('{ kind = "single" }', "half-drop"),
        ('{ kind = "julian", power = 3, dist = 3, shift = [14, 5] }', "brick"),
        ('{ kind = "ring", count = 5, radius = 30 }', "p4g"),
        ('{ kind = "toss", distance = "1 mm", count = 3 }', "pgg"),
    ],
)
def test_a_drawing_lies_in_any_layout_and_repeat_without_a_seam(
    tmp_path: Path, layout: str, repeat: str
) -> None:
    path = desk(tmp_path, VEIN, LEAF)
    text = path.read_text().replace("scale = 1", f'width = "24 mm"\nlayout = {layout}')
    path.write_text(f'{text}repeat = "{repeat}"\n'.replace('"50 mm"]', '"70 mm"]'))
    artwork = compile_recipe(load_recipe(path))
    facts = inspect(artwork)
    assert (facts["violations"], facts["seam"]) == ([], [])
    assert certify(artwork, symmetry=False).passed


def test_treatments_draw_fills_outlines_and_bodies(tmp_path: Path) -> None:
    def parts(motif: str) -> list[tuple[int, int]]:
        recipe = load_recipe(desk(tmp_path, motif, LEAF))
        return [(len(areas), len(lines)) for _, areas, lines in svg_of(recipe).shapes(0.05)]

    # The leaf's fill; the vein's five dashes; the stem's body.
    assert parts("") == [(1, 0), (5, 0), (1, 0)]
    assert parts('treatment = "line"\n') == [(1, 1), (0, 5), (0, 1)]
    assert parts('treatment = "stroke"\nelements = "leaf"\n') == [(1, 1)]
    assert parts('treatment = "both"\nelements = "leaf"\n') == [(1, 1)]
    assert parts('treatment = "area"\nelements = "stem"\n') == [(0, 0)]


def test_curves_are_sampled_at_the_size_at_which_they_come_to_lie(tmp_path: Path) -> None:
    vertices = []
    for scale in (1, 16):
        path = desk(tmp_path, 'elements = "leaf"\n', LEAF)
        path.write_text(path.read_text().replace("scale = 1", f"scale = {scale}"))
        path.write_text(path.read_text().replace('"70 mm", "50 mm"', '"2 m", "2 m"'))
        artwork = compile_recipe(load_recipe(path))
        vertices.append(artwork.vertex_count)
        (layer,) = artwork.layers
        area, length = (float(measure(layer.areas).sum()) for measure in (shapely.area, shapely.length))
        # Twice the integral of y dx over the upper curve, in px of the drawing.
        assert area == pytest.approx(787.5 * (scale * 25.4 / 96) ** 2, abs=0.02 * length)
    # A chord's height grows with the square of its length.
    assert 2.5 < vertices[1] / vertices[0] < 5.5
