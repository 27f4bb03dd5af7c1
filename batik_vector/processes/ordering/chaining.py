"""A first order: ends that lie nearest to one another are joined, the shortest gap first (greedy edge).

J. L. Bentley, Fast algorithms for geometric traveling salesman problems, ORSA Journal on Computing 4 (1992).
"""

from __future__ import annotations

import numpy as np

from batik_vector.geometry.outlines import Index
from batik_vector.processes.ordering.distances import Distances
from batik_vector.processes.ordering.neighbours import NOBODY, Pairs
from batik_vector.processes.ordering.sites import Sites

NEAREST = 5
"""Neighbours of an end that it may be joined to, at each going over but the first."""
FIRST = 0.7
"""Pairs so much nearer than is usual are joined before others are looked at."""


def chained(sites: Sites, pairs: Pairs) -> Index:
    """Return an order of strokes as the ends that are passed, shape (2n,): in, out, in, out.

    The strokes of a group follow one another, lower groups first.

    Args:
        sites: where strokes may begin and end. Either end of a closed stroke may be joined.
        pairs: of ends that lie near one another; others are looked for when these are used up.
    """
    chains = _Chains(sites)
    while len(pairs) and chains.join(pairs):
        pairs = chains.pairs()
    return chains.walked()


class _Chains:
    """Strokes joined end to end: the end that each is joined to, and of chains the other end."""

    def __init__(self, sites: Sites) -> None:
        ends = len(sites.x)
        self.sites = sites
        self.either = sites.round.tolist() if sites.round.any() else None
        self.link = [NOBODY] * ends
        self.tail = (np.arange(ends) ^ 1).tolist()
        self.open = bytearray(b"\1") * ends
        """Which ends are joined to none."""
        self.free = np.frombuffer(self.open, bool)
        """The same, as an array."""

    def join(self, pairs: Pairs) -> bool:
        """Join ends of pairs that are free, the nearest first; return whether there were any."""
        one, two, apart = pairs.one, pairs.two, pairs.apart
        short = apart < FIRST * apart.mean()
        first = np.flatnonzero(short)
        any_ = self._link(one[first], two[first], apart[first])
        # By now most ends are joined, and most of the pairs that are left are of such.
        free = self.free
        if self.either:
            free = free | np.repeat(self.sites.round & (free[0::2] | free[1::2]), 2)
        left = np.flatnonzero(free.take(one) & free.take(two) & ~short)
        return self._link(one[left], two[left], apart[left]) or any_

    def _link(self, one: Index, two: Index, apart: Distances) -> bool:
        """Join ends that are free, the nearest first; return whether there were any."""
        order = np.argsort(apart, kind="stable")
        link, tail, free, either = self.link, self.tail, self.open, self.either
        any_ = False
        for u, v in zip(one[order].tolist(), two[order].tolist(), strict=True):
            if either:
                # The other end of a closed stroke will do as well.
                if not free[u] and either[u >> 1]:
                    u ^= 1
                if not free[v] and either[v >> 1]:
                    v ^= 1
            if free[u] and free[v]:
                first = tail[u]
                if first != v:
                    free[u] = free[v] = 0
                    link[u], link[v] = v, u
                    last = tail[v]
                    tail[first], tail[last] = last, first
                    any_ = True
        return any_

    def pairs(self) -> Pairs:
        """Return pairs of free ends that lie near one another, of groups that are not one chain yet."""
        free = np.flatnonzero(self.free)
        group = self.sites.group[free >> 1]
        free = free[np.bincount(group)[group] > 2]
        if not len(free):
            return Pairs(free, free, np.empty(0))
        # The two ends of a chain are no neighbours.
        tail = np.array([self.tail[end] for end in free.tolist()], np.intp)
        return self.sites.pairs(free, tail, NEAREST)

    def walked(self) -> Index:
        """Return the ends along all chains, in the order of their groups."""
        link, tail = self.link, self.tail
        heads = np.flatnonzero(self.free)
        heads = heads[np.argsort(self.sites.group[heads >> 1], kind="stable")]
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
