"""Overlays on whole steps, which go another way round where GEOS fails on its grid."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.regions import polygonal
from batik_vector.geometry.sampling import Geometries

HAIR = 2.0
"""Steps of breadth, on average, below which a polygon is nothing that could be cut."""


def united(areas: Geometries) -> Geometries:
    """Return the union of polygons as polygons on whole steps."""
    try:
        return polygonal(shapely.union_all(areas, grid_size=1))
    except shapely.errors.GEOSException:
        # Where rounding closes a gap, a hole may be left without a shell; off the grid none is.
        return polygonal(shapely.set_precision(shapely.union_all(areas), 1))


def meeting(areas: Geometries, apart: float = 0.0) -> NDArray[np.bool_]:
    """Return which polygons meet others, or are no farther than so many steps from them."""
    near = np.zeros(len(areas), bool)
    tree = shapely.STRtree(areas)
    if apart:
        one, other = tree.query(areas, predicate="dwithin", distance=apart)
    else:
        one, other = tree.query(areas, predicate="intersects")
    pairs = one < other
    near[one[pairs]] = near[other[pairs]] = True
    return near


def without(area: shapely.Geometry, others: Geometries) -> Geometries:
    """Return what polygons leave of one, as polygons on whole steps."""
    covered = shapely.union_all(others)
    try:
        return polygonal(shapely.difference(area, covered, grid_size=1))
    except shapely.errors.GEOSException:
        return polygonal(shapely.set_precision(shapely.difference(area, covered), 1))


def on_grid(areas: Geometries) -> Geometries:
    """Return polygons on whole steps, still valid; what is narrower than a step is gone."""
    coords = shapely.get_coordinates(areas)
    if (coords == np.rint(coords)).all():
        return areas
    return polygonal(shapely.set_precision(areas, 1))


def without_hairs(areas: Geometries) -> Geometries:
    """Return polygons without those that are all hair: rounding leaves them where others meet."""
    return areas[2 * shapely.area(areas) >= HAIR * shapely.length(areas)]
