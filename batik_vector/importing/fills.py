"""What fills cover: rings become polygons by the fill rule of their shape."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry.regions import FillRule, oriented, settle

Points = NDArray[np.float64]
Indices = NDArray[np.intp]

SLIVER_MM = 1e-6
"""Mean breadth below which an area is what rounding left between two edges, and nothing drawn."""


def filled(
    points: Points, offsets: Indices, shape: Indices, evenodd: NDArray[np.bool_]
) -> tuple[Geometries, Indices]:
    """Return what the fills of shapes cover as valid polygons, and the shape of each.

    Args:
        points: shape (n, 2), mm.
        offsets: shape (r + 1,): ring i is ``points[offsets[i]:offsets[i + 1]]``, closed or not.
        shape: shape (r,), ascending: whose ring each is.
        evenodd: for every shape, whether it is filled by the even-odd rule; else by the nonzero one.
    """
    coords, ring = _closed(points, offsets)
    # Three points and the first again are the least that encloses anything.
    enough = np.bincount(ring, minlength=len(shape)) >= 4
    keep = enough[ring]
    owner = shape[enough]
    if not len(owner):
        return np.empty(0, dtype=object), np.empty(0, np.intp)
    rings = shapely.linearrings(coords[keep], indices=(np.cumsum(enough) - 1)[ring[keep]])
    polygons: Geometries = np.asarray(shapely.polygons(rings), dtype=object)
    valid: NDArray[np.bool_] = np.asarray(shapely.is_valid(polygons))
    alone = np.bincount(owner, minlength=len(evenodd))[owner] == 1
    easy = alone & valid
    parts, owners = [oriented(polygons[easy])], [owner[easy]]
    for number in dict.fromkeys(owner[~easy].tolist()):
        mine = slice(*np.searchsorted(owner, [number, number + 1]))
        found = _compound(polygons[mine], valid[mine], bool(evenodd[number]))
        parts.append(found)
        owners.append(np.full(len(found), number, np.intp))
    areas, owner = np.concatenate(parts), np.concatenate(owners)
    order = np.argsort(owner, kind="stable")
    order = order[solid(areas[order])]
    return areas[order], owner[order]


def solid(areas: Geometries) -> NDArray[np.bool_]:
    """Return which areas (mm) are more than what rounding left."""
    return np.asarray(2 * shapely.area(areas) > SLIVER_MM * shapely.length(areas))


def _closed(points: Points, offsets: Indices) -> tuple[Points, Indices]:
    """Return rings with their first point at the end, and without points that repeat the one before."""
    count = np.diff(offsets)
    ring = np.repeat(np.arange(len(count)), count)
    first = points[offsets[:-1][count > 0]]
    coords = np.concatenate([points, first])
    ring = np.concatenate([ring, np.flatnonzero(count > 0)])
    order = np.argsort(ring, kind="stable")
    coords, ring = coords[order], ring[order]
    again = (coords[1:] == coords[:-1]).all(axis=1) & (ring[1:] == ring[:-1])
    keep = np.append(True, ~again) if len(coords) else np.empty(0, bool)
    return coords[keep], ring[keep]


def _compound(polygons: Geometries, valid: NDArray[np.bool_], evenodd: bool) -> Geometries:
    """Return what the rings of one shape cover together."""
    nested = _nested(polygons, evenodd) if valid.all() else None
    if nested is not None:
        return nested
    rule = FillRule.EVENODD if evenodd else FillRule.NONZERO
    return settle([shapely.get_coordinates(each) for each in polygons], rule)


def _nested(polygons: Geometries, evenodd: bool) -> Geometries | None:
    """Return what rings cover that lie beside or inside one another, or None where some cross.

    A ring lies as deep as there are rings round it. It bounds what is covered where it is filled on one
    side alone: by the even-odd rule that is every ring, by the nonzero rule it hangs on their turns.
    """
    outer, inner = shapely.STRtree(polygons).query(polygons, predicate="intersects")
    pairs = outer < inner
    a, b = polygons[outer[pairs]], polygons[inner[pairs]]
    over = shapely.relate_pattern(a, b, "T********")
    holds, held = shapely.covers(a, b), shapely.covers(b, a)
    if (over & (holds == held)).any():
        return None
    up = np.concatenate([outer[pairs][over & holds], inner[pairs][over & held]])
    down = np.concatenate([inner[pairs][over & holds], outer[pairs][over & held]])
    turn = np.where(shapely.is_ccw(shapely.get_exterior_ring(polygons)), 1, -1)
    count = len(polygons)
    outside = np.bincount(down, np.ones(len(up)) if evenodd else turn[up], count).astype(int)
    inside = outside + (1 if evenodd else turn)
    solid = (inside % 2 == 1, outside % 2 == 1) if evenodd else (inside != 0, outside != 0)
    shells, holes = np.flatnonzero(solid[0] & ~solid[1]), np.flatnonzero(~solid[0] & solid[1])
    # The smallest shell round a hole is the one that it is cut from.
    size = shapely.area(polygons)
    is_shell, is_hole = np.isin(up, shells), np.isin(down, holes)
    at = np.flatnonzero(is_shell & is_hole)
    at = at[np.lexsort([size[up[at]], down[at]])]
    hole, first = np.unique(down[at], return_index=True)
    if len(hole) < len(holes):
        return None
    around = up[at[first]]
    order = np.argsort(around, kind="stable")
    cuts = np.searchsorted(around[order], [shells, shells + 1])
    rings = shapely.get_exterior_ring(polygons)
    whole = polygons[shells]
    for number in np.flatnonzero(cuts[1] > cuts[0]).tolist():
        mine = hole[order[cuts[0][number] : cuts[1][number]]]
        whole[number] = shapely.polygons(rings[shells[number]], holes=rings[mine])
    return oriented(whole) if shapely.is_valid(whole).all() else None
