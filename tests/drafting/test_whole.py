"""Marks taken whole: what the edges of a page cut is one mark again, and no mark is there twice."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Cell, DropAxis
from batik_vector.drafting.marks import Painted
from batik_vector.drafting.whole import Whole, made_whole
from tests.drafting.test_copies import array

CELL = Cell(100_000, 80_000)
DISC = shapely.Point(0, 0).buffer(12)


def disc(x: float, y: float) -> shapely.Geometry:
    return shapely.transform(DISC, lambda xy: xy + [x, y])


def whole(*shapes: shapely.Geometry, cell: Cell = CELL, ink: list[int] | None = None) -> Whole:
    inks = np.array(ink or [0] * len(shapes))
    painted = Painted(array(*shapes), inks, np.full(len(shapes), "", dtype=object), ("#000000", "#ff0000"))
    return made_whole(painted, cell, 0.02)


def test_what_is_drawn_at_both_edges_is_one_mark() -> None:
    found = whole(disc(3, 40), disc(103, 40), disc(50, 40))
    assert len(found.marks) == 2
    assert len(found.pieces) == 0
    # The one is taken of which the page shows more.
    assert sorted(shapely.get_x(shapely.centroid(found.marks.shapes)).round(6).tolist()) == [3, 50]


def test_what_is_drawn_at_four_corners_is_one_mark() -> None:
    found = whole(disc(1, 1), disc(101, 1), disc(1, 81), disc(101, 81))
    assert len(found.marks) == 1
    assert shapely.area(found.marks.shapes)[0] == pytest.approx(DISC.area)


def test_a_drop_says_where_a_twin_lies() -> None:
    cell = Cell(100_000, 80_000, Fraction(1, 2))
    assert cell.axis == DropAxis.COLUMN
    assert len(whole(disc(100, 20), disc(0, 60), cell=cell).marks) == 1


@pytest.mark.parametrize("cut", [True, False])
def test_halves_are_joined_where_they_are_drawn_apart(cut: bool) -> None:
    page = shapely.box(0, 0, 100, 80)
    halves = [disc(0, 40), disc(100, 40)]
    if cut:
        halves = [shapely.intersection(each, page) for each in halves]
    else:
        # One reaches over the edge, and its other half is drawn as a half.
        halves[1] = shapely.intersection(halves[1], page)
    found = whole(*halves)
    assert len(found.marks) == 1
    assert shapely.area(found.marks.shapes)[0] == pytest.approx(DISC.area, rel=1e-4)


def test_what_the_page_cuts_off_stays_cut_off() -> None:
    found = whole(disc(3, 40))
    assert shapely.bounds(found.marks.shapes)[0][0] == 0.0
    assert shapely.area(found.marks.shapes)[0] < DISC.area


def test_bars_have_no_end() -> None:
    found = whole(shapely.box(-5, 10, 105, 20), shapely.box(40, 40, 60, 50))
    assert len(found.marks) == 1
    assert found.pieces.shapes[0].equals(shapely.box(0, 10, 100, 20))


def test_marks_keep_their_order_and_ink() -> None:
    found = whole(shapely.box(-5, 10, 105, 20), disc(50, 15), disc(3, 60), disc(103, 60), ink=[1, 0, 1, 1])
    assert found.marks.ink.tolist() == [0, 1]
    assert found.pieces.ink.tolist() == [1]
    assert found.order.tolist()[0] == 1
    assert found.order.tolist()[-1] == 0
