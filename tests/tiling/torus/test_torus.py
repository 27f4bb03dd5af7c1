"""Wrapping and cutting on the torus, in whole grid steps."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.errors import TooLargeError
from batik_vector.geometry.nets.components import components
from batik_vector.tiling.torus.seams import joined, rolled, symmetric_difference
from batik_vector.tiling.torus.torus import (
    Window,
    clip_areas,
    clip_lines,
    polygons_of,
    split_at,
    to_step_grid,
    wrap,
)
from batik_vector.tiling.welding.duplicates import drawn_once
from batik_vector.tiling.welding.weld import welded

WINDOW = Window(0, 0, 1000, 700)
GRID = ((1000, 0), (0, 700))


def array(*shapes: shapely.Geometry) -> np.ndarray:
    return np.array(shapes, dtype=object)


@pytest.mark.parametrize(
    "lattice", [GRID, ((1000, 350), (0, 700)), ((1000, 0), (300, 700)), ((1000, 233), (0, 700))]
)
def test_a_mark_cut_on_the_torus_keeps_its_area_wherever_it_lies(
    lattice: tuple[tuple[int, int], tuple[int, int]],
) -> None:
    disc = shapely.transform(shapely.Point(0, 0).buffer(300), np.rint)
    for x, y in [(0, 0), (500, 350), (999, 1), (-4321, 98765), (1000, 350)]:
        marks, names = wrap(array(shapely.affinity.translate(disc, x, y)), np.zeros(1, int), lattice, WINDOW)
        pieces, _ = clip_areas(marks, names, WINDOW)
        # Each crossing is rounded by half a step at most.
        assert shapely.area(pieces).sum() == pytest.approx(disc.area, abs=100)
        assert shapely.union_all(pieces).area == pytest.approx(shapely.area(pieces).sum())


points = st.tuples(st.integers(-3000, 3000), st.integers(-3000, 3000))


@given(st.lists(points, min_size=2, max_size=8), st.integers(-5, 5), st.integers(-5, 5), st.booleans())
def test_crossings_do_not_depend_on_place_or_direction(
    line: list[tuple[int, int]], i: int, j: int, backwards: bool
) -> None:
    coords = np.array(line, np.int64)
    moved = coords + [i * 1000, j * 700]
    window = Window(i * 1000, j * 700, (i + 1) * 1000, (j + 1) * 700)
    if backwards:
        moved = moved[::-1]
    first, _ = split_at(coords, np.array([0, len(coords)]), WINDOW)
    second, _ = split_at(np.ascontiguousarray(moved), np.array([0, len(coords)]), window)
    if backwards:
        second = second[::-1]
    assert (second - [i * 1000, j * 700]).tolist() == first.tolist()


@given(st.lists(points, min_size=2, max_size=10))
def test_a_polyline_cut_on_the_torus_keeps_its_length_and_gains_no_edge(line: list[tuple[int, int]]) -> None:
    whole = shapely.remove_repeated_points(shapely.LineString(line))
    if whole.length == 0:
        return
    marks, names = wrap(array(whole), np.zeros(1, int), GRID, WINDOW)
    pieces, _ = clip_lines(marks, names, WINDOW)
    assert shapely.length(pieces).sum() == pytest.approx(whole.length, abs=2.0 * len(pieces) + 2)
    bounds = shapely.total_bounds(pieces)
    assert bounds[0] >= 0
    assert bounds[1] >= 0
    assert bounds[2] <= 1000
    assert bounds[3] <= 700


def test_a_stretch_on_the_seam_is_drawn_on_one_side() -> None:
    line = array(shapely.LineString([(0, 10), (0, 90)]))
    pieces, _ = clip_lines(*wrap(line, np.zeros(1, int), GRID, WINDOW), WINDOW)
    assert [list(p.coords) for p in pieces] == [[(0, 10), (0, 90)]]


def test_a_ring_that_begins_inside_is_cut_into_no_more_pieces_than_it_must() -> None:
    ring = array(shapely.LineString([(50, 50), (-50, 60), (-60, 80), (50, 90), (50, 50)]))
    pieces, _ = clip_lines(*wrap(ring, np.zeros(1, int), GRID, WINDOW), WINDOW)
    assert len(pieces) == 2


def test_rounding_to_the_grid_leaves_valid_polygons_only() -> None:
    rng = np.random.default_rng(3)
    stars = []
    for _ in range(300):
        angle = np.sort(rng.uniform(0, 2 * np.pi, 40))
        radius = rng.uniform(0.0005, 0.01, 40)
        star = shapely.Polygon(np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]))
        if star.is_valid:
            stars.append(star)
    snapped = to_step_grid(array(*stars))
    assert shapely.is_valid(snapped).all()
    coords = shapely.get_coordinates(snapped)
    assert np.array_equal(coords, np.rint(coords))


segment = st.tuples(st.integers(0, 6), st.integers(0, 6), st.integers(0, 6), st.integers(0, 6)).filter(
    lambda s: s[:2] != s[2:]
)


@settings(max_examples=300)
@given(st.lists(segment, min_size=1, max_size=12))
def test_nothing_is_drawn_twice_and_nothing_is_lost(segments: list[tuple[int, int, int, int]]) -> None:
    lines = array(*(shapely.LineString([s[:2], s[2:]]) for s in segments))
    once, names = drawn_once(lines, np.arange(len(lines)))
    assert len(once) == len(names)
    drawn = shapely.union_all(lines)
    assert shapely.length(once).sum() == pytest.approx(drawn.length)
    assert shapely.hausdorff_distance(shapely.union_all(once), drawn, densify=0.1) < 1e-9


intervals = st.lists(st.tuples(st.integers(0, 99), st.integers(1, 30)), max_size=6).map(
    lambda rows: joined(np.array([(a, min(a + n, 100)) for a, n in rows], np.int64).reshape(-1, 2))
)


def covered(rows: np.ndarray) -> set[int]:
    return {step for low, high in rows.tolist() for step in range(low, high)}


@given(intervals, intervals, st.integers(-250, 250))
def test_interval_sets_behave_as_sets(a: np.ndarray, b: np.ndarray, shift: int) -> None:
    assert covered(symmetric_difference(a, b)) == covered(a) ^ covered(b)
    assert covered(rolled(a, shift, 100)) == {(step + shift) % 100 for step in covered(a)}


@given(st.integers(1, 40), st.lists(st.tuples(st.integers(0, 39), st.integers(0, 39)), max_size=60))
def test_components_are_those_of_a_flood(count: int, links: list[tuple[int, int]]) -> None:
    pairs = np.array([(a % count, b % count) for a, b in links], np.intp).reshape(-1, 2)
    expected = list(range(count))
    for _ in range(count):
        for a, b in pairs.tolist():
            expected[a] = expected[b] = min(expected[a], expected[b])
    assert components(count, pairs).tolist() == expected


def test_only_areas_that_share_more_than_points_are_welded() -> None:
    squares = array(
        shapely.box(0, 0, 10, 10),
        shapely.box(10, 10, 20, 20),
        shapely.box(5, 0, 15, 5),
        shapely.box(50, 0, 60, 9),
    )
    joined, first = welded(squares)
    assert sorted(shapely.area(joined).tolist()) == [90, 100, 125]
    assert sorted(first.tolist()) == [0, 1, 3]


def test_a_needle_that_rounding_folds_does_not_flood_the_window() -> None:
    # A sliver of the paper's leaf that crosses a corner's lines within a step of one another.
    rng = np.random.default_rng(11)
    for _ in range(2000):
        x, y = rng.integers(-40, 41, 2)
        tip, side = rng.integers(-60, 61, 2), rng.integers(1, 3)
        needle = shapely.Polygon([(x - 300, y), tuple(tip), (x - 300, y + side)])
        if not needle.is_valid or needle.area == 0:
            continue
        pieces, _ = clip_areas(array(needle), np.zeros(1, int), WINDOW)
        assert shapely.area(pieces).sum() <= needle.area + 0.5 * needle.length + 1


def test_parts_are_found_however_deep_they_lie() -> None:
    several = shapely.MultiPolygon([shapely.box(0, 0, 1, 1)])
    deep = shapely.GeometryCollection([several, shapely.LineString([(0, 0), (5, 5)])])
    parts, names = polygons_of(array(deep), np.array([7]))
    assert [part.area for part in parts] == [1]
    assert names.tolist() == [7]


def test_a_mark_that_reaches_over_far_too_many_repeats_is_refused() -> None:
    mark = np.array([shapely.Point(0, 0).buffer(500_000, quad_segs=1500)], dtype=object)
    with pytest.raises(TooLargeError, match="vertices in one of them, past the limit"):
        wrap(mark, np.zeros(1, np.intp), ((10_000, 0), (0, 10_000)), Window(0, 0, 10_000, 10_000))
