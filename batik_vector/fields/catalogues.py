"""Catalogues: kinds by name, those of the program and behind them those that installed plug-ins bring.

A plug-in is a package with entry points in the groups ``batik_vector.curves``, ``.layouts``, ``.fills``,
``.motifs``, ``.processes`` and ``.formats``; each names a class, and its own name is the kind that recipes
write. Nothing is looked for until a name is asked for that is none of the program's, or the whole list is.
What is broken is passed over, and told in :attr:`Catalogue.broken`.
"""

from __future__ import annotations

import dataclasses
import functools
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from batik_vector.values import frozen

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

Kind = TypeVar("Kind")

GROUP = "batik_vector."
"""What the names of entry points' groups begin with."""
NAME = r"[a-z][a-z0-9]*(-[a-z0-9]+)*"
"""Kinds are in small letters, as those of the program."""


@frozen
class Origin:
    """The package that brings a kind."""

    package: str
    version: str

    def __str__(self) -> str:
        return f"{self.package} {self.version}"


class Catalogue(Mapping[str, Kind], Generic[Kind]):
    """Kinds by name.

    Args:
        group: of the entry points, without what all begin with, such as ``"curves"``.
        own: the program's kinds; one told as "module:Class" is imported when it is asked for.
        sort: returns the class that those of plug-ins must be of; called when there are any.
        made: makes the kind of a plug-in's class; it raises ValueError with what is wrong with that.
    """

    def __init__(
        self,
        group: str,
        own: Mapping[str, Kind | str],
        sort: Callable[[], type],
        made: Callable[[str, Any], Kind] | None = None,
    ) -> None:
        self.group = group
        self._own = dict(own)
        self._sort = sort
        self._made = made
        self._brought: dict[str, tuple[Kind, Origin]] | None = None
        self._broken: dict[str, str] = {}

    def __getitem__(self, name: str) -> Kind:
        if name in self._own:
            kind = self._own[name]
            if isinstance(kind, str):
                file, _, cls = kind.partition(":")
                kind = self._own[name] = getattr(import_module(file), cls)
            return kind
        return self._plugins()[name][0]

    def __iter__(self) -> Iterator[str]:
        yield from self._own
        yield from self._plugins()

    def __len__(self) -> int:
        return len(self._own) + len(self._plugins())

    @property
    def own(self) -> tuple[str, ...]:
        """The names of the program's kinds."""
        return tuple(self._own)

    @property
    def brought(self) -> Mapping[str, Origin]:
        """The names of plug-ins' kinds, and the package that brings each."""
        return {name: origin for name, (_, origin) in self._plugins().items()}

    @property
    def broken(self) -> Mapping[str, str]:
        """What is passed over: the names of entry points, and what is wrong with each."""
        self._plugins()
        return self._broken

    def _plugins(self) -> Mapping[str, tuple[Kind, Origin]]:
        if self._brought is None:
            self._brought, self._broken = {}, {}
            found: dict[str, list[EntryPoint]] = {}
            for point in _installed().get(GROUP + self.group, ()):
                found.setdefault(point.name, []).append(point)
            for name, points in sorted(found.items()):
                origins = [_origin(point) for point in points]
                try:
                    kind = self._loaded(name, points, origins)
                except Exception as error:  # whatever a stranger's module may raise
                    self._broken[name] = f"{' and '.join(map(str, origins))}: {_words(error)}"
                else:
                    self._brought[name] = kind, origins[0]
        return self._brought

    def _loaded(self, name: str, points: list[EntryPoint], origins: list[Origin]) -> Kind:
        if name in self._own:
            raise ValueError("the program has this name already")
        if len(points) > 1:
            raise ValueError("both bring this name, and neither is taken")
        if not re.fullmatch(NAME, name):
            raise ValueError("expected a name of small letters, digits and hyphens")
        cls, sort = points[0].load(), self._sort()
        if not (isinstance(cls, type) and issubclass(cls, sort) and dataclasses.is_dataclass(cls)):
            raise ValueError(f"expected a frozen dataclass of {sort.__module__}.{sort.__name__}")
        kind: Kind = self._made(name, cls) if self._made else cls  # type: ignore[assignment]
        _known[cls] = origins[0]
        return kind


_known: dict[type, Origin] = {}
"""The classes of plug-ins that have been loaded."""


def named(attribute: str, sort: type) -> Callable[[str, Any], Any]:
    """Return a check that a class has its name of the catalogue in an attribute too, such as ``kind``."""

    def made(name: str, cls: Any) -> Any:
        if getattr(cls, attribute, None) != name:
            raise ValueError(f'expected {attribute} = "{name}" in the class of {sort.__name__}')
        return cls

    return made


def brought_by(values: Iterable[Any]) -> tuple[str, ...]:
    """Return the plug-ins whose classes values are of, or hold anywhere within: name and version, sorted."""
    if not _known:
        return ()
    found: set[Origin] = set()
    left = list(values)
    while left:
        value = left.pop()
        if dataclasses.is_dataclass(value) and not isinstance(value, type):
            if type(value) in _known:
                found.add(_known[type(value)])
            left += [getattr(value, each.name) for each in dataclasses.fields(value)]
        elif isinstance(value, dict):
            left += value.values()
        elif isinstance(value, tuple | list):
            left += value
    return tuple(sorted(map(str, found)))


def installed() -> tuple[str, ...]:
    """Return all plug-ins that are installed, broken or not: name and version, sorted."""
    origins = {str(_origin(point)) for points in _installed().values() for point in points}
    return tuple(sorted(origins))


@functools.cache
def _installed() -> Mapping[str, list[EntryPoint]]:
    """Return the entry points of our groups, each group's in an order that no folder's hangs on."""
    from importlib.metadata import distributions

    found: dict[str, list[EntryPoint]] = {}
    seen = set[str]()
    for package in distributions():
        points = [point for point in package.entry_points if point.group.startswith(GROUP)]
        # What two folders of the path hold is there as in the first. To read a name is what costs.
        if points and (name := package.metadata["Name"]) not in seen:
            seen.add(name)
            for point in points:
                found.setdefault(point.group, []).append(point)
    return {
        group: sorted(points, key=lambda point: (point.name, str(_origin(point))))
        for group, points in found.items()
    }


def _origin(point: EntryPoint) -> Origin:
    of = point.dist
    return Origin(of.metadata["Name"], of.version) if of is not None else Origin(point.value, "")


def _words(error: Exception) -> str:
    if type(error) is ValueError:
        return str(error)
    first = (str(error).splitlines() or [""])[0][:200]
    return f"{type(error).__name__}: {first}".rstrip(": ")
