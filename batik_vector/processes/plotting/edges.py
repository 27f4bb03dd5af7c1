"""Edges of the page: where they cut an area off, its outline runs along them, which is no line of the design.

On a tile that repeats such a line comes twice, on this edge and on the one opposite, and is left out on both.
A mark whose own border lies on the edge has no twin there and keeps it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import FAR, Index, Outlines
from batik_vector.processes.plotting.pieces import Pieces
from batik_vector.values import frozen

Box: TypeAlias = tuple[int, int, int, int]
"""Left, lower, right and upper edge, in steps."""
Shifts: TypeAlias = tuple[tuple[int, int], tuple[int, int]]
"""The two translations that repeat a tile, in steps."""
Ints: TypeAlias = NDArray[np.int64]


@frozen(eq=False)
class _Edge:
    """Pieces along an edge: their numbers, and where they lie on it, the lower end first."""

    which: Index
    low: Ints
    high: Ints

    @staticmethod
    def at(pieces: Pieces, axis: int, place: int) -> _Edge:
        """Return the pieces along x = ``place``, or y for axis 1."""
        upon = (pieces.begin[:, axis] == place) & (pieces.end[:, axis] == place)
        which = np.flatnonzero(upon)
        ends = np.stack([pieces.begin[which, 1 - axis], pieces.end[which, 1 - axis]])
        return _Edge(which, ends.min(axis=0), ends.max(axis=0))

    def within(self, stretches: Ints) -> NDArray[np.bool_]:
        """Return which pieces lie within stretches, of which none parts a piece."""
        return np.asarray(np.searchsorted(stretches, self.low, "right") % 2 == 1)

    def stretches(self, shift: int, period: int) -> Ints:
        """Return the ends of the stretches where pieces lie when moved along, and a period to either side."""
        moved = [shift - period, shift, shift + period]
        low, high = (np.concatenate([each + by for by in moved]) for each in (self.low, self.high))
        order = np.argsort(low, kind="stable")
        low, high = low[order], np.maximum.accumulate(high[order])
        heads = np.flatnonzero(np.append(True, low[1:] > high[:-1])[: len(low)])
        tails = np.append(heads[1:], len(low))[: len(heads)] - 1
        return np.stack([low[heads], high[tails]], axis=1).ravel()


def without_edges(outlines: Outlines, box: Box, shifts: Shifts | None = None) -> Outlines:
    """Return outlines of areas without what runs along the edges of a page.

    Args:
        outlines: one ring to a mark.
        box: the page.
        shifts: of a tile that repeats, whose lower left corner is (0, 0): only what is there on both of two
            opposite edges is left out.
    """
    pieces = Pieces.of(outlines)
    if shifts is None:
        whole = np.array([-FAR, FAR], np.int64)
        edges = [(axis, box[k], whole) for axis in (0, 1) for k in (axis, axis + 2)]
    else:
        edges = list(_twins(pieces, box, shifts))
    for axis, place, stretches in edges:
        pieces = _cut(pieces, axis, place, stretches)
    stays = np.ones(len(pieces.stroke), bool)
    for axis, place, stretches in edges:
        edge = _Edge.at(pieces, axis, place)
        stays[edge.which[edge.within(stretches)]] = False
    return outlines if stays.all() else pieces.staying(stays, outlines.closed)[0]


def _twins(pieces: Pieces, box: Box, shifts: Shifts) -> Iterator[tuple[int, int, Ints]]:
    """Yield each edge with the stretches that lie along the one opposite, brought here."""
    for axis in (0, 1):
        along, period = shifts[axis][1 - axis], shifts[1 - axis][1 - axis]
        low, high = box[axis], box[axis + 2]
        yield axis, low, _Edge.at(pieces, axis, high).stretches(-along, period)
        yield axis, high, _Edge.at(pieces, axis, low).stretches(along, period)


def _cut(pieces: Pieces, axis: int, place: int, stretches: Ints) -> Pieces:
    """Return pieces of which none along an edge lies partly within stretches."""
    edge = _Edge.at(pieces, axis, place)
    first, stop = np.searchsorted(stretches, edge.low, "right"), np.searchsorted(stretches, edge.high, "left")
    counts = np.maximum(stop - first, 0)
    if not counts.any():
        return pieces
    ends = np.cumsum(counts)
    local = np.arange(ends[-1]) - np.repeat(ends - counts, counts)
    down = (pieces.begin[edge.which, 1 - axis] > edge.low)[np.repeat(np.arange(len(counts)), counts)]
    local = np.where(down, np.repeat(counts, counts) - 1 - local, local)
    at = np.full((ends[-1], 2), place, np.int64)
    at[:, 1 - axis] = stretches[np.repeat(first, counts) + local]
    return pieces.cut(np.repeat(edge.which, counts), at)
