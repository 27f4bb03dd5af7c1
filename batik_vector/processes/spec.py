"""What every process has: its kind, where it stands, and how it is spelled as ``--process`` takes it."""

from __future__ import annotations

import dataclasses
import enum
import json
import re
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar, Self

from batik_vector.fields import check
from batik_vector.units import format_mm
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.artwork import Artwork, Page
    from batik_vector.machines import Machine
    from batik_vector.processes.prepared import Prepared


@frozen(kw_only=True)
class ProcessSpec:
    """What a machine needs done to a page before it is written."""

    kind: ClassVar[str] = ""
    module: ClassVar[str] = ""
    """Where its ``apply`` stands."""
    keeps_tile: ClassVar[bool] = True
    """Whether what is left repeats as the tile did."""
    of_tile: ClassVar[bool] = False
    """Whether it is done to the tile, before this is repeated, bled or filled into cloth."""
    keeps_group: ClassVar[bool] = True
    """Whether what is left has the symmetry that the tile had."""

    def __post_init__(self) -> None:
        check(self)

    def apply(self, page: Page, machine: Machine) -> Prepared | Artwork:
        """Return a page as the process leaves it.

        Raises:
            GeometryError: with the key at fault and the value that would do.
        """
        done: Prepared | Artwork = self._applied(page, machine)
        return done

    def _applied(self, page: Page, machine: Machine) -> Any:
        return import_module(self.module).apply(page, self.resolved(machine), machine)

    def parts(self, page: Page) -> list[tuple[str, Self]]:
        """Return the files over which what the process leaves is divided, none where it is not.

        Returns:
            What is added to the name of each, and the process that leaves what is in it.

        Raises:
            GeometryError: as :meth:`apply`.
        """
        return []

    def resolved(self, machine: Machine) -> Self:
        """Return the process with what it leaves unset as the machine's tool has it."""
        tool = machine.tool
        unset = [each.name for each in dataclasses.fields(self) if getattr(self, each.name) is None]
        known = {name: getattr(tool, name) for name in unset if getattr(tool, name, None) is not None}
        return dataclasses.replace(self, **known) if known else self

    def __str__(self) -> str:
        """Return the process as ``--process`` takes it, without what stands at its default."""
        said = [f"{name}={value}" for name, value in _chosen(self)]
        return " ".join([self.kind, *said])


@frozen(kw_only=True)
class StrokeProcess(ProcessSpec):
    """A process that leaves the strokes of tools."""

    def apply(self, page: Page, machine: Machine) -> Prepared:
        """Return the strokes that tools make of a page; see :meth:`ProcessSpec.apply`."""
        done: Prepared = self._applied(page, machine)
        return done


def _chosen(spec: object, before: str = "") -> list[tuple[str, str]]:
    found = []
    for each in dataclasses.fields(spec):  # type: ignore[arg-type]
        value = getattr(spec, each.name)
        default = each.default_factory() if callable(each.default_factory) else each.default
        if value == default:
            continue
        if dataclasses.is_dataclass(value):
            kind = getattr(value, "kind", "")
            found += [(f"{before}{each.name}.kind", kind)] if kind else []
            found += _chosen(value, f"{before}{each.name}.")
        else:
            found.append((before + each.name, _spelled(value)))
    return found


def _spelled(value: object) -> str:
    if isinstance(value, enum.Enum):
        return str(value.value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return format_mm(value)
    if isinstance(value, tuple):
        return "[" + ",".join(map(_spelled, value)) + "]"
    if isinstance(value, dict):
        return "{" + ",".join(f"{_key(name)}={_spelled(each)}" for name, each in value.items()) + "}"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else str(value)


def _key(name: str) -> str:
    """Return a key as TOML writes it."""
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else json.dumps(name, ensure_ascii=False)
