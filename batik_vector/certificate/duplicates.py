"""What is drawn twice: stretches that two lines share, and areas that lie over one another.

Lines are compared on the torus: one along the left edge and one along the right edge are the same line.
A plotter draws the second over the first, a cutter cuts it again.

Stretches on one straight line count at any length. Lines that only run close to one another are found in
many drawings, wherever curves touch. In files off the 1 µm grid they are the same line drawn twice where
nearly all of both runs so, or a straight stretch longer than ``LONG_MM``. Tiles on the grid have been through
a compiler that draws no stretch twice, and what comes close in them was drawn so; of these only lines of
that length count that a seam parts. Two lines close together along the seam are looked for as slivers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Overlap
from batik_vector.certificate.drawing import Edges, Frame, InkDrawing, joined, repeats
from batik_vector.certificate.report import Kind, Limits, SeamFault
from batik_vector.units import format_mm
from batik_vector.values import frozen

LONG_MM = 5.0
"""A stretch this long (mm) does not run beside another because both curves happen to touch."""

SAME_MM = 1e-6
"""Stretches this near (mm) to one straight line lie on it, in files off the grid."""

STEADY = 0.4
"""Share of the limit by which the distance of such a stretch may change from one end to the other."""

MOST = 0.9
"""Share of both lines that has to run side by side for them to be one."""

Floats = NDArray[np.float64]


@frozen(eq=False)
class Shared:
    """Stretches that pairs of edges share: on edge ``one`` from ``low`` to ``high`` (steps from its begin).

    ``other`` is the edge it shares them with; ``exact`` says that both lie on one straight line,
    ``steady`` that they keep their distance, ``across`` that the seam is between them.
    """

    one: NDArray[np.intp]
    other: NDArray[np.intp]
    low: Floats
    high: Floats
    exact: NDArray[np.bool_]
    steady: NDArray[np.bool_]
    across: NDArray[np.bool_]

    def only(self, which: NDArray[np.bool_]) -> Shared:
        """Return some of them."""
        return Shared(*(getattr(self, name)[which] for name in self.__dataclass_fields__))


def doubled_lines(ink: InkDrawing, frame: Frame, limits: Limits) -> tuple[float, list[SeamFault]]:
    """Return the total length (mm) of lines drawn again, and a fault for each pair of lines at it."""
    edges = ink.strokes
    if not len(edges):
        return 0.0, []
    shared = _shared(edges, frame, limits.double * frame.per_mm)
    shared = shared.only(_counts(shared, edges, frame))
    # The later of two edges is the one drawn again.
    shared = shared.only(shared.one > shared.other)
    total = _covered(shared, edges) / frame.per_mm
    owners = np.column_stack([edges.owner[shared.one], edges.owner[shared.other]])
    pairs, number = np.unique(owners, axis=0, return_inverse=True)
    lengths = np.bincount(number.ravel(), shared.high - shared.low, minlength=len(pairs)) / frame.per_mm
    faults = []
    for pair, length in enumerate(lengths.tolist()):
        rows = np.flatnonzero(number.ravel() == pair)
        longest = rows[np.argmax((shared.high - shared.low)[rows])]
        faults.append(_line_fault(shared, edges, int(longest), length, ink.ink.name, frame))
    return total, faults


def shared_lines(inks: Sequence[InkDrawing], frame: Frame, limits: Limits) -> list[SeamFault]:
    """Return a fault for each pair of lines of different inks that run along the same way."""
    some = [ink for ink in inks if len(ink.strokes)]
    if len(some) < 2:
        return []
    edges = joined([ink.strokes for ink in some])
    counts = [int(ink.strokes.owner.max()) + 1 for ink in some]
    begins = np.concatenate([[0], np.cumsum(counts)])
    ink = np.repeat(np.arange(len(some)), [len(each.strokes) for each in some])
    edges = replace(edges, owner=edges.owner + begins[ink])
    shared = _shared(edges, frame, limits.double * frame.per_mm)
    shared = shared.only(_counts(shared, edges, frame))
    shared = shared.only((shared.one > shared.other) & (ink[shared.one] != ink[shared.other]))
    pairs = np.column_stack([edges.owner[shared.one], edges.owner[shared.other]])
    faults = []
    for pair in np.unique(pairs, axis=0):
        rows = np.flatnonzero((pairs == pair).all(axis=1))
        length = float((shared.high - shared.low)[rows].sum()) / frame.per_mm
        row = int(rows[np.argmax((shared.high - shared.low)[rows])])
        mine, other = (some[ink[side[row]]].ink.name for side in (shared.one, shared.other))
        fault = _line_fault(shared, edges, row, length, mine, frame)
        words = f"{format_mm(length)} mm of a line are drawn in ink {other} too"
        faults.append(replace(fault, kind=Kind.BETWEEN, words=words))
    return faults


def _line_fault(shared: Shared, edges: Edges, row: int, length: float, ink: str, frame: Frame) -> SeamFault:
    edge = shared.one[row]
    step = (edges.end[edge] - edges.begin[edge]).astype(np.float64)
    middle = edges.begin[edge] + step * (shared.low[row] + shared.high[row]) / 2 / np.hypot(*step)
    words = f"{format_mm(length)} mm of a line are drawn twice"
    return SeamFault(Kind.DOUBLE, ink, frame.mm(float(middle[0]), float(middle[1])), words, length)


def _shared(edges: Edges, frame: Frame, reach: float) -> Shared:
    """Return every stretch on which an edge runs within ``reach`` steps of another, on the torus."""
    count = len(edges)
    begin, end = edges.begin.astype(np.float64), edges.end.astype(np.float64)
    copies = repeats(edges, frame, 0, reach) + repeats(edges, frame, 1, reach)
    begins = np.concatenate([begin, *(begin[rows] + shift for rows, shift in copies)])
    ends = np.concatenate([end, *(end[rows] + shift for rows, shift in copies)])
    origin = np.concatenate([np.arange(count), *(rows for rows, _ in copies)])
    lines = np.asarray(shapely.linestrings(np.stack([begins, ends], axis=1)), dtype=object)
    one, other = shapely.STRtree(lines).query(lines[:count], predicate="dwithin", distance=reach)
    apart = origin[one] != origin[other]
    one, other = one[apart], other[apart]
    step = end[one] - begin[one]
    length = np.hypot(step[:, 0], step[:, 1])
    way = step / length[:, None]
    from_begin, from_end = begins[other] - begin[one], ends[other] - begin[one]
    t0, t1 = (from_begin * way).sum(axis=1), (from_end * way).sum(axis=1)
    s0, s1 = _across(step, length, from_begin), _across(step, length, from_end)
    low, high = _within(t0, t1, s0, s1, length, reach)
    close = high - low > 2 * reach
    slope = (s1 - s0) / np.where(t1 == t0, 1.0, t1 - t0)
    # On the grid lines that are a step apart were drawn so, and one line is one to the bit.
    exact = np.maximum(np.abs(s0), np.abs(s1)) <= (0.0 if frame.exact else SAME_MM * frame.per_mm)
    steady = np.abs(slope) * (high - low) <= STEADY * reach
    found = Shared(one, origin[other], low, high, exact, steady, other >= count)
    return found.only(close)


def _across(step: Floats, length: Floats, offset: Floats) -> Floats:
    """Return how far offsets lead to the left of edges; exactly 0 where they are parallel on the grid."""
    return np.asarray((step[:, 0] * offset[:, 1] - step[:, 1] * offset[:, 0]) / length)


def _within(
    t0: Floats, t1: Floats, s0: Floats, s1: Floats, length: Floats, reach: float
) -> tuple[Floats, Floats]:
    """Return where along an edge another lies within reach of it: (low, high), low > high where nowhere.

    The other runs from t0, s0 to t1, s1 in the edge's own coordinates, along and across it.
    """
    run, rise = t1 - t0, s1 - s0
    flat = rise == 0
    safe = np.where(flat, 1.0, rise)
    first = np.where(
        flat, np.where(np.abs(s0) <= reach, 0.0, 2.0), np.minimum((-reach - s0) / safe, (reach - s0) / safe)
    )
    last = np.where(flat, 1.0, np.maximum((-reach - s0) / safe, (reach - s0) / safe))
    first, last = np.maximum(first, 0.0), np.minimum(last, 1.0)
    a, b = t0 + first * run, t0 + last * run
    low, high = np.maximum(np.minimum(a, b), 0.0), np.minimum(np.maximum(a, b), length)
    return np.where(first <= last, low, 1.0), np.where(first <= last, high, 0.0)


def _counts(shared: Shared, edges: Edges, frame: Frame) -> NDArray[np.bool_]:
    """Tell which stretches are a line drawn twice, and not curves that touch."""
    size = shared.high - shared.low
    least = LONG_MM * frame.per_mm
    long = shared.steady & (size >= least) & (not frame.exact)
    whole = np.bincount(edges.owner, np.hypot(*(edges.end - edges.begin).astype(np.float64).T))
    mine, its = edges.owner[shared.one], edges.owner[shared.other]
    pair, back = mine * len(whole) + its, its * len(whole) + mine
    number, row = np.unique(pair, return_inverse=True)
    beside = np.bincount(row.ravel(), size, minlength=len(number))[row.ravel()]
    most = (beside >= MOST * whole[mine]) & (mine != its)
    if frame.exact:
        most &= shared.across & (whole[mine] >= least)
    return np.asarray(shared.exact | long | (most & np.isin(back, pair[most])))


def _covered(shared: Shared, edges: Edges) -> float:
    """Return the length of edges that shared stretches cover, in steps, each part once."""
    if not len(shared.one):
        return 0.0
    span = float(np.hypot(*(edges.end - edges.begin).astype(np.float64).T).max()) + 1
    order = np.lexsort([shared.low, shared.one])
    low, high = shared.low[order] + shared.one[order] * span, shared.high[order] + shared.one[order] * span
    reach = np.maximum.accumulate(high)
    before = np.concatenate([[-1.0], reach[:-1]])
    return float(np.maximum(high - np.maximum(low, before), 0.0).sum())


def doubled_areas(ink: InkDrawing, frame: Frame, limits: Limits) -> tuple[float, list[SeamFault]]:
    """Return the total area (mm²) drawn again, and a fault for each pair of areas that lie over one another.

    Of an ink that overlays only areas that are exactly the same count. Neighbours that overlap by less
    than the limit for lines, taken over the length of the overlap, are left out.
    """
    if not len(ink.overlaps):
        return 0.0, []
    one, other = (ink.marks[side] for side in ink.overlaps.T)
    if ink.ink.overlap == Overlap.OVERLAY:
        same = shapely.equals(one, other)
        one, other = one[same], other[same]
    common = np.asarray(shapely.intersection(one, other), dtype=object)
    area, length = shapely.area(common), shapely.length(common)
    thick = 2 * area > limits.double * frame.per_mm * length
    common, area = common[thick], area[thick] / frame.per_mm**2
    places = shapely.get_coordinates(shapely.point_on_surface(common))
    faults = [
        SeamFault(Kind.DOUBLE, ink.ink.name, frame.mm(x, y), f"{format_mm(size)} mm² are drawn twice", size)
        for (x, y), size in zip(places.tolist(), area.tolist(), strict=True)
    ]
    return float(area.sum()), faults
