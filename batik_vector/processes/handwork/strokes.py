"""Strokes: lines as a canting draws them, pooling where it is set down and running dry towards their end."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Geometries
from batik_vector.geometry.outlines import Offsets, Outlines, Steps
from batik_vector.geometry.sampling import Array
from batik_vector.processes.handwork.corners import densified_lines
from batik_vector.processes.handwork.options import HandProcess
from batik_vector.processes.handwork.ribbons import ribbons
from batik_vector.processes.handwork.waver import Wave, Waver
from batik_vector.units import STEPS_PER_MM

PRESSURE = ((0.9, 1.0), (0.33, 0.35))
"""The waves of a hand's pressure at full strength: how far bumps stand apart, over its reach, and by how much
of its breadth each makes a line broader or narrower."""
POOL, DRY = 0.3, 0.45
"""By how much of its breadth a line is broader where it begins, and narrower where it ends."""
POOLS, DRIES = 1.2, 4.0
"""Over how many of its breadths."""
LEFT = 0.5
"""The part of its breadth that a line keeps where nothing else is asked."""


def strokes(
    lines: Outlines, width: float, waver: Waver, spec: HandProcess, step: float, spare: float = 0.0
) -> Geometries:
    """Return lines as areas.

    Args:
        lines: of a tile, in steps.
        width: their breadth in mm.
        waver: how places are shifted.
        spec: how steady the hand is.
        step: how long an edge may be, in steps.
        spare: steps by which they are broader than asked where they are narrowest.
    """
    points, offsets = lines.repeating()
    starts, ends = _free(points, offsets, waver.cell)
    broad = width * STEPS_PER_MM
    points, offsets = densified_lines(points, offsets, min(step, broad))
    reach = spec.reach * STEPS_PER_MM
    waves = [Wave(far * reach, by) for far, by in PRESSURE]
    swell = Waver.drawn(waver.cell, waves, (spec.seed, 4), numbers=1).at(points)[:, 0]
    before, after = _ways(points, offsets)
    line = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    swell += POOL * starts[line] * _near(before, POOLS * broad) - DRY * ends[line] * _near(
        after, DRIES * broad
    )
    least = LEFT * width if spec.least is None else spec.least
    radius = np.maximum(broad * (1 + spec.strength * swell), least * STEPS_PER_MM + spare) / 2
    moved = waver.moved(points)
    # What has come to lie on the point before it says nothing of the way.
    same = np.append(False, (moved[1:] == moved[:-1]).all(axis=1) & (line[1:] == line[:-1]))
    moved, radius, line = moved[~same], radius[~same], line[~same]
    offsets = np.searchsorted(line, np.arange(len(offsets)))
    long = np.diff(offsets) > 1
    keep = long[line]
    offsets = np.append(0, np.cumsum(np.diff(offsets)[long]))
    return ribbons(moved[keep], offsets, radius[keep], round_ends=True)


def _free(points: Steps, offsets: Offsets, cell: Cell) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Return which lines begin freely, and which end so: not on one another, and not at the tile's edge."""
    both = np.concatenate([points[offsets[:-1]], points[offsets[1:] - 1]])
    inside = ((both > 0) & (both < (cell.columns, cell.rows))).all(axis=1)
    _, place, count = np.unique(both, axis=0, return_inverse=True, return_counts=True)
    free = inside & (count[place.ravel()] == 1)
    half = len(offsets) - 1
    return free[:half], free[half:]


def _ways(points: Steps, offsets: Offsets) -> tuple[Array, Array]:
    """Return how far each point is along its line, from where this begins and to where it ends."""
    way = (points[1:] - points[:-1]).astype(float)
    length = np.floor(np.append(0.0, np.sqrt(way[:, 0] * way[:, 0] + way[:, 1] * way[:, 1])) + 0.5)
    length[offsets[:-1]] = 0.0
    # Whole numbers add up to the same in any order.
    total = np.cumsum(length)
    line = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    return total - total[offsets[:-1]][line], total[offsets[1:] - 1][line] - total


def _near(far: Array, over: float) -> Array:
    """Return 1 at an end, falling to 0 over some way."""
    left = np.maximum(1 - far / over, 0.0)
    return left * left
