"""Where closed strokes begin: at the vertex least out of the way between what comes before and after."""

from __future__ import annotations

import numpy as np

from batik_vector.geometry.outlines import Index, Offsets, Outlines, Steps, runs
from batik_vector.processes.ordering.distances import Distances, lengths


def ends_of(strokes: Outlines, start: Index) -> Steps:
    """Return where each stroke begins and ends, shape (2n, 2); closed ones at their starts.

    Args:
        strokes: one ring or polyline to a mark.
        start: shape (n,), the numbers of the points at which closed strokes begin.
    """
    first = np.where(strokes.closed, start, strokes.rings[:-1])
    last = np.where(strokes.closed, start, strokes.rings[1:] - 1)
    return np.asarray(strokes.points[np.stack([first, last], axis=1).ravel()], np.int64)


def settled(strokes: Outlines, passed: Index, start: Index, tried: int | None = None) -> Index:
    """Return better starts of closed strokes, for an order as it is.

    Args:
        strokes: one ring or polyline to a mark.
        passed: shape (2n,), the ends as they are passed: stroke i has the ends 2i and 2i + 1.
        start: as :func:`ends_of` takes it.
        tried: how many vertices of each stroke are tried, evenly spaced; all if not told.
    """
    start = start.copy()
    sequence = passed[::2] >> 1
    columns = strokes.points[:, 0].copy(), strokes.points[:, 1].copy()
    for parity in (0, 1):
        places = np.arange(parity, len(sequence), 2)
        places = places[strokes.closed[sequence[places]]]
        if not len(places) or len(sequence) < 2:
            continue
        at = ends_of(strokes, start)[passed]
        # The first has nothing before it, the last nothing behind: what is on the other side counts twice.
        before = np.where(places > 0, 2 * places - 1, 2 * places + 2)
        behind = np.where(places + 1 < len(sequence), 2 * places + 2, 2 * places - 1)
        which = sequence[places]
        members, offsets = _members(strokes.rings, which, tried)
        sizes = np.diff(offsets)
        # Column by column: NumPy's loop over the two numbers of each point is many times dearer.
        x, y = (column[members].astype(float) for column in columns)
        way: Distances = np.zeros(len(members))
        for other in (at[before], at[behind]):
            way += lengths(x - np.repeat(other[:, 0], sizes), y - np.repeat(other[:, 1], sizes))
        least = np.minimum.reduceat(way, offsets[:-1])
        best = np.flatnonzero(way == np.repeat(least, sizes))
        ring = np.searchsorted(offsets, best, side="right")
        first = np.append(True, ring[1:] != ring[:-1])
        start[which] = members[best[first]]
    return start


def _members(rings: Offsets, which: Index, tried: int | None) -> tuple[Index, Offsets]:
    """Return the numbers of the points of some rings, or of some of them, and where each ring begins."""
    if tried is None:
        return runs(rings, which)
    sizes = np.diff(rings)[which]
    counts = np.minimum(sizes, tried)
    offsets = np.concatenate([[0], np.cumsum(counts)])
    number = np.arange(offsets[-1]) - np.repeat(offsets[:-1], counts)
    step = number * np.repeat(sizes, counts) // np.repeat(counts, counts)
    return np.repeat(rings[:-1][which], counts) + step, offsets
