"""Unions of two large areas that meet in few places: what lies away from the other is set aside.

GEOS overlays all of both, holes that the other area comes nowhere near as well, and nets of thousands of
holes cost it twenty times as much a vertex as small shapes.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries

LARGE = 600
"""Vertices of two areas from which it pays to set aside what lies away from the other."""


def joined_pairs(first: Geometries, second: Geometries) -> Geometries:
    """Return the union of each of some areas with the one in the same row: valid areas, in grid steps."""
    large = shapely.get_num_coordinates(first) + shapely.get_num_coordinates(second) > LARGE
    joined = np.empty(len(first), dtype=object)
    joined[~large] = shapely.union(first[~large], second[~large])
    for row in np.flatnonzero(large).tolist():
        joined[row] = _joined(shapely.get_parts(first[row]), shapely.get_parts(second[row]))
    return joined


def _joined(mine: Geometries, others: Geometries) -> shapely.Geometry:
    """Return the union of two areas, given as their polygons."""
    i, j = shapely.STRtree(others).query(mine)
    met_mine, met_others = np.zeros(len(mine), bool), np.zeros(len(others), bool)
    met_mine[i] = met_others[j] = True
    apart = np.concatenate([mine[~met_mine], others[~met_others]])
    if not len(i):
        return _together(apart)
    # What lies within a hole that is set aside is apart as well, so what is filled overlaps nothing.
    filled, holes = _filled(mine[met_mine], others[met_others])
    other_filled, other_holes = _filled(others[met_others], mine[met_mine])
    union = shapely.union(shapely.multipolygons(filled), shapely.multipolygons(other_filled))
    parts = _pierced(shapely.get_parts(union), np.concatenate([holes, other_holes]))
    return _together(np.concatenate([parts, apart]))


def _together(parts: Geometries) -> shapely.Geometry:
    found: shapely.Geometry = parts[0]
    return found if len(parts) == 1 else shapely.MultiPolygon(parts.tolist())


def _filled(areas: Geometries, others: Geometries) -> tuple[Geometries, Geometries]:
    """Return polygons without the holes whose bounds meet none of the others', and these holes, as rings."""
    rings, owner = shapely.get_rings(areas, return_index=True)
    shell = np.r_[True, owner[1:] != owner[:-1]]
    aside = ~shell
    aside[shapely.STRtree(others).query(rings)[0]] = False
    if not aside.any():
        return areas, rings[:0]
    return _polygons(rings[~aside], owner[~aside]), rings[aside]


def _pierced(parts: Geometries, holes: Geometries) -> Geometries:
    """Return polygons with holes that lie each in one of them."""
    if not len(holes):
        return parts
    rings, owner = shapely.get_rings(parts, return_index=True)
    within = _holder(parts, holes)
    order = np.argsort(np.concatenate([owner, within]), kind="stable")
    return _polygons(np.concatenate([rings, holes])[order], np.concatenate([owner, within])[order])


def _holder(parts: Geometries, holes: Geometries) -> NDArray[np.intp]:
    """Return the number of the polygon that each of some rings lies in."""
    if len(parts) == 1:
        return np.zeros(len(holes), np.intp)
    shapely.prepare(parts)
    points = np.asarray(shapely.point_on_surface(shapely.polygons(holes)), dtype=object)
    hole, part = shapely.STRtree(parts).query(points)
    held = shapely.contains(parts[part], points[hole])
    found = np.zeros(len(holes), np.intp)
    found[hole[held]] = part[held]
    return found


def _polygons(rings: Geometries, owner: NDArray[np.intp]) -> Geometries:
    """Return polygons of rings, the shell of each before its holes; owners are ascending, each has a ring."""
    starts = np.flatnonzero(np.r_[True, owner[1:] != owner[:-1]])
    return np.array(
        [
            shapely.polygons(rings[start], rings[start + 1 : stop])
            for start, stop in zip(starts, np.append(starts[1:], len(rings)), strict=True)
        ],
        dtype=object,
    )
