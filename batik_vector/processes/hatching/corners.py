"""Spikes: rings reach out into corners that are sharper than the pen, without the pen being lifted.

A ring's ink has round corners, so that a little stays white in each corner between it and the ring around it.
How far the white goes is known from where the corner passed half way.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines, Steps
from batik_vector.processes.hatching.inward import Floats
from batik_vector.processes.hatching.regions import Drawn, Regions
from batik_vector.values import frozen

BLUNT = 0.7
"""The cosine of 45°: where rings turn by less, nearly nothing is left white."""
SLACK = 1 / 64
"""A part of the pen's width that is not seen."""
SHORT = 1 / 6
"""A part of the pen's width by which a spike's ink ends before the corner: hardly anything is left there."""
FARTHEST = 2.0
"""How many widths a spike may be long; from there on lifting the pen takes less time."""
FOOT = 8
"""The foot of a spike is an eighth of the pen's width on either side of the corner."""


@frozen(eq=False)
class Spikes:
    """Where rings reach out: from which point of theirs, and to which tip, in steps, shape (n, 2)."""

    point: Index
    tip: Floats


def no_spikes() -> Spikes:
    """Return none."""
    return Spikes(np.empty(0, np.intp), np.empty((0, 2)))


def in_corners(drawn: Drawn, broad: float) -> tuple[Spikes, Index]:
    """Return spikes of the regions that were drawn in edge by edge, and those of the regions before in which
    something else is left.

    Args:
        drawn: by a spacing, told where corners passed where the pen's ink ends.
        broad: how broad the ink of a ring is, in steps.
    """
    regions = drawn.regions
    point = np.flatnonzero(sharp(regions) & (drawn.corner >= 0))
    if not len(point) or drawn.moved is None:
        return no_spikes(), np.empty(0, np.intp)
    corner = np.column_stack([regions.x[point], regions.y[point]])
    # Each with all the places that became this corner.
    at = drawn.corner[point]
    low, high = (np.searchsorted(drawn.moved.into, at, side=side) for side in ("left", "right"))
    times = high - low
    of = np.repeat(np.arange(len(point)), times)
    nth = np.arange(len(of)) - np.repeat(np.cumsum(times) - times, times)
    of = np.concatenate([np.arange(len(point)), of])
    places = np.concatenate([drawn.moved.passed[at], drawn.moved.merged[low[of[len(point) :]] + nth]])
    way = places - corner[of]
    away = np.sqrt(way[:, 0] * way[:, 0] + way[:, 1] * way[:, 1])
    farthest = np.lexsort((-np.rint(away), of))
    farthest = farthest[np.diff(of[farthest], prepend=-1) > 0]
    far, length = way[farthest], away[farthest]
    share = np.maximum(length - broad * (0.5 + SHORT), 0.0) / np.maximum(length, 1.0)
    tip = far * share[:, None]
    good = length * share <= broad * FARTHEST
    good[of[_off(way, tip[of]) > broad * (0.5 + SHORT + SLACK)]] = False
    drawn_out = good & (share > 0)
    part = np.searchsorted(regions.rings[regions.parts], point[~good], side="right") - 1
    return Spikes(point[drawn_out], (corner + tip)[drawn_out]), np.unique(drawn.parents[part])


def _off(way: Floats, tip: Floats) -> Floats:
    """Return how far places are from lines that lead to tips; all begin at 0."""
    square = tip[:, 0] * tip[:, 0] + tip[:, 1] * tip[:, 1]
    along = (way[:, 0] * tip[:, 0] + way[:, 1] * tip[:, 1]) / np.maximum(square, 1.0)
    rest = way - tip * np.clip(along, 0.0, 1.0)[:, None]
    return np.asarray(np.sqrt(rest[:, 0] * rest[:, 0] + rest[:, 1] * rest[:, 1]))


def sharp(regions: Regions) -> NDArray[np.bool_]:
    """Return at which points rings turn to the left by more than a little."""
    x, y = _steps(regions.x, regions), _steps(regions.y, regions)
    from_x, from_y = _before(x, regions), _before(y, regions)
    dot = x * from_x + y * from_y
    square = (x * x + y * y) * (from_x * from_x + from_y * from_y)
    blunt = (dot > 0) & (dot * dot >= BLUNT * BLUNT * square)
    return np.asarray(~blunt & (from_x * y > from_y * x))


def _steps(values: Floats, regions: Regions) -> Floats:
    """Return how much larger the value at the next point of the ring is."""
    found = np.empty_like(values)
    found[:-1] = values[1:]
    found[regions.rings[1:] - 1] = values[regions.rings[:-1]]
    return np.asarray(found - values)


def _before(values: Floats, regions: Regions) -> Floats:
    """Return the value at the point before each."""
    found = np.empty_like(values)
    found[1:] = values[:-1]
    found[regions.rings[:-1]] = values[regions.rings[1:] - 1]
    return found


def spiked(rings: Outlines, spikes: Spikes, width: float) -> Outlines:
    """Return rings that reach out by spikes: before and after each the corner is left out.

    Args:
        rings: closed outlines, one to a mark.
        spikes: what they reach out for.
        width: of the pen, in steps: an eighth of it is the foot of a spike, on either side.
    """
    # A corner has one spike.
    at, which = np.unique(spikes.point, return_index=True)
    if not len(at):
        return rings
    tip = np.rint(spikes.tip[which]).astype(np.int64)
    ring = np.searchsorted(rings.rings, at, side="right") - 1
    starts, stops = rings.rings[ring], rings.rings[ring + 1]
    before, after = np.where(at == starts, stops - 1, at - 1), np.where(at + 1 == stops, starts, at + 1)
    feet = [_toward(rings.points[at], rings.points[other], width / FOOT) for other in (before, after)]
    points = rings.points.copy()
    points[at] = feet[0]
    points = np.insert(points, np.repeat(at + 1, 2), np.stack([tip, feet[1]], axis=1).reshape(-1, 2), axis=0)
    more = 2 * np.bincount(ring, minlength=len(rings))
    return Outlines(points, rings.rings + np.concatenate([[0], np.cumsum(more)]), rings.marks, rings.closed)


def _toward(places: Steps, others: Steps, distance: float) -> Steps:
    """Return places so far on the way to others, by a third of the way at most."""
    way = others - places
    length = np.sqrt((way * way).sum(axis=1))
    share = np.minimum(distance / np.maximum(length, 1.0), 1 / 3)
    moved: Steps = np.rint(places + way * share[:, None]).astype(np.int64)
    return moved
