"""Machine fit: a repeat drawn out a little, so that a whole number of them fills a machine's own.

Screens, rotary rollers and heat presses come in given lengths; 640 mm and 25.25 in (641.35 mm) are the
commonest rotary repeats. Printers of pixels want a whole number of them in a repeat.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Annotated

from batik_vector.artwork import Cell
from batik_vector.errors import Fault, RecipeError
from batik_vector.fields import Between, Length, Says, check
from batik_vector.units import STEPS_PER_MM, format_mm, to_steps
from batik_vector.values import frozen

STEPS_PER_INCH = 25_400

MachineRepeat = Annotated[Length, Between(0.1, 20_000)]

ROUNDING = 1e-9
"""Relative: what floats may add to a stretch that is just within its limit."""


@frozen(kw_only=True)
class Fit:
    """The repeat of a machine, which a whole number of the finished rectangle's repeats must fill."""

    width: Annotated[MachineRepeat | None, Says("machine repeat across; free when left out")] = None
    height: Annotated[MachineRepeat | None, Says("machine repeat along the cloth; free when left out")] = None
    limit: Annotated[float, Between(0, 50), Says("per cent that the drawing may be stretched by")] = 1.0

    def __post_init__(self) -> None:
        check(self)


def per_cent(stretch: float) -> str:
    """Return a factor as people read it: 1.0123 → "+1.23 %"."""
    return f"{100 * (stretch - 1):+.3g} %"


def repeats_to_fill(machine: float, repeat: float, units: int, limit: float, side: str) -> int:
    """Return how many repeats fill a machine's length with the least stretch.

    Args:
        machine: the machine's repeat, in mm.
        repeat: the finished rectangle's side, in mm.
        units: how many units of the tile lie along it.
        limit: of the stretch, in per cent.
        side: ``width`` or ``height``, for the message.

    Raises:
        RecipeError: with the stretch and the sizes that fit without one.
    """
    counts = sorted({max(math.floor(machine / repeat), 1), math.ceil(machine / repeat)})
    best = min(counts, key=lambda count: abs(math.log(machine / (count * repeat))))
    stretch = machine / (best * repeat)
    if abs(stretch - 1) * 100 <= limit * (1 + ROUNDING) + ROUNDING:
        return best
    key = f"fit.{side}"
    if best == 1 and stretch < 1:
        raise RecipeError(
            [
                Fault(
                    f"the repeat's {side} of {format_mm(repeat)} mm does not fit into the machine's "
                    f"{format_mm(machine)} mm: expected a tile of at most {format_mm(machine / units)} mm",
                    key,
                )
            ]
        )
    # What is told is what the tile would have: its sides lie on the grid.
    told = per_cent(to_steps(machine / (best * units)) * units / STEPS_PER_MM / repeat)
    nearest = sorted(counts, key=lambda count: count != best)
    sizes = " or ".join(f"{format_mm(machine / (count * units))} mm" for count in nearest)
    raise RecipeError(
        [
            Fault(
                f"{best} repeats of {format_mm(repeat)} mm fill {format_mm(machine)} mm when stretched by "
                f"{told}, past the limit of {limit:g} %: expected a tile of {side} {sizes}, "
                "or a higher limit",
                key,
            )
        ]
    )


def pixel_advice(cell: Cell, dpi: float) -> str | None:
    """Return a warning where a cell is no whole number of pixels at a resolution, and what would be.

    A tile of broken pixels is resampled by whoever prints it, and shows its seams.
    """
    resolution = Fraction(str(dpi))
    broken = []
    for side, steps in (("width", cell.columns), ("height", cell.rows)):
        pixels = steps * resolution / STEPS_PER_INCH
        if pixels.denominator != 1:
            broken.append((side, steps, pixels))
    if not broken:
        return None
    words = " and ".join(
        f"the {side} of {format_mm(steps / STEPS_PER_MM)} mm is {float(pixels):,.2f} pixels"
        for side, steps, pixels in broken
    )
    sizes = " and ".join(f"a {side} of {_whole_size(steps, resolution)}" for side, steps, _ in broken)
    return f"{words} at {dpi:g} dpi: whole at {_whole_resolutions(cell, resolution)}, or with {sizes}"


def _whole_resolutions(cell: Cell, resolution: Fraction) -> str:
    """Return the resolutions below and above one at which both sides are whole numbers of pixels."""
    step = math.lcm(*(STEPS_PER_INCH // math.gcd(side, STEPS_PER_INCH) for side in (cell.columns, cell.rows)))
    below = math.floor(resolution / step) * step
    choices = [each for each in (below, below + step) if each]
    choices.sort(key=lambda each: (abs(each - resolution), each))
    return " or ".join(f"{each:,}" for each in choices) + " dpi"


def _whole_size(steps: int, resolution: Fraction) -> str:
    """Return the nearest length that is a whole number of pixels and of grid steps."""
    pixel = STEPS_PER_INCH / resolution
    count = max(round(steps / (pixel * pixel.denominator)), 1) * pixel.denominator
    return f"{format_mm(float(count * pixel) / STEPS_PER_MM)} mm ({count:,} pixels)"
