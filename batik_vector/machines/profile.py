"""The profile of a machine or a workshop: its bed, its tool, how fast it moves, what it can still draw.

A profile is a page of TOML, read as recipes are. What it leaves unset is not known of the machine: a process
then takes its own default, and an audit does not measure it.
"""

from __future__ import annotations

from dataclasses import field, replace
from typing import Annotated

from batik_vector.fields import Between, Length, Says, check
from batik_vector.machines.gcode import Gcode
from batik_vector.machines.hpgl import Hpgl, sheet_of
from batik_vector.machines.limits import Limits
from batik_vector.values import frozen

Side = Annotated[Length, Between(1, 1_000_000)]


LANGUAGES = {"hpgl": Hpgl, "gcode": Gcode}
"""The formats that are spoken to machines, each with its section of a profile."""


@frozen(kw_only=True)
class Tool:
    """What meets the material."""

    width: Annotated[
        Annotated[Length, Between(0.01, 100)] | None, Says("breadth of what it draws in one pass")
    ] = None
    kerf: Annotated[
        Annotated[Length, Between(0, 20)] | None, Says("breadth of material that a cut takes away")
    ] = None
    blade_offset: Annotated[
        Annotated[Length, Between(0, 10)] | None, Says("how far a drag knife's tip trails behind its axis")
    ] = None

    def __post_init__(self) -> None:
        check(self)


@frozen(kw_only=True)
class Motion:
    """How fast it moves."""

    draw_speed: Annotated[float, Between(0.01, 10_000), Says("mm per second with the tool down")] = 50.0
    travel_speed: Annotated[float, Between(0.01, 10_000), Says("mm per second with the tool up")] = 150.0
    acceleration: Annotated[float, Between(0.1, 1_000_000), Says("mm per second squared")] = 1000.0
    lift: Annotated[float, Between(0, 60), Says("seconds to lift and lower the tool once")] = 0.2
    tool_change: Annotated[float, Between(0, 3600), Says("seconds to change the tool")] = 0.0

    def __post_init__(self) -> None:
        check(self)


@frozen(kw_only=True)
class Machine:
    """A machine or a workshop."""

    says: Annotated[str, Says("what it is, in a line")] = ""
    size: Annotated[tuple[Side, Side] | None, Says("breadth and height that it reaches")] = None
    tool: Annotated[Tool, Says("what meets the material")] = field(default_factory=Tool)
    motion: Annotated[Motion, Says("how fast it moves")] = field(default_factory=Motion)
    limits: Annotated[Limits, Says("what it can still draw")] = field(default_factory=Limits)
    gcode: Annotated[Gcode, Says("how it is spoken to in G-code")] = field(default_factory=Gcode)
    hpgl: Annotated[Hpgl, Says("how it is spoken to in HP-GL")] = field(default_factory=Hpgl)
    sources: Annotated[dict[str, str], Says("where the numbers come from, by their keys")] = field(
        default_factory=dict
    )

    __pydantic_config__ = {"strict": True, "allow_inf_nan": False}  # noqa: RUF012

    def __post_init__(self) -> None:
        check(self)

    @property
    def languages(self) -> tuple[str, ...]:
        """The formats in which the profile says how it is spoken to; none where it says nothing of that."""
        return tuple(name for name in LANGUAGES if getattr(self, name) != LANGUAGES[name]())

    @property
    def hpgl_device(self) -> Hpgl:
        """What HP-GL is written for: where no sheet is named, one as large as the machine reaches."""
        if self.size is None or self.hpgl.page:
            return self.hpgl
        return replace(self.hpgl, page=(sheet_of("all that it reaches", self.size, self.hpgl),))
