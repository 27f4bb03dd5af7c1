"""Geometry of shapely as outlines: polygons with their holes, lines, and whatever holds several of them."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.errors import GeometryError
from batik_vector.fields.fitting import shown
from batik_vector.geometry.paths.outline import EMPTY, LINE, MOVE, Outline, joined
from batik_vector.geometry.sampling import Geometries


def outline_of(geometry: Any) -> Outline:
    """Return a geometry, or several, as an outline: rings are closed subpaths, lines open ones.

    Outer rings run anticlockwise and holes clockwise, so that both fill rules fill what the polygons cover.

    Raises:
        GeometryError: where it is none, holds points, coordinates that are not finite, or nothing.
    """
    parts = _parts(geometry)
    kinds = shapely.get_type_id(parts)
    if np.isin(kinds, [shapely.GeometryType.POINT]).any():
        raise GeometryError("a geometry of points, expected polygons or lines")
    polygons = kinds == shapely.GeometryType.POLYGON
    rings = shapely.get_rings(shapely.orient_polygons(parts[polygons]))
    closed = kinds[~polygons] == shapely.GeometryType.LINEARRING
    found = [_outline(rings, np.ones(len(rings), bool)), _outline(parts[~polygons], closed)]
    outline = joined(found)
    if not len(outline.points):
        raise GeometryError("an empty geometry, expected polygons or lines")
    if not np.isfinite(outline.points).all():
        raise GeometryError("a geometry with coordinates that are not finite")
    return outline


def _parts(geometry: Any) -> Geometries:
    """Return the polygons, lines and points that geometry is made of, however nested."""
    parts = np.array(geometry, dtype=object).ravel()
    if not shapely.is_geometry(parts).all():
        raise GeometryError(f"{shown(geometry)}, expected geometry of shapely: polygons or lines")
    while (shapely.get_type_id(parts) > shapely.GeometryType.POLYGON).any():
        parts = shapely.get_parts(parts)
    return np.asarray(parts[~shapely.is_empty(parts)], dtype=object)


def _outline(lines: Geometries, closed: NDArray[np.bool_]) -> Outline:
    if not len(lines):
        return EMPTY
    points, owner = shapely.get_coordinates(lines, return_index=True)
    kinds = np.full(len(points), LINE, np.uint8)
    kinds[np.searchsorted(owner, np.arange(len(lines)))] = MOVE
    return Outline(points, kinds, closed)
