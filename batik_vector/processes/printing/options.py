"""What can be chosen of plates and of printing out of register."""

from __future__ import annotations

import enum
from dataclasses import field
from importlib import import_module
from typing import TYPE_CHECKING, Annotated, Self, TypeAlias

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Length, Says
from batik_vector.processes.spec import ProcessSpec
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.artwork import Page

Shift: TypeAlias = Annotated[Length, Between(-20, 20)]


class PlateColour(enum.StrEnum):
    """What a plate is drawn in."""

    BLACK = "black"
    """Black on white, as films and screens are made from."""
    INK = "ink"
    """The ink's own colour on the cloth's."""


@frozen(kw_only=True)
class SeparateProcess(ProcessSpec):
    """Plates: what one ink prints, a file for each."""

    kind = "separate"
    module = "batik_vector.processes.printing.separating"

    ink: Annotated[str, Says("the one in the file; a file for each if unset")] = ""
    colour: Annotated[PlateColour, Says("black on white (black), or the ink's on the cloth's (ink)")] = (
        PlateColour.BLACK
    )

    def parts(self, page: Page) -> list[tuple[str, Self]]:
        """Return a file for each ink, where none is named and there are several."""
        found: list[tuple[str, Self]] = import_module(self.module).parts(page, self)
        return found


@frozen(kw_only=True)
class MisregisterProcess(ProcessSpec):
    """Inks out of register, as machines print them: a preview that shows whether traps hold."""

    kind = "misregister"
    module = "batik_vector.processes.printing.misregistering"
    of_tile = True
    keeps_group = False

    by: Annotated[
        Annotated[Length, Between(0, 20)],
        Says("how far each ink but the first is off, in a direction that the seed gives"),
    ] = 0.3
    seed: Annotated[int, Between(0, 2**31 - 1), Says("which directions")] = 0
    shifts: Annotated[
        dict[str, tuple[Shift, Shift]],
        Says("by inks, how far right and up each is off: where it is given, all others stay"),
    ] = field(default_factory=dict)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.shifts and self.seed:
            raise GeometryError(
                f"seed = {self.seed}, expected none beside shifts, which leave nothing to chance"
            )
