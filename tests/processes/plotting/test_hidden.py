from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from batik_vector.geometry.outlines import Outlines, nothing, of_polygons, to_polygons, to_polylines
from batik_vector.processes.ordering.distances import PARTS
from batik_vector.processes.plotting.hidden import seen
from tests.processes.strokes import box, line, parts_of, strokes
from tests.thorough import examples, long

PLACE = st.tuples(st.integers(0, 90), st.integers(0, 90)).map(lambda place: (100 * place[0], 100 * place[1]))

SHARP = 60.0
"""What may be more or less, in steps, where a line meets an edge at a sharp angle."""


def areas(*polygons: Any) -> Outlines:
    return of_polygons(np.array(polygons, dtype=object))


def test_a_line_goes_up_to_the_area_above_it_and_on_behind_it() -> None:
    left, source, hidden = seen(strokes(line((0, 500), (5000, 500))), areas(shapely.box(1000, 0, 2000, 1000)))
    assert parts_of(left) == [[(0, 500), (1002, 500)], [(1998, 500), (5000, 500)]]
    assert source.tolist() == [0, 0]
    assert hidden / PARTS == 996


def test_it_keeps_away_by_a_margin() -> None:
    left, _, _ = seen(strokes(line((0, 500), (5000, 500))), areas(shapely.box(1000, 0, 2000, 1000)), 300)
    assert parts_of(left) == [[(0, 500), (700, 500)], [(2300, 500), (5000, 500)]]


def test_what_lies_under_it_is_gone_and_in_its_holes_it_is_not() -> None:
    ring = shapely.Polygon(
        shapely.box(0, 0, 9000, 9000).exterior, [shapely.box(3000, 3000, 6000, 6000).exterior]
    )
    drawn = strokes(box(1500, 1500, 1000), box(4500, 4500, 1000), box(20_000, 0, 1000))
    left, source, _ = seen(drawn, areas(ring))
    assert source.tolist() == [1, 2]
    assert left.closed.all()


def test_the_edge_of_an_area_is_not_under_it() -> None:
    square = shapely.box(-1000, -1000, 1000, 1000)
    left, _, hidden = seen(strokes(box(0, 0, 2000), line((1000, -500), (1000, 500))), areas(square))
    assert (len(left), hidden) == (2, 0)


def test_a_closed_stroke_that_is_cut_is_one_line_wherever_it_began() -> None:
    for turn in range(4):
        points = [(0, 0), (4000, 0), (4000, 4000), (0, 4000)]
        ring = (True, points[turn:] + points[:turn])
        left, _, _ = seen(strokes(ring), areas(shapely.box(1000, -500, 2000, 500)))
        assert (len(left), left.closed.tolist()) == (1, [False])
        assert len(left.points) == 6


@long
@settings(max_examples=examples(50, 800), deadline=None)
@given(
    st.lists(st.lists(PLACE, min_size=2, max_size=5, unique=True), min_size=1, max_size=6),
    st.lists(st.lists(PLACE, min_size=3, max_size=7, unique=True), min_size=1, max_size=4),
    st.sampled_from([0, 0, 200]),
)
def test_it_is_the_difference(lines: Any, shapes: Any, margin: int) -> None:
    # Areas of an artwork are valid on whole steps, and so are these; what is made of them is not on steps.
    polygons = [shapely.set_precision(shapely.buffer(shapely.Polygon(shape), 0), 1.0) for shape in shapes]
    cover = areas(*(part for shape in polygons for part in shapely.get_parts(shape)))
    assume(len(cover))
    parts = to_polygons(cover)
    drawn = strokes(*(line(*points) for points in lines))
    left, source, hidden = seen(drawn, cover, margin)
    whole = shapely.union_all(parts)
    inside, outside = whole.buffer(margin - 4), whole.buffer(margin + 4)
    given_lines, found = to_polylines(drawn), to_polylines(left)
    total = sum(shapely.length(found)) + hidden / PARTS
    assert total == pytest.approx(sum(shapely.length(given_lines)), abs=2 * len(left) + 1)
    for number, each in enumerate(given_lines):
        mine = shapely.union_all(found[source == number])
        # Nothing deep inside is left, and nothing well outside is lost.
        assert shapely.intersection(mine, inside).length <= SHARP
        lost = shapely.difference(shapely.difference(each, outside), shapely.buffer(mine, 2))
        assert lost.length <= SHARP


def test_a_needle_that_all_but_meets_another_area_stays_a_cover() -> None:
    # An inward buffer with mitres makes a hole of this triangle (shapely 2.1, GEOS 3.13).
    needle = shapely.Polygon([(0, 0), (100, 0), (1600, 5600)])
    other = shapely.Polygon([(900, 5500), (5100, 6400), (4779, 5997)])
    left, _, _ = seen(strokes(line((40, 60), (100, 100))), areas(needle, other))
    assert len(left) == 0


def test_nothing_shows_between_areas_that_meet() -> None:
    two = areas(
        shapely.box(0, 0, 1000, 1000), shapely.box(1000, 0, 2000, 1000), shapely.box(2003, 0, 3000, 1000)
    )
    left, _, _ = seen(strokes(line((500, 500), (2500, 500)), line((1000, 100), (1000, 900))), two)
    assert len(left) == 0


def test_nothing_hides_nothing() -> None:
    drawn = strokes(line((0, 0), (10, 10)))
    assert seen(drawn, nothing())[0] is drawn
    assert len(seen(nothing(), areas(shapely.box(0, 0, 9, 9)))[0]) == 0
