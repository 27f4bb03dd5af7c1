"""Stretches: runs of edges about as long as a reach, whose neighbours are found before edges are compared.

A tree of stretches is small beside one of edges. And most that lie close follow one another on a smooth
outline: of those it is enough to know how much it turns. An arc that turns by less than π in all is no longer
than its chord over the cosine of half of that (Sullivan, Curves of Finite Total Curvature, 2008), so that its
ends cannot be ``AROUND`` times nearer than the way round.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from batik_vector.audit.close_boxes import close_pairs
from batik_vector.audit.contours import Floats, Mask
from batik_vector.audit.edges import Edges
from batik_vector.certificate.drawing import Frame
from batik_vector.geometry.outlines import Index
from batik_vector.values import frozen

LONG = 2.0
"""Length of a stretch in multiples of the reach."""

AROUND = 5.0
"""The way round a narrow place, in multiples of its width: a strip is then twice as long as wide."""

TURNING = 2 * np.arccos(1 / AROUND)
"""What turns by less (radians) is nowhere so narrow."""

MOST_PAIRS = 1 << 18
"""Pairs of edges that are compared at a time, so that they stay in the processor's cache."""


@frozen(eq=False)
class Turning:
    """How much contours turn: each edge's up to its ``begin``, counted on from contour to contour (radians).

    ``circuit`` is how much the contour of each edge turns in all; infinite where it has an end.
    """

    begin: Floats
    circuit: Floats

    def little(self, edges: Edges, one: Index, last: Index, other: Index, end: Index) -> Mask:
        """Return which runs, edges ``one`` to ``last`` and ``other`` to ``end``, are on one smooth arc.

        It turns too little to come near itself. The second run does not come before the first.
        """
        between = self.begin[end] - self.begin[one]
        behind = self.circuit[one] - (self.begin[other] - self.begin[last])
        return np.asarray(
            (edges.contour[one] == edges.contour[other]) & (np.minimum(between, behind) < TURNING)
        )


def turning(edges: Edges) -> Turning:
    """Return how much contours turn."""
    step = edges.end - edges.begin
    before = step[np.maximum(edges.before, 0)]
    cross = before[:, 0] * step[:, 1] - before[:, 1] * step[:, 0]
    turn = np.abs(np.arctan2(cross, before[:, 0] * step[:, 0] + before[:, 1] * step[:, 1]))
    turn[(edges.before < 0) | edges.idle] = 0.0
    begins = np.flatnonzero(np.append(True, np.diff(edges.contour) != 0))
    whole = np.add.reduceat(np.where(edges.idle, np.inf, turn), begins)
    return Turning(np.cumsum(turn), np.repeat(whole, np.diff(np.append(begins, len(turn)))))


@frozen(eq=False)
class Stretches:
    """Runs of edges: from edge ``first`` on, ``count`` of them; ``box`` holds the bounds of each."""

    first: Index
    count: Index
    box: Floats


def stretches(edges: Edges, reach: float) -> Stretches:
    """Return the edges in runs."""
    step = edges.end - edges.begin
    long = np.hypot(step[:, 0], step[:, 1]) > reach
    bucket = np.floor(edges.travel / (LONG * reach))
    new = np.ones(len(long), bool)
    new[1:] = (edges.contour[1:] != edges.contour[:-1]) | (bucket[1:] != bucket[:-1]) | long[1:] | long[:-1]
    first = np.flatnonzero(new)
    count = np.diff(np.append(first, len(long)))
    last = first + count - 1
    low = np.minimum(np.minimum.reduceat(edges.begin, first), edges.end[last])
    high = np.maximum(np.maximum.reduceat(edges.begin, first), edges.end[last])
    return Stretches(first, count, np.hstack([low, high]))


