"""Clusters: what hangs together on the endless cloth, told by the repeats between its parts.

Parts of one tile are nodes, and a joint between two of them says how many repeats one lies from the other:
a gain graph over Z². On the endless cloth a cluster is one piece where its joints lead round to every repeat,
that is where the gains of its circles span Z²; else it is many, one for each coset of what they span.
T. Zaslavsky, Biased graphs I, Journal of Combinatorial Theory B 47 (1989).
"""

from __future__ import annotations

import math
from typing import TypeAlias

from batik_vector.values import frozen

Gain: TypeAlias = tuple[int, int]
"""So many repeats along the first and along the second translation of the lattice."""
NONE: Gain = (0, 0)


@frozen
class Span:
    """What gains span, in Hermite's form: (across, along) and (0, up); numbers that are 0 span nothing."""

    across: int = 0
    along: int = 0
    up: int = 0

    def reduced(self, gain: Gain) -> Gain:
        """Return the gain that stands for all of its coset."""
        x, y = gain
        if self.across:
            times = x // self.across
            x, y = x - times * self.across, y - times * self.along
        if self.up:
            y %= self.up
        return x, y

    def with_(self, gain: Gain) -> Span:
        """Return what is spanned with one gain more."""
        x, y = self.reduced(gain)
        if x == y == 0:
            return self
        a, b, d = self.across, self.along, self.up
        while x:
            times = a // x
            a, b, x, y = x, y, a - times * x, b - times * y
        if a < 0:
            a, b = -a, -b
        d = math.gcd(d, abs(y))
        return Span(a, b % d if d else b, d)

    def joined(self, other: Span) -> Span:
        """Return what two spans span together."""
        if not other.rank:
            return self
        return self.with_((other.across, other.along)).with_((0, other.up))

    @property
    def rank(self) -> int:
        """In how many directions it leads."""
        return bool(self.across) + bool(self.up)

    @property
    def whole(self) -> bool:
        """Whether every repeat is reached."""
        return self.across == self.up == 1


class Clusters:
    """Nodes that are joined one after the other, and what they make up.

    ``lies`` tells of each node where its copy lies that is of one piece with its cluster's first node.
    """

    def __init__(self, count: int) -> None:
        self._above = list(range(count))
        self._shift: list[Gain] = [NONE] * count
        self._span = [Span() for _ in range(count)]
        self._size = [1] * count
        self.count = count

    def copy(self) -> Clusters:
        """Return the same clusters, to be joined otherwise."""
        other = Clusters(0)
        other._above, other._shift = self._above.copy(), self._shift.copy()
        other._span, other._size, other.count = self._span.copy(), self._size.copy(), self.count
        return other

    def lies(self, node: int) -> tuple[int, Gain]:
        """Return the first node of a node's cluster, and where the node lies that is of one piece with it."""
        trail = []
        while self._above[node] != node:
            trail.append(node)
            node = self._above[node]
        x = y = 0
        for each in reversed(trail):
            dx, dy = self._shift[each]
            x, y = x + dx, y + dy
            self._above[each], self._shift[each] = node, (x, y)
        return node, (x, y)

    def span(self, node: int) -> Span:
        """Return the repeats of itself that a node is of one piece with."""
        return self._span[self.lies(node)[0]]

    def piece(self, node: int, gain: Gain) -> tuple[int, int, int]:
        """Return what names the piece of the endless cloth to which a copy of a node belongs."""
        first, (x, y) = self.lies(node)
        return (first, *self._span[first].reduced((gain[0] - x, gain[1] - y)))

    def gained(self, joints: list[tuple[int, int, Gain]]) -> float:
        """Return what joints would add: 1 for two clusters made one and for a direction, less for a coset."""
        firsts: dict[int, int] = {}
        inner = []
        for one, other, (x, y) in joints:
            (a, (ax, ay)), (b, (bx, by)) = self.lies(one), self.lies(other)
            for each in (a, b):
                firsts.setdefault(each, len(firsts))
            inner.append((firsts[a], firsts[b], (ax + x - bx, ay + y - by)))
        if len(inner) == 1:
            a, b, gain = inner[0]
            if a != b:
                return 1.0
        trial = Clusters(len(firsts))
        trial._span = [self._span[each] for each in firsts]
        before = trial._worth()
        for one, other, gain in inner:
            trial.join(one, other, gain)
        return trial._worth() - before

    def _worth(self) -> float:
        span = Span()
        for each, above in enumerate(self._above):
            if each == above and self._span[each].rank:
                span = span.joined(self._span[each])
        cosets = max(span.across, 1) * max(span.up, 1)
        # A span of many cosets holds less than one of few.
        return span.rank + (0.5 / cosets if span.rank else 0.0) - self.count

    def join(self, one: int, other: int, gain: Gain) -> bool:
        """Join a node to another that lies so many repeats away; return whether that makes a difference."""
        (a, (ax, ay)), (b, (bx, by)) = self.lies(one), self.lies(other)
        x, y = ax + gain[0] - bx, ay + gain[1] - by
        if a == b:
            more = self._span[a].with_((x, y))
            changed = more != self._span[a]
            self._span[a] = more
            return changed
        if self._size[a] < self._size[b]:
            a, b, x, y = b, a, -x, -y
        self._above[b], self._shift[b] = a, (x, y)
        self._span[a] = self._span[a].joined(self._span[b])
        self._size[a] += self._size[b]
        self.count -= 1
        return True

    @property
    def whole(self) -> bool:
        """Whether all is one piece, on the torus and on the endless cloth."""
        return self.count == 1 and self.span(0).whole
