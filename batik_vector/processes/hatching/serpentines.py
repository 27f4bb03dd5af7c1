"""Parallel strokes joined into serpentines, so that the pen is lifted least.

Two strokes on neighbouring lines are joined along the outline between their ends: that way is in the region
wherever the outline goes. Even lines are drawn towards the left and odd ones towards the right; so each end
has one neighbour at most that it can be joined to, every serpentine climbs line by line, and none runs into
itself.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines, nothing
from batik_vector.processes.hatching.crossings import Crossings, Lines
from batik_vector.processes.hatching.paths import Stretches, chains, lengths, polylines
from batik_vector.values import frozen

DETOUR = 2.0
"""How many times as long as straight the way along the outline may be: round a spur it is longer."""


@frozen(eq=False)
class _Joins:
    """Ways along an outline from a crossing on a line to one on the line above, and the points between."""

    low: Index
    high: Index
    way: Stretches


def serpentines(areas: Outlines, lines: Lines, *, join: bool) -> tuple[Outlines, Index]:
    """Return strokes along lines through areas, and the mark that each lies in.

    Args:
        areas: closed outlines, of which no ring crosses itself or another of its mark.
        lines: what they are hatched with.
        join: whether neighbouring strokes become one.
    """
    found = lines.crossings(areas)
    count = len(found.scan) // 2
    if not count:
        return nothing(), np.empty(0, np.intp)
    number = np.empty(2 * count, np.intp)
    number[found.scan] = np.arange(2 * count)
    joins = _joins(areas, found, number, join)
    before, onward = np.full(count, -1, np.intp), np.full(count, -1, np.intp)
    before[number[joins.high] >> 1] = number[joins.low] >> 1
    onward[number[joins.low] >> 1] = np.arange(len(joins.low))
    order, heads = chains(before)
    strokes, kept = _drawn(areas, found, order, heads, joins.way, onward[order])
    mark = np.repeat(np.arange(len(areas)), areas.sizes())
    return strokes, mark[found.edge[found.scan[2 * order[heads[kept]]]]]


def _joins(areas: Outlines, found: Crossings, number: Index, join: bool) -> _Joins:
    """Return the ways by which strokes are joined; ``number`` is each crossing's place in the scan."""
    ring = np.searchsorted(areas.rings, found.edge, side="right") - 1
    first = np.flatnonzero(np.diff(ring, prepend=-1))
    last = np.append(first[1:], len(ring)) - 1
    after = np.arange(1, len(ring) + 1)
    after[last] = first
    wraps = np.zeros(len(ring), bool)
    wraps[last] = True
    lower = np.minimum(found.line, found.line[after])
    side = number & 1
    which = (np.abs(found.line[after] - found.line) == 1) & (side == side[after]) & (lower & 1 == side)
    which &= _not_far(areas, found, after, wraps, ring)
    begin = np.flatnonzero(which & join)
    end = after[begin]
    back = found.line[end] < found.line[begin]
    size = np.diff(areas.rings)[ring[begin]]
    passed = found.edge[end] - found.edge[begin] + np.where(wraps[begin], size, 0)
    way = Stretches(ring[begin], found.edge[begin] + 1, passed, back)
    return _Joins(np.where(back, end, begin), np.where(back, begin, end), way)


def _not_far(
    areas: Outlines, found: Crossings, after: Index, wraps: NDArray[np.bool_], ring: Index
) -> NDArray[np.bool_]:
    """Return from which crossings it is hardly farther to the next along the outline than straight."""
    length, before = lengths(areas)
    at = before[found.edge] + length[found.edge] * found.share
    whole = before[areas.rings[1:]] - before[areas.rings[:-1]]
    way = at[after] - at + np.where(wraps, whole[ring], 0.0)
    apart = found.place[after] - found.place
    near: NDArray[np.bool_] = way <= DETOUR * np.sqrt((apart * apart).sum(axis=1))
    return near


def _drawn(
    areas: Outlines, found: Crossings, order: Index, heads: Index, way: Stretches, onward: Index
) -> tuple[Outlines, NDArray[np.bool_]]:
    """Return chains of strokes as polylines; ``onward`` is the way on from each, or -1."""
    enter, leave = found.scan[2 * order], found.scan[2 * order + 1]
    leftward = found.line[enter] & 1 == 0
    enter, leave = np.where(leftward, leave, enter), np.where(leftward, enter, leave)
    joined = np.flatnonzero(onward >= 0)
    taken = way.taken(onward[joined])
    sizes = np.full(len(order), 2)
    sizes[joined] += taken.count
    ends = np.concatenate([[0], np.cumsum(sizes)])
    points = np.empty((ends[-1], 2), np.int64)
    points[ends[:-1]], points[ends[:-1] + 1] = found.place[enter], found.place[leave]
    members, of, nth = taken.members(areas)
    points[ends[joined[of]] + 2 + nth] = areas.points[members]
    return polylines(points, np.append(ends[heads], ends[-1]))
