"""What would make a tile pass: the limit, the repeat or the page that its faults speak for."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np

from batik_vector.certificate.drawing import Drawing
from batik_vector.certificate.picture.bodies import Bodies
from batik_vector.certificate.picture.joints import Joints, joints_of
from batik_vector.certificate.picture.rim import Rim
from batik_vector.certificate.report import Kind, Limits, SeamFault
from batik_vector.certificate.seam import Seam, seams_of
from batik_vector.certificate.shifts import repeat_words
from batik_vector.units import format_mm

EXACT = Limits().position
"""Crossings that stand further apart (mm) are told of, also where more is allowed."""

NEAR = 0.1
"""Crossings (mm) as far apart as files with one decimal of a pixel leave them, and some more."""

DROPS = sorted(
    {Fraction(p, q) for q in range(2, 6) for p in range(1, q)}, key=lambda drop: (drop.denominator, drop)
)
"""Drops that are tried where a tile does not repeat straight."""

PAGE = 0.02
"""Share of a side by which another page is looked for."""

MOST_TRIED, MOST_VOTES = 6, 2000
"""Pages that are tried for each side, and places on each edge by which they are found."""

MM_PER_PX = 25.4 / 96


def hints(
    faults: Sequence[SeamFault],
    tile: Drawing,
    bodies: Bodies | None,
    joints: Sequence[Joints],
    limits: Limits,
) -> Iterator[str]:
    """Yield in words what would mend the faults of a tile."""
    apart = [fault.amount for fault in faults if fault.kind == Kind.OFFSET]
    seam_faults = [fault for fault in faults if fault.kind in (Kind.OFFSET, Kind.UNPAIRED, Kind.SHIFT)]
    if apart and len(apart) == len(faults) and max(apart) <= NEAR:
        yield f"every crossing meets within {_up(max(apart))} mm: --position {_up(max(apart))} lets it pass"
    passed = max((each.mismatch for each in joints), default=0.0)
    if passed > EXACT:
        yield (
            f"crossings stand up to {_up(passed)} mm apart, and {limits.position:g} mm are allowed: "
            f"--position {_up(passed)} would do"
        )
    if bodies is None or not any(each.broken for each in joints):
        return
    if len(seam_faults) == len(faults):
        yield from _repeats(tile, bodies, limits)
        yield from _pages(tile, bodies, joints, limits)


def _up(value: float) -> str:
    """Round up to two digits, so that what is told is enough."""
    digits = 1 - math.floor(math.log10(value))
    return f"{math.ceil(value * 10**digits - 1e-9) / 10**digits:.{max(digits, 0)}f}"


def _repeats(tile: Drawing, bodies: Bodies, limits: Limits) -> Iterator[str]:
    """Yield the repeat, if there is one, in which nothing is cut off at any seam."""
    seams = seams_of(tile.frame)
    rim = Rim(bodies, seams)
    sound = {
        (seam.axis, drop): not joints_of(
            rim, replace(seam, slip=round(drop * seam.length)), tile, limits
        ).broken
        for seam in seams
        for drop in (Fraction(0), *DROPS)
        if (drop * seam.length).denominator == 1 or drop.denominator == 2
    }
    now = Fraction(seams[0].slip, seams[0].length), Fraction(seams[1].slip, seams[1].length)
    for axis in (0, 1):
        if not sound.get((1 - axis, Fraction(0))):
            continue
        for drop in (Fraction(0), *DROPS):
            if sound.get((axis, drop)) and now[axis] != drop:
                words = repeat_words(drop, axis)
                yield f"as {words} nothing would be cut off: --repeat {words}"
                return


def _pages(tile: Drawing, bodies: Bodies, joints: Sequence[Joints], limits: Limits) -> Iterator[str]:
    """Yield the sides that the page would have to have."""
    for each in joints:
        seam = each.seam
        if not each.broken or seam.slip:
            continue
        for far in _candidates(bodies, seam):
            other = replace(seam, far=far)
            if not joints_of(Rim(bodies, [other, *_others(tile, seam)]), other, tile, limits).broken:
                side, mm = ("wide", "high")[seam.axis], far / seam.frame.per_mm
                was = (seam.far - seam.near) / seam.frame.per_mm
                right = f"{format_mm(mm)} mm ({mm / MM_PER_PX:.2f} px)"
                yield f"the page is {format_mm(was)} mm {side}; {right} would be right"
                break


def _others(tile: Drawing, seam: Seam) -> list[Seam]:
    return [each for each in seams_of(tile.frame) if each.axis != seam.axis]


def _candidates(bodies: Bodies, seam: Seam) -> list[int]:
    """Return where the far edge would bring most vertices of it onto those of the near edge, in steps."""
    per_mm = seam.frame.per_mm
    xy, paint = Rim.vertices(bodies, per_mm)
    across, along = xy[:, seam.axis], xy[:, 1 - seam.axis]
    reach = PAGE * (seam.far - seam.near)
    near = np.flatnonzero(np.abs(across - seam.near) <= reach)[:MOST_VOTES]
    far = np.flatnonzero(np.abs(across - seam.far) <= reach)[:MOST_VOTES]
    if not len(near) or not len(far):
        return []
    level = np.abs(along[near][:, None] - along[far][None, :]) <= 0.01 * per_mm
    level &= paint[near][:, None] == paint[far][None, :]
    apart = (across[far][None, :] - across[near][:, None])[level]
    apart = apart[np.abs(apart - (seam.far - seam.near)) <= reach]
    steps, votes = np.unique(np.rint(apart / (0.002 * per_mm)), return_counts=True)
    best = np.argsort(-votes, kind="stable")[:MOST_TRIED]
    return [round(float(np.median(apart[np.rint(apart / (0.002 * per_mm)) == steps[i]]))) for i in best]
