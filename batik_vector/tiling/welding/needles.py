"""Needles: spikes and slits of an outline that are thinner than the grid, and no drawing.

Where marks cross or touch at a sharp angle, what is left between them runs out into a needle that rounding
makes as long as it likes: both of its sides lie within a step of each other. A pen would draw the one and
take the other for drawn already. Sharp tips of marks are wider than that, and stay.

Coordinates are whole grid steps.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry.outlines import Index, Outlines, of_polygons, to_polygons
from batik_vector.tiling.torus.torus import Window

THIN = 1.0
"""Steps: how far the sides of a needle lie apart, at most, where the shorter of them begins."""

LONG = 3.0
"""Steps: shorter needles are vertices beside a corner."""

ROUNDS = 8
"""A needle may have vertices on its sides, and be taken back from its tip one by one."""


def needled(areas: Geometries) -> NDArray[np.bool_]:
    """Return which polygons have a needle."""
    outlines = of_polygons(areas)
    found = np.zeros(len(areas), bool)
    tip = np.flatnonzero(_tips(outlines))
    found[np.searchsorted(outlines.rings[outlines.marks], tip, side="right") - 1] = True
    return found


def without_needles(areas: Geometries, window: Window) -> Geometries:
    """Return valid polygons without their needles; what they cover of the window's edges stays.

    One that would become invalid is left as it is.
    """
    outlines = of_polygons(areas)
    for _ in range(ROUNDS):
        tip = _tips(outlines) & _is_free(outlines, window)
        # Of a ring that is a needle nothing would be left.
        sizes = np.diff(outlines.rings)
        tip &= np.repeat(sizes - np.add.reduceat(tip, outlines.rings[:-1], dtype=np.int64) > 2, sizes)
        if not tip.any():
            break
        rings = outlines.rings - np.concatenate([[0], np.cumsum(tip)])[outlines.rings]
        outlines = Outlines(outlines.points[~tip], rings, outlines.marks, outlines.closed)
    found = to_polygons(outlines)
    torn = ~shapely.is_valid(found)
    found[torn] = areas[torn]
    return found


def _tips(outlines: Outlines) -> NDArray[np.bool_]:
    """Return which points are the tips of needles."""
    before, after = _neighbours(outlines)
    (ax, ay), (bx, by) = ((outlines.points[each] - outlines.points).T for each in (before, after))
    one, other = _squared(ax, ay), _squared(bx, by)
    apart = _squared(ax * by - ay * bx, 0) <= THIN**2 * np.maximum(one, other)
    return np.asarray((ax * bx + ay * by > 0) & apart & (np.minimum(one, other) > LONG**2))


def _squared(x: NDArray[np.int64], y: NDArray[np.int64] | int) -> NDArray[np.float64]:
    return np.asarray(x * 1.0 * x + y * 1.0 * y)


def _neighbours(outlines: Outlines) -> tuple[Index, Index]:
    """Return for each point which points of its ring lie before and after it."""
    first, last = outlines.rings[:-1], outlines.rings[1:] - 1
    before = np.arange(-1, len(outlines.points) - 1)
    after = before + 2
    before[first], after[last] = last, first
    return before, after


def _is_free(outlines: Outlines, window: Window) -> NDArray[np.bool_]:
    """Return which points may go and leave alone what lies along the window's edges."""
    x, y = outlines.points.T
    on = np.column_stack([x == window.left, x == window.right, y == window.bottom, y == window.top])
    before, after = _neighbours(outlines)
    along = (on & on[before]) | (on & on[after]) | (on[before] & on[after])
    return np.asarray(~along.any(axis=1))
