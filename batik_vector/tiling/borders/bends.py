"""Bends: a stretch of a band carried round a quarter circle, in whole grid steps."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import shapely

from batik_vector.geometry.sampling import Array, Indices, Points, refine
from batik_vector.tiling.borders.bands import Marks, on_grid


def bent(marks: Marks, length: int, radius: int, tolerance: float, merges: bool) -> Marks:
    """Return a stretch of a band bent round a corner, to be laid from the point where it leaves its side.

    The point (x, y) of the band goes to the distance ``radius`` − y from the centre of the bend at
    (0, ``radius``), and to the angle 90°·x/``length``: the ends x = 0 and x = ``length`` stay straight and on
    the grid.

    Args:
        marks: in front of x = 0 up to ``length``, in grid steps.
        length: of the stretch.
        radius: of the band's outer edge.
        tolerance: in grid steps: how far a chord may stand from the arc that an edge becomes.
        merges: whether areas that meet become one.
    """

    def on_arc(xy: Points) -> Points:
        angle = (math.pi / 2 / length) * xy[:, 0]
        away = radius - xy[:, 1]
        return np.column_stack([away * np.sin(angle), radius - away * np.cos(angle)])

    areas, lines = marks.areas, marks.lines
    if len(areas):
        _, coords, (offsets, polygons) = shapely.to_ragged_array(areas)
        coords, rings = _carried(coords, offsets.astype(np.intp), on_arc, tolerance)
        areas = np.asarray(
            shapely.from_ragged_array(shapely.GeometryType.POLYGON, coords, (rings, polygons)), dtype=object
        )
    if len(lines):
        _, coords, (offsets,) = shapely.to_ragged_array(lines)
        coords, ends = _carried(coords, offsets.astype(np.intp), on_arc, tolerance)
        lines = np.asarray(
            shapely.from_ragged_array(shapely.GeometryType.LINESTRING, coords, (ends,)), dtype=object
        )
    return on_grid(replace(marks, areas=areas, lines=lines), merges)


def _carried(
    coords: Points, offsets: Indices, to: Callable[[Points], Points], tolerance: float
) -> tuple[Points, Indices]:
    """Return the images of polylines, one after another, with vertices put in where their edges bend."""
    lasts = offsets[1:] - 1
    edges = np.delete(np.arange(len(coords)), lasts)
    step = np.zeros_like(coords)
    step[:-1] = np.diff(coords, axis=0)

    def evaluate(edge: Indices, t: Array) -> Points:
        return to(coords[edge] + step[edge] * t[:, None])

    edge, t = refine(evaluate, edges, np.zeros(len(edges)), np.ones(len(edges)), tolerance)
    stops = np.searchsorted(edge, lasts)
    images = np.insert(evaluate(edge, t), stops, to(coords[lasts]), axis=0)
    return images, np.concatenate([[0], stops + np.arange(1, len(lasts) + 1)]).astype(np.intp)
