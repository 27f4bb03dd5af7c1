"""The short way from tables to a recipe, for recipes that are right.

Building pydantic's validator costs ten times what it takes to read a recipe, and every call of the command
pays it. So a recipe is first built straight from the hints of its dataclasses. This builder knows nothing
of messages: whatever it is not sure of raises :class:`UnsureError`, and pydantic, which can tell what is
wrong, has the last word. What it accepts, pydantic accepts with the same values; tests hold it to that.
"""

from __future__ import annotations

import dataclasses
import enum
import functools
import math
from collections.abc import Callable
from typing import Any, TypeVar

from batik_vector.errors import BatikError
from batik_vector.recipe.reading.field_types import Hint, chosen, members
from batik_vector.units import parse_length

Built = TypeVar("Built")


class UnsureError(Exception):
    """What was read may be wrong."""


def built(cls: type[Built], table: dict[str, Any], **hidden: Any) -> Built:
    """Return a dataclass from the table of a recipe, and from fields that a recipe cannot write.

    Raises:
        UnsureError: where anything is not as the hints say.
    """
    kind: type = cls
    known = members(kind)
    if not known.keys() >= table.keys():
        raise UnsureError
    values = {name: _value(known[name].hint, value) for name, value in table.items()}
    try:
        return cls(**values, **hidden)
    except (BatikError, TypeError, ValueError, ArithmeticError) as error:
        raise UnsureError from error


def _value(hint: Hint, value: Any) -> Any:
    if hint.one_of is not None:
        return _tagged(hint, value)
    if isinstance(value, dict):
        return _table(hint, value)
    if isinstance(value, list):
        return _list(hint, value)
    if hint.base is float:
        return _number(hint, value)
    if hint.base is int and type(value) is int:
        return _bounded(hint, value)
    if hint.base is bool and type(value) is bool:
        return value
    if type(value) is str:
        return _text(hint, value)
    raise UnsureError


def _tagged(hint: Hint, value: Any) -> Any:
    cls = chosen(hint, value)
    if cls is None or hint.one_of is None:
        raise UnsureError
    return built(cls, {key: each for key, each in value.items() if key != hint.one_of.tag})


def _table(hint: Hint, value: dict[str, Any]) -> Any:
    if hint.alone and hint.item is not None:
        return (_value(hint.item, value),)
    if hint.origin is dict and hint.item is not None:
        return {name: _table_again(hint.item, each) for name, each in value.items()}
    if isinstance(hint.base, type) and dataclasses.is_dataclass(hint.base):
        return _again(hint, value, functools.partial(built, hint.base))
    raise UnsureError


KEPT_TABLES, KEPT_TEXT = 512, 20_000
"""How many tables are remembered with the values that they became, and how long they may be, written out."""

_known: dict[tuple[int, str], tuple[Hint, Any]] = {}


def _table_again(hint: Hint, value: Any) -> Any:
    """Return the value of one table among several."""
    return (
        _again(hint, value, functools.partial(_value, hint)) if type(value) is dict else _value(hint, value)
    )


def _again(hint: Hint, value: dict[str, Any], make: Callable[[dict[str, Any]], Any]) -> Any:
    """Return what is made of a table. Kept: who turns one knob reads the other tables again."""
    # Written out 1, 1.0 and true are told apart, which are equal.
    key = id(hint), repr(value)
    found = _known.get(key)
    if found is None:
        # The hint is kept too, so that no other comes to have its number.
        found = hint, make(value)
        if len(key[1]) <= KEPT_TEXT:
            _known[key] = found
            while len(_known) > KEPT_TABLES:
                _known.pop(next(iter(_known)), None)
    return found[1]


def _list(hint: Hint, value: list[Any]) -> tuple[Any, ...]:
    if hint.several and value:
        return tuple(_text(hint, each) if type(each) is str else _value(hint, each) for each in value)
    if hint.many and hint.item is not None:
        return tuple(_table_again(hint.item, each) for each in value)
    if len(hint.items) != len(value) or not value:
        raise UnsureError
    return tuple(_value(item, each) for item, each in zip(hint.items, value, strict=True))


def _number(hint: Hint, value: Any) -> float:
    if hint.length and type(value) is str:
        try:
            value = parse_length(value)
        except ValueError as error:
            raise UnsureError from error
    if type(value) not in (int, float):
        raise UnsureError
    try:
        return float(_bounded(hint, float(value)))
    except OverflowError as error:
        raise UnsureError from error


def _bounded(hint: Hint, value: float) -> float:
    bounds = hint.bounds
    if not abs(value) < math.inf or (bounds and not bounds.low <= value <= bounds.high):
        raise UnsureError
    return value


def _text(hint: Hint, value: str) -> Any:
    if isinstance(hint.base, type) and issubclass(hint.base, enum.Enum):
        if value not in hint.names:
            raise UnsureError
        return hint.base(value)
    if hint.base is not str:
        raise UnsureError
    try:
        return hint.text.parse(value) if hint.text else value
    except ValueError as error:
        raise UnsureError from error
