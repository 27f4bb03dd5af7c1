"""Choosing: the fewest bridges by which a sheet is one piece, and of as few those that disturb least.

Without symmetry that is a shortest spanning tree (J. B. Kruskal, On the shortest spanning subtree of a graph,
Proceedings of the American Mathematical Society 7 (1956)), and joints round the torus besides. Orbits of
several bridges are taken by what they join for their number, the best first; then those go again that the
later ones made needless, and others are tried without each of those that are left (L. A. Wolsey, An analysis
of the greedy algorithm for the submodular set covering problem, Combinatorica 2 (1982)).
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Collection, Sequence

from batik_vector.processes.stencilling.bridges import Orbit
from batik_vector.processes.stencilling.clusters import Clusters

TRIED = 24
"""Chosen orbits up to which others are tried without each of them."""

Clash = Callable[[int, Collection[int]], bool]
"""Whether an orbit comes too near to some that are chosen."""


def fewest(
    start: Clusters, orbits: Sequence[Orbit], clash: Clash, *, thorough: bool = True
) -> tuple[list[int], Clusters]:
    """Return the orbits that are chosen, and the clusters that they make: one, where it can be had.

    Args:
        start: the parts of the sheet as they hang together without bridges.
        orbits: that may be chosen.
        clash: tells which do not go together.
        thorough: whether to look for fewer than are found at once.
    """
    best, made = _pruned(start, orbits, _greedy(start, orbits, clash, ()))
    if not thorough or not made.whole or all(len(orbit.bridges) == 1 for orbit in orbits):
        return best, made
    for _ in range(3):
        before = best
        for each in list(best) if len(best) <= TRIED else []:
            other, joined = _pruned(start, orbits, _greedy(start, orbits, clash, (each,)))
            if joined.whole and price(orbits, other) < price(orbits, best):
                best, made = other, joined
        if best == before:
            break
    return best, made


def price(orbits: Sequence[Orbit], chosen: Collection[int]) -> tuple[int, float]:
    """Return how many bridges orbits are, and what they cost."""
    return sum(len(orbits[each].bridges) for each in chosen), sum(orbits[each].cost for each in chosen)


def _greedy(start: Clusters, orbits: Sequence[Orbit], clash: Clash, barred: Collection[int]) -> list[int]:
    """Return orbits that each join something, those first that join most for their number and cost least."""
    made, chosen = start.copy(), list[int]()
    heap = [(*_rate(orbit, 2.0 * len(orbit.bridges)), number) for number, orbit in enumerate(orbits)]
    heapq.heapify(heap)
    while heap and not made.whole:
        rate, cost, number = heapq.heappop(heap)
        if number in barred:
            continue
        gained = made.gained(orbits[number].joints)
        if gained <= 0:
            continue
        now = _rate(orbits[number], gained)
        # What an orbit joins gets less as others are chosen: it may have to wait for its turn.
        if now > (rate, cost) and heap and now > heap[0][:2]:
            heapq.heappush(heap, (*now, number))
            continue
        if clash(number, chosen):
            continue
        for joint in orbits[number].joints:
            made.join(*joint)
        chosen.append(number)
    return chosen


def _rate(orbit: Orbit, gained: float) -> tuple[float, float]:
    return round(len(orbit.bridges) / gained, 9), orbit.cost / gained


def _pruned(start: Clusters, orbits: Sequence[Orbit], chosen: list[int]) -> tuple[list[int], Clusters]:
    """Return chosen orbits without those that the others make needless, the dearest looked at first."""
    made = joined(start, orbits, chosen)
    bridges = sum(len(orbits[each].bridges) for each in chosen)
    if not made.whole or bridges == start.count - 1:
        return sorted(chosen), made
    kept = sorted(chosen)
    for each in sorted(chosen, key=lambda one: (-len(orbits[one].bridges), -orbits[one].cost, one)):
        rest = [other for other in kept if other != each]
        without = joined(start, orbits, rest)
        if without.whole:
            kept, made = rest, without
    return kept, made


def joined(start: Clusters, orbits: Sequence[Orbit], chosen: Collection[int]) -> Clusters:
    """Return the clusters that chosen orbits make."""
    made = start.copy()
    for each in chosen:
        for joint in orbits[each].joints:
            made.join(*joint)
    return made
