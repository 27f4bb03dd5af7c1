"""What a cut was told, in steps and radians: the recipe's word, or the machine's, or the default."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from batik_vector.fields import belongs
from batik_vector.processes.cutting.choices import Inks, Keep, LineBodies, Narrow, Start, Turns
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.processes.options import CutProcess

OVERCUT = 1.0
"""How far in mm a drag knife cuts past its start, unless told: the usual value of vinyl cutters (SkyCut)."""
PRECUT = 2.0
"""How long in mm the cut is that turns a drag knife into its first direction, unless told."""
SAG = 0.025
"""How far in mm a drag knife may cut beside coarse sides to follow the curve that they stand for."""
LOOSE = 2.0
"""Tolerances by which sides may stray from a curve and still stand for it: they may be unevenly spaced."""
QUARTERS = {Turns.NONE: (0,), Turns.HALF: (0, 2), Turns.QUARTER: (0, 1, 2, 3)}


@frozen(kw_only=True)
class Told:
    """A cut in the kernels' units: lengths in steps, angles in radians. None where nothing is asked."""

    inks: Inks
    lines: LineBodies
    keep: Keep
    narrow: Narrow
    kerf: int
    blade_offset: int
    corner: float
    sag: float
    swivel: float
    precut: int
    overcut: float
    start: Start
    tabs: int
    tab_length: int
    tab_spacing: int | None
    weed_box: int | None
    weed_lines: int | None
    weed_margin: int
    registration: int | None
    sheet: tuple[int, int] | None
    gap: int
    quarters: tuple[int, ...]
    sheet_number: int | None

    @property
    def inset(self) -> int:
        """How far from the edges of a sheet nothing is nested: registration marks stand there."""
        return 2 * (self.registration or 0)


def told(spec: CutProcess, tolerance: float) -> Told:
    """Return what is asked, and what the defaults say where nothing is.

    Args:
        spec: what the recipe says, and where it says nothing the machine.
        tolerance: how far drawn edges may stand from the true curves, in mm.
    """
    blade = spec.blade_offset or 0.0
    if not blade:
        belongs(spec, ("swivel", "precut"), "blade_offset, or a machine with a drag knife,")
    start = spec.start or (Start.STRAIGHT if blade else Start.NEAREST)
    return Told(
        inks=spec.inks,
        lines=spec.lines,
        keep=spec.keep,
        narrow=spec.narrow,
        kerf=_steps(spec.kerf or 0.0),
        blade_offset=_steps(blade),
        corner=math.radians(spec.corner),
        sag=min(SAG, LOOSE * tolerance) * STEPS_PER_MM,
        swivel=math.radians(spec.swivel),
        precut=_steps(_first(spec.precut, PRECUT if blade else 0.0)),
        overcut=_first(spec.overcut, OVERCUT if blade else 0.0),
        start=start,
        tabs=spec.tabs,
        tab_length=_steps(spec.tab_length),
        tab_spacing=_maybe(spec.tab_spacing),
        weed_box=_maybe(spec.weed_box),
        weed_lines=_maybe(spec.weed_lines),
        weed_margin=_steps(spec.weed_margin),
        registration=_maybe(spec.registration),
        sheet=None if spec.sheet is None else (_steps(spec.sheet[0]), _steps(spec.sheet[1])),
        gap=_steps(spec.gap),
        quarters=QUARTERS[spec.turns],
        sheet_number=spec.sheet_number,
    )


def _first(*given: float | None) -> float:
    return next((each for each in given if each is not None), 0.0)


def _steps(millimetres: float) -> int:
    return round(millimetres * STEPS_PER_MM)


def _maybe(millimetres: float | None) -> int | None:
    return None if millimetres is None else _steps(millimetres)
