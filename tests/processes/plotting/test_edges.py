from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Cell
from batik_vector.geometry.outlines import Outlines, nothing, to_polylines
from batik_vector.processes.plotting.edges import without_edges
from tests.processes.strokes import parts_of, strokes

BOX = (0, 0, 1000, 800)
STRAIGHT = ((1000, 0), (0, 800))


def ring(*points: tuple[int, int]) -> tuple[bool, list[tuple[int, int]]]:
    return True, list(points)


def bar(left: int, bottom: int, right: int, top: int) -> tuple[bool, list[tuple[int, int]]]:
    return ring((left, bottom), (right, bottom), (right, top), (left, top))


def test_what_the_page_cuts_off_has_no_line_there() -> None:
    found = without_edges(strokes(bar(0, 100, 300, 200), bar(400, 300, 500, 400)), BOX)
    assert parts_of(found) == [
        [(0, 100), (300, 100), (300, 200), (0, 200)],
        [(400, 300), (500, 300), (500, 400), (400, 400)],
    ]
    assert found.closed.tolist() == [False, True]


def test_a_tile_leaves_out_what_comes_on_both_edges() -> None:
    drawn = strokes(bar(0, 100, 300, 200), bar(700, 100, 1000, 200))
    assert [len(part) for part in parts_of(without_edges(drawn, BOX, STRAIGHT))] == [4, 4]
    assert not without_edges(drawn, BOX, STRAIGHT).closed.any()


def test_a_border_of_its_own_stays_as_far_as_it_goes() -> None:
    # The left one is higher than the right one, which goes on below a corner of its own.
    drawn = strokes(bar(0, 100, 300, 250), bar(700, 50, 1000, 200))
    left = shapely.union_all(to_polylines(without_edges(drawn, BOX, STRAIGHT)))
    for x, low, high in ((0, 200, 250), (1000, 50, 100)):
        upon = shapely.intersection(left, shapely.LineString([(x, 0), (x, 800)]))
        assert upon.length == high - low
        assert shapely.covers(upon, shapely.LineString([(x, low), (x, high)]))


def test_a_drop_brings_the_edges_together_elsewhere() -> None:
    cell = Cell(1000, 800, drop=Fraction(1, 2))
    drawn = strokes(bar(0, 600, 300, 700), bar(700, 200, 1000, 300), bar(700, 600, 1000, 700))
    found = without_edges(drawn, BOX, cell.lattice)
    assert found.closed.tolist() == [False, False, True]


HEIGHTS = st.lists(st.integers(0, 8).map(lambda k: 100 * k), min_size=2, max_size=8, unique=True).map(sorted)


@settings(max_examples=60, deadline=None)
@given(HEIGHTS, HEIGHTS, st.sampled_from([0, 300, 400]), st.booleans())
def test_it_is_the_difference_with_the_opposite_edge(
    left: list[int], right: list[int], shift: int, upright: bool
) -> None:
    def bars(ends: list[int], edge: int) -> list[shapely.Polygon]:
        inner = 10 if edge == 0 else edge - 10
        return [
            shapely.box(min(edge, inner), a, max(edge, inner), b)
            for a, b in zip(ends[::2], ends[1::2], strict=False)
        ]

    def outlines() -> Outlines:
        corners = [list(box.exterior.coords)[:-1] for box in bars(left, 0) + bars(right, 1000)]
        turned = [[(int(x), int(y)) if upright else (int(y), int(x)) for x, y in part] for part in corners]
        return strokes(*((True, part) for part in turned))

    box, shifts = (0, 0, 1000, 800), ((1000, shift), (0, 800))
    if not upright:
        box, shifts = (0, 0, 800, 1000), ((800, 0), (shift, 1000))
    found = shapely.union_all(to_polylines(without_edges(outlines(), box, shifts)))

    def stretches(ends: list[int], by: int) -> shapely.Geometry:
        lines = [
            shapely.LineString([(a + by + k, 0), (b + by + k, 0)])
            for a, b in zip(ends[::2], ends[1::2], strict=False)
            for k in (-800, 0, 800)
        ]
        return shapely.union_all(np.array(lines, dtype=object))

    for ends, others, by, edge in ((left, right, -shift, 0), (right, left, shift, 1000)):
        line = shapely.LineString([(edge, 0), (edge, 800)] if upright else [(0, edge), (800, edge)])
        mine = shapely.intersection(stretches(ends, 0), shapely.LineString([(0, 0), (800, 0)]))
        assert shapely.intersection(found, line).length == pytest.approx(
            shapely.difference(mine, stretches(others, by)).length
        )


def test_nothing_has_no_edges() -> None:
    assert len(without_edges(nothing(), BOX, STRAIGHT)) == 0
    assert len(without_edges(nothing(), BOX)) == 0
