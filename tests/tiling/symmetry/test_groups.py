"""The seventeen groups: each is a group, has its known number of copies, and fills the cell once."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from fractions import Fraction

import pytest
import shapely

from batik_vector.errors import UnknownNameError
from batik_vector.tiling.symmetry.groups import (
    GROUPS,
    IDENTITY,
    TRANSPOSED,
    Group,
    Kind,
    Operation,
    Pair,
    group,
    multiplied,
    parse_operation,
    whole_cells,
)

# fmt: off
COPIES = {
    "p1": 1, "p2": 2, "pm": 2, "pg": 2, "cm": 4, "pmm": 4, "pmg": 4, "pgg": 4, "cmm": 8, "p4": 4, "p4m": 8,
    "p4g": 8, "p3": 6, "p3m1": 12, "p31m": 12, "p6": 12, "p6m": 24,
}
ALIASES = {
    "p2mm": "pmm", "p2mg": "pmg", "p2gg": "pgg", "c2mm": "cmm", "p4mm": "p4m", "p4gm": "p4g", "p6mm": "p6m",
    "*442": "p4m", "4*2": "p4g", "442": "p4", "*333": "p3m1", "3*3": "p31m", "2*22": "cmm", "22*": "pmg",
    "22×": "pgg", "22x": "pgg", "*×": "cm", "xx": "pg", "**": "pm", "o": "p1", "*632": "p6m", "632": "p6",
    "333": "p3", "2222": "p2", "*2222": "pmm", " P4M ": "p4m", "p1m1": "pm",
}
NATURE = {
    "p1": (1, False, False), "p2": (2, False, False), "pm": (1, True, False), "pg": (1, False, True),
    "cm": (1, True, False), "pmm": (2, True, False), "pmg": (2, True, True), "pgg": (2, False, True),
    "cmm": (2, True, False), "p4": (4, False, False), "p4m": (4, True, False), "p4g": (4, True, True),
    "p3": (3, False, False), "p3m1": (3, True, False), "p31m": (3, True, False), "p6": (6, False, False),
    "p6m": (6, True, False),
}
"""Highest turn; whether there are mirrors; whether some glide is no mirror followed by a lattice move."""
# fmt: on
every = pytest.mark.parametrize("name", GROUPS)


def reduced(operation: Operation) -> Operation:
    return operation.reduced(whole_cells)


def size_of(turn: Operation) -> int:
    """The order of the linear part."""
    power, count = turn, 1
    while power.linear != IDENTITY.linear:
        power, count = power @ turn, count + 1
    return count


def reflects(operation: Operation) -> bool:
    return operation.a * operation.d - operation.b * operation.c < 0


def test_there_are_seventeen_with_their_copies_in_a_rectangle() -> None:
    assert {name: each.copies for name, each in GROUPS.items()} == COPIES


@every
def test_the_operations_are_a_group_modulo_whole_cells(name: str) -> None:
    operations = GROUPS[name].operations
    assert operations[0] == IDENTITY
    known = set(operations)
    assert len(known) == len(operations)
    assert {reduced(one @ other) for one, other in itertools.product(operations, operations)} == known
    # In a hexagonal group whole cells are no normal subgroup: inverses of two classes may fall into one.
    assert {reduced(one.inverse()) for one in operations} <= known
    assert all(one @ one.inverse() == IDENTITY for one in operations)


@every
def test_the_operations_are_isometries_of_the_cell(name: str) -> None:
    height = GROUPS[name].kind.ratio or 0.7
    for each in GROUPS[name].operations:
        a, b, c, d = float(each.a), float(each.b) / height, float(each.c) * height, float(each.d)
        assert a * a + c * c == pytest.approx(1)
        assert b * b + d * d == pytest.approx(1)
        assert a * b + c * d == pytest.approx(0, abs=1e-12)


@every
def test_the_region_fills_the_cell_once(name: str) -> None:
    known = GROUPS[name]
    area = sum((p[0] * q[1] - p[1] * q[0] for p, q in known.edges()), Fraction(0)) / 2
    assert area == Fraction(1, known.copies)
    cell = shapely.box(0, 0, 1, 1)
    pieces = []
    for each in known.operations:
        corners = [each.at(corner) for corner in known.region]
        for i, j in itertools.product(range(-2, 3), repeat=2):
            image = shapely.Polygon([(float(x + i), float(y + j)) for x, y in corners])
            pieces.append(shapely.intersection(image, cell))
    assert sum(piece.area for piece in pieces) == pytest.approx(1)
    assert shapely.union_all(pieces).area == pytest.approx(1)


@every
def test_a_point_of_the_regions_middle_has_all_its_images_and_touches_no_mirror(name: str) -> None:
    known = GROUPS[name]
    assert len({whole_cells(each.at(known.centre)) for each in known.operations}) == known.copies
    corner = {whole_cells(each.at(known.region[0])) for each in known.operations}
    # The first corner is a centre of the highest turn, or lies on a mirror; p1 and pg have neither.
    assert len(corner) < known.copies or name in ("p1", "pg", "pmg")


def lattice_moves(known: Group) -> list[tuple[Fraction, Fraction]]:
    return [
        (x + i, y + j) for x, y in known.translations for i, j in itertools.product(range(-2, 3), repeat=2)
    ]


def mirrors(known: Group) -> list[Operation]:
    """The reflections that leave a line where it is, lattice moves tried."""
    moved = [
        replace(each, e=each.e + e, f=each.f + f)
        for each in known.operations
        for e, f in lattice_moves(known)
        if reflects(each)
    ]
    return [each for each in moved if each @ each == IDENTITY]


@every
def test_each_has_the_turns_mirrors_and_glides_of_its_name(name: str) -> None:
    known = GROUPS[name]
    turn = max(size_of(each) for each in known.operations if not reflects(each))
    found = {each.linear for each in mirrors(known)}
    glides = {each.linear for each in known.operations if reflects(each)} - found
    assert (turn, bool(found), bool(glides)) == NATURE[name]


@pytest.mark.parametrize(("name", "expected"), [("p3m1", True), ("p31m", False)])
def test_all_threefold_centres_lie_on_mirrors_in_p3m1_and_not_in_p31m(name: str, expected: bool) -> None:
    known = GROUPS[name]
    centres = set()
    for each in known.operations:
        for e, f in lattice_moves(known) if not reflects(each) and size_of(each) == 3 else ():
            turn = replace(each, e=each.e + e, f=each.f + f)
            # The centre of a third of a turn is the mean of a point's three images.
            (x, y), (u, v) = turn.shift, turn.at(turn.shift)
            centres.add(whole_cells(((x + u) / 3, (y + v) / 3)))
    on_mirror = {centre for centre in centres if any(lies_on(centre, each) for each in mirrors(known))}
    assert len(centres) == 6
    assert (on_mirror == centres) == expected
    assert on_mirror


def lies_on(point: Pair, mirror: Operation) -> bool:
    x, y = mirror.at(point)
    return (x, y) == point


@pytest.mark.parametrize(("alias", "name"), ALIASES.items())
def test_groups_go_by_all_their_names(alias: str, name: str) -> None:
    assert group(alias) is GROUPS[name]


def test_settings_with_level_mirrors_are_the_same_groups_turned() -> None:
    for alias, name in TRANSPOSED.items():
        turned = group(alias)
        assert turned.name == name
        assert {each.transposed() for each in turned.operations} == set(GROUPS[name].operations)
        assert sum((p[0] * q[1] - p[1] * q[0] for p, q in turned.edges()), Fraction(0)) > 0
    assert group("p11m").generators == (parse_operation("x, -y"),)


@pytest.mark.parametrize(
    ("wrong", "near"), [("p4n", "p4"), ("p6mn", "p6m"), ("p2ng", "p2mg"), ("*44", "*442")]
)
def test_an_unknown_group_is_told_with_the_nearest(wrong: str, near: str) -> None:
    with pytest.raises(UnknownNameError) as told:
        group(wrong)
    assert str(told.value) == f'unknown group "{wrong}": did you mean "{near}"?'


def test_operations_that_generate_no_group_are_refused() -> None:
    with pytest.raises(ValueError, match="no group"):
        multiplied([parse_operation("x + y, y + 1/7919")])


def test_hexagonal_cells_are_root_three_high() -> None:
    assert Kind.HEXAGONAL.ratio == pytest.approx(math.sqrt(3))
