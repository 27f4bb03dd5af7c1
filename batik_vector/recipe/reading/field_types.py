"""The types of a recipe's fields, taken apart: what schema and messages are made of."""

from __future__ import annotations

import dataclasses
import enum
import functools
import math
import types
import typing
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Literal, Union

from batik_vector.fields import (
    HIDDEN,
    Alone,
    Between,
    LengthUnit,
    OneOf,
    Says,
    Several,
    Text,
    Useful,
    bound,
    hint_of,
)
from batik_vector.units import format_mm
from batik_vector.values import frozen


@frozen
class Hint:
    """A type with the marks it carries. ``base`` is a plain type, an enum, a dataclass or a generic."""

    base: Any
    bounds: Between | None = None
    useful: Useful | None = None
    says: Says | None = None
    one_of: OneOf | None = None
    text: Text | None = None
    length: bool = False
    several: bool = False
    alone: bool = False

    @functools.cached_property
    def origin(self) -> Any:
        """``tuple`` for ``tuple[int, ...]``; the type itself where it is not generic."""
        return typing.get_origin(self.base) or self.base

    @functools.cached_property
    def items(self) -> list[Hint]:
        """What a fixed tuple holds, place by place; nothing for any other type."""
        args = typing.get_args(self.base)
        return [] if self.origin is not tuple or self.many else [taken_apart(arg) for arg in args]

    @functools.cached_property
    def many(self) -> bool:
        """Whether this is a tuple of any length."""
        return self.origin is tuple and typing.get_args(self.base)[-1] is Ellipsis

    @functools.cached_property
    def item(self) -> Hint | None:
        """What a list of any length or a table by names holds."""
        args = typing.get_args(self.base)
        if self.many:
            return taken_apart(args[0])
        return taken_apart(args[1]) if self.origin is dict else None

    @functools.cached_property
    def names(self) -> list[str]:
        """The words to choose from, of an enum or a literal."""
        if self.origin is Literal:
            return [str(arg) for arg in typing.get_args(self.base)]
        if isinstance(self.base, type) and issubclass(self.base, enum.Enum):
            return [str(each.value) for each in self.base]
        return []


@frozen
class Member:
    """A field of a dataclass that a recipe may write."""

    hint: Hint
    required: bool
    default: Any = None


_MARKS: Mapping[type, str] = {
    Between: "bounds",
    Useful: "useful",
    Says: "says",
    OneOf: "one_of",
    Text: "text",
}


def taken_apart(hint: Any) -> Hint:
    """Return a type without ``Annotated`` and ``| None``, and what these said. Outer marks win."""
    marks: dict[str, Any] = {}
    while True:
        origin = typing.get_origin(hint)
        if origin is Annotated:
            hint, *metadata = typing.get_args(hint)
            for mark in reversed(metadata):
                if type(mark) in _MARKS:
                    marks.setdefault(_MARKS[type(mark)], mark)
                marks["length"] = marks.get("length") or isinstance(mark, LengthUnit)
                marks["several"] = marks.get("several") or isinstance(mark, Several)
                marks["alone"] = marks.get("alone") or isinstance(mark, Alone)
        elif origin in (Union, types.UnionType) and types.NoneType in typing.get_args(hint):
            (hint,) = (arg for arg in typing.get_args(hint) if arg is not types.NoneType)
        else:
            return Hint(str if marks.get("several") else hint, **marks)


class _Members(Mapping[str, Member]):
    """The fields of a dataclass that a recipe may write, each taken apart when it is first asked for."""

    def __init__(self, cls: type) -> None:
        self._cls = cls
        written = (field for field in dataclasses.fields(cls) if field.init and HIDDEN not in field.metadata)
        self._fields = {field.name: field for field in written}
        self._found: dict[str, Member] = {}

    def __getitem__(self, name: str) -> Member:
        found = self._found.get(name)
        if found is None:
            found = self._found[name] = self._member(self._fields[name])
        return found

    def _member(self, field: dataclasses.Field[Any]) -> Member:
        default = field.default if field.default is not dataclasses.MISSING else None
        if field.default_factory is not dataclasses.MISSING:
            default = field.default_factory()
        required = field.default is field.default_factory is dataclasses.MISSING
        return Member(taken_apart(hint_of(self._cls, field.name)), required, default)

    def __iter__(self) -> Iterator[str]:
        return iter(self._fields)

    def __len__(self) -> int:
        return len(self._fields)


@functools.cache
def members(cls: type) -> Mapping[str, Member]:
    """Return the fields of a dataclass that a recipe may write, by name."""
    return _Members(cls)


def chosen(hint: Hint, value: Any) -> type | None:
    """Return the dataclass that a table is read as: the hint's own, or the one that its tag names."""
    if hint.one_of is not None:
        tag = value.get(hint.one_of.tag) if isinstance(value, dict) else None
        return hint.one_of.load().get(tag) if isinstance(tag, str) else None
    return hint.base if isinstance(hint.base, type) and dataclasses.is_dataclass(hint.base) else None


def span(hint: Hint) -> str:
    """Return the bounds of a number: ``1 to 360``."""
    assert hint.bounds is not None
    low, high = hint.bounds.low, hint.bounds.high
    if hint.length:
        return f"{format_mm(low) if low >= 1e-3 or low <= 0 else low} to {format_mm(high)} mm"
    return f"{bound(low)} to {bound(high)}"


def example(hint: Hint) -> str:
    """Return a length as a recipe would write it, within the bounds."""
    low, high = (hint.bounds.low, hint.bounds.high) if hint.bounds else (0.0, math.inf)
    return f"{next((bound(mm) for mm in (280, 1, 0.02) if low <= mm <= high), bound(low))} mm"


def expected(hint: Hint) -> str:
    """Return in words what a value of a type looks like."""
    bounds = f" of {span(hint)}" if hint.bounds else ""
    if hint.length:
        return f'a length{bounds} such as "{example(hint)}"'
    if hint.base in (int, float):
        what = "a whole number" if hint.base is int else "a number"
        return what + (f" from {span(hint)}" if hint.bounds else "")
    if hint.names:
        return "one of " + ", ".join(f'"{name}"' for name in hint.names)
    if hint.items:
        return _expected_items(hint.items)
    return _expected_other(hint)


def _expected_items(items: list[Hint]) -> str:
    kind = {int: "whole numbers", float: "numbers"}
    same = {(each.base, each.length) for each in items}
    if len(same) > 1:
        return f"a list of {len(items)} numbers"
    base, length = same.pop()
    return f"a list of {len(items)} {'lengths' if length else kind.get(base, 'values')}"


def _expected_other(hint: Hint) -> str:
    if hint.many:
        assert hint.item is not None
        if hint.alone:
            return f"{_expected_other(hint.item)}, or a list of such"
        if hint.item.one_of or dataclasses.is_dataclass(hint.item.base):
            return "a list of tables"
        if hint.item.names:
            return "a list of " + ", ".join(f'"{name}"' for name in hint.item.names)
        return "a list of text" if hint.item.base is str else "a list of lists of numbers"
    if hint.origin is dict:
        return "tables by name"
    if hint.one_of:
        return f"a table with a {hint.one_of.tag}"
    if dataclasses.is_dataclass(hint.base):
        return "a table"
    if hint.base is bool:
        return "true or false"
    if hint.several:
        return Several.expected
    return hint.text.expected if hint.text else "text in quotes"
