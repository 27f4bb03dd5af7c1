"""Strokes cut along the edges of a window: what lies within stays, in its order and direction.

All is whole numbers: where a stroke passes an edge, the place on the edge is the nearest one.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Offsets, Steps

Window: TypeAlias = tuple[int, int, int, int]
"""Left, lower, right and upper edge."""


def clipped(
    points: Steps, offsets: Offsets, closed: NDArray[np.bool_], window: Window
) -> tuple[Steps, Offsets]:
    """Return what of some strokes lies in a window or on its edges, as strokes of their own.

    Args:
        points: shape (n, 2).
        offsets: shape (k + 1,), where each stroke begins; a closed one repeats its first point at its end.
        closed: shape (k,). A closed stroke that leaves the window begins outside, so that it falls into no
            more strokes than it must.
        window: within which strokes stay.

    Returns:
        Points and offsets of the strokes that are left, all of them open.
    """
    if not len(points):
        return points, offsets
    low, high = np.array(window[:2]), np.array(window[2:])
    within = np.asarray(((points >= low) & (points <= high)).all(axis=1), bool)
    if within.all():
        return points, offsets
    points = points.take(_from_outside(within, offsets, closed), axis=0)
    for axis, sign, edge in ((0, 1, low[0]), (0, -1, -high[0]), (1, 1, low[1]), (1, -1, -high[1])):
        points, offsets = _beyond(points, offsets, axis, sign, int(edge))
    return points, offsets


def _from_outside(within: NDArray[np.bool_], offsets: Offsets, closed: NDArray[np.bool_]) -> Index:
    """Return the order of points in which closed strokes begin, where they can, at a point outside."""
    count = len(within)
    first, sizes = offsets[:-1], np.diff(offsets)
    outside = np.minimum.reduceat(np.where(within, count, np.arange(count)), first)
    turned = np.where(closed & (outside < count), outside - first, 0)
    rank = np.arange(count) - np.repeat(first, sizes)
    # The last point of a closed stroke is its first: around it goes in one step less.
    around = np.repeat(np.where(closed, np.maximum(sizes - 1, 1), sizes), sizes)
    move = np.repeat(turned, sizes)
    return np.asarray(np.where(move > 0, (rank + move) % around, rank) + np.repeat(first, sizes), np.intp)


def _beyond(points: Steps, offsets: Offsets, axis: int, sign: int, edge: int) -> tuple[Steps, Offsets]:
    """Return what of some strokes has a coordinate that, times a sign, is no less than the edge."""
    if not len(points):
        return points, offsets
    away = points[:, axis] * sign - edge
    inside = away >= 0
    if inside.all():
        return points, offsets
    goes_on = np.ones(len(points), bool)
    goes_on[offsets[1:] - 1] = False
    after = np.append(inside[1:], False)
    crosses = goes_on & (inside != after)
    rows = np.empty((len(points), 2, 2), np.int64)
    rows[:, 0] = points
    at = np.flatnonzero(crosses)
    rows[at, 1] = _crossing(points, away, at, axis, sign * edge)
    kept = np.stack([inside, crosses], axis=1)
    begins = np.zeros((len(points), 2), bool)
    begins[offsets[:-1], 0] = True
    begins[:, 1] = crosses & ~inside
    heads = np.flatnonzero((begins & kept).ravel()[kept.ravel()])
    left = rows.reshape(-1, 2)[kept.ravel()]
    return left, np.append(heads, len(left))


def _crossing(points: Steps, away: NDArray[np.int64], at: Index, axis: int, edge: int) -> Steps:
    """Return where the segments that begin at some points pass the edge."""
    begin, end = points[at], points[at + 1]
    other = 1 - axis
    whole = np.abs(away[at]) + np.abs(away[at + 1])
    part = np.abs(away[at])
    place = np.empty_like(begin)
    place[:, axis] = edge
    way = (end[:, other] - begin[:, other]) * part
    place[:, other] = begin[:, other] + (2 * way + whole) // (2 * whole)
    return place
