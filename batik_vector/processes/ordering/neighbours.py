"""The nearest places about each of many places, in bulk: strips across, and in each of them up and down.

Places are dealt out into strips of equally many, by their abscissas; in its own strip and in those beside it
a place looks at those next above and below it. That finds nearly all of the nearest, wherever places crowd,
at the same cost for each; a tour needs no more.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index
from batik_vector.processes.ordering.distances import PARTS, Column, Distances
from batik_vector.values import frozen

STRIP = 3.0
"""How many times farther apart strips lie than the places within one, about."""
ABOVE = 3
"""Places that are looked at above, and as many below, in each strip."""
SEEN = np.array([range(-ABOVE, ABOVE), [*range(-ABOVE, 0), *range(1, ABOVE + 1)], range(-ABOVE, ABOVE)])
"""Where they are kept, from the place of the strip on which is as high: of the strip itself without it."""
TOGETHER = 1024
"""Places that look about at a time: what they see then stays near the processor."""
NOBODY = -1
FEW = 48
"""Places of which all pairs are looked at."""


@frozen(eq=False)
class Pairs:
    """Places that lie near one another: their numbers, each pair once, and how far they are apart."""

    one: Index
    two: Index
    apart: Distances

    def __len__(self) -> int:
        return len(self.one)


def neighbours(x: Column, y: Column, group: Index, twin: Index, count: int) -> Pairs:
    """Return each place with those nearest to it.

    Args:
        x, y: shape (n,).
        group: shape (n,), counted from 0: only places of one group are neighbours.
        twin: shape (n,), a place that is no neighbour of each, or ``NOBODY``.
        count: how many neighbours of each are looked for, 18 at most, its twin among them; of those that are
            equally far all are given.
    """
    places = len(x)
    if places <= FEW:
        return _all(x, y, group, twin)
    order, strip = _strips(x, y, group)
    x, y = x[order], y[order]
    strips = _Strips(x, y, strip)
    reach = np.empty(len(strips.x))
    parts = [strips.seen(slice(at, at + TOGETHER), count, reach) for at in range(0, places, TOGETHER)]
    one, two, squares = (np.concatenate(each) for each in zip(*parts, strict=True))
    # Pairs that both see are taken as the lower sees them.
    once = np.flatnonzero((one < two) | (squares > reach.take(two)))
    whose = np.empty(len(strips.x), np.intp)
    whose[strips.at] = order
    one, two, squares = whose[one[once]], whose[two[once]], squares[once]
    good = np.flatnonzero((twin[one] != two) & (twin[two] != one))
    apart = np.sqrt(squares[good])
    apart *= PARTS
    return Pairs(one[good], two[good], np.rint(apart, out=apart))


def _all(x: Column, y: Column, group: Index, twin: Index) -> Pairs:
    one, two = np.triu_indices(len(x), 1)
    near = np.flatnonzero((group[one] == group[two]) & (twin[one] != two) & (twin[two] != one))
    one, two = one[near], two[near]
    apart = np.sqrt((x[one] - x[two]) ** 2 + (y[one] - y[two]) ** 2)
    apart *= PARTS
    return Pairs(one, two, np.rint(apart, out=apart))


def _strips(x: Column, y: Column, group: Index) -> tuple[Index, Index]:
    """Return places strip by strip, upwards in each, and the strip of each of these.

    There is an empty strip beside those of each group.
    """
    sizes = np.bincount(group)
    across = np.maximum(np.rint(np.sqrt(sizes / STRIP)).astype(np.intp), 1)
    if len(sizes) == 1:
        order = np.argsort(x, kind="stable")
        strip = 1 + np.arange(len(x)) * across[0] // len(x)
    else:
        base = np.cumsum(across + 1) - across
        order = np.lexsort([x, group])
        of = group[order]
        rank = np.arange(len(x)) - (np.cumsum(sizes) - sizes)[of]
        strip = base[of] + rank * across[of] // sizes[of]
    # Strips are whole numbers that rise, so that sorting by them and then upwards leaves them as they are.
    return order[np.argsort(_keys(strip, y[order])[0], kind="stable")], strip


def _keys(strip: Index, y: Column) -> tuple[NDArray[np.int64], int]:
    """Return numbers that rise strip by strip, upwards in each, and by how much from strip to strip."""
    low = y.min()
    height = int(y.max() - low) + 1
    return strip * height + (y - low).astype(np.int64), height


class _Strips:
    """Places strip by strip, upwards in each, with room between strips that is no place at all.

    So what looks beyond the end of a strip sees what is no number, and that is never near.
    """

    def __init__(self, x: Column, y: Column, strip: Index) -> None:
        self.key, self.height = _keys(strip, y)
        self.strip = strip
        self.at = np.arange(len(x)) + ABOVE * strip
        """Where each place is kept."""
        self.x, self.y = (np.full(len(x) + ABOVE * (int(strip[-1]) + 2), np.nan) for _ in (x, y))
        self.x[self.at], self.y[self.at] = x, y

    def seen(self, rows: slice, count: int, reach: Column) -> tuple[Index, Index, Column]:
        """Return whom some places see, and the squares of how far; put into ``reach`` how far each looks."""
        here, key, room = self.at[rows], self.key[rows], ABOVE * self.strip[rows]
        at = np.empty((len(here), 3), np.intp)
        at[:, 0] = self.key.searchsorted(key - self.height) + room - ABOVE
        at[:, 1] = here
        at[:, 2] = self.key.searchsorted(key + self.height) + room + ABOVE
        other = (at[:, :, None] + SEEN).reshape(len(here), -1)
        squares = self.x.take(other)
        squares -= self.x[here, None]
        squares *= squares
        up = self.y.take(other)
        up -= self.y[here, None]
        up *= up
        squares += up
        farthest = np.fmin(np.partition(squares, count - 1, axis=1)[:, count - 1], np.inf)
        reach[here] = farthest
        found = np.flatnonzero(squares <= farthest[:, None])
        return here[found // other.shape[1]], other.ravel()[found], squares.ravel()[found]