def neighbours(edges: Edges, reach: float, frame: Frame) -> Iterator[tuple[Index, Index, Floats]]:
    """Yield pairs of edges that may lie within a reach, and how far the other is moved to lie by the one.

    Each pair comes once, and once more for every other period that brings it near.
    """
    if not len(edges.contour):
        return
    runs, turns = stretches(edges, reach), turning(edges)
    one, other, moved = _near(runs, reach, frame)
    last = runs.first + runs.count - 1
    smooth = turns.little(edges, runs.first[one], last[one], runs.first[other], last[other])
    kept = ~smooth | (moved[:, 0] != 0) | (moved[:, 1] != 0)
    one, other, moved = one[kept], other[kept], moved[kept]
    sizes = runs.count[one] * runs.count[other]
    total = np.cumsum(sizes)
    ends = np.arange(MOST_PAIRS, total[-1] if len(total) else 0, MOST_PAIRS)
    cuts = np.unique(np.searchsorted(total, ends))
    for rows in np.split(np.arange(len(one)), cuts):
        a, b, row = _expanded(runs, one[rows], other[rows])
        shift = moved[rows][row]
        close = np.flatnonzero(_may_meet(edges, a, b, shift, reach))
        a, b, shift = a[close], b[close], shift[close]
        bends = (shift[:, 0] != 0) | (shift[:, 1] != 0)
        bends |= (a < b) & ~turns.little(edges, a, a, b, b)
        yield a[bends], b[bends], shift[bends]


def _near(runs: Stretches, reach: float, frame: Frame) -> tuple[Index, Index, Floats]:
    """Return the pairs of stretches that may be within a reach, and how far the other is moved."""
    number, moved = _translates(runs.box, reach, frame)
    one, other = close_pairs(runs.box[number] + np.tile(moved, 2), reach)
    kept = (one < len(runs.box)) & (one <= number[other])
    own = np.arange(len(runs.box))
    one, other = np.concatenate([own, one[kept]]), np.concatenate([own, other[kept]])
    return one, number[other], moved[other]


def _expanded(runs: Stretches, one: Index, other: Index) -> tuple[Index, Index, Index]:
    """Return all pairs of edges of pairs of stretches, and the row of the pair each comes from."""
    sizes = runs.count[one] * runs.count[other]
    row = np.repeat(np.arange(len(one)), sizes)
    inner = np.arange(len(row)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    a, b = np.divmod(inner, runs.count[other][row])
    return runs.first[one][row] + a, runs.first[other][row] + b, row


def _may_meet(edges: Edges, a: Index, b: Index, moved: Floats, reach: float) -> Mask:
    """Return which pairs of edges have bounds within a reach, and are no neighbours on one contour."""
    close = (edges.after[a] != b) & (edges.after[b] != a)
    for axis in (0, 1):
        p, q = edges.begin[a, axis], edges.end[a, axis]
        r, s = edges.begin[b, axis] + moved[:, axis], edges.end[b, axis] + moved[:, axis]
        close &= (
            np.maximum(np.minimum(p, q), np.minimum(r, s))
            <= np.minimum(np.maximum(p, q), np.maximum(r, s)) + reach
        )
    return np.asarray(close & ~edges.idle[a] & ~edges.idle[b])


def _translates(box: Floats, reach: float, frame: Frame) -> tuple[Index, Floats]:
    """Return boxes and those translates of them that come within a reach of any box.

    Returns:
        The number of each, and how far it is moved. The boxes themselves come first, not moved.
    """
    low, high = box[:, :2].min(axis=0) - reach, box[:, 2:].max(axis=0) + reach
    first, second = (np.array(each, float) for each in frame.cell.lattice)
    numbers, moved = [np.arange(len(box))], [np.zeros((len(box), 2))]
    for way in _ways(first, second, high - low, frame):
        axis = int(np.argmax(np.abs(way)))
        if way[axis] > 0:
            rows = np.flatnonzero(box[:, axis] <= high[axis] - way[axis])
        else:
            rows = np.flatnonzero(box[:, 2 + axis] >= low[axis] - way[axis])
        there = box[rows] + np.tile(way, 2)
        rows = rows[(there[:, 2:] >= low).all(axis=1) & (there[:, :2] <= high).all(axis=1)]
        numbers.append(rows)
        moved.append(np.broadcast_to(way, (len(rows), 2)))
    return np.concatenate(numbers), np.concatenate(moved)


def _ways(first: Floats, second: Floats, extent: Floats, frame: Frame) -> Iterator[Floats]:
    """Yield the periods, other than none, that may bring something of such an extent onto itself."""
    sides = np.array([frame.cell.columns, frame.cell.rows], float)
    most = np.ceil(extent / sides).astype(int) + 1
    for i in range(-int(most[0]), int(most[0]) + 1):
        for j in range(-int(most[1]), int(most[1]) + 1):
            way = i * first + j * second
            if (i, j) != (0, 0) and (np.abs(way) < extent).all():
                yield way
