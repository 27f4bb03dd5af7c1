"""What a field or an argument was given, brought to its type, or refused with what was expected.

The types and marks of :mod:`batik_vector.fields` say all; :func:`check` reads them where a value is built in
Python. Who writes Python may say what a recipe may (words for choices, lengths with units), and give lists
where tuples are held.
"""

from __future__ import annotations

import enum
import functools
import math
import numbers
import operator
import types
import typing
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Annotated, Any, Literal, TypeAlias

from batik_vector.errors import BatikError, GeometryError, unknown_name
from batik_vector.fields.marks import (
    Alone,
    Between,
    Converted,
    Instead,
    LengthUnit,
    OneOf,
    Several,
    Text,
    hint_of,
)
from batik_vector.units import parse_length
from batik_vector.values import defaults

Fit: TypeAlias = Callable[[Any], Any]
"""Returns a value as its type has it, the same object where it is so already; raises :class:`UnfitError`."""

_LONGEST = 60


class UnfitError(Exception):
    """A value, or a part of it, that its type does not have."""

    def __init__(self, value: Any, words: str, names: Iterable[str] = ()) -> None:
        super().__init__(words)
        self.value = value
        self.words = words
        self.names = list(names)
        self.in_list = False


def check(value: Any) -> None:
    """Bring what a dataclass instance was given to the types of its fields.

    Defaults are taken to be right.

    Raises:
        GeometryError: naming the field, what it was given and what was expected.
    """
    cls: type = type(value)
    for name, default in defaults(value).items():
        held = getattr(value, name)
        if held is default or (type(held) is str and held == default):
            continue
        quick = _quick(cls, name)
        if type(held) in quick.kinds and quick.low <= held <= quick.high:
            continue
        fitted = _fitted(quick.fit, held, name)
        if fitted is not held:
            object.__setattr__(value, name, fitted)


def belongs(value: Any, names: Sequence[str], to: str) -> None:
    """Refuse fields of a dataclass instance that have been set and do nothing without another one.

    Args:
        value: the instance.
        names: of the fields.
        to: what they belong to, and is not there, as people are told of it.

    Raises:
        GeometryError: naming the first of them.
    """
    known = defaults(value)
    for name in names:
        held = getattr(value, name)
        if held != known[name]:
            said = f"{held:g}" if isinstance(held, float) else held
            raise GeometryError(f"{name} = {said}, expected {to} beside it: it does nothing without")


def given(value: Any, hint: Any, name: str) -> Any:
    """Return an argument of a function as its type has it; see :func:`check`."""
    return _fitted(_fit_for(hint), value, name)


@functools.cache
def _fit_for(hint: Any) -> Fit:
    return _fit_of(hint)


def _fitted(fit: Fit, value: Any, name: str) -> Any:
    try:
        return fit(value)
    except UnfitError as error:
        if error.names:
            what = (name.removesuffix("s") if error.in_list else name).replace("_", " ")
            raise GeometryError(unknown_name(error.value, error.names, what)) from None
        raise GeometryError(f"{name} = {shown(error.value)}, {error.words}") from None


def shown(value: Any) -> str:
    """Return a value as a message shows it: text in quotes, nothing longer than a line, no addresses."""
    if isinstance(value, str):
        text = value if len(value) <= _LONGEST else value[:_LONGEST] + "…"
        return '"' + "".join(c if c.isprintable() else "\ufffd" for c in text) + '"'
    if isinstance(value, int | float | complex | bytes | numbers.Number | None):
        text = str(value) if not isinstance(value, int) or value.bit_length() < 200 else "a longer number"
        return text if len(text) <= _LONGEST else text[:_LONGEST] + "…"
    if isinstance(value, list | tuple | dict | set | frozenset):
        return f"a {type(value).__name__} of {len(value)}"
    return (
        f"the class {value.__name__}"
        if isinstance(value, type)
        else f"a value of type {type(value).__name__}"
    )


def bound(value: float) -> str:
    """Return a bound as people write it."""
    return str(int(value)) if float(value).is_integer() and abs(value) < 2**63 else f"{value:g}"


