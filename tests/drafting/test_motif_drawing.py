"""A motif drawn as an SVG comes back as it was, with names, inks and looks."""

from __future__ import annotations

from pathlib import Path

import pytest
import shapely

from batik_vector import compile_recipe, load_recipe, read_recipe
from batik_vector.artwork import Artwork
from batik_vector.drafting.motif_drawing import motif_drawing
from batik_vector.errors import UnknownNameError
from batik_vector.importing.document import parse

FLOWER = """
[motif.flower]
kind = "flower"
petal = { count = 6, gap = "0.3 mm", ink = "red" }
pistil = { treatment = "cut" }
core = { ink = "red", treatment = "stroke" }
"""
LINES = """
[motif.flower]
kind = "rosette"
[[motif.flower.elements]]
name = "tip of a leaf"
curve = { kind = "superellipse", a = 0.3 }
count = 5
radius = 0.9
ink = "red"
treatment = "both"
line_ink = "wax"
gap = 0.5
[[motif.flower.elements]]
curve = { kind = "spiral" }
treatment = "line"
[[motif.flower.elements]]
name = "star"
curve = { kind = "hypocycloid", m = 5, n = 2, length = 0.5 }
fill = "evenodd"
"""
AROUND = """
tile = { size = ["80 mm", "60 mm"], repeat = "half-drop" }
[ink.wax]
colour = "#f4efe2"
[ink.red]
colour = "#8c2f2b"
[[place]]
motif = "flower"
ink = "wax"
scale = "14 mm"
"""


def recipe_path(folder: Path, motif: str) -> Path:
    path = folder / "recipe.toml"
    path.write_text(AROUND + motif, "utf-8")
    return path


def apart(one: Artwork, other: Artwork) -> float:
    """Return how far outlines and lines are apart, in the mean, at worst (mm)."""
    assert [layer.ink for layer in one.layers] == [layer.ink for layer in other.layers]
    worst = 0.0
    for mine, theirs in zip(one.layers, other.layers, strict=True):
        a, b = shapely.union_all(mine.areas), shapely.union_all(theirs.areas)
        worst = max(worst, shapely.symmetric_difference(a, b).area / (shapely.length(a) or 1.0))
        for one_way in ((mine.lines, theirs.lines), (theirs.lines, mine.lines)):
            places = shapely.points(shapely.get_coordinates(one_way[0]))
            # Where a line is cut aslant its end lies further off.
            if len(one_way[0]):
                worst = max(worst, float(shapely.distance(places, shapely.union_all(one_way[1])).mean()))
    return worst


@pytest.mark.parametrize("motif", [FLOWER, LINES])
def test_a_motif_comes_back_as_it_was(motif: str, tmp_path: Path) -> None:
    path = recipe_path(tmp_path, motif)
    recipe = load_recipe(path)
    drawing = motif_drawing(recipe, "flower")
    (tmp_path / "own.svg").write_text(drawing.svg, "utf-8")
    again = load_recipe(recipe_path(tmp_path, drawing.table("flower", "own.svg")))
    assert apart(compile_recipe(recipe), compile_recipe(again)) < recipe.tolerance


def test_elements_keep_their_names(tmp_path: Path) -> None:
    drawing = motif_drawing(load_recipe(recipe_path(tmp_path, LINES)), "flower")
    document = parse(drawing.svg.encode())
    labels = [value for each in document.root.iter() for key, value in each.items() if "label" in key]
    assert labels == ["cloth", "flower", "tip of a leaf", "element", "star"]
    assert [name for name, _ in drawing.looks] == ["tipOfALeaf", "element", "star"]
    assert "20 mm are a unit" in drawing.svg


def test_a_motif_that_is_none_is_told_with_the_nearest() -> None:
    with pytest.raises(UnknownNameError, match='unknown motif "flwer": did you mean "flower"'):
        motif_drawing(read_recipe(AROUND + FLOWER), "flwer")
