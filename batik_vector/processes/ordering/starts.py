"""Where closed strokes begin: at the vertex least out of the way between what comes before and after."""

from __future__ import annotations

import numpy as np

from batik_vector.geometry.outlines import Index, Outlines, Steps, runs
from batik_vector.processes.ordering.distances import distances


def ends_of(strokes: Outlines, start: Index) -> Steps:
    """Return where each stroke begins and ends, shape (2n, 2); closed ones at their starts.

    Args:
        strokes: one ring or polyline to a mark.
        start: shape (n,), the numbers of the points at which closed strokes begin.
    """
    first = np.where(strokes.closed, start, strokes.rings[:-1])
    last = np.where(strokes.closed, start, strokes.rings[1:] - 1)
    return np.asarray(strokes.points[np.stack([first, last], axis=1).ravel()], np.int64)


def settled(strokes: Outlines, passed: Index, start: Index) -> Index:
    """Return better starts of closed strokes, for an order as it is.

    Args:
        strokes: one ring or polyline to a mark.
        passed: shape (2n,), the ends as they are passed: stroke i has the ends 2i and 2i + 1.
        start: as :func:`ends_of` takes it.
    """
    start = start.copy()
    sequence = passed[::2] >> 1
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
        members, offsets = runs(strokes.rings, which)
        ring = np.repeat(np.arange(len(which)), np.diff(offsets))
        here = strokes.points[members]
        way = distances(here, at[before][ring]) + distances(here, at[behind][ring])
        least = np.minimum.reduceat(way, offsets[:-1])
        best = np.flatnonzero(way == least[ring])
        first = np.append(True, ring[best][1:] != ring[best][:-1])
        start[which] = members[best[first]]
    return start
