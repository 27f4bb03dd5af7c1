"""Doubles: stretches of straight line that are drawn more than once, by whatever ink.

Two edges lie on one straight line where their directions in lowest terms and their offsets from the origin
are the same whole numbers; of those on one line, what overlaps is drawn twice.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.audit.contours import Floats, Mask
from batik_vector.geometry.outlines import Index
from batik_vector.values import frozen

Ints = NDArray[np.int64]


@frozen(eq=False)
class Doubles:
    """Stretches drawn again: by the edge ``again`` what ``first`` drew, from ``begin`` to ``end`` (steps)."""

    again: Index
    first: Index
    begin: Floats
    end: Floats

    def only(self, which: Mask) -> Doubles:
        """Return some of them."""
        return Doubles(self.again[which], self.first[which], self.begin[which], self.end[which])


def doubles(begin: Floats, end: Floats) -> Doubles:
    """Return what edges (whole steps, shape (n, 2)) draw again of what others drew.

    Every stretch is told once for each time that it is drawn again, of the edges with the later numbers.
    """
    numbers = np.empty(len(begin), np.uint64)
    small = max(_farthest(begin), _farthest(end)) < SMALL
    for first in range(0, len(begin), BLOCK):
        block = slice(first, first + BLOCK)
        numbers[block] = _hashes(_whole(begin[block]), _whole(end[block]), small=small)
    suspects = np.flatnonzero(_shared(numbers))
    a, b = _whole(begin[suspects]), _whole(end[suspects])
    some = (a != b).any(axis=1)
    suspects, a, b = suspects[some], a[some], b[some]
    way, offset = _line(a, b)
    low, high = _along(a, b, way)
    order = np.lexsort((suspects, low, offset, way[:, 1], way[:, 0]))
    return _overlaps(order, way, offset, low, high, a, suspects)


def _line(a: Ints, b: Ints) -> tuple[Ints, Ints]:
    """Return the direction of edges in lowest terms, to the right or up, and the offset of their line."""
    step = b - a
    step = step // np.maximum(np.gcd(step[:, 0], step[:, 1]), 1)[:, None]
    back = (step[:, 0] < 0) | ((step[:, 0] == 0) & (step[:, 1] < 0))
    step[back] *= -1
    return step, step[:, 0] * a[:, 1] - step[:, 1] * a[:, 0]


def _whole(places: Floats) -> Ints:
    return np.rint(places).astype(np.int64)


def _farthest(places: Floats) -> float:
    return max(float(places.max(initial=0.0)), -float(places.min(initial=0.0)))


def _hashes(a: Ints, b: Ints, *, small: bool) -> NDArray[np.uint64]:
    """Return a number for each edge's line: equal lines have equal numbers, others hardly ever."""
    if small:
        slope, height = _quotients(a, b)
    else:
        way, offset = _line(a, b)
        slope, height = (way[:, 0] * PRIME + way[:, 1]).view(np.uint64), offset.view(np.uint64)
    mixed = slope * np.uint64(0x9E3779B97F4A7C15)
    mixed ^= height * np.uint64(0xC2B2AE3D27D4EB4F)
    return np.asarray(mixed ^ (mixed >> np.uint64(29)))


BLOCK = 1 << 16
"""Edges of which numbers are worked out at a time, so that they stay in the processor's cache."""
PRIME = 1_000_003
TABLE = 4
"""How many places a table has for each number, at least."""
SMALL = 1 << 25
"""Below it products of coordinates are exact in floats, and so equal fractions have equal quotients."""


def _quotients(a: Ints, b: Ints) -> tuple[NDArray[np.uint64], NDArray[np.uint64]]:
    """Return the bits of slope and height at zero of edges' lines; of upright ones infinite and where."""
    step = b - a
    upright = step[:, 0] == 0
    run = np.where(upright, 1, step[:, 0])
    slope = np.where(upright, np.inf, step[:, 1] / run)
    height = np.where(upright, a[:, 0], (step[:, 0] * a[:, 1] - step[:, 1] * a[:, 0]) / run)
    # Nought has two spellings.
    return (slope + 0.0).view(np.uint64), (height + 0.0).view(np.uint64)


def _shared(numbers: NDArray[np.uint64]) -> Mask:
    """Return which numbers occur more than once."""
    shared = np.zeros(len(numbers), bool)
    # Most are alone in a table of a few times as many places, and need not be put in order.
    places = 1 << max(len(numbers) * TABLE - 1, 1).bit_length()
    place = (numbers & np.uint64(places - 1)).astype(np.intp)
    own = np.arange(len(numbers), dtype=np.int32)
    last = np.empty(places, np.int32)
    last[place] = own
    met = np.zeros(places, bool)
    met[place[last[place] != own]] = True
    asked = np.flatnonzero(met[place])
    order = asked[np.argsort(numbers[asked], kind="stable")]
    same = numbers[order][1:] == numbers[order][:-1]
    shared[order[1:][same]] = shared[order[:-1][same]] = True
    return shared


def _along(a: Ints, b: Ints, way: Ints) -> tuple[Ints, Ints]:
    """Return where edges begin and end along their lines, in multiples of their direction."""
    axis = np.where(np.abs(way[:, 0]) >= np.abs(way[:, 1]), 0, 1)
    rows = np.arange(len(a))
    ends = np.stack([a[rows, axis], b[rows, axis]])
    flip = np.where(way[rows, axis] < 0, -1, 1)
    ends = np.sort(ends * flip, axis=0)
    return ends[0], ends[1]


def _overlaps(order: Index, way: Ints, offset: Ints, low: Ints, high: Ints, a: Ints, names: Index) -> Doubles:
    """Return the overlaps of edges in the order of their lines and beginnings."""
    same = np.append((np.diff(way[order], axis=0) == 0).all(axis=1) & (np.diff(offset[order]) == 0), False)
    one, other = [], []
    # Each with the next, with the next but one, and so on, as long as any two overlap.
    left = np.arange(len(order))
    for apart in range(1, len(order)):
        left = left[left + apart < len(order)]
        linked = same[left + apart - 1]
        left = left[linked]
        meets = low[order[left + apart]] < high[order[left]]
        if not len(left):
            break
        one.append(order[left[meets]])
        other.append(order[left[meets] + apart])
        left = left[meets]
    if not one:
        nothing = np.empty(0, np.intp)
        return Doubles(nothing, nothing, np.empty((0, 2)), np.empty((0, 2)))
    p, q = np.concatenate(one), np.concatenate(other)
    first, last = np.maximum(low[p], low[q]), np.minimum(high[p], high[q])
    begin, end = (_at(a[p], way[p], each) for each in (first, last))
    later, earlier = np.maximum(names[p], names[q]), np.minimum(names[p], names[q])
    return Doubles(later, earlier, begin, end)


def _at(a: Ints, way: Ints, along: Ints) -> Floats:
    """Return the places on edges' lines that lie so far along them."""
    axis = np.where(np.abs(way[:, 0]) >= np.abs(way[:, 1]), 0, 1)
    rows = np.arange(len(a))
    flip = np.where(way[rows, axis] < 0, -1, 1)
    share = (along * flip - a[rows, axis]) / way[rows, axis]
    return np.asarray(a + way * share[:, None])