class _Quick:
    """How a field is checked, and numbers that need no more: of these types, within these bounds."""

    def __init__(self, hint: Any) -> None:
        self.fit = _fit_of(hint)
        bounds, kind = _number(hint)
        self.kinds: tuple[type, ...] = {int: (int,), float: (int, float)}.get(kind, ())
        self.low = max((each.low for each in bounds), default=-math.inf)
        self.high = min((each.high for each in bounds), default=math.inf)
        if not bounds and kind is float:
            self.low, self.high = -_MOST, _MOST


_MOST = 1.7976931348623157e308


@functools.cache
def _quick(cls: type, name: str) -> _Quick:
    return _Quick(hint_of(cls, name))


def _number(hint: Any) -> tuple[list[Between], Any]:
    """Return the bounds of a number's type and whether it is int or float; of any other type nothing."""
    bounds = []
    while True:
        bounds += [mark for mark in getattr(hint, "__metadata__", ()) if isinstance(mark, Between)]
        if typing.get_origin(hint) is Annotated:
            hint = hint.__origin__
        elif len(rest := _without_none(hint)) == 1 and rest[0] is not hint:
            hint = rest[0]
        else:
            return bounds, hint


def _without_none(hint: Any) -> list[Any]:
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        return [each for each in typing.get_args(hint) if each is not types.NoneType]
    return [hint]


def _fit_of(hint: Any, marks: tuple[Any, ...] = ()) -> Fit:
    """Return what brings a value to a type. ``marks`` are those that stand outside of it."""
    if typing.get_origin(hint) is Annotated:
        return _fit_of(hint.__origin__, (*hint.__metadata__, *marks))
    for mark in marks:
        if isinstance(mark, Converted | Several):
            return _parsed(mark.parse, mark.expected)
        if isinstance(mark, Instead):
            return _instance(hint, mark.expected)
        if isinstance(mark, Alone):
            return _alone(_fit_of(hint))
        if isinstance(mark, OneOf):
            return _instance(hint, f"a {mark.what}, such as {next(iter(mark.load().values())).__name__}(…)")
    rest = _without_none(hint)
    if rest != [hint]:
        return _or_none(_fit_of(rest[0], marks) if len(rest) == 1 else _instance(hint, _called(hint)), hint)
    origin = typing.get_origin(hint)
    if hint in (int, float):
        return _number_fit(hint, marks)
    if hint is str:
        return _text(next((mark for mark in marks if isinstance(mark, Text)), None))
    if hint is bool:
        return _instance(bool, "True or False")
    if origin is tuple:
        return _tuple(typing.get_args(hint))
    if origin in (dict, Mapping):
        return _table(*typing.get_args(hint))
    if origin is Literal:
        return _choice(typing.get_args(hint), None)
    if isinstance(hint, type) and issubclass(hint, enum.Enum):
        return _choice([each.value for each in hint], hint)
    if origin is Callable:
        return _callable
    known = isinstance(hint, type) and origin is None and hint not in (Any, object)
    return _instance(hint, _called(hint)) if known else _any


def _any(value: Any) -> Any:
    return value


def _alone(fit: Fit) -> Fit:
    return lambda value: fit(Alone.listed(value))


def _or_none(fit: Fit, hint: Any) -> Fit:
    if types.NoneType not in typing.get_args(hint):
        return fit
    return lambda value: None if value is None else fit(value)


def _called(hint: Any) -> str:
    kinds = [getattr(each, "__name__", str(each)) for each in _without_none(hint)]
    return " or ".join(f"{'an' if kind[0] in 'AEIO' else 'a'} {kind}" for kind in kinds)


def _instance(kind: Any, expected: str) -> Fit:
    def fit(value: Any) -> Any:
        if isinstance(value, kind):
            return value
        if kind is bool and type(value).__name__ in ("bool", "bool_"):
            return bool(value)  # NumPy's
        raise UnfitError(value, f"expected {expected}")

    return fit


def _callable(value: Any) -> Any:
    if callable(value):
        return value
    raise UnfitError(value, "expected a function")


