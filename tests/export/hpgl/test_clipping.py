from __future__ import annotations

import itertools

import numpy as np
import shapely
from hypothesis import given
from hypothesis import strategies as st

from batik_vector.export.hpgl.clipping import clipped
from batik_vector.geometry.outlines import Outlines
from tests.processes.strokes import box, line, strokes

place = st.tuples(st.integers(-60, 60), st.integers(-60, 60))
parts = st.lists(st.tuples(st.booleans(), st.lists(place, min_size=2, max_size=8)), min_size=1, max_size=5)
WINDOW = (-30, -20, 25, 35)


def cut(made: Outlines, window: tuple[int, int, int, int] = WINDOW) -> list[list[tuple[int, int]]]:
    points, offsets = made.repeating()
    points, offsets = clipped(points, offsets, made.closed, window)
    assert offsets[-1] == len(points)
    return (
        [[tuple(each) for each in part.tolist()] for part in np.split(points, offsets[1:-1])]
        if len(points)
        else []
    )


def lines(found: list[list[tuple[int, int]]]) -> shapely.MultiLineString:
    return shapely.MultiLineString([part for part in found if len(part) > 1])


@given(parts)
def test_what_is_left_is_what_lies_within(given_parts: list[tuple[bool, list[tuple[int, int]]]]) -> None:
    made = strokes(*given_parts)
    points, offsets = made.repeating()
    segments = [pair for part in np.split(points, offsets[1:-1]) for pair in itertools.pairwise(part)]
    whole = shapely.linestrings(segments)
    window = shapely.box(*WINDOW)
    found = lines(cut(made))
    assert found.is_empty or window.covers(found)
    within = shapely.intersection(whole, window)
    # A place on the edge is a whole number, so that it may lie half a unit off.
    assert abs(shapely.length(within).sum() - found.length) <= 2 * len(segments)
    places = np.asarray(shapely.points(shapely.get_coordinates(found)))
    assert (shapely.distance(places[:, None], whole).min(axis=1) <= 1).all()


def test_a_ring_that_leaves_once_stays_in_one_piece() -> None:
    for start in range(4):
        closed, corners = box(0, 0, 40)
        turned = corners[start:] + corners[:start]
        (left,) = cut(strokes((closed, turned)), (-100, -100, 10, 100))
        assert left == [(10, 20), (-20, 20), (-20, -20), (10, -20)]


def test_what_lies_within_is_left_as_it_is_and_what_lies_beyond_goes() -> None:
    made = strokes(box(0, 0, 10), line((100, 0), (200, 5)), line((-5, 0), (5, 0)))
    found = cut(made)
    assert [(-5, -5), (5, -5), (5, 5), (-5, 5), (-5, -5)] in found
    assert [(-5, 0), (5, 0)] in found
    assert len(found) == 2


def test_the_order_and_direction_of_strokes_stay() -> None:
    found = cut(strokes(line((0, 100), (0, -100)), line((5, 0), (100, 0), (100, 1), (6, 1))))
    assert found == [[(0, 35), (0, -20)], [(5, 0), (25, 0)], [(25, 1), (6, 1)]]
