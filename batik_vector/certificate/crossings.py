"""Where the borders of areas cross the seam, and whether what leaves by one edge comes in by the other.

What the areas of an ink cover of two opposite edges is compared as intervals on one circle. A stretch
that one of them covers alone is a break. Where it lies between a crossing of the one edge and a crossing
of the other, a border crosses both out of register, by the length of the stretch; else a mark ends at the
seam, or stops short of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from batik_vector.certificate.drawing import Borders, InkDrawing
from batik_vector.certificate.report import EdgeStretch, Kind, Limits, Measures, SeamFault
from batik_vector.certificate.seam import EDGE_NAMES, Seam, nearest_distance, traces
from batik_vector.certificate.shifts import Events
from batik_vector.geometry.congruence import distinct
from batik_vector.tiling.torus.seams import Intervals, inside, joined, symmetric_difference
from batik_vector.units import format_mm
from batik_vector.values import frozen


@frozen(eq=False)
class Crossings:
    """What the borders of one ink do at one seam, in steps.

    ``here`` and ``there`` are what near and far edge are covered by, ``breaks`` what one of them has
    alone, longer than the limit and not meant. ``mismatch`` is the worst of the crossings that stand
    apart, in mm.
    """

    ink: InkDrawing
    seam: Seam
    here: Intervals
    there: Intervals
    breaks: Intervals
    mismatch: float

    def only(self, counts: Callable[[float, float], bool]) -> Crossings:
        """Return what is left where of all breaks only some count, by where (steps) they begin and end."""
        rows = [counts(low, high) for low, high in self.breaks.tolist()]
        return replace(
            self, breaks=self.breaks[np.array(rows, bool)], mismatch=self.mismatch if any(rows) else 0.0
        )

    @property
    def paired(self) -> NDArray[np.int64]:
        """Where the borders of both edges meet."""
        near, far = (_ends(covered, self.seam.length) for covered in (self.here, self.there))
        both = np.intersect1d(2 * near.along + near.sort, 2 * far.along + far.sort)
        return distinct(both // 2)

    def along(self, limit: float) -> list[EdgeStretch]:
        """Return what of either edge alone is covered on purpose, longer than a limit (mm)."""
        seam, per_mm = self.seam, self.seam.frame.per_mm
        cuts = distinct(np.concatenate([self.here.ravel(), self.there.ravel(), self.breaks.ravel()]))
        middle = (cuts[1:] + cuts[:-1]) / 2
        near, far, broken = (inside(middle, each) for each in (self.here, self.there, self.breaks))
        found = []
        for is_far, only in ((False, near & ~far & ~broken), (True, far & ~near & ~broken)):
            stretches = joined(np.column_stack([cuts[:-1][only], cuts[1:][only]]))
            for low, high in stretches.tolist():
                if high - low > limit * per_mm:
                    begin = seam.place(low, is_far)[1 - seam.axis]
                    edge = EDGE_NAMES[seam.axis][is_far]
                    found.append(EdgeStretch(edge, self.ink.ink.name, begin, begin + (high - low) / per_mm))
        return found

    @property
    def measures(self) -> Measures:
        """Counts and the worst displacement."""
        return Measures(crossings=len(self.paired), unpaired=len(self.breaks), mismatch=self.mismatch)

    def broken(self, limit: float) -> list[float]:
        """Return where breaks are, in steps along the near edge. They are longer than any limit (mm)."""
        return [float(low + high) / 2 for low, high in self.breaks.tolist()]

    def events(self, number: int) -> tuple[Events, Events]:
        """Return the crossings of near and far edge, sorted by ink and by whether it begins or ends there."""
        near, far = (_ends(covered, self.seam.length) for covered in (self.here, self.there))
        return Events(near.along, near.sort + 3 * number), Events(far.along, far.sort + 3 * number)


def _ends(covered: Intervals, length: int) -> Events:
    """Return where ink begins and ends on a circle, given as intervals that are cut at its beginning."""
    ends, sort = covered.ravel(), np.tile([0, 1], len(covered))
    if len(covered) and covered[0, 0] == 0 and covered[-1, 1] == length:
        ends, sort = ends[1:-1], sort[1:-1]
    return Events(ends % length, sort)


def area_crossings(ink: InkDrawing, seam: Seam, borders: Borders, limits: Limits, finer: int) -> Crossings:
    """Compare two opposite edges.

    Args:
        ink: whose areas.
        seam: the edges.
        borders: stretches that may be covered on one side, see :class:`~batik_vector.artwork.Artwork`.
        limits: how far crossings may stand apart.
        finer: how many steps a step of the borders is.
    """
    here, there = traces(ink.areas, seam)
    meant = [
        (low * finer, high * finer)
        for name, axis, low, high in sorted(borders)
        if (name, axis) == (ink.ink.name, seam.axis)
    ]
    legal = joined(np.array(sorted(meant), np.int64).reshape(-1, 2))
    odd = symmetric_difference(here, there)
    breaks = symmetric_difference(joined(np.vstack([odd, legal])), legal)
    sizes = breaks[:, 1] - breaks[:, 0]
    limit = limits.position * seam.frame.per_mm
    breaks, small = breaks[sizes > limit], sizes[sizes <= limit]
    apart = [
        high - low for low, high, _ in _displaced(_round(breaks, seam.length), here, there, seam, limits)
    ]
    worst = max([*apart, *small.tolist()], default=0)
    return Crossings(ink, seam, here, there, breaks, worst / seam.frame.per_mm)


def _round(breaks: Intervals, length: int) -> list[tuple[int, int]]:
    """Return breaks on the circle: one that lies across its beginning as one."""
    rows: list[tuple[int, int]] = [(int(low), int(high)) for low, high in breaks]
    if len(rows) > 1 and rows[0][0] == 0 and rows[-1][1] == length:
        rows = [*rows[1:-1], (rows[-1][0], length + rows[0][1])]
    return rows


def _displaced(
    breaks: list[tuple[int, int]], here: Intervals, there: Intervals, seam: Seam, limits: Limits
) -> Iterator[tuple[int, int, bool]]:
    """Yield the breaks between two crossings that ought to be one, and whether the lower one is near."""
    near, far = set(here.ravel().tolist()), set(there.ravel().tolist())
    for low, high in breaks:
        if high - low > limits.reach * seam.frame.per_mm:
            continue
        a, b = low % seam.length, high % seam.length
        if a in near and b in far:
            yield low, high, True
        elif a in far and b in near:
            yield low, high, False


def break_faults(found: Crossings, limits: Limits) -> list[SeamFault]:
    """Return a fault for each break of a seam."""
    seam = found.seam
    breaks = _round(found.breaks, seam.length)
    faults = []
    displaced = {
        (low, high): near for low, high, near in _displaced(breaks, found.here, found.there, seam, limits)
    }
    for low, high in breaks:
        if (low, high) in displaced:
            faults.append(_offset_fault(found, low, high, displaced[low, high]))
        else:
            faults.append(_unpaired_fault(found, low, high, limits))
    return faults


def _offset_fault(found: Crossings, low: int, high: int, low_is_near: bool) -> SeamFault:
    seam = found.seam
    near, far = (low, high) if low_is_near else (high, low)
    apart = (high - low) / seam.frame.per_mm
    words = (
        f"a border crosses {seam.at(near, False)} and {seam.at(far, True)}, "
        f"{format_mm(apart) if apart >= 0.001 else f'{apart:.6f}'} mm out of register"
    )
    return SeamFault(Kind.OFFSET, found.ink.ink.name, seam.place(near, False), words, apart)


def _unpaired_fault(found: Crossings, low: int, high: int, limits: Limits) -> SeamFault:
    seam, middle = found.seam, (low + high) / 2
    at = middle % seam.length
    row = np.searchsorted(found.here[:, 0], at, side="right") - 1
    near = bool(row >= 0 and at < found.here[row, 1])
    size = (high - low) / seam.frame.per_mm
    words = (
        f"{format_mm(size)} mm are covered at {seam.at(middle, not near)} and bare at {seam.at(middle, near)}"
    )
    short = nearest_distance(found.ink.areas, seam.steps(middle, near), limits.reach * seam.frame.per_mm)
    if short is None:
        return SeamFault(Kind.UNPAIRED, found.ink.ink.name, seam.place(middle, not near), words, size)
    gap = short[0] / seam.frame.per_mm
    words += f", where the ink stops {format_mm(gap)} mm short"
    return SeamFault(Kind.UNPAIRED, found.ink.ink.name, seam.place(middle, near), words, size)
