"""Which groups a repeat admits, and what their operations do to its lattice."""

from __future__ import annotations

import itertools
from fractions import Fraction

import numpy as np
import pytest

from batik_vector.artwork import Cell, DropAxis
from batik_vector.errors import GeometryError
from batik_vector.tiling.symmetry.groups import GROUPS, Kind
from batik_vector.tiling.symmetry.spread import Frame, Spread, fits, fitting, lattice_of, orbit_of, shapes_of

HALF = Fraction(1, 2)
UPRIGHT = ["p1", "p2", "pm", "pg", "cm", "pmm", "pmg", "pgg", "cmm"]
SQUARE = [*UPRIGHT, "p4", "p4m", "p4g"]
HEXAGONAL = [*UPRIGHT, "p3", "p3m1", "p31m", "p6", "p6m"]


def frame(cell: Cell) -> Frame:
    return Frame(cell, shapes_of(cell))


@pytest.mark.parametrize(
    ("cell", "expected"),
    [
        (Cell(100_000, 80_000), UPRIGHT),
        (Cell(100_000, 100_000), SQUARE),
        (Cell(100_000, 173_205), HEXAGONAL),
        (Cell(100_000, 80_000, HALF), UPRIGHT),
        (Cell(100_000, 80_000, HALF, DropAxis.ROW), UPRIGHT),
        (Cell(50_000, 100_000, HALF), SQUARE),
        (Cell(50_000, 173_206, HALF), HEXAGONAL),
        (Cell(90_000, 60_000, Fraction(1, 3)), ["p1", "p2"]),
        # Points (1, 2) and (0, 5) make a square lattice that no mirror brings onto itself.
        (Cell(10_000, 50_000, Fraction(2, 5)), ["p1", "p2", "p4"]),
        (Cell(10_000, 50_000, Fraction(1, 5)), ["p1", "p2"]),
    ],
)
def test_a_repeat_admits_the_groups_that_bring_it_onto_itself(cell: Cell, expected: list[str]) -> None:
    assert fitting(frame(cell)) == expected


@pytest.mark.parametrize(
    "cell",
    [
        Cell(100_000, 100_000),
        Cell(100_000, 173_205),
        Cell(50_000, 100_000, HALF),
        Cell(80_000, 60_000, HALF, DropAxis.ROW),
        Cell(10_000, 50_000, Fraction(2, 5)),
    ],
)
def test_operations_bring_the_translations_onto_translations_of_the_drawing(cell: Cell) -> None:
    for name in fitting(frame(cell)):
        orbit = orbit_of(GROUPS[name], frame(cell))
        basis = np.array(orbit.periods)
        moves = [
            np.array([each.e, each.f]) for each in orbit.operations if (each.a, each.d, each.b) == (1, 1, 0)
        ]
        for each, step in itertools.product(orbit.operations, basis):
            image = np.array([each.a * step[0] + each.b * step[1], each.c * step[0] + each.d * step[1]])
            shares = [(image - move) @ np.linalg.inv(basis) for move in moves]
            assert min(np.abs(share - np.rint(share)).max() for share in shares) < 1e-5


@pytest.mark.parametrize(
    ("cell", "name", "copies"),
    [
        (Cell(100_000, 80_000), "cm", 4),
        (Cell(100_000, 80_000, HALF), "cm", 2),
        (Cell(100_000, 80_000, HALF), "pm", 2),
        (Cell(100_000, 80_000, HALF), "cmm", 4),
        (Cell(90_000, 60_000, Fraction(1, 3)), "p2", 2),
        (Cell(10_000, 50_000, Fraction(2, 5)), "p4", 4),
        (Cell(100_000, 173_205), "p6m", 24),
    ],
)
def test_translations_of_the_drop_count_once(cell: Cell, name: str, copies: int) -> None:
    assert len(orbit_of(GROUPS[name], frame(cell)).operations) == copies


def test_a_group_that_does_not_fit_is_refused_with_those_that_do() -> None:
    with pytest.raises(
        GeometryError, match=r"p4 does not .* rectangle is 100 × 80 mm.* expected one of p1, p2"
    ):
        orbit_of(GROUPS["p4"], frame(Cell(100_000, 80_000)))


@pytest.mark.parametrize("axis", DropAxis)
@pytest.mark.parametrize("name", ["p1", "p2", "cm", "cmm"])
def test_the_region_of_a_drop_fills_its_unit(name: str, axis: DropAxis) -> None:
    cell = Cell(90_000, 60_000, HALF, axis)
    orbit = orbit_of(GROUPS[name], frame(cell), spread=Spread.CUT)
    assert orbit.region is not None
    shape = orbit.region.shape((False,) * len(orbit.region.corners))
    assert shape.area * len(orbit.operations) == pytest.approx(90_000 * 60_000)


def test_a_region_that_a_drop_would_divide_is_refused() -> None:
    with pytest.raises(GeometryError, match=r"expected p1 or p2 \(try cm or cmm\)"):
        orbit_of(GROUPS["pm"], frame(Cell(90_000, 60_000, HALF)), spread=Spread.CUT)


def test_a_phase_moves_the_origin_of_the_operations_and_of_the_placement() -> None:
    still = orbit_of(GROUPS["p2"], frame(Cell(90_000, 60_000)))
    moved = orbit_of(GROUPS["p2"], frame(Cell(90_000, 60_000)), (10.0, 5.0))
    assert (moved.base.e, moved.base.f) == (10.0, 5.0)
    point = np.array([[33.0, 7.0]])
    for before, after in zip(still.operations, moved.operations, strict=True):
        assert after.at(point + [10.0, 5.0]) == pytest.approx(before.at(point) + [10.0, 5.0])


def test_a_stretch_is_seen_by_the_operations_and_by_what_is_placed() -> None:
    cell = Cell(100_000, 101_000)
    orbit = orbit_of(GROUPS["p4"], Frame(cell, frozenset(Kind), (1.0, 1.01)))
    quarter = orbit.operations[1]
    assert quarter.at(np.array([[10.0, 0.0]]))[0] == pytest.approx([0.0, 10.1])
    assert (orbit.base.a, orbit.base.d) == (1.0, 1.01)


@pytest.mark.parametrize("name", GROUPS)
def test_the_default_place_of_centre_is_the_middle_of_the_region(name: str) -> None:
    cell = Cell(60_000, round(60_000 * (GROUPS[name].kind.ratio or 0.8)))
    orbit = orbit_of(GROUPS[name], frame(cell), spread=Spread.CENTRE)
    assert orbit.middle == (0.0, 0.0)
    places = np.array([each.at(np.array([[orbit.base.e, orbit.base.f]]))[0] for each in orbit.operations])
    shares = places / [cell.width, cell.height] % 1.0
    assert len(np.unique(np.round(shares, 6), axis=0)) == GROUPS[name].copies


def test_lattices_in_fractions() -> None:
    zero, one, third = Fraction(0), Fraction(1), Fraction(1, 3)
    assert lattice_of(Cell(3, 3, third)) == ((third, third), (zero, one))
    assert lattice_of(Cell(3, 3, 2 * third, DropAxis.ROW)) == ((one, zero), (2 * third, third))
    assert fits(GROUPS["p2"], frame(Cell(60, 60, Fraction(7, 60))))
