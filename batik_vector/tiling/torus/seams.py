"""Seams: where geometry meets the edges of a tile, and whether opposite edges agree to the bit.

Coordinates are whole grid steps, as in :mod:`batik_vector.tiling.torus.torus`.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Geometries
from batik_vector.tiling.torus.torus import Steps, Window

Intervals = Steps
"""Disjoint, ascending intervals on a line: shape (n, 2)."""


def border(areas: Geometries, axis: int, value: int) -> Intervals:
    """Return the intervals in which areas touch the line x = value (axis 0) or y = value (axis 1)."""
    if not len(areas):
        return np.empty((0, 2), np.int64)
    bounds = shapely.bounds(areas)
    near = areas[(bounds[:, axis] <= value) & (bounds[:, axis + 2] >= value)]
    coords, ring = shapely.get_coordinates(shapely.get_rings(near), return_index=True)
    on = coords[:, axis] == value
    edge = on[1:] & on[:-1] & (ring[1:] == ring[:-1])
    along = coords[:, 1 - axis].astype(np.int64)
    return joined(np.sort(np.column_stack([along[:-1][edge], along[1:][edge]]), axis=1))


def joined(intervals: Intervals) -> Intervals:
    """Return the union of intervals: sorted, disjoint, none touching another, none empty."""
    intervals = intervals[intervals[:, 0] < intervals[:, 1]]
    if not len(intervals):
        return np.empty((0, 2), np.int64)
    intervals = intervals[np.argsort(intervals[:, 0], kind="stable")]
    reach = np.maximum.accumulate(intervals[:, 1])
    new = np.concatenate([[True], intervals[1:, 0] > reach[:-1]])
    last = np.concatenate([np.flatnonzero(new)[1:] - 1, [len(intervals) - 1]])
    return np.column_stack([intervals[new, 0], reach[last]])


def inside(places: NDArray[np.float64], intervals: Intervals) -> NDArray[np.bool_]:
    """Tell which places lie in one of disjoint, ascending intervals."""
    row = np.searchsorted(intervals[:, 0], places, side="right") - 1
    return np.asarray((row >= 0) & (places < np.append(intervals[:, 1], 0)[row]))


def opposite_edges(cell: Cell) -> list[tuple[int, int, int, int]]:
    """Return the pairs of edges that must agree: (axis, value, opposite value, shift along the edge).

    The shift says how far along the opposite edge the twin stands; it is modulo the edge's length.
    """
    (_, slip_y), (slip_x, _) = cell.lattice
    return [(0, 0, cell.columns, slip_y), (1, 0, cell.rows, slip_x)]


def mismatch(areas: Geometries, cell: Cell) -> NDArray[np.int64]:
    """Return the edges' intervals covered on one side of a seam only, as (axis, from, to), shape (n, 3).

    A border that lies along the seam itself is such an interval and no fault; any other is a break.
    """
    found = []
    for axis, near, far, shift in opposite_edges(cell):
        length = cell.rows if axis == 0 else cell.columns
        here = border(areas, axis, near)
        there = rolled(border(areas, axis, far), -shift, length)
        for low, high in symmetric_difference(here, there):
            found.append((axis, low, high))
    return np.array(found, np.int64).reshape(-1, 3)


def rolled(intervals: Intervals, shift: int, length: int) -> Intervals:
    """Return intervals moved along a circle of the given length and cut where it begins."""
    if shift % length == 0:
        return intervals
    moved = intervals + shift % length
    over = moved[:, 1] > length
    wrapped = np.column_stack([np.maximum(moved[over, 0] - length, 0), moved[over, 1] - length])
    moved[:, 1] = np.minimum(moved[:, 1], length)
    return joined(np.vstack([moved[moved[:, 0] < length], wrapped]))


def symmetric_difference(a: Intervals, b: Intervals) -> Intervals:
    """Return what exactly one of two interval sets covers."""
    cuts, times = np.unique(np.concatenate([a.ravel(), b.ravel()]), return_counts=True)
    odd = cuts[times % 2 == 1]
    return np.asarray(odd.reshape(-1, 2))


def on_seam(areas: Geometries, window: Window) -> NDArray[np.int64]:
    """Return the edges of areas that run along the window's edges, as (axis, from, to), shape (n, 3)."""
    found = []
    for axis, values in ((0, (window.left, window.right)), (1, (window.bottom, window.top))):
        for value in values:
            for low, high in border(areas, axis, value):
                found.append((axis, low, high))
    return np.array(found, np.int64).reshape(-1, 3)


MEND_STEPS = 4
"""Breaks up to this long (grid steps) come from rounding and are mended; longer ones never do."""


def mended(areas: Geometries, cell: Cell) -> Geometries:
    """Return areas whose far edges repeat their near ones where rounding left them a step or two apart.

    Edges that cross or nearly coincide close to a seam may be rounded differently on its two sides. The
    vertices on the far edge are then moved along it to where their twins stand; a contact that one side
    alone has, of a few steps, is closed. What is longer is left for :func:`mismatch` to tell.
    """
    for axis, near, far, shift in opposite_edges(cell):
        length = cell.rows if axis == 0 else cell.columns
        here = border(areas, axis, near)
        there = rolled(border(areas, axis, far), -shift, length)
        for low, high in symmetric_difference(here, there).tolist():
            if high - low > MEND_STEPS:
                continue
            of_here = [p for p in (low, high) if p in here]
            # Moves along the far edge, without wrapping: a corner stays at its own end.
            to_far = (low + shift) % length - low
            of_there = [p for p in (low, high) if p in there]
            if len(of_there) == 1:
                target = low + high - of_there[0]
                moves = [(of_there[0] + to_far, target + to_far, far)]
            elif of_there:
                moves = [(high + to_far, low + to_far, far)]
            else:
                moves = [(high, low, near)] if len(of_here) == 2 else []
            for old, new, value in moves:
                areas = _moved(areas, axis, value, old, new)
    return areas


def _moved(areas: Geometries, axis: int, value: int, old: int, new: int) -> Geometries:
    """Move the vertices at one place of an edge to another."""
    bounds = shapely.bounds(areas)
    at = np.flatnonzero((bounds[:, axis] <= value) & (bounds[:, axis + 2] >= value))

    def move(coords: NDArray[np.float64]) -> NDArray[np.float64]:
        hit = (coords[:, axis] == value) & (coords[:, 1 - axis] == old)
        coords[hit, 1 - axis] = new
        return coords

    areas = areas.copy()
    areas[at] = shapely.remove_repeated_points(shapely.transform(areas[at], move))
    return areas
