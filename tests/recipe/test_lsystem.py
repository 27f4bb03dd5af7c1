"""Motifs that an L-system grows: strokes, and marks where the word has their symbol."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector import certify, compile_recipe, read_recipe
from batik_vector.errors import GeometryError, RecipeError
from batik_vector.geometry.curves import Circle, Origin
from batik_vector.recipe.figures import draw
from batik_vector.recipe.lsystem import Grown, Growth

PAGE = """
[motif.m]
kind = "lsystem"
{keys}
[ink.wax]
width = 1
[[place]]
motif = "m"
width = 60
[tile]
size = [80, 80]
"""


def test_marks_stand_at_their_symbols_and_shrink_with_the_steps() -> None:
    leaf = Growth(symbol="X", name="leaf", curve=Circle(0.25), radius=0.5)
    tree = Grown(
        axiom="X", rules=('X -> F[+"X]',), level=2, width=0.1, marks=(leaf,), origin=Origin.START, angle=90
    )
    stroke, leaves = draw(tree, 1e-3)
    assert len(stroke.areas) == 1
    (area,) = leaves.areas
    # After two steps, of 1 and 0.7, the turtle looks back; the last leaf has half the size.
    assert shapely.get_coordinates(shapely.centroid(area))[0] == pytest.approx([1 - 0.245, 0.7], abs=1e-3)
    assert area.area == pytest.approx(np.pi * (0.25 * 0.49) ** 2, rel=1e-2)


def test_marks_without_a_symbol_in_the_word_are_told() -> None:
    with pytest.raises(RecipeError, match=r"marks\[0\].symbol: \"Y\": its word has none"):
        Grown(axiom="F", width=0.1, marks=(Growth(symbol="Y", curve=Circle(0.1)),))
    with pytest.raises(RecipeError, match="expected one symbol"):
        Grown(axiom="F", width=0.1, marks=(Growth(symbol="FF", curve=Circle(0.1)),))


def test_an_open_line_without_a_breadth_has_no_area() -> None:
    with pytest.raises(GeometryError, match="open line has no area"):
        Grown(system="dragon")


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ('system = "dragoon"', 'motif.m.system: "dragoon": did you mean "dragon"?'),
        ('system = "dragon"\nwidth = 0.2\nlevel = 50', "m.level: 50 writes a word of about 10^15 symbols"),
        ('axiom = "F[F"\nwidth = 0.2', 'motif.m.axiom: "F[F": unbalanced brackets'),
        ('axiom = "F"\nrules = ["F -> Q"]\nwidth = 0.2', 'unknown symbol "Q"'),
        ('system = "levy"\nwidth = -1', "motif.m.width: -1, expected 0 to 100"),
    ],
)
def test_faults_are_told_where_they_stand(keys: str, words: str) -> None:
    with pytest.raises(RecipeError) as error:
        read_recipe(PAGE.format(keys=keys))
    assert words in str(error.value)


def test_a_link_makes_a_ground_of_lines_that_close_on_the_torus() -> None:
    keys = """
axiom = "XF"
rules = ["X -> -YF+XFX+FY-", "Y -> +XF-YFY-FX+"]
level = 2
width = 0.5
origin = "link"
"""
    ground = 'scale = 20\nlayout = { kind = "stripes", count = 4 }'
    artwork = compile_recipe(read_recipe(PAGE.format(keys=keys).replace("width = 60", ground)))
    assert certify(artwork).passed
    # 4 lines of 4 links of 16 steps of 5 mm; a round corner lacks a little of the square that two steps
    # share.
    steps = sum(area.area for area in artwork.layers[0].areas) / (5 * 2.5)
    assert 0.96 * 4 * 4 * 16 < steps < 4 * 4 * 16
