"""What no bridges hold: said with the key, the place, and the value that would do."""

from __future__ import annotations

import math

import numpy as np
import shapely

from batik_vector.errors import GeometryError
from batik_vector.geometry.sampling import Points
from batik_vector.processes.stencilling.planning import Ground, Plan, planned
from batik_vector.processes.stencilling.spans import BEHIND
from batik_vector.units import STEPS_PER_MM, format_mm

HALVINGS = 5
"""How often the breadth that would do is halved in on."""
LEAST = 100
"""Steps of breadth below which no bridge is offered."""


def check_whole(plan: Plan, ink: str, breadth: int, symmetric: bool) -> None:
    """Refuse a sheet that its bridges do not hold.

    Args:
        plan: as it came out.
        ink: whose stencil it is.
        breadth: of the bridges, in steps.
        symmetric: whether they were to follow the symmetry.

    Raises:
        GeometryError: with the place of what falls out, and the breadth of bridges that would do.
    """
    if plan.made.whole:
        return
    ground = plan.ground
    place, what = _loose(plan)
    at = f"({place[0] / STEPS_PER_MM:.3f}, {place[1] / STEPS_PER_MM:.3f}) mm"
    loose = f'{what} of ink "{ink}" at {at}'
    free = symmetric and len(ground.symmetry) > 1 and _holds_without(ground, breadth)
    fits = _breadth_that_fits(ground, breadth)
    if free:
        ways = f"at most {_mm(fits)}, or symmetric = false" if fits else "symmetric = false beside it"
        why = f"no bridges so broad hold {loose} and follow all {len(ground.symmetry)} symmetries"
    elif fits:
        ways = f"at most {_mm(fits)}"
        why = (
            f"{loose} is held by none so broad, which needs the gap on both sides and {BEHIND:g} of its "
            "breadth of sheet behind either end"
        )
    else:
        ways, why = "a sheet that bridges can hold", f"{loose} falls out whatever their breadth"
    raise GeometryError(
        f"bridge = {_mm(breadth)}, expected {ways}: {why}; drop leaves small islands out, "
        'backing = "net" holds them without bridges'
    )


def check_sheet(ground: Ground, ink: str) -> None:
    """Refuse openings that leave nothing of the sheet.

    Raises:
        GeometryError: naming the ink.
    """
    if not len(ground.sheet.parts):
        raise GeometryError(
            f'inks, expected openings that leave a sheet: ink "{ink}" covers all of the tile, and nothing is '
            "left to cut a stencil of"
        )


def _loose(plan: Plan) -> tuple[Points, str]:
    """Return a place on the smallest piece that is not held, and what it is."""
    sheet, made = plan.ground.sheet, plan.made
    lies = [made.lies(part)[0] for part in range(len(sheet.parts))]
    area = shapely.area(sheet.parts)
    total: dict[int, float] = {}
    for name, own in zip(lies, area.tolist(), strict=True):
        total[name] = total.get(name, 0.0) + own
    closed = {name for name in total if not made.span(name).rank}
    name = min(closed or total, key=lambda each: (total[each], each))
    mine = np.array([each == name for each in lies])
    part = sheet.parts[mine][int(np.argmax(area[mine]))]
    return shapely.get_coordinates(shapely.point_on_surface(part))[0], "an island" if closed else "a strip"


def _breadth_that_fits(ground: Ground, breadth: int) -> int:
    """Return a breadth of bridges that would hold the sheet, about the largest; 0 where there is none."""
    low, high = 0, breadth
    for _ in range(HALVINGS):
        middle = (low + high) // 2
        if middle < LEAST:
            break
        if planned(ground, middle, thorough=False).made.whole:
            low = middle
        else:
            high = middle
    digits = 10 ** max(0, math.floor(math.log10(low)) - 1) if low else 1
    return low // digits * digits


def _holds_without(ground: Ground, breadth: int) -> bool:
    return planned(Ground(ground.sheet, ground.opened, ground.contours), breadth, thorough=False).made.whole


def _mm(steps: float) -> str:
    return f"{format_mm(steps / STEPS_PER_MM)} mm"
