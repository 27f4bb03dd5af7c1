"""The nearest places about each of many places, in bulk: strips across, and in each of them up and down.

Places are dealt out into strips of equally many, by their abscissas; in its own strip and in those beside it
a place looks at those next above and below it. That finds nearly all of the nearest, wherever places crowd,
at the same cost for each; a tour needs no more.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Offsets
from batik_vector.processes.ordering.distances import PARTS, Column, Distances
from batik_vector.values import frozen

STRIP = 3.0
"""How many times farther apart strips lie than the places within one, about."""
ABOVE = 3
"""Places that are looked at above, and as many below, in each strip."""
TOGETHER = 2048
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
        count: how many neighbours of each are looked for, 18 at most; of those that are equally far all
            are given.
    """
    places = len(x)
    if places <= FEW:
        return _all(x, y, group, twin)
    order, strip, first = _strips(x, y, group)
    rank = np.empty(places, np.intp)
    rank[order] = np.arange(places)
    mate = np.where(twin < 0, NOBODY, rank[twin])[order]
    x, y = x[order], y[order]
    key, height = _keys(strip, y)
    reach = np.empty(places)
    parts = [
        _seen(slice(start, min(start + TOGETHER, places)), x, y, strip, first, key, height, mate, count, reach)
        for start in range(0, places, TOGETHER)
    ]
    one, two, squares = (np.concatenate(each) for each in zip(*parts, strict=True))
    # Pairs that both see are taken as the lower sees them.
    once = np.flatnonzero((one < two) | (squares > reach[two]))
    apart = np.sqrt(squares[once])
    apart *= PARTS
    return Pairs(order[one[once]], order[two[once]], np.rint(apart, out=apart))


def _all(x: Column, y: Column, group: Index, twin: Index) -> Pairs:
    one, two = np.triu_indices(len(x), 1)
    near = np.flatnonzero((group[one] == group[two]) & (twin[one] != two) & (twin[two] != one))
    one, two = one[near], two[near]
    apart = np.sqrt((x[one] - x[two]) ** 2 + (y[one] - y[two]) ** 2)
    apart *= PARTS
    return Pairs(one, two, np.rint(apart, out=apart))


def _strips(x: Column, y: Column, group: Index) -> tuple[Index, Index, Offsets]:
    """Return places strip by strip, upwards in each; the strip of each of these; and where strips begin.

    There is an empty strip beside those of each group.
    """
    sizes = np.bincount(group)
    across = np.maximum(np.rint(np.sqrt(sizes / STRIP)).astype(np.intp), 1)
    base = np.cumsum(across + 1) - across
    if len(sizes) == 1:
        order = np.argsort(x, kind="stable")
        strip = 1 + np.arange(len(x)) * across[0] // len(x)
    else:
        order = np.lexsort([x, group])
        of = group[order]
        rank = np.arange(len(x)) - (np.cumsum(sizes) - sizes)[of]
        strip = base[of] + rank * across[of] // sizes[of]
    # Strips are whole numbers that rise, so that sorting by them and then upwards leaves them as they are.
    order = order[np.argsort(_keys(strip, y[order])[0], kind="stable")]
    held = np.bincount(strip, minlength=base[-1] + across[-1] + 2)
    first = np.zeros(len(held) + 1, np.intp)
    np.cumsum(held, out=first[1:])
    return order, strip, first


def _keys(strip: Index, y: Column) -> tuple[NDArray[np.int64], int]:
    """Return numbers that rise strip by strip, upwards in each, and by how much from strip to strip."""
    low = y.min()
    height = int(y.max() - low) + 1
    return strip * height + (y - low).astype(np.int64), height


def _seen(
    rows: slice,
    x: Column,
    y: Column,
    strip: Index,
    first: Offsets,
    key: NDArray[np.int64],
    height: int,
    mate: Index,
    count: int,
    reach: Column,
) -> tuple[Index, Index, Column]:
    """Return whom some places see, and the squares of how far; how far each looks is put into ``reach``."""
    here = np.arange(rows.start, rows.stop)
    width = 2 * ABOVE
    other = np.empty((len(here), 3, width), np.intp)
    low, high = np.empty((len(here), 3, 1), np.intp), np.empty((len(here), 3, 1), np.intp)
    for column, shift in enumerate((-1, 0, 1)):
        there = strip[rows] + shift
        low[:, column, 0], high[:, column, 0] = first[there], first[there + 1]
        at = np.searchsorted(key, key[rows] + shift * height) if shift else here
        steps = np.arange(-ABOVE, ABOVE)
        other[:, column] = at[:, None] + (steps if shift else steps + (steps >= 0))
    away = (other < low) | (other >= high) | (other == mate[rows, None, None])
    other, away = other.reshape(len(here), -1), away.reshape(len(here), -1)
    squares = x.take(other, mode="clip")
    squares -= x[rows, None]
    squares *= squares
    up = y.take(other, mode="clip")
    up -= y[rows, None]
    up *= up
    squares += up
    squares[away] = np.inf
    farthest = np.partition(squares, count - 1, axis=1)[:, count - 1]
    reach[rows] = farthest
    seen = np.flatnonzero((squares <= farthest[:, None]) & ~away)
    return seen // other.shape[1] + rows.start, other.ravel()[seen], squares.ravel()[seen]
