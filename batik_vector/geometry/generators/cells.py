"""Cells of a grid, merged: the regions that filled cells make up, as rings along their sides."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.lsystems import rounding
from batik_vector.geometry.lsystems.turtle import Complex
from batik_vector.geometry.nesting import rings_of, with_holes
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.geometry.sampling import Geometries, Indices
from batik_vector.geometry.work import spend_on_cells

Cells = NDArray[np.bool_]

STEPS = ((0, 1), (1, 0), (0, -1), (-1, 0))
"""East, north, west and south as steps over rows and columns of corners, anticlockwise."""


def merged(cells: Cells, share: float, tolerance: float, *, periodic: bool = False) -> Geometries:
    """Return the regions of filled cells, each 1 large, the first row lowest, the origin in the lower left.

    Cells that meet in a corner alone stay apart.

    Args:
        cells: shape (rows, columns).
        share: how round corners are; at 1 arcs meet in the middle of a cell's side.
        tolerance: how far a chord may stand off such an arc.
        periodic: whether the cells go on over their edges: corners there are then as round as the
            neighbours beyond leave them, and the regions are cut along the edges.

    Raises:
        TooLargeError: where they have too many corners.
    """
    rows, columns = cells.shape
    around = np.pad(cells, 2, mode="wrap") if periodic else cells
    points, offsets = _outlines(around)
    if not len(points):
        return np.empty(0, dtype=object)
    spend_on_cells(len(points))
    points, offsets, _ = rounding.sampled(points, offsets, np.ones(len(points)), share, tolerance)
    ring = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    xy = np.column_stack([points.real, points.imag])
    areas = with_holes(np.asarray(shapely.linearrings(xy, indices=ring), dtype=object))
    sound = np.asarray(shapely.is_valid(areas))
    if not sound.all():
        # Sharp outlines that come to one corner twice go round a hole there.
        mended = shapely.make_valid(areas[~sound], method="structure")
        areas = np.concatenate([areas[sound], polygonal(np.asarray(mended, dtype=object))])
    if not periodic:
        return oriented(areas)
    areas = np.asarray(shapely.transform(areas, lambda p: p - 2), dtype=object)
    inside = shapely.intersection(areas, shapely.box(0, 0, columns, rows))
    return oriented(polygonal(np.asarray(inside, dtype=object)))


def _outlines(cells: Cells) -> tuple[Complex, Indices]:
    """Return the corners of all outlines, closed, filled cells on their left, and where each begins."""
    full = np.pad(cells, 1)
    # A side is drawn eastward below a filled cell, northward to its right, and so round it.
    sides = np.zeros((full.shape[0] + 1, full.shape[1] + 1, 4), bool)
    low, high = full[1:-1, 1:-1], full
    for side, (begin, beyond) in enumerate(
        (((0, 0), (-1, 0)), ((0, 1), (0, 1)), ((1, 1), (1, 0)), ((1, 0), (0, -1)))
    ):
        other = high[
            1 + beyond[0] : high.shape[0] - 1 + beyond[0], 1 + beyond[1] : high.shape[1] - 1 + beyond[1]
        ]
        rows, columns = np.nonzero(low & ~other)
        sides[rows + begin[0] + 1, columns + begin[1] + 1, side] = True
    row, column, way = np.nonzero(sides)
    number = np.zeros(sides.shape, np.int64)
    number[row, column, way] = np.arange(len(row))
    step = np.array(STEPS)
    to_row, to_column = row + step[way, 0], column + step[way, 1]
    # Round its own cell where two meet in a corner: left first, then straight on, then right.
    behind = np.full(len(row), -1)
    for turn in (3, 0, 1):
        there = sides[to_row, to_column, (way + turn) % 4]
        behind[there] = ((way + turn) % 4)[there]
    following = number[to_row, to_column, behind]
    order, sizes = rings_of(following)
    turned = behind[order] != way[order]
    corner = (to_column[order] - 1) + 1j * (to_row[order] - 1)
    ring = np.repeat(np.arange(len(sizes)), sizes)[turned]
    points = corner[turned]
    first = np.flatnonzero(np.append(True, ring[1:] != ring[:-1])[: len(ring)])
    size = np.diff(np.append(first, len(ring)))
    closed = np.insert(points, np.cumsum(size), points[first])
    return closed, np.append(0, np.cumsum(size + 1)).astype(np.intp)