def _number_fit(kind: type, marks: tuple[Any, ...]) -> Fit:
    bounds = [mark for mark in marks if isinstance(mark, Between)]
    length = any(isinstance(mark, LengthUnit) for mark in marks)
    spans = [f"{bound(each.low)} to {bound(each.high)}" for each in bounds]
    what = "a whole number" if kind is int else 'a length such as "280 mm"' if length else "a number"
    wanted = f"expected {what}" + (f" from {spans[0]}" if spans and not length else "")

    def fit(value: Any) -> Any:
        if length and isinstance(value, str):
            try:
                value = parse_length(value)
            except ValueError as error:
                raise UnfitError(value, str(error)) from None
        try:
            number = _plain(kind, value)
            finite = math.isfinite(number)
        except (TypeError, ValueError, OverflowError):
            raise UnfitError(value, wanted) from None
        for each, span in zip(bounds, spans, strict=True):
            if not (finite and each.low <= number <= each.high):
                raise UnfitError(value, f"expected {span}")
        if not finite:
            raise UnfitError(value, f"{wanted} that is finite")
        return number

    return fit


def _plain(kind: type, value: Any) -> Any:
    """Return a number as Python's own.

    Raises:
        TypeError: where it is none, or not of the kind.
    """
    if type(value) is kind or type(value) is int:
        return value
    if isinstance(value, bool) or type(value).__name__ in ("bool", "bool_"):
        raise TypeError
    if kind is int:
        return operator.index(value)
    if isinstance(value, numbers.Real) or type(value).__name__ == "Decimal":
        return float(value)
    raise TypeError


def _text(mark: Text | None) -> Fit:
    def fit(value: Any) -> Any:
        if not isinstance(value, str):
            raise UnfitError(value, f"expected {mark.expected if mark else 'text'}")
        text = value if type(value) is str or isinstance(value, enum.Enum) else str(value)
        if mark is None:
            return text
        try:
            found = mark.parse(text)
        except ValueError as error:
            if isinstance(error, BatikError):
                raise
            raise UnfitError(text, str(error)) from None
        return text if found == text else found

    return fit


def _parsed(parse: Callable[[Any], Any], expected: str) -> Fit:
    def fit(value: Any) -> Any:
        try:
            return parse(value)
        except UnfitError:
            raise
        except (TypeError, ValueError, ArithmeticError):
            raise UnfitError(value, f"expected {expected}") from None

    return fit


def _choice(words: Iterable[Any], kind: type[enum.Enum] | None) -> Fit:
    known = [str(word) for word in words]

    def fit(value: Any) -> Any:
        if kind is not None and type(value) is kind:
            return value
        if isinstance(value, str) and value in known:
            return kind(value) if kind else value
        if isinstance(value, str):
            raise UnfitError(value, "", known)
        raise UnfitError(value, f"expected one of {', '.join(known)}")

    return fit


def _listed(value: Any) -> tuple[Any, ...] | list[Any] | None:
    """Return a list, a tuple or an array of NumPy as one of the former two."""
    if isinstance(value, list | tuple):
        return value
    plain = value.tolist() if hasattr(value, "__array__") and hasattr(value, "tolist") else None
    return plain if isinstance(plain, list) else None


def _tuple(parts: tuple[Any, ...]) -> Fit:
    many = len(parts) == 2 and parts[1] is Ellipsis
    fits = [_fit_of(each) for each in (parts[:1] if many else parts)]

    def fit(value: Any) -> Any:
        items = _listed(value)
        if items is None:
            raise UnfitError(value, "expected a list" + ("" if many else f" of {len(fits)}"))
        if not many and len(items) != len(fits):
            raise UnfitError(value, f"expected {len(fits)} of them")
        if type(value) is tuple and many and parts[0] is str and set(map(type, value)) <= {str}:
            return value  # names of a million marks
        try:
            made = [one(item) for one, item in zip(fits * (len(items) if many else 1), items, strict=True)]
        except UnfitError as error:
            error.in_list = True
            raise
        same = type(value) is tuple and all(map(operator.is_, made, items))
        return value if same else tuple(made)

    return fit


def _table(key: Any, item: Any) -> Fit:
    keys, items = _fit_of(key), _fit_of(item)

    def fit(value: Any) -> Any:
        if not isinstance(value, Mapping):
            raise UnfitError(value, "expected a dict by name")
        made = {keys(name): items(each) for name, each in value.items()}
        same = all(made[name] is each for name, each in value.items())
        return value if same else made

    return fit
