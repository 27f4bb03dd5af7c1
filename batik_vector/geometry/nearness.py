"""Which shapes come near to which, and which hold which points: large ones are made ready for it first.

GEOS measures from one shape to another segment by segment, all with all, unless one of them is prepared; then
it looks its segments up in a tree. What it then tells of a distance is the same.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.sampling import Array, Geometries, Indices, Points

MANY = 100
"""Vertices from which on a shape is prepared: fewer are as soon measured."""


def nearer(shapes: Geometries, others: Geometries, distance: float | Array) -> NDArray[np.bool_]:
    """Return which pairs come nearer than a distance; at a distance of 0, which meet.

    Args:
        shapes: of which each is in many pairs, or is the larger.
        others: shape (n,) as well.
        distance: one for all, or shape (n,).
    """
    # The largest distance below the one asked for.
    below = np.broadcast_to(np.maximum(np.nextafter(distance, -np.inf), 0.0), shapes.shape)
    near = np.empty(len(shapes), bool)
    large = shapely.get_num_coordinates(shapes) >= MANY
    shapely.prepare(shapes[large])
    # The stubs want one distance for all.
    within_each: Any = shapely.dwithin
    near[large] = within_each(shapes[large], others[large], below[large])
    near[~large] = shapely.distance(shapes[~large], others[~large]) <= below[~large]
    return near


def pairs_within(shapes: Geometries, large: Geometries, reach: float) -> tuple[Indices, Indices]:
    """Return the pairs of one of some shapes and one of some large ones that come within ``reach``."""
    one, other = shapely.STRtree(large).query(boxes(shapes, reach))
    shapely.prepare(large)
    near = shapely.dwithin(large[other], shapes[one], reach)
    return one[near], other[near]


def boxes(shapes: Geometries, reach: float) -> Geometries:
    """Return the boxes round shapes, and ``reach`` further."""
    low_x, low_y, high_x, high_y = shapely.bounds(shapes).T
    return np.asarray(shapely.box(low_x - reach, low_y - reach, high_x + reach, high_y + reach), dtype=object)


def held(points: Points, areas: Geometries) -> tuple[Indices, Indices]:
    """Return the pairs of one of some points, shape (n, 2), and one of some areas that it lies within."""
    one, other = shapely.STRtree(areas).query(shapely.points(points))
    shapely.prepare(areas)
    within = shapely.contains_xy(areas[other], points[one, 0], points[one, 1])
    return one[within], other[within]


def on_lines(points: Points, lines: Geometries, reach: float) -> NDArray[np.bool_]:
    """Return which points, shape (n, 2), lie within ``reach`` of any of some lines."""
    together = shapely.multilinestrings(shapely.get_parts(lines))
    shapely.prepare(together)
    return np.asarray(shapely.dwithin(together, shapely.points(points), reach))
