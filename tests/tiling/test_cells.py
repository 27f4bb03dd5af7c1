"""Repeats: what a recipe may write, and the lattice it means."""

from __future__ import annotations

from fractions import Fraction

import pytest

from batik_vector.artwork import Cell, DropAxis
from batik_vector.errors import GeometryError
from batik_vector.tiling.cells import Cut, TileSpec, parse_repeat


@pytest.mark.parametrize(
    ("text", "drop", "axis"),
    [
        ("grid", Fraction(0), DropAxis.COLUMN),
        ("half-drop", Fraction(1, 2), DropAxis.COLUMN),
        ("brick", Fraction(1, 2), DropAxis.ROW),
        ("drop 1/3", Fraction(1, 3), DropAxis.COLUMN),
        ("Drop 2 / 6", Fraction(1, 3), DropAxis.COLUMN),
        ("brick 3/4", Fraction(3, 4), DropAxis.ROW),
        ("drop 5/3", Fraction(2, 3), DropAxis.COLUMN),
    ],
)
def test_repeats(text: str, drop: Fraction, axis: DropAxis) -> None:
    assert parse_repeat(text) == (drop, axis)


@pytest.mark.parametrize(
    "text", ["half drop", "drop", "drop 1/0", "drop 1/61", "drop 0.5", "p4m", "", "drop -1/2"]
)
def test_what_is_no_repeat_is_refused_with_what_is(text: str) -> None:
    with pytest.raises(GeometryError, match=r"expected .*p/q"):
        parse_repeat(text)


def test_a_drop_is_given_back_as_the_smallest_rectangle_that_repeats_straight() -> None:
    spec = TileSpec(size=(100.0, 60.0), repeat="drop 1/3")
    assert spec.unit().lattice == ((100_000, 20_000), (0, 60_000))
    assert spec.cell() == Cell(300_000, 60_000)
    brick = TileSpec(size=(100.0, 60.0), repeat="brick 1/4")
    assert brick.unit().lattice == ((100_000, 0), (25_000, 60_000))
    assert brick.cell() == Cell(100_000, 240_000)


def test_a_drop_lands_on_the_grid_by_the_smallest_stretch() -> None:
    unit = TileSpec(size=(100.0, 100.0), repeat="drop 1/3", cut=Cut.UNIT).cell()
    assert (unit.columns, unit.rows) == (100_000, 99_999)
    with pytest.raises(ValueError, match="does not land on the grid"):
        Cell(100_000, 100_000, Fraction(1, 3))
