"""Values: frozen dataclasses that cost next to nothing to make.

The standard library writes out the methods of every frozen dataclass and compiles them, at half a
millisecond a class: for the hundred classes of a recipe and its compiler that was a third of a short run. A
value is such a dataclass to everybody (``fields``, ``replace``, ``asdict``, equality, hash, what it refuses),
but all values share their methods, which look the fields up. Heirs of a value are values too.

From Python 3.13 on the standard library compiles an empty function for each dataclass that asks for no
methods. That costs 15 to 40 µs a class, a fiftieth of a start; to avoid it would mean to fill in the fields
by names that the standard library keeps to itself.
"""

from __future__ import annotations

import functools
import operator
from collections.abc import Callable, Mapping
from dataclasses import MISSING, Field, FrozenInstanceError, dataclass, field, fields
from typing import Any, TypeVar, dataclass_transform, overload

Value = TypeVar("Value")


@overload
def frozen(cls: type[Value], /) -> type[Value]: ...


@overload
def frozen(*, kw_only: bool = False, eq: bool = True) -> Callable[[type[Value]], type[Value]]: ...


@dataclass_transform(frozen_default=True, field_specifiers=(Field, field))
def frozen(cls: Any = None, /, *, kw_only: bool = False, eq: bool = True) -> Any:
    """Make a class a value, as ``dataclass(frozen=True)`` would.

    Args:
        cls: the class.
        kw_only: whether its fields are given by name alone.
        eq: whether values with equal fields are equal; without it each equals itself alone.
    """
    if cls is None:
        return functools.partial(frozen, kw_only=kw_only, eq=eq)
    made: Any = dataclass(init=False, repr=False, eq=False, kw_only=kw_only)(cls)
    for name, method in (_SHARED | _COMPARED if eq else _SHARED).items():
        if name not in vars(made):
            setattr(made, name, method)
    return made


class _Form:
    """How a class is filled: ``blank`` has each field's default, or ``MISSING``, in the fields' order."""

    def __init__(self, cls: Any) -> None:
        known = fields(cls)
        made = tuple((each.name, each.default_factory) for each in known)
        self.factories = tuple((name, make) for name, make in made if make is not MISSING)
        self.positional = tuple(each.name for each in known if not each.kw_only)
        self.blank = {each.name: each.default for each in known}
        filled = {name for name, _ in self.factories}
        self.needed = tuple(
            each.name for each in known if each.default is MISSING and each.name not in filled
        )
        self.held: Callable[[Any], Any] = operator.attrgetter(*self.blank) if known else lambda _: ()
        self.settles = hasattr(cls, "__post_init__")


_form_of = functools.cache(_Form)


def _form(made: Any) -> _Form:
    cls: type = type(made)
    return _form_of(cls)


def defaults(made: Any) -> Mapping[str, Any]:
    """Return the fields of a dataclass instance, each with its default or ``MISSING``."""
    return _form(made).blank


def _init(self: Any, *args: Any, **given: Any) -> None:
    form = _form(self)
    if args:
        given = _named(self, form, args, given)
    values = {**form.blank, **given}
    if len(values) > len(form.blank):
        unknown = next(name for name in given if name not in form.blank)
        raise TypeError(f"{_called(self)} got an unexpected keyword argument {unknown!r}")
    for name in form.needed:
        if values[name] is MISSING:
            missing = [each for each in form.needed if values[each] is MISSING]
            raise TypeError(f"{_called(self)} missing required arguments: {', '.join(map(repr, missing))}")
    for name, make in form.factories:
        if values[name] is MISSING:
            values[name] = make()
    self.__dict__.update(values)
    if form.settles:
        self.__post_init__()


def _named(self: Any, form: _Form, args: tuple[Any, ...], given: dict[str, Any]) -> dict[str, Any]:
    """Return what is given by place and by name, all by name."""
    most = len(form.positional)
    if len(args) > most:
        raise TypeError(f"{_called(self)} takes {most} positional arguments but {len(args)} were given")
    placed = dict(zip(form.positional, args, strict=False))
    for name in placed.keys() & given.keys():
        raise TypeError(f"{_called(self)} got multiple values for argument {name!r}")
    return placed | given


def _called(self: Any) -> str:
    return f"{type(self).__qualname__}.__init__()"


def _set(self: Any, name: str, to: Any) -> None:
    raise FrozenInstanceError(f"cannot assign to field {name!r}")


def _delete(self: Any, name: str) -> None:
    raise FrozenInstanceError(f"cannot delete field {name!r}")


def _repr(self: Any) -> str:
    held = ", ".join(f"{name}={getattr(self, name)!r}" for name in _form(self).blank)
    return f"{type(self).__qualname__}({held})"


def _equal(self: Any, other: Any) -> Any:
    if type(other) is not type(self):
        return NotImplemented
    held = _form(self).held
    return held(self) == held(other)


def _hash(self: Any) -> int:
    return hash(_form(self).held(self))


class _Signature:
    """The signature of a class, made when a person or a tool asks for it."""

    def __get__(self, instance: object, owner: type) -> Any:
        from inspect import Parameter, Signature

        known = sorted(fields(owner), key=lambda each: bool(each.kw_only))
        parameters = []
        for each in known:
            kind = Parameter.KEYWORD_ONLY if each.kw_only else Parameter.POSITIONAL_OR_KEYWORD
            default = Parameter.empty if each.default is MISSING else each.default
            if each.default_factory is not MISSING:
                default = each.default_factory()
            parameters.append(Parameter(each.name, kind, default=default, annotation=each.type))
        return Signature(parameters, return_annotation=None)


_SHARED: dict[str, Any] = {
    "__init__": _init,
    "__repr__": _repr,
    "__setattr__": _set,
    "__delattr__": _delete,
    "__signature__": _Signature(),
}
_COMPARED: dict[str, Any] = {"__eq__": _equal, "__hash__": _hash}
