"""What is remembered of overlays is what would be made, and counts as much."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
import shapely

from batik_vector import compile_recipe, read_recipe, render
from batik_vector.errors import TooLargeError
from batik_vector.geometry import work
from batik_vector.tiling.torus import remembered as room
from batik_vector.tiling.torus.remembered import remembered
from batik_vector.tiling.welding.growth import grown_on_grid
from tests.thorough import examples, long

SQUARES = np.array([shapely.box(0, 0, 100, 100), shapely.box(200, 0, 300, 100)], dtype=object)

RECIPE = """
[ink.wax]
[motif.star]
kind = "rosette"
elements = [
  {{ curve = {{ kind = "petal", n = 2, length = 1.0 }}, count = 4 }},
  {{ curve = {{ kind = "hypocycloid", length = {length} }}, treatment = "cut", gap = "{gap} mm" }},
  {{ curve = {{ kind = "circle", radius = 0.2 }}, gap = "0.8 mm" }},
]
[[place]]
motif = "star"
width = "44 mm"
at = ["{at} mm", "7 mm"]
[tile]
size = ["40 mm", "40 mm"]
"""


@pytest.fixture(autouse=True)
def forgotten() -> Iterator[None]:
    room._known.clear()
    yield
    room._known.clear()


def test_the_same_is_made_once_and_counted_each_time() -> None:
    shares = []
    found = []
    for _ in range(3):
        with work.account():
            found.append(grown_on_grid(SQUARES.copy(), 0.01, 4))
            shares.append(work.counted())
    assert len(room._known) == 1
    # The very same polygons, in arrays of one's own: what a caller writes is not what the next one gets.
    assert all(one is other is third for one, other, third in zip(*found, strict=True))
    found[1][0] = None
    assert found[0][0] is found[2][0] is not None
    with work.account():
        assert grown_on_grid(SQUARES, 0.01, 4)[0] is found[0][0]
    assert shares[0] == shares[1] == shares[2] != (0, 0, 0, 0)
    room._known.clear()
    with work.account():
        assert shapely.equals_identical(grown_on_grid(SQUARES, 0.01, 4), found[0]).all()


def test_whatever_it_hangs_on_makes_another() -> None:
    turned = SQUARES[::-1].copy()
    begun = np.array([shapely.Polygon([(0, 0), (100, 0), (100, 100), (0, 100)]), SQUARES[1]])
    with work.account():
        made = [
            grown_on_grid(shapes, reach, corners)
            for shapes in (SQUARES, turned, begun, SQUARES[:1])
            for reach in (0.01, 0.02)
            for corners in (4, 8)
        ]
    assert len(room._known) == len(made) == 16


def test_work_that_is_known_is_refused_as_it_was() -> None:
    with work.account():
        grown_on_grid(SQUARES, 0.01, 4)
    with work.account():
        work.spend(work.LIMIT)
        with pytest.raises(TooLargeError):
            grown_on_grid(SQUARES, 0.01, 4)


def test_few_and_small_results_are_kept() -> None:
    def made() -> room.Arrays:
        return (np.zeros(1),)

    large = np.array([shapely.Point(0, 0).buffer(100, quad_segs=room.KEPT_VERTICES)], dtype=object)
    with work.account():
        remembered(("large",), large, made)
        assert not room._known
        for number in range(2 * room.KEPT):
            remembered((number,), SQUARES, made)
    assert [key[0] for key in room._known] == list(range(room.KEPT, 2 * room.KEPT))
    remembered(("outside of an account",), SQUARES, made)
    assert len(room._known) == room.KEPT


@long
@pytest.mark.parametrize("seed", range(examples(2, 12)))
def test_a_tile_is_the_same_whatever_was_compiled_before(seed: int) -> None:
    rng = np.random.default_rng(seed)
    choices = [(0.7, 0.8), (0.4, 0.9), (3, 20)]
    told = [dict(zip(("length", "gap", "at"), map(rng.choice, choices), strict=True)) for _ in range(5)]
    texts = [RECIPE.format(**each) for each in told]
    warm = [render(compile_recipe(read_recipe(text)), "svg") for text in texts]
    for text, before in zip(texts, warm, strict=True):
        room._known.clear()
        assert render(compile_recipe(read_recipe(text)), "svg") == before
