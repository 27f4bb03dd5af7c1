"""A first order: ends that lie nearest to one another are joined, the shortest gap first (greedy edge).

J. L. Bentley, Fast algorithms for geometric traveling salesman problems, ORSA Journal on Computing 4 (1992).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Steps
from batik_vector.processes.ordering.neighbours import NOBODY, neighbours

NEAREST = 5
"""Neighbours of an end that it may be joined to, at each going over."""


def chained(ends: Steps, group: Index) -> Index:
    """Return an order of strokes as the ends that are passed, shape (2n,): in, out, in, out.

    Args:
        ends: shape (2n, 2): where stroke i may begin or end are rows 2i and 2i + 1. Where these are the same
            place, as of a closed stroke, either may be joined.
        group: shape (n,), counted from 0. The strokes of a group follow one another, lower groups first.
    """
    count = len(group)
    link, tail = [NOBODY] * (2 * count), [end ^ 1 for end in range(2 * count)]
    round_ = (ends[0::2] == ends[1::2]).all(axis=1)
    either = round_.tolist()
    joined = True
    while joined:
        joined = False
        for u, v in _gaps(ends, group, round_, np.array(link, np.int64)):
            # The other end of a closed stroke will do as well.
            if link[u] >= 0 and either[u >> 1]:
                u ^= 1
            if link[v] >= 0 and either[v >> 1]:
                v ^= 1
            if link[u] >= 0 or link[v] >= 0 or tail[u] == v:
                continue
            link[u], link[v] = v, u
            first, last = tail[u], tail[v]
            tail[first], tail[last] = last, first
            joined = True
    return _walked(link, group)


def _gaps(
    ends: Steps, group: Index, round_: NDArray[np.bool_], link: NDArray[np.int64]
) -> list[tuple[int, int]]:
    """Return pairs of free ends that lie near one another, the nearest first."""
    free = link == NOBODY
    # A closed stroke stands for itself once, as long as it has an end to offer.
    free[1::2] &= ~(round_ & free[0::2])
    sites = np.flatnonzero(free)
    if len(sites) < 2:
        return []
    other, apart = neighbours(ends[sites], group[sites >> 1], sites >> 1, NEAREST)
    one = np.repeat(np.arange(len(sites)), other.shape[1])
    two, farthest, apart = other.ravel(), apart[:, -1], apart.ravel()
    # Pairs that both see are taken as the lower sees them.
    taken = np.flatnonzero((two != NOBODY) & ((one < two) | (apart >= farthest[two])))
    taken = taken[np.argsort(apart[taken], kind="stable")]
    return list(zip(sites[one[taken]].tolist(), sites[two[taken]].tolist(), strict=True))


def _walked(link: list[int], group: Index) -> Index:
    """Return the ends along all chains, in the order of their groups."""
    heads = np.flatnonzero(np.array(link, np.int64) < 0)
    heads = heads[np.argsort(group[heads >> 1], kind="stable")]
    order, seen = list[int](), bytearray(len(group))
    for head in heads.tolist():
        end = head
        while end >= 0 and not seen[end >> 1]:
            seen[end >> 1] = 1
            order += (end, end ^ 1)
            end = link[end ^ 1]
    return np.array(order, np.intp)
