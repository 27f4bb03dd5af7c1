"""Strokes put together from straight pieces and stretches of outlines, many at a time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Offsets, Outlines
from batik_vector.values import frozen


@frozen(eq=False)
class Stretches:
    """Runs of points along rings, k of them.

    Each is of ``count`` points of the ring numbered ``ring``, from the point numbered ``first`` on and past
    the ring's end to its beginning; where ``back``, the last of them comes first.
    """

    ring: Index
    first: Index
    count: Index
    back: NDArray[np.bool_]

    def taken(self, which: Index) -> Stretches:
        """Return some of them."""
        return Stretches(self.ring[which], self.first[which], self.count[which], self.back[which])

    def members(self, outlines: Outlines) -> tuple[Index, Index, Index]:
        """Return the points of all runs, run by run, of which run each is, and its place in it."""
        of = np.repeat(np.arange(len(self.count)), self.count)
        nth = np.arange(len(of)) - np.repeat(np.cumsum(self.count) - self.count, self.count)
        begin, size = outlines.rings[self.ring[of]], np.diff(outlines.rings)[self.ring[of]]
        passed = np.where(self.back[of], self.count[of] - 1 - nth, nth)
        return begin + (self.first[of] - begin + passed) % size, of, nth


def lengths(outlines: Outlines) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return how long each edge of closed outlines is, and how much of all lies before each, at last all.

    They are added one after the other: so the sums are the same everywhere.
    """
    step = np.empty_like(outlines.points)
    step[:-1] = outlines.points[1:] - outlines.points[:-1]
    last = outlines.rings[1:] - 1
    step[last] = outlines.points[outlines.rings[:-1]] - outlines.points[last]
    length = np.sqrt((step * step).sum(axis=1))
    return length, np.concatenate([[0.0], np.cumsum(length)])


def chains(before: Index) -> tuple[Index, Index]:
    """Return pieces chain by chain, and where in these each chain begins.

    Args:
        before: the piece that each goes on from, or -1; no piece goes on from itself by however many others.
    """
    own = np.arange(len(before))
    root = np.where(before < 0, own, before)
    rank = (before >= 0).astype(np.int64)
    # Each looks twice as far back as before, until all have reached their heads.
    while True:
        farther = root[root]
        if (farther == root).all():
            break
        rank += rank[root]
        root = farther
    order = np.lexsort((rank, root))
    return order, np.flatnonzero(rank[order] == 0)


def polylines(points: NDArray[np.int64], rings: Offsets) -> tuple[Outlines, NDArray[np.bool_]]:
    """Return open strokes without points where the one before them lies, and which of them are left: those of
    a single place are not.
    """
    stays = np.zeros(len(points), bool)
    stays[1:] = (points[1:] == points[:-1]).all(axis=1)
    stays[rings[:-1]] = False
    sizes = np.diff(rings) - np.add.reduceat(stays, rings[:-1], dtype=np.int64)
    kept = sizes > 1
    points = points[~stays & np.repeat(kept, np.diff(rings))]
    rings = np.concatenate([[0], np.cumsum(sizes[kept])])
    return Outlines(points, rings, np.arange(len(rings)), np.zeros(len(rings) - 1, bool)), kept
