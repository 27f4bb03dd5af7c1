"""The nearest places about each of many places, in bulk: strips across, and in each of them up and down.

Places are dealt out into strips of equally many, by their abscissas; in its own strip and in those beside it
a place looks at those next above and below it. That finds nearly all of the nearest, wherever places crowd,
at the same cost for each; a tour needs no more.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Steps
from batik_vector.processes.ordering.distances import Distances, distances

STRIP = 3.0
"""How many times farther apart strips lie than the places within one, about."""
ABOVE = 3
"""Places that are looked at above, and as many below, in each strip."""
NOBODY = -1
FAR = np.int64(2**62)


def neighbours(places: Steps, group: Index, of: Index, count: int) -> tuple[Index, Distances]:
    """Return the nearest places about each, nearest first.

    Args:
        places: shape (n, 2).
        group: shape (n,), counted from 0: only places of one group are neighbours.
        of: shape (n,), whose each place is: places of one owner are no neighbours.
        count: how many are asked for, 18 at most.

    Returns:
        Their numbers, shape (n, count), ``NOBODY`` where there are too few, and how far they are.
    """
    strip, strips = _strips(places, group)
    order = np.lexsort([places[:, 0], places[:, 1], strip])
    low = int(places[:, 1].min(initial=0))
    high = int(places[:, 1].max(initial=0)) - low + 1
    up: NDArray[np.int64] = places[:, 1] - low
    key = (strip * high + up)[order]
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    seen = np.concatenate([np.arange(-ABOVE, 0), np.arange(1, ABOVE + 1)])
    beside = np.arange(-ABOVE, ABOVE)
    found = []
    for shift in (-1, 0, 1):
        at = rank[:, None] + seen
        there = strip + shift
        if shift:
            at = np.searchsorted(key, there * high + up)[:, None] + beside
        inside = (at >= 0) & (at < len(order))
        other = order[np.where(inside, at, 0)]
        inside &= (strip[other] == there[:, None]) & (strips[there + 1] == group)[:, None]
        found.append(np.where(inside & (of[other] != of[:, None]), other, NOBODY))
    others = np.concatenate(found, axis=1)
    return _nearest(places, others, count)


def _strips(places: Steps, group: Index) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the strip of each place, and the group of each strip, with one of no group at both ends."""
    sizes = np.bincount(group)
    across = np.maximum(np.rint(np.sqrt(sizes / STRIP)).astype(np.int64), 1)
    across[sizes == 0] = 0
    order = np.lexsort([places[:, 1], places[:, 0], group])
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    rank -= (np.cumsum(sizes) - sizes)[group]
    first = np.cumsum(across) - across
    strip = first[group] + rank * across[group] // sizes[group]
    groups = np.repeat(np.arange(len(sizes)), across)
    return strip, np.concatenate([[NOBODY], groups, [NOBODY]])


def _nearest(places: Steps, others: Index, count: int) -> tuple[Index, Distances]:
    """Return the nearest ``count`` of the others of each place, and how far they are."""
    width = others.shape[1]
    apart = distances(places[:, None], places[others])
    # Each has a key of its own, so that every way of sorting gives the same.
    keys = np.where(others == NOBODY, FAR, apart * width) + np.arange(width)
    count = min(count, width)
    keys = np.sort(np.partition(keys, count - 1, axis=1)[:, :count], axis=1)
    chosen = np.take_along_axis(others, _column(keys, width), axis=1)
    return chosen, np.where(chosen == NOBODY, FAR, keys // width)


def _column(keys: NDArray[np.int64], width: int) -> Index:
    return np.asarray(np.where(keys >= FAR, keys - FAR, keys % width), np.intp)
