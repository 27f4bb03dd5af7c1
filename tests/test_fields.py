"""Bounds are checked where a value is built, at no cost for what it does not say."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Annotated, Any

import pytest

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Length, Says, _outside, check, hint_of
from batik_vector.model import Recipe
from batik_vector.reading.hints import Hint, members
from batik_vector.values import frozen


@frozen(kw_only=True)
class Sized:
    """A base whose field its heirs have too."""

    size: Annotated[float, Between(0, 10), Says("a number")] = 1.0

    def __post_init__(self) -> None:
        check(self)


@frozen(kw_only=True)
class Several(Sized):
    """Numbers in every shape that bounds come in."""

    count: Annotated[Annotated[int, Between(1, 5)] | None, Says("or none")] = None
    pair: tuple[Annotated[float, Between(-1, 1)], float] = (0.0, 0.0)
    many: Annotated[tuple[Annotated[Length, Between(0, 9)], ...], Says("any number of them")] = ()
    name: str = ""


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"size": 11}, "size = 11, expected 0 to 10"),
        ({"size": float("nan")}, "size = nan, expected 0 to 10"),
        ({"size": -float("inf")}, "size = -inf, expected 0 to 10"),
        ({"count": 0}, "count = 0, expected 1 to 5"),
        ({"pair": (2.0, 5.0)}, "pair = 2.0, expected -1 to 1"),
        ({"many": [1.0, 10.0]}, "many = 10.0, expected 0 to 9"),
    ],
)
def test_a_number_outside_its_bounds_is_refused(given: dict[str, Any], words: str) -> None:
    with pytest.raises(GeometryError) as raised:
        Several(**given)
    assert str(raised.value) == words


def test_numbers_within_their_bounds_pass() -> None:
    assert Several(size=0, count=5, pair=(-1, 99.0), many=(0, 9), name="a").count == 5
    assert Several(size=10).size == 10


def test_types_are_looked_up_once_and_only_for_what_is_said() -> None:
    @frozen
    class Fresh(Sized):
        """Not looked at by any other test."""

        other: Annotated[int, Between(0, 3)] = 1

    def looked_up() -> int:
        return hint_of.cache_info().misses

    before = looked_up()
    Fresh()
    assert looked_up() == before
    Fresh(other=2)
    assert looked_up() == before + 1
    Fresh(other=3)
    assert looked_up() == before + 1


def classes(hint: Hint, seen: dict[type, None]) -> Iterator[type]:
    """Every dataclass that a recipe can come to hold."""
    for inner in (*hint.items, *([hint.item] if hint.item else [])):
        yield from classes(inner, seen)
    found = list(hint.one_of.load().values()) if hint.one_of else [hint.base]
    for cls in found:
        if dataclasses.is_dataclass(cls) and cls not in seen:
            seen[cls] = None
            yield cls
            for member in members(cls).values():
                yield from classes(member.hint, seen)


@pytest.mark.parametrize("cls", list(classes(Hint(Recipe), {})), ids=lambda cls: cls.__name__)
def test_defaults_which_are_not_checked_lie_within_their_bounds(cls: type) -> None:
    for field in dataclasses.fields(cls):
        if field.default is not dataclasses.MISSING:
            assert list(_outside(hint_of(cls, field.name), field.default)) == []
