"""What is asked of a tile's symmetry: a group by name, or at least the one that its recipe promises."""

from __future__ import annotations

import dataclasses
import math

import pytest

from batik_vector import certify, compile_recipe, read_recipe
from batik_vector.certificate import Asked, Limits
from batik_vector.certificate.expectations import contained
from batik_vector.errors import GeometryError, UnknownNameError
from batik_vector.tiling.symmetry.groups import GROUPS, group

ROSE = """
[motif.rose]
kind = "rosette"
elements = [{ curve = { kind = "petal", n = 3, length = 10 }, count = 4 }]

[[place]]
motif = "rose"
scale = 1

[tile]
size = [40, 40]
"""


def order(name: str) -> int:
    """Rotations and reflections of a group, translations apart."""
    row = group(name)
    return row.copies // sum(tuple(map(int, each.linear)) == (1, 0, 0, 1) for each in row.operations)


@pytest.mark.parametrize("name", GROUPS)
def test_a_group_contains_itself_its_rotations_and_nothing_of_another_kind(name: str) -> None:
    inner = contained(name)
    assert {"p1", name} <= inner
    assert all(order(each) <= order(name) and order(name) % order(each) == 0 for each in inner)
    for each in inner:
        assert contained(each) <= inner
    # A group without mirrors and glides has none in its subgroups.
    if name in ("p1", "p2", "p3", "p4", "p6"):
        assert inner <= {"p1", "p2", "p3", "p4", "p6"}


def test_the_order_alone_says_nothing() -> None:
    assert "p4" not in contained("p31m")
    assert "p3" not in contained("p4m")
    assert "pmm" in contained("p4m")


def test_more_symmetry_than_the_recipe_promises_will_do_but_not_than_is_asked_by_name() -> None:
    artwork = compile_recipe(read_recipe(ROSE))
    assert certify(artwork).group == "p4m"
    assert certify(artwork, asked=Asked("p2mm", exactly=False)).passed
    assert certify(artwork, asked=Asked("p2", exactly=False)).passed
    assert not certify(artwork, asked=Asked("p3", exactly=False)).passed
    assert not certify(artwork, asked="pmm").passed
    assert certify(artwork, asked="*442").passed


def test_a_tile_that_a_fit_stretched_is_measured_with_that_stretch() -> None:
    text = ROSE.replace("[40, 40]", '[40, 40]\nrepeat = "p4"\nfit = { width = 42, height = 40, limit = 6 }')
    artwork = compile_recipe(read_recipe(text))
    assert not certify(artwork, asked=Asked("p4", exactly=False)).passed
    assert certify(artwork, asked=Asked("p4", exactly=False, stretch=0.052)).passed


def test_an_unknown_group_is_told() -> None:
    with pytest.raises(UnknownNameError):
        Asked("p5")


@pytest.mark.parametrize("name", [field.name for field in dataclasses.fields(Limits)])
@pytest.mark.parametrize("value", [math.nan, math.inf, -1.0])
def test_a_limit_is_a_number_from_nought_on(name: str, value: float) -> None:
    with pytest.raises(GeometryError, match=name):
        Limits(**{name: value})
