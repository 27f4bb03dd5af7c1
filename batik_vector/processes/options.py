"""The catalogue of processes and what can be chosen of each, with bounds and help.

A process is a row here and a file beside this one, with ``apply(page, spec, machine) -> Prepared``. Importing
the catalogue costs nothing heavy.
"""

from __future__ import annotations

import dataclasses
import enum
from importlib import import_module
from typing import TYPE_CHECKING, Annotated, ClassVar, TypeAlias

from batik_vector.fields import OneOf, Says, check
from batik_vector.units import format_mm
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.artwork import Page
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

    def __post_init__(self) -> None:
        check(self)

    def apply(self, page: Page, machine: Machine) -> Prepared:
        """Return a page as the process leaves it.

        Raises:
            ExportError: with the key at fault and the value that would do.
        """
        done: Prepared = import_module(self.module).apply(page, self, machine)
        return done

    def __str__(self) -> str:
        """Return the process as ``--process`` takes it, without what stands at its default."""
        said = [f"{name}={value}" for name, value in _chosen(self)]
        return " ".join([self.kind, *said])


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
        return "{" + ",".join(f"{key}={_spelled(each)}" for key, each in value.items()) + "}"
    return str(value)


@frozen(kw_only=True)
class PlotProcess(ProcessSpec):
    """Outlines and lines as strokes for a pen, in a good order."""

    kind = "plot"
    module = "batik_vector.processes.plot"

    join: Annotated[bool, Says("draw strokes that meet end to end as one")] = True


@frozen(kw_only=True)
class CutProcess(ProcessSpec):
    """Closed contours for a knife or a laser, the inner before the outer."""

    kind = "cut"
    module = "batik_vector.processes.cut"


PROCESSES: dict[str, type[ProcessSpec]] = {each.kind: each for each in (PlotProcess, CutProcess)}
"""The catalogue of processes."""

AnyProcess: TypeAlias = Annotated[ProcessSpec, OneOf(lambda: PROCESSES, "process")]
