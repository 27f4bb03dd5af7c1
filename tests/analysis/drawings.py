"""Drawings to be analysed: compiled, stripped of all but their geometry, and moved about."""

from __future__ import annotations

import re
from pathlib import Path

from batik_vector import load_recipe
from batik_vector.artwork import Artwork
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.export import SvgOptions, render
from batik_vector.recipe.loading import read_recipe

SAMPLES = Path(__file__).parents[2] / "samples"

TABLE_2 = {
    1: "2, rotation, 1/8, single, curved, 8, 1",
    2: "3, rotation, 1/8, single, wavy, 8, 2",
    3: "2, rotation, 1/8, single, rhombus, 8, 2",
    4: "2, rotation, 1/6, double, curved, 6, 2",
    5: "2, rotation, 1/8, single, curved, 8, multi",
    6: "2, rotation, none, multi, curved, 10 or more, none",
}
"""The paper's column "Generation", by the number of the flower."""


def flower(number: int) -> Artwork:
    """Return one of the paper's six flowers."""
    return compile_recipe(load_recipe(SAMPLES / f"figure-15-{number}.toml"))


def changed(number: int, *changes: tuple[str, str]) -> Artwork:
    """Return one of them with words of its recipe replaced, each of which has to be there."""
    text = (SAMPLES / f"figure-15-{number}.toml").read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    return compile_recipe(read_recipe(text))


def bare_svg(artwork: Artwork, *, bezier: bool = False, placed: str = "", page: float = 0.0) -> bytes:
    """Return a drawing as an SVG of shapes and colours: no metadata, no names of layers or elements.

    Args:
        artwork: the drawing.
        bezier: whether curves are fitted to it.
        placed: a transform under which all of it is drawn.
        page: the side of a square page in mm; the tile's own page when left out.
    """
    text = render(artwork, "svg", SvgOptions(curves="bezier" if bezier else "polyline")).decode()  # type: ignore[arg-type]
    text = re.sub(r"<(metadata|title|desc|sodipodi:namedview)\b.*?</\1>", "", text, flags=re.DOTALL)
    text = re.sub(r"<(sodipodi:namedview)\b[^>]*/>", "", text)
    text = re.sub(r' (id|inkscape:\w+|sodipodi:\w+|class|xmlns:batik)="[^"]*"', "", text)
    assert not re.search("provenance|petal", text)
    if placed:
        head, body = re.match(r"(.*?<svg[^>]*>)(.*)</svg>", text, re.DOTALL).groups()  # type: ignore[union-attr]
        head = re.sub(r'(width|height)="[\d.]+mm"', rf'\1="{page:g}mm"', head)
        head = re.sub(r'viewBox="[^"]*"', f'viewBox="0 0 {page:g} {page:g}"', head)
        text = f'{head}<g transform="{placed}">{body}</g></svg>'
    return text.encode()
