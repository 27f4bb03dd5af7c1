"""Places along contours, by the way to them: in whole parts of a step, the same on every machine."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines, Steps
from batik_vector.processes.ordering.distances import PARTS, distances
from batik_vector.units import STEPS_PER_MM

Ways: TypeAlias = NDArray[np.int64]
"""Lengths along contours, in parts of a step."""


def ways(millimetres: float) -> int:
    """Return a length in mm as one along contours."""
    return round(millimetres * STEPS_PER_MM * PARTS)


def following(strokes: Outlines) -> Index:
    """Return for each point the number of the next one; of an open stroke's last point, its own."""
    after: Index = np.arange(1, len(strokes.points) + 1)
    last = strokes.rings[1:] - 1
    after[last] = np.where(strokes.closed, strokes.rings[:-1], last)
    return after


def reached(strokes: Outlines) -> Ways:
    """Return the way to each point through all before it, and at last that through all: n + 1 numbers."""
    steps = distances(strokes.points, strokes.points[following(strokes)]).astype(np.int64)
    return np.concatenate([np.zeros(1, np.int64), np.cumsum(steps)])


def around(strokes: Outlines) -> Ways:
    """Return how long each stroke is, a closed one all the way round."""
    return np.asarray(np.diff(reached(strokes)[strokes.rings]))


def length(strokes: Outlines) -> float:
    """Return how long all strokes are together, in mm."""
    return int(reached(strokes)[-1]) / PARTS / STEPS_PER_MM


def turns(strokes: Outlines) -> NDArray[np.float64]:
    """Return by what angle each stroke turns at each point, in radians, to the left positive.

    Where an open stroke begins and ends it does not turn. A turn back is half a turn to the left. Angles are
    rounded, so that every machine decides alike by them.

    Args:
        strokes: without points that repeat the one before.
    """
    after = following(strokes)
    before = np.arange(-1, len(strokes.points) - 1)
    first = strokes.rings[:-1]
    before[first] = np.where(strokes.closed, strokes.rings[1:] - 1, first)
    into = strokes.points - strokes.points[before]
    out = strokes.points[after] - strokes.points
    return turn(into, out)


def turn(into: Steps, out: Steps) -> NDArray[np.float64]:
    """Return the angles from some directions to others, in radians: see :func:`turns`."""
    cross = into[:, 0] * out[:, 1] - into[:, 1] * out[:, 0]
    dot = into[:, 0] * out[:, 0] + into[:, 1] * out[:, 1]
    return np.asarray(np.round(np.arctan2(cross.astype(float), dot.astype(float)), 9))


def along(strokes: Outlines, which: Index, begin: Ways, end: Ways) -> Outlines:
    """Return parts of strokes as open polylines, without names.

    Args:
        strokes: one ring or polyline to a mark.
        which: shape (k,), the stroke of each part.
        begin: shape (k,), where it begins: from 0 up to the stroke's length, but not that of a closed one.
        end: shape (k,), where it ends, behind its beginning; of a closed stroke as far beyond its length as
            one likes.
    """
    reach = reached(strokes)
    base, sizes = reach[strokes.rings[:-1]][which], np.diff(strokes.rings)[which]
    whole = reach[strokes.rings[1:]][which] - base
    rounds = np.where(strokes.closed[which], end // np.maximum(whole, 1), 0)
    head, head_at = _placed(strokes, reach, base + begin, which)
    tail, tail_at = _placed(strokes, reach, base + end - rounds * whole, which)
    inner = tail + rounds * sizes - head
    # A part that ends in a point ends there already.
    more = (tail_at != strokes.points[tail]).any(axis=1)
    counts = 1 + inner + more
    rings = np.concatenate([np.zeros(1, np.int64), np.cumsum(counts)])
    first = strokes.rings[:-1][which]
    step = np.arange(rings[-1]) - np.repeat(rings[:-1], counts) + np.repeat(head - first, counts)
    points = strokes.points[np.repeat(first, counts) + step % np.repeat(sizes, counts)]
    points[rings[:-1]] = head_at
    points[rings[1:][more] - 1] = tail_at[more]
    return Outlines(points, rings, np.arange(len(rings)), np.zeros(len(which), bool))


def _placed(strokes: Outlines, reach: Ways, at: Ways, which: Index) -> tuple[Index, Steps]:
    """Return the number of the point before each place, and the place itself."""
    number = np.searchsorted(reach, at, side="right") - 1
    # The end of a stroke is the beginning of the next one.
    number = np.clip(number, strokes.rings[:-1][which], strokes.rings[1:][which] - 1)
    return number, between(strokes, reach, number, at)


def between(strokes: Outlines, reach: Ways, number: Index, at: Ways) -> Steps:
    """Return places between points and the next ones, shape (k, 2).

    Args:
        strokes: one ring or polyline to a mark.
        reach: as :func:`reached` gives it.
        number: shape (k,), the point before each place.
        at: shape (k,), the way to it.
    """
    after = following(strokes)[number]
    past, step = at - reach[number], np.maximum(reach[number + 1] - reach[number], 1)
    way = (strokes.points[after] - strokes.points[number]) * past[:, None] / step[:, None]
    return np.asarray(strokes.points[number] + np.rint(way).astype(np.int64))
