"""Stretches drawn again: all of them, and no more, on and off the grid."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import affinity

from batik_vector.audit import Kind, audit
from batik_vector.audit.doubles import doubles
from batik_vector.machines import Limits, Machine, Twice
from tests.audit.tiles import tile

whole = st.integers(-8, 8)
ways = st.sampled_from([(1, 0), (0, 1), (3, 2), (-5, 7), (2, -4)])
edges = st.lists(st.tuples(ways, st.tuples(whole, whole), st.integers(1, 6)), min_size=1, max_size=8)

AGAIN = Machine(limits=Limits(twice=Twice.ALL))


@given(edges)
def test_what_is_drawn_again_is_what_the_union_lacks(
    drawn: list[tuple[tuple[int, int], tuple[int, int], int]],
) -> None:
    begin = np.array([at for _, at, _ in drawn], float)
    end = begin + np.array([(x * times, y * times) for (x, y), _, times in drawn], float)
    found = doubles(begin, end)
    lines = [shapely.LineString(ends) for ends in np.stack([begin, end], axis=1)]
    pairs = [shapely.intersection(a, b).length for i, a in enumerate(lines) for b in lines[:i]]
    assert np.hypot(*(found.end - found.begin).T).sum() == pytest.approx(sum(pairs))
    assert (found.again > found.first).all()
    for k, which in enumerate(found.again):
        assert lines[which].distance(shapely.Point(found.begin[k])) < 1e-9
        assert lines[found.first[k]].distance(shapely.Point(found.end[k])) < 1e-9


@given(st.floats(0, 360), st.floats(0, 0.004))
def test_lines_off_the_grid_that_all_but_coincide_are_one_line(turn: float, apart: float) -> None:
    line = shapely.LineString([(-20, 0), (20, 0)])
    other = shapely.LineString([(-20, apart), (20, apart)])
    marks = [
        affinity.translate(affinity.rotate(each, turn, (0, 0)), 60.12345, 50.54321) for each in (line, other)
    ]
    (found,) = audit(tile([], marks), AGAIN).findings
    assert found.kind == Kind.DOUBLE
    assert found.value == pytest.approx(40, abs=0.1)
    assert shapely.Point(found.where).distance(marks[0]) < 0.1


def test_circles_that_touch_share_nothing() -> None:
    rings = [shapely.Point(50 + 20 * i, 50).buffer(10, 64).exterior for i in range(2)]
    assert audit(tile([], rings), AGAIN).findings == ()


def test_lines_that_share_a_place_in_the_table_are_told_apart() -> None:
    # More edges than a block, none of them on one line but two.
    rows = np.arange(70_000, dtype=float)
    begin = np.column_stack([3 * rows, 7 * rows % 1009])
    end = begin + np.column_stack([1000 + rows, np.full(len(rows), 31.0)])
    begin[69_999], end[69_999] = begin[5], end[5]
    found = doubles(begin, end)
    assert found.again.tolist() == [69_999]
    assert found.first.tolist() == [5]
