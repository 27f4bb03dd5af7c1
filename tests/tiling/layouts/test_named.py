"""The paper's layouts by name: they are what the catalogue could say already, and deal out several motifs."""

from __future__ import annotations

import numpy as np
import pytest

from batik_vector import analyse
from batik_vector.artwork import Artwork
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.errors import RecipeError
from batik_vector.geometry.maps.affines import Affines
from batik_vector.recipe.loading import read_recipe
from batik_vector.tiling.layouts import (
    LAYOUTS,
    Circle,
    DoubleSquare,
    FiveCircle,
    FourSquare,
    Julian,
    Layout,
    Mirror,
    Ring,
    Symmetric,
    ThreeCircle,
)


def rows(layout: Layout) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    images = layout.images((7.0, 9.0))
    assert isinstance(images, Affines)
    return np.asarray(images.rows)


def same(one: Layout, other: Layout) -> bool:
    """Whether two layouts set the same images, in whatever order."""
    a, b = ({tuple((np.round(row, 9) + 0.0).tolist()) for row in rows(each)} for each in (one, other))
    return a == b


@pytest.mark.parametrize(
    ("named", "power", "shift"),
    [
        (Symmetric(), 2, (4 / 3, 0.0)),
        (ThreeCircle(), 3, (4 / 3, 0.0)),
        (FourSquare(), 4, (4 / 3, 4 / 3)),
        (FiveCircle(distance=4 / 3), 5, (4 / 3, 0.0)),
    ],
)
def test_they_are_the_papers_julian_layouts(named: Layout, power: int, shift: tuple[float, float]) -> None:
    assert same(named, Julian(power=power, dist=power, level=1, shift=shift))


def test_a_mirrored_pair_is_the_mirror_and_a_circle_the_ring() -> None:
    assert same(Symmetric(mirrored=True, turn=20), Mirror(shift=(4 / 3, 0), turn=20))
    assert same(Circle(count=7, radius=3, turn=5), Ring(count=7, radius=3, turn=5))


def test_a_mirrored_four_square_mirrors_left_and_right_and_up_and_down() -> None:
    images = rows(FourSquare(distance=2, mirrored=True))
    assert np.allclose(images[:, 4:], [(2, 2), (-2, 2), (-2, -2), (2, -2)])
    assert np.allclose(images[:, [0, 3]], [(1, 1), (-1, 1), (-1, -1), (1, -1)])


def test_a_double_square_is_a_row_that_more_iterations_of_julian_draw_too() -> None:
    places = rows(DoubleSquare(count=3))[:, 4:]
    assert np.allclose(places, [(-8 / 3, 0), (0, 0), (8 / 3, 0)])
    two = rows(Julian(power=2, dist=2, level=2, shift=(4 / 3, 0.0)))[:, 4:]
    assert {tuple(np.round(place, 9) + 0.0) for place in two} == {
        tuple(np.round(place, 9) + 0.0) for place in places
    }
    turned = rows(DoubleSquare(count=2, distance=2, axis=90, flip=True))
    assert np.allclose(turned[:, 4:], [(0, -1), (0, 1)])
    assert np.allclose(np.linalg.det(turned[:, :4].reshape(2, 2, 2)), [1, -1])


RECIPE = """
[motif.round]
kind = "rosette"
elements = [{ curve = { kind = "circle", radius = 1 } }]
[motif.square]
kind = "rosette"
elements = [{ curve = { kind = "polygon", sides = 4, radius = 1 } }]
[ink.a]
[[place]]
motif = ["round", "square"]
layout = { kind = "circle", count = 6, radius = 4 }
scale = "10 mm"
[tile]
size = ["100 mm", "100 mm"]
"""


def compiled(text: str) -> Artwork:
    return compile_recipe(read_recipe(text))


def test_several_motifs_take_their_places_in_turn() -> None:
    areas = compiled(RECIPE).layers[0].areas
    by_angle = sorted(
        areas, key=lambda area: np.arctan2(area.centroid.y - 50, area.centroid.x - 50) % (2 * np.pi)
    )
    assert [len(area.exterior.coords) > 5 for area in by_angle] in ([True, False] * 3, [False, True] * 3)
    assert analyse(compiled(RECIPE)).symmetry.order == 3


@pytest.mark.parametrize("kind", ["symmetric", "double-square", "four-square"])
def test_every_named_layout_deals(kind: str) -> None:
    text = RECIPE.replace('kind = "circle", count = 6, radius = 4', f'kind = "{kind}", distance = 2.5')
    corners = sorted(len(area.exterior.coords) > 5 for area in compiled(text).layers[0].areas)
    assert corners == sorted([True, False] * (len(corners) // 2))
    assert LAYOUTS[kind].deals


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("count = 6", "count = 5", '["round", "square"]: 2 motifs in turn do not come out even on 5 places'),
        (
            "count = 6",
            "count = 1",
            "do not come out even on 1 places, expected a number of motifs that divides 1",
        ),
        ('scale = "10 mm"', 'width = "90 mm"', "set out at one scale, expected scale instead of width"),
        (
            'kind = "circle", count = 6, radius = 4',
            'kind = "mirror"',
            "only rings, lattices and the paper's layouts deal",
        ),
    ],
)
def test_what_cannot_be_dealt_out_is_refused(old: str, new: str, words: str) -> None:
    with pytest.raises(RecipeError, match=r"place\[0\]") as refused:
        read_recipe(RECIPE.replace(old, new))
    assert words in str(refused.value)
