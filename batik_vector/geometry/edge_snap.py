"""What all but lies on an edge of the page is taken to lie on it, as files round it off by a micrometre.

Of a curve that touches the edge in a point, as a disc does, the points beside it lie as near; they stay where
they are, since a point would become a stretch along the edge that no other edge has.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

CORNER = math.cos(math.radians(45))
"""Cosine of the turn from which a vertex is a corner; polylines of curves turn less, but the tiniest."""
ROUNDED = 1.0
"""Steps by which places that a file writes alike may differ once they are rounded."""


def snapped(xy: Floats, offsets: Indices, far: tuple[int, int], reach: float) -> Floats:
    """Return the vertices of rings and lines, those that are meant to lie on an edge of the page moved there.

    Of a run of vertices near an edge these are its corners, its ends of lines, those nearest to the edge, and
    all between any two of them.

    Args:
        xy: shape (n, 2), steps.
        offsets: shape (r + 1,): chain i is ``xy[offsets[i]:offsets[i + 1]]``; one whose last vertex is its
            first is closed.
        far: where the page's right and upper edge lie; the others lie at 0.
        reach: how near an edge a vertex may be moved onto it.
    """
    xy = xy.copy()
    for axis in (0, 1):
        for edge in (0, far[axis]):
            away = np.abs(xy[:, axis] - edge)
            near = np.flatnonzero(away <= reach)
            if len(near):
                xy[near[_meant(xy, offsets, near, away[near])], axis] = edge
    return xy


def _meant(xy: Floats, offsets: Indices, near: Indices, away: Floats) -> NDArray[np.bool_]:
    """Return which of the vertices near an edge are meant to lie on it."""
    chain = np.searchsorted(offsets, near, side="right") - 1
    first, last = offsets[chain], offsets[chain + 1] - 1
    closed = (xy[first] == xy[last]).all(axis=1)
    run, place = _runs(near, chain, first, last, closed)
    least = np.full(len(near), np.inf)
    np.minimum.at(least, run, away)
    held = (away <= least[run] + ROUNDED) | _cornered(xy, near, first, last, closed)
    low, high = np.full(len(near), np.inf), np.full(len(near), -np.inf)
    np.minimum.at(low, run[held], place[held])
    np.maximum.at(high, run[held], place[held])
    return np.asarray((place >= low[run]) & (place <= high[run]))


def _runs(
    near: Indices, chain: Indices, first: Indices, last: Indices, closed: NDArray[np.bool_]
) -> tuple[Indices, Indices]:
    """Return of vertices that follow one another a number that they share, and where each stands."""
    begins = np.append(True, (np.diff(near) > 1) | (np.diff(chain) > 0))
    run = np.cumsum(begins) - 1
    place = near.copy()
    # A run over the place where a ring begins is one: what stands at the ring's end stands before its start.
    at_end = np.flatnonzero(closed & (near == last))
    begin = np.searchsorted(near, first[at_end])
    over = (near[begin] == first[at_end]) & (run[begin] != run[at_end])
    joins = np.arange(len(near))
    joins[run[at_end[over]]] = run[begin[over]]
    tail = joins[run] != run
    place[tail] -= (last - first)[tail]
    return joins[run], place


def _cornered(
    xy: Floats, near: Indices, first: Indices, last: Indices, closed: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Return which vertices are corners, or ends of lines."""
    begins, ends = near == first, near == last
    before, after = near - 1, near + 1
    before[begins] = last[begins] - 1
    after[ends] = first[ends] + 1
    # A chain of a single vertex has no neighbours.
    before, after = np.clip(before, first, last), np.clip(after, first, last)
    one, other = xy[near] - xy[before], xy[after] - xy[near]
    along = (one * other).sum(axis=1)
    sharp = along < CORNER * np.hypot(*one.T) * np.hypot(*other.T)
    return np.asarray(sharp | (~closed & (begins | ends)))
