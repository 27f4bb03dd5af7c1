"""Repeats: what a recipe may write, and the lattice it means."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest

from batik_vector.artwork import Cell, DropAxis
from batik_vector.errors import GeometryError, RecipeError
from batik_vector.tiling.symmetry.groups import GROUPS
from batik_vector.tiling.symmetry.machine_fit import Fit
from batik_vector.tiling.symmetry.orbits import TRIVIAL
from batik_vector.tiling.symmetry.repeats import (
    MIRRORS,
    REPEAT_PATTERN,
    Cut,
    TileSpec,
    parse_repeat,
    repeat_of,
)


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


@pytest.mark.parametrize(
    "text", ["p4m", " P4MM ", "*442", "22×", "p11m", "cmm", "mirror", "mirror-x", "brick 1/4"]
)
def test_a_repeat_may_be_a_group_a_mirror_or_a_drop(text: str) -> None:
    repeat = repeat_of(text)
    assert (repeat.group is None) == ("brick" in text)
    assert repeat.mirrored == ("mirror" in text)
    # Editors know the small letters only.
    assert re.search(REPEAT_PATTERN, text.lower())


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("p4n", 'did you mean "p4"?'),
        ("miror", 'did you mean "mirror"?'),
        ("half drop", 'did you mean "half-drop"?'),
        ("zigzag", 'or a wallpaper group such as "p4m"'),
        ("drop 1/99", "q from 1 to 60"),
    ],
)
def test_what_is_no_repeat_is_told_with_the_nearest(text: str, words: str) -> None:
    with pytest.raises(GeometryError, match=re.escape(words)):
        TileSpec(size=(60.0, 60.0), repeat=text)


def test_mirror_repeats_have_the_rectangle_of_their_reflected_units() -> None:
    cells = {name: TileSpec(size=(40.001, 30.0), repeat=name).cell() for name in MIRRORS}
    assert cells == {
        "mirror": Cell(80_002, 60_000),
        "mirror-x": Cell(80_002, 30_000),
        "mirror-y": Cell(40_001, 60_000),
    }
    assert TileSpec(size=(40.001, 30.0), repeat="mirror").unit() == Cell(40_001, 30_000)
    with pytest.raises(GeometryError, match='cut = "unit" leaves the half of a mirror repeat'):
        TileSpec(size=(40.0, 30.0), repeat="mirror", cut=Cut.UNIT)


@pytest.mark.parametrize("name", GROUPS)
def test_a_groups_cell_is_its_rectangle_and_a_little_stretch_is_taken_and_told(name: str) -> None:
    ratio = GROUPS[name].kind.ratio
    spec = TileSpec(size=(60.0, 60.0 * (ratio or 0.7) * 1.004), repeat=name)
    assert spec.cell() == spec.unit() == Cell(60_000, round(60_000 * (ratio or 0.7) * 1.004))
    assert spec.stretch == pytest.approx((1.0, 1.004 if ratio else 1.0), abs=1e-5)
    assert len(spec.orbit().operations) == GROUPS[name].copies


def test_a_cell_that_is_far_off_is_refused_with_the_size_that_fits() -> None:
    with pytest.raises(RecipeError) as told:
        TileSpec(size=(120.0, 200.0), repeat="p6")
    assert str(told.value) == (
        "size[1]: p6 asks for √3 times the width as height, expected 207.846 mm and not 200 mm, "
        "a stretch by -3.77 % past the limit of 1 %"
    )
    with pytest.raises(RecipeError, match="p4g asks for a square, expected 100 mm and not 102 mm"):
        TileSpec(size=(100.0, 102.0), repeat="p4g")
    assert TileSpec(size=(100.0, 102.0), repeat="p4g", fit=Fit(limit=2.5)).stretch == (1.0, 1.02)


def test_without_a_symmetry_nothing_is_multiplied() -> None:
    for repeat in ("grid", "half-drop", "brick 1/4", "p1"):
        assert TileSpec(size=(60.0, 60.0), repeat=repeat).orbit() is TRIVIAL
