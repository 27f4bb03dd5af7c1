"""Nets: what many areas cover together is what GEOS says, and what is congruent is worked out once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from batik_vector.geometry.nets import Net, net, united
from batik_vector.geometry.nets.net import Unite
from batik_vector.geometry.nets.solving import Copies, Solved, solved
from batik_vector.geometry.outlines import Index, of_polygons, to_polygons
from batik_vector.geometry.regions import oriented
from batik_vector.geometry.sampling import Geometries
from batik_vector.tiling.torus import overlay
from tests.thorough import examples, long

Places = Sequence[tuple[int, int]]


def together(
    shapes: Geometries, kind: Index, places: NDArray[np.int64], unite: Unite = overlay.united
) -> tuple[Geometries, Net | None]:
    """Return copies of shapes, and what comes of them as a net."""
    shapes = oriented(shapes)
    marks = shapes[kind].copy()
    xy, owner = shapely.get_coordinates(marks, return_index=True)
    marks = np.asarray(shapely.set_coordinates(marks, xy + places[owner]), dtype=object)
    a, b = shapely.STRtree(marks).query(shapely.envelope(marks))
    pairs = np.column_stack([a, b])[a < b]
    return marks, united(of_polygons(shapes), shapes, kind, places, pairs, unite)


def drawn(shapes: Geometries, kind: Index, places: NDArray[np.int64]) -> tuple[Geometries, Geometries]:
    """Return copies, and the areas of their net, which must be told."""
    marks, found = together(shapes, kind, places)
    assert found is not None
    return marks, np.concatenate([to_polygons(found.areas), marks[found.alone]])


def ring(points: NDArray[np.float64]) -> shapely.Polygon:
    return shapely.Polygon(np.rint(points))


def lobed(lobes: int, wave: float, size: float, turn: float = 0.0, count: int = 60) -> shapely.Polygon:
    angle = 2 * np.pi * np.arange(count) / count
    radius = size * (1 + wave * np.cos(lobes * angle + turn))
    return ring(np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]))


def array(shapes: Sequence[shapely.Polygon]) -> Geometries:
    found = np.empty(len(shapes), dtype=object)
    found[:] = shapes
    return found


def grid(columns: int, rows: int, across: int, up: int, stagger: int = 0) -> NDArray[np.int64]:
    row, column = np.divmod(np.arange(columns * rows), columns)
    return np.column_stack([column * across + row % 2 * stagger, row * up])


# A rectangle, a diamond, a frame, and what has both kinds of edges: where they cross lies on the grid.
SQUARE = shapely.box(0, 0, 8, 8)
BAR = shapely.box(0, 0, 20, 4)
DIAMOND = shapely.Polygon([(8, 0), (16, 8), (8, 16), (0, 8)])
FRAME = shapely.Polygon(shapely.box(0, 0, 16, 16).exterior, [shapely.box(4, 4, 12, 12).exterior])
HOUSE = shapely.Polygon([(0, 0), (8, 0), (8, 8), (4, 12), (0, 8)])
EXACT = array([SQUARE, BAR, DIAMOND, FRAME, HOUSE])


def same(made: Geometries, marks: Geometries) -> None:
    """The areas are those that GEOS says, part by part, and valid."""
    wanted = shapely.get_parts(shapely.union_all(marks))
    assert shapely.is_valid(made).all()
    assert len(made) == len(wanted)
    assert shapely.area(made).sum() == shapely.area(wanted).sum()
    assert shapely.equals(shapely.union_all(made), shapely.union_all(marks))


@long
@settings(max_examples=examples(25, 150), deadline=None)
@given(st.lists(st.tuples(st.integers(0, 4), st.integers(0, 12), st.integers(0, 12)), min_size=1, max_size=9))
def test_marks_that_share_edges_corners_and_points_are_united_exactly(
    rows: list[tuple[int, int, int]],
) -> None:
    table = np.array(rows)
    marks, found = together(EXACT, table[:, 0], 2 * table[:, 1:])
    assert found is not None
    same(np.concatenate([to_polygons(found.areas), marks[found.alone]]), marks)
    for area, first in zip(to_polygons(found.areas), found.first.tolist(), strict=True):
        inside = shapely.covers(area, marks)
        assert first == np.flatnonzero(inside)[0]


@pytest.mark.parametrize(
    ("kinds", "places"),
    [
        ([0, 0], [(0, 0), (8, 4)]),
        ([0, 0], [(0, 0), (8, 8)]),
        ([2, 2], [(0, 0), (16, 0)]),
        ([0, 3], [(4, 4), (0, 0)]),
        ([0, 3], [(6, 6), (0, 0)]),
        ([0, 0, 0, 0], [(0, 0), (6, 6), (0, 12), (-6, 6)]),
        ([0, 0, 0], [(0, 0), (8, 0), (4, 8)]),
        ([0, 0, 0], [(0, 0), (0, 0), (4, 4)]),
        ([3, 0], [(0, 0), (0, 0)]),
        ([1, 1], [(0, 0), (0, 0)]),
    ],
    ids=[
        "part of an edge in common",
        "a corner in common",
        "tangent",
        "in a hole that it fills",
        "in a hole, half over its edge",
        "a ring that closes a hole",
        "three in a point",
        "one twice",
        "inside, along two edges",
        "the same",
    ],
)
def test_meetings_of_every_sort(kinds: list[int], places: Places) -> None:
    marks, made = drawn(EXACT, np.array(kinds), np.array(places))
    same(made, marks)


def test_copies_on_a_lattice_are_solved_once_for_each_surroundings(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []

    def counted(copies: Copies, sorts: Index) -> Solved | None:
        asked.append(len(sorts))
        return solved(copies, sorts)

    monkeypatch.setattr(net, "solved", counted)
    places = grid(20, 20, 1000, 1000, 500)
    marks, made = drawn(array([lobed(5, 0.25, 520)]), np.zeros(400, np.intp), places)
    assert asked[0] < 30
    wanted = shapely.transform(shapely.union_all(marks), lambda xy: np.floor(xy + 0.5))
    assert shapely.equals(shapely.union_all(made), wanted)
    # As copies of one shape or as shapes of their own, they come to the very same.
    alone = np.arange(400)
    _, other = drawn(marks, alone, np.zeros((400, 2), np.int64))
    assert (shapely.normalize(made) == shapely.normalize(other)).all()


@long
@settings(max_examples=examples(3, 40), deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(2, 60), st.floats(0.6, 2.5))
def test_marks_at_random_cover_what_geos_says(seed: int, count: int, density: float) -> None:
    rng = np.random.default_rng(seed)
    side = 1000 * (count / density) ** 0.5
    shapes = array(
        [
            lobed(
                int(rng.integers(2, 8)), float(rng.uniform(0, 0.4)), float(rng.uniform(200, 700)), float(turn)
            )
            for turn in rng.uniform(0, 7, count)
        ]
    )
    places = np.rint(rng.uniform(0, side, (count, 2))).astype(np.int64)
    marks, found = together(shapes, np.arange(count), places)
    if found is None:
        return
    made = np.concatenate([to_polygons(found.areas), marks[found.alone]])
    assert shapely.is_valid(made).all()
    whole, wanted = shapely.union_all(made), shapely.union_all(marks)
    # A crossing is off by half a step each way, and so are the edges to both sides of it.
    assert shapely.symmetric_difference(whole, wanted).area <= 0.75 * wanted.length
    assert shapely.covers(shapely.buffer(wanted, 1.5), whole)
    assert shapely.covers(shapely.buffer(whole, 1.5), wanted)
    moved = together(shapes, np.arange(count), places + np.array([12345, -777]))[1]
    assert moved is not None
    assert (moved.areas.points == found.areas.points + [12345, -777]).all()


@pytest.mark.parametrize(("size", "seed"), [(400, 1), (800, 7)])
def test_marks_that_rounding_entangles_are_united_beforehand(size: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = 300
    shapes = array(
        [
            lobed(int(rng.integers(2, 8)), 0.3, float(rng.uniform(size / 2, size)), count=30)
            for _ in range(count)
        ]
    )
    places = np.rint(rng.uniform(0, 15 * size, (count, 2))).astype(np.int64)
    asked = []

    def unite(groups: list[Geometries]) -> Geometries:
        asked.append([len(group) for group in groups])
        return overlay.united(groups)

    marks, found = together(shapes, np.arange(count), places, unite)
    assert len(asked) == 1
    assert found is not None
    made = np.concatenate([to_polygons(found.areas), marks[found.alone]])
    assert shapely.is_valid(made).all()
    whole, wanted = shapely.union_all(made), shapely.union_all(marks)
    assert shapely.symmetric_difference(whole, wanted).area <= 0.75 * wanted.length
