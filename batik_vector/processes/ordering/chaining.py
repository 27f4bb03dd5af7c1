"""A first order: ends that lie nearest to one another are joined, the shortest gap first (greedy edge).

J. L. Bentley, Fast algorithms for geometric traveling salesman problems, ORSA Journal on Computing 4 (1992).
"""

from __future__ import annotations

import numpy as np

from batik_vector.geometry.outlines import Index
from batik_vector.processes.ordering.neighbours import NOBODY, Pairs
from batik_vector.processes.ordering.sites import Sites

NEAREST = 5
"""Neighbours of an end that it may be joined to, at each going over but the first."""


def chained(sites: Sites, pairs: Pairs) -> Index:
    """Return an order of strokes as the ends that are passed, shape (2n,): in, out, in, out.

    The strokes of a group follow one another, lower groups first.

    Args:
        sites: where strokes may begin and end. Either end of a closed stroke may be joined.
        pairs: of ends that lie near one another; others are looked for when these are used up.
    """
    count = len(sites.group)
    link, tail = [NOBODY] * (2 * count), [end ^ 1 for end in range(2 * count)]
    either = sites.round.tolist() if sites.round.any() else None
    while len(pairs) and _joined(pairs, link, tail, either):
        pairs = _left(sites, np.array(link, np.intp), np.array(tail, np.intp))
    return _walked(link, tail, sites.group)


def _joined(pairs: Pairs, link: list[int], tail: list[int], either: list[bool] | None) -> bool:
    """Join ends of pairs that are free, the nearest first; return whether there were any."""
    order = np.argsort(pairs.apart, kind="stable")
    any_ = False
    for u, v in zip(pairs.one[order].tolist(), pairs.two[order].tolist(), strict=True):
        if either:
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
        any_ = True
    return any_


def _left(sites: Sites, link: Index, tail: Index) -> Pairs:
    """Return pairs of free ends that lie near one another, of groups that are not one chain yet."""
    free = np.flatnonzero(link == NOBODY)
    group = sites.group[free >> 1]
    free = free[np.bincount(group)[group] > 2]
    if not len(free):
        return Pairs(free, free, np.empty(0))
    # The two ends of a chain are no neighbours.
    return sites.pairs(free, tail[free], NEAREST)


def _walked(link: list[int], tail: list[int], group: Index) -> Index:
    """Return the ends along all chains, in the order of their groups."""
    heads = np.flatnonzero(np.array(link, np.intp) < 0)
    heads = heads[np.argsort(group[heads >> 1], kind="stable")]
    passed, last = list[int](), set[int]()
    for head in heads.tolist():
        if head in last:
            continue
        last.add(tail[head])
        end = head
        while end >= 0:
            passed.append(end)
            end = link[end ^ 1]
    into = np.array(passed, np.intp)
    return np.stack([into, into ^ 1], axis=1).ravel()
