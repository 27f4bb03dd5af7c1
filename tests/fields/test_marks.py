"""Bounds are checked where a value is built, at no cost for what it does not say."""

from __future__ import annotations

import dataclasses
import importlib
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import pytest

from batik_vector import InkSpec, Placement, Recipe, TileSpec, compile_recipe
from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Length, Says, check, given, hint_of
from batik_vector.recipe.reading.field_types import Hint, members
from batik_vector.tiling.layouts import Ring
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
        # What is empty is left out.
        if field.default is not dataclasses.MISSING and field.default != "":
            assert given(field.default, hint_of(cls, field.name), field.name) == field.default


OWN = """
import math
from typing import Annotated

import numpy as np

from batik_vector import Element, Rosette
from batik_vector.fields import Between, Says
from batik_vector.geometry.curves import Curve
from batik_vector.values import frozen


@frozen
class Heart(Curve):
    "Heart, x = sin(2πt)^3."

    width: Annotated[float, Between(0.1, 10), Says("breadth")] = 1.0
    later: "Annotated[tuple[Late, ...], Says('of a class that comes after')]" = ()

    def at(self, t):
        turn = 2 * np.pi * t
        return np.column_stack([self.width * np.sin(turn) ** 3, np.cos(turn) - np.cos(2 * turn) / 3])


@frozen
class Broad(Heart):
    "A heart with a field more."

    height: Annotated[float, Between(0.1, 10)] = 1.0


class Late:
    pass


star = Rosette(elements=(Element(curve=Broad(width=2.0), name="heart", count=5),))
"""


@pytest.mark.parametrize("future", ["", "from __future__ import annotations\n"])
def test_curves_of_ones_own_are_made_with_and_without_deferred_annotations(
    future: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Annotations are text, types, or from Python 3.14 on not yet worked out."""
    name = f"own_{bool(future)}".lower()
    (tmp_path / f"{name}.py").write_text(future + OWN, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    own: Any = importlib.import_module(name)
    tile = TileSpec(size=(100.0, 100.0))
    place = (Placement(motif="star", layout=Ring(count=6, radius=2.2), width=90.0),)
    recipe = Recipe(motif={"star": own.star}, place=place, ink={"wax": InkSpec()}, tile=tile)
    assert len(compile_recipe(recipe).layers[0].areas) > 0
    with pytest.raises(GeometryError, match=r"width = 99, expected 0\.1 to 10"):
        own.Heart(width=99)
    with pytest.raises(GeometryError, match=r"height = 0, expected 0\.1 to 10"):
        own.Broad(height=0)
    assert hint_of(own.Broad, "later").__origin__.__args__ == (own.Late, ...)


def test_bounds_are_known_where_a_class_keeps_no_annotations() -> None:
    """From Python 3.14 on they are no longer in its dictionary; here they are taken out of it."""

    @frozen
    class Bare:
        """Has nothing but what the dataclass has read."""

        size: Annotated[float, Between(0, 10)] = 1.0

        def __post_init__(self) -> None:
            check(self)

    if sys.version_info < (3, 14):
        del Bare.__annotations__
    with pytest.raises(GeometryError, match="size = 11, expected 0 to 10"):
        Bare(size=11)
