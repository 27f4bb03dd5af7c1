"""What is remembered of overlays is what would be made, and counts as much."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
import shapely

from batik_vector import compile_recipe, read_recipe, render
from batik_vector.artwork import Geometries
from batik_vector.errors import TooLargeError
from batik_vector.geometry import work
from batik_vector.tiling.torus import remembered as room
from batik_vector.tiling.torus.remembered import Asked, Memory, identities, interned
from batik_vector.tiling.welding.growth import grown_on_grid
from tests.thorough import examples

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
    room.clear()
    yield
    room.clear()


def test_the_same_is_made_once_and_counted_each_time() -> None:
    shares = []
    found = []
    for _ in range(3):
        with work.account():
            found.append(grown_on_grid(SQUARES.copy(), 0.01, 4))
            shares.append(work.counted())
    # The very same polygons, in arrays of one's own: what a caller writes is not what the next one gets.
    assert all(one is other is third for one, other, third in zip(*found, strict=True))
    found[1][0] = None
    assert found[0][0] is found[2][0] is not None
    with work.account():
        assert grown_on_grid(SQUARES, 0.01, 4)[0] is found[0][0]
    assert shares[0] == shares[1] == shares[2] != (0, 0, 0, 0)
    room.clear()
    with work.account():
        assert shapely.equals_identical(grown_on_grid(SQUARES, 0.01, 4), found[0]).all()


@pytest.mark.parametrize("other", [(0.02, 4), (0.01, 8)])
def test_whatever_it_hangs_on_makes_another(other: tuple[float, int]) -> None:
    begun = np.array([shapely.Polygon([(0, 0), (100, 0), (100, 100), (0, 100)]), SQUARES[1]])
    with work.account():
        made = [
            grown_on_grid(SQUARES, 0.01, 4),
            grown_on_grid(SQUARES, *other),
            grown_on_grid(begun, 0.01, 4),
        ]
    assert made[0][0] is not made[1][0]
    # Where a ring begins is another shape; what is the same of two arrays is known.
    assert made[0][0] is not made[2][0]
    assert made[0][1] is made[2][1]


def test_work_that_is_known_is_refused_as_it_was() -> None:
    with work.account():
        grown_on_grid(SQUARES, 0.01, 4)
    with work.account():
        work.spend(work.LIMIT)
        with pytest.raises(TooLargeError):
            grown_on_grid(SQUARES, 0.01, 4)


def test_large_shapes_are_not_remembered(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("batik_vector.tiling.welding.growth.KEPT_VERTICES", 9)
    with work.account():
        found = [grown_on_grid(SQUARES, 0.01, 4) for _ in range(2)]
    assert shapely.equals_identical(*found).all()
    assert found[0][0] is not found[1][0]


def test_what_is_kept_is_bounded_and_what_is_asked_for_stays() -> None:
    memory = Memory(100 * (room.PER_ENTRY + 1000))
    memory.keep("squares", "asked for", 0, 1000)
    for number in range(1, 1000):
        memory.keep("squares", number, number, 1000)
        assert memory.get("squares", ["asked for", number]) == [0, number]
        assert len(memory) <= 102
    assert memory.get("squares", [1, 998]) == [None, 998]
    assert memory.get("circles", [998]) == [None]


def test_equal_shapes_are_one_object() -> None:
    twice = interned(
        np.array([SQUARES[0], shapely.from_wkb(SQUARES[0].wkb), shapely.from_wkb(SQUARES[1].wkb)])
    )
    assert twice[0] is twice[1] is SQUARES[0]
    again = interned(shapely.from_wkb(shapely.to_wkb(SQUARES)))
    assert again[1] is twice[2]
    # Which way a ring runs, and where it begins, makes another.
    assert interned(shapely.reverse(SQUARES))[0] is not SQUARES[0]


def test_answers_are_made_where_they_are_not_known_and_hold_what_was_asked() -> None:
    made: list[list[int]] = []

    def ask(shapes: Geometries, shift: int) -> list[float]:
        def make(fresh: list[int]) -> list[float]:
            made.append(fresh)
            return [float(shapely.area(shapes[row])) + shift for row in fresh]

        rows = np.column_stack([identities(shapes), np.full(len(shapes), shift)])
        return Asked[float]("area", rows, (shapes,)).answers(make)

    assert ask(SQUARES[:1], 0) == [10_000.0]
    assert ask(SQUARES, 0) == [10_000.0, 10_000.0]
    assert ask(SQUARES, 1) == [10_001.0, 10_001.0]
    assert made == [[0], [1], [0, 1]]
    # A shape that is gone leaves its number to none that could be taken for it.
    for side in range(1, 200):
        assert ask(np.array([shapely.box(0, 0, side, 1)]), 0) == [side]


@pytest.mark.parametrize("seed", range(examples(2, 12)))
def test_a_tile_is_the_same_whatever_was_compiled_before(seed: int) -> None:
    rng = np.random.default_rng(seed)
    choices = [(0.7, 0.8), (0.4, 0.9), (3, 20)]
    told = [dict(zip(("length", "gap", "at"), map(rng.choice, choices), strict=True)) for _ in range(5)]
    texts = [RECIPE.format(**each) for each in told]
    warm = [render(compile_recipe(read_recipe(text)), "svg") for text in texts]
    for text, before in zip(texts, warm, strict=True):
        room.clear()
        assert render(compile_recipe(read_recipe(text)), "svg") == before
