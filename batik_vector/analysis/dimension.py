"""Box dimension: how the boxes that a drawing's outline meets grow in number as they grow small.

Every box that an edge runs through is counted, by the edge and not by points on it: edges are cut where they
cross the lines of the finest grid, and coarser grids of the same family follow from that. Of several
positions of the grid the one with the fewest boxes counts, as the definition by coverings has it. Falconer,
Fractal Geometry (2004), 3.1.
"""

from __future__ import annotations

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.analysis.marks import Indices, Numbers, Points
from batik_vector.artwork import Geometries
from batik_vector.values import frozen

COARSEST, FINEST = 12.0, 512.0
"""Boxes to the drawing's extent, in the largest and in the smallest boxes that are counted."""

FAMILIES = 3
"""Sizes of boxes between one size and its half."""

OFFSETS = ((0.0, 0.0), (0.37, 0.19), (0.71, 0.53), (0.13, 0.83))
"""Positions of the grid, in its largest boxes."""

SHARP = math.radians(25)
"""The turn of a corner."""

CORNERED = 24.0
"""Stretches between corners to the drawing's extent past which they bound the fit: no detail is finer."""

MOST_CROSSINGS = 3e6
"""Boxes run through in the finest grid, about, at the most: finer ones are left out of the fit."""


@frozen
class BoxDimension:
    """The slope of log N against log 1/ε, fitted from boxes of ``smallest`` to ``largest`` mm.

    There are ``sizes`` of them. ``residual`` is the root of the mean square by which log₂ N misses the line,
    weighted as the fit is: by N.
    """

    dimension: float
    smallest: float
    largest: float
    residual: float
    sizes: int


def box_dimension(areas: Geometries, lines: Geometries) -> BoxDimension | None:
    """Return the box dimension of the outlines of areas together with lines; None where nothing is drawn.

    Args:
        areas: polygons.
        lines: polylines, in the same unit.
    """
    rings = shapely.get_rings(areas) if len(areas) else np.empty(0, dtype=object)
    drawn = np.concatenate([rings, np.asarray(lines, dtype=object)])
    xy, owner = shapely.get_coordinates(drawn, return_index=True)
    same = owner[1:] == owner[:-1]
    begin, end = xy[:-1][same], xy[1:][same]
    long = (begin != end).any(axis=1)
    begin, end = begin[long], end[long]
    if not len(begin):
        return None
    low = xy.min(axis=0)
    extent = float(np.ptp(xy, axis=0).max())
    length = float(np.hypot(*(end - begin).T).sum())
    finest = max(
        extent / FINEST, length / MOST_CROSSINGS, _detail(begin, end, owner[:-1][same][long], extent)
    )
    sizes: list[float] = []
    counts: list[float] = []
    for family in range(FAMILIES):
        largest = extent / COARSEST * 2 ** (-family / FAMILIES)
        steps = math.floor(math.log2(largest / finest) + 1e-9)
        if steps < 1:
            continue
        sizes += [largest / 2**step for step in range(steps, -1, -1)]
        counts += _counts(begin - low, end - low, largest, steps)
    if len(sizes) < 3:
        return None
    x, y = -np.log2(sizes), np.log2(counts)
    # A count of N boxes is uncertain by about √N, so its logarithm by 1/√N.
    weight = np.sqrt(counts)
    slope, at = np.polyfit(x, y, 1, w=weight)
    off = weight * (y - slope * x - at)
    residual = float(np.sqrt((off * off).sum() / (weight * weight).sum()))
    return BoxDimension(float(slope), min(sizes), max(sizes), residual, len(sizes))


def _detail(begin: Points, end: Points, owner: Indices, extent: float) -> float:
    """Return how long a stretch between two corners is; 0 where corners are few and all is smooth."""
    step = end - begin
    length: Numbers = np.hypot(*step.T)
    follows = (owner[1:] == owner[:-1]) & (begin[1:] == end[:-1]).all(axis=1)
    cross = step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0]
    sharp = np.abs(np.arctan2(cross, (step[:-1] * step[1:]).sum(axis=1))) > SHARP
    stretch = np.concatenate([[0], np.cumsum(sharp | ~follows)])
    lengths: Numbers = np.bincount(stretch, length).astype(np.float64)
    order = np.argsort(lengths, kind="stable")
    half = np.searchsorted(np.cumsum(lengths[order]), lengths.sum() / 2)
    middle = float(lengths[order][min(int(half), len(order) - 1)])
    return middle if middle <= extent / CORNERED else 0.0


def _counts(begin: Points, end: Points, largest: float, steps: int) -> list[float]:
    """Return how many boxes are met, of those 2^steps times smaller than the largest first."""
    least = [math.inf] * (steps + 1)
    whole = 2**steps
    for offset in OFFSETS:
        shift = np.array(offset) * largest
        met = _boxes((begin + shift) * (whole / largest), (end + shift) * (whole / largest), whole)
        for step in range(steps + 1):
            if step:
                met = met[0::2] | met[1::2]
                met = met[:, 0::2] | met[:, 1::2]
            least[step] = min(least[step], float(np.count_nonzero(met)))
    return least


def _boxes(a: Points, b: Points, whole: int) -> NDArray[np.bool_]:
    """Return which boxes of side 1 edges run through; the grid's sides are multiples of ``whole``.

    An edge enters every box but its first through a line of the grid, so the boxes on both sides of where it
    crosses one are all there are.
    """
    far = np.maximum(a.max(axis=0), b.max(axis=0))
    columns, rows = ((np.floor(far / whole).astype(np.intp) + 1) * whole).tolist()
    met = np.zeros((rows, columns), bool)
    # What ends on the grid's lower or left edge crosses it, into boxes that are not there.
    for place in (a, b):
        cell = np.floor(place).astype(np.intp)
        met[cell[:, 1], cell[:, 0]] = True
    for axis in (0, 1):
        low, high = np.minimum(a[:, axis], b[:, axis]), np.maximum(a[:, axis], b[:, axis])
        first = np.floor(low).astype(np.intp) + 1
        count = np.maximum(np.ceil(high).astype(np.intp) - first, 0)
        row = np.repeat(np.arange(len(a)), count)
        line = first[row] + np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
        part = (line - a[row, axis]) / (b[row, axis] - a[row, axis])
        other = np.floor(a[row, 1 - axis] + part * (b[row, 1 - axis] - a[row, 1 - axis])).astype(np.intp)
        for side in (line - 1, line):
            if axis == 0:
                met[other, side] = True
            else:
                met[side, other] = True
    return met
