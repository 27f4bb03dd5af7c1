from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from batik_vector.geometry.outlines import of_polygons
from batik_vector.processes.hatching.crossings import Lines
from batik_vector.processes.hatching.directions import UNIT, Direction
from batik_vector.processes.hatching.serpentines import serpentines
from tests.thorough import examples, long

from .shapes import areas, lines, outlines

Place = tuple[int, int]
ANGLES = st.one_of(st.sampled_from([0.0, 30.0, 45.0, 90.0, -90.0, 180.0]), st.floats(-360, 360))
SPACINGS = st.one_of(st.sampled_from([500.0, 333.4]), st.floats(200, 3000))


def needed(shape: shapely.Polygon, direction: Direction, spacing: float) -> tuple[int, int, float]:
    """By shapely: in how many pieces lines cut a polygon, how many of them are longer than a step and a half,
    and how long all are.
    """
    along = np.array([direction.right, direction.up]) / direction.length
    left = np.array([-along[1], along[0]])
    points = shapely.get_coordinates(shape)
    low, high = (points @ left).min() / spacing, (points @ left).max() / spacing
    reach = (points @ along).min() - 1, (points @ along).max() + 1
    pieces = []
    for number in range(math.ceil(low), math.floor(high) + 1):
        ends = [number * spacing * left + each * along for each in reach]
        cut = shapely.get_parts(shape.intersection(shapely.LineString(ends)))
        pieces += [float(each.length) for each in cut if each.geom_type == "LineString"]
    return len(pieces), sum(each > 1.5 for each in pieces), sum(pieces)


@long
@settings(max_examples=examples(60, 400), deadline=None)
@given(areas(), ANGLES, SPACINGS)
def test_strokes_are_what_lines_and_areas_have_in_common(
    shapes: NDArray[np.object_], angle: float, spacing: float
) -> None:
    assume(len(shapes))
    direction = Direction.of(angle)
    strokes, marks = serpentines(of_polygons(shapes), Lines(direction, spacing), join=False)
    drawn = lines(strokes)
    for number, shape in enumerate(shapes):
        mine = drawn[marks == number]
        all_of, clear, length = needed(shape, direction, spacing)
        # A line through a corner alone may count, or not.
        assert clear - 2 <= len(mine) <= all_of + 2
        assert shapely.length(mine).sum() == pytest.approx(length, abs=2.0 * (all_of + 2))
        assert shapely.covers(shape.buffer(1.0), mine).all()
    across = direction.across(strokes.points) / direction.length
    assert (np.abs(across - np.rint(across / spacing) * spacing) <= 0.72).all()


@long
@settings(max_examples=examples(60, 400), deadline=None)
@given(areas(), ANGLES, SPACINGS)
def test_joined_strokes_are_fewer_and_stay_inside(
    shapes: NDArray[np.object_], angle: float, spacing: float
) -> None:
    assume(len(shapes))
    given = of_polygons(shapes)
    with_lines = Lines(Direction.of(angle), spacing)
    single, _ = serpentines(given, with_lines, join=False)
    joined, marks = serpentines(given, with_lines, join=True)
    assert len(joined) <= len(single)
    drawn = lines(joined)
    assert shapely.covers(shapely.buffer(shapes[marks], 1.0), drawn).all()
    assert not joined.closed.any()
    pairs = {tuple(sorted(pair)) for pair in _legs(joined.points, joined.rings)}
    assert {tuple(sorted(pair)) for pair in _legs(single.points, single.rings)} <= pairs


def _legs(
    points: NDArray[np.int64], rings: NDArray[np.int64]
) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    runs = (points[first:stop].tolist() for first, stop in itertools.pairwise(rings.tolist()))
    return [((a, b), (c, d)) for run in runs for (a, b), (c, d) in itertools.pairwise(run)]


@pytest.mark.parametrize("angle", [0, 17, 45, 90, 171.5])
def test_a_convex_area_is_one_stroke(angle: float) -> None:
    disc = outlines(shapely.Point(3, 4).buffer(20, quad_segs=64))
    strokes, _ = serpentines(disc, Lines(Direction.of(angle), 500), join=True)
    assert len(strokes) == 1


def test_a_spur_between_two_lines_is_not_gone_round() -> None:
    spur = shapely.union_all([shapely.box(0, 0, 10, 3), shapely.box(10, 1.2, 90, 1.4)])
    strokes, _ = serpentines(outlines(spur), Lines(Direction.of(0), 1000), join=True)
    assert strokes.points[:, 0].max() == 10_000
    assert len(strokes) == 2


def test_strokes_go_to_and_fro() -> None:
    box = outlines(shapely.box(0.2, 0.2, 10, 3.8))
    strokes, _ = serpentines(box, Lines(Direction.of(0), 1000), join=True)
    assert strokes.points.tolist() == [
        [200, 1000], [10000, 1000], [10000, 2000], [200, 2000], [200, 3000], [10000, 3000],
    ]  # fmt: skip


def test_lines_are_the_pages_and_not_the_shapes() -> None:
    whole = outlines(shapely.box(-7, -3, 13, 9))
    parts = outlines(shapely.box(-7, -3, 2.345, 9), shapely.box(2.345, -3, 13, 9))
    lie = Lines(Direction.of(37), 700)
    one, both = (serpentines(each, lie, join=False)[0] for each in (whole, parts))
    ink = shapely.union_all(lines(both)).buffer(1)
    assert shapely.covers(ink, lines(one)).all()
    assert shapely.length(lines(both)).sum() == pytest.approx(shapely.length(lines(one)).sum(), abs=100)


@settings(max_examples=30, deadline=None)
@given(areas(most=1), st.integers(1, 10))
def test_where_a_ring_begins_makes_no_difference(shapes: NDArray[np.object_], turn: int) -> None:
    assume(len(shapes))
    ring = shapely.get_coordinates(shapes[0].exterior)[:-1]
    holes = [hole.coords for hole in shapes[0].interiors]
    turned = np.array([shapely.Polygon(np.roll(ring, turn, axis=0)[::-1], holes)], dtype=object)
    with_lines = Lines(Direction.of(45), 500)
    a, b = (serpentines(of_polygons(each), with_lines, join=True)[0] for each in (shapes, turned))
    assert a.points.tolist() == b.points.tolist()
    assert a.rings.tolist() == b.rings.tolist()


@given(st.floats(-360, 360))
def test_directions_are_as_long_as_told_and_within_half_a_millionth(angle: float) -> None:
    direction = Direction.of(angle)
    assert direction.length == pytest.approx(UNIT, abs=1)
    turn = math.radians(angle)
    assert abs(math.sin(turn) * direction.right - math.cos(turn) * direction.up) <= 0.75


@given(st.floats(0.5, 1e6), st.integers(-(2**44), 2**44))
def test_a_line_lies_beyond_each_place_and_the_one_before_does_not(spacing: float, across: int) -> None:
    with_lines = Lines(Direction.of(0), spacing)
    number = with_lines.beyond(np.array([across]))
    assert with_lines.offsets(number)[0] > 2 * across > with_lines.offsets(number - 1)[0]
