"""From rings that may cross themselves to valid polygons, by a fill rule."""

from __future__ import annotations

import enum
from collections.abc import Sequence

import numpy as np
import shapely

from batik_vector.geometry.sampling import Geometries, Indices, Points


class FillRule(enum.StrEnum):
    """Which faces of a self-crossing figure are inside."""

    NONZERO = "nonzero"
    """Every face that the rings wind round."""
    EVENODD = "evenodd"
    """Every other face, from the outside in."""
    OUTLINE = "outline"
    """All within the outer boundary."""


def settle(rings: Sequence[Points], rule: FillRule = FillRule.NONZERO) -> Geometries:
    """Return the region that rings enclose as valid polygons, outer rings anticlockwise.

    Args:
        rings: each of shape (n, 2), closed (the first point repeated at the end); they may cross
            themselves and one another, and every vertex of theirs on the boundary is kept.
        rule: what counts as inside.

    Returns:
        The polygons, as an array; they touch one another in points at most.
    """
    polygons = np.array([shapely.Polygon(ring) for ring in rings], dtype=object)
    if shapely.is_valid(polygons).all() and not _interfere(polygons):
        return oriented(polygons)
    noded = shapely.union_all([shapely.LineString(ring) for ring in rings])
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(noded)))
    if rule == FillRule.OUTLINE:
        inside = faces
    else:
        winding = winding_numbers(rings, shapely.get_coordinates(shapely.point_on_surface(faces)))
        inside = faces[winding != 0] if rule == FillRule.NONZERO else faces[winding % 2 == 1]
    # Faces share their edges to the bit.
    merged = shapely.get_parts(shapely.coverage_union_all(inside))
    if rule == FillRule.OUTLINE:
        merged = shapely.get_parts(shapely.union_all(shapely.polygons(shapely.get_exterior_ring(merged))))
    return oriented(merged)


def oriented(polygons: Geometries) -> Geometries:
    """Return polygons with outer rings anticlockwise and holes clockwise."""
    return np.asarray(shapely.orient_polygons(polygons), dtype=object)


def _interfere(polygons: Geometries) -> bool:
    """Whether any two polygons share more than boundary points."""
    if len(polygons) < 2:
        return False
    a, b = shapely.STRtree(polygons).query(polygons)
    pairs = a < b
    return bool(shapely.relate_pattern(polygons[a[pairs]], polygons[b[pairs]], "T********").any())


def winding_numbers(rings: Sequence[Points], at: Points) -> Indices:
    """Return how often the rings together wind anticlockwise round each point.

    Sunday, "Inclusion of a Point in a Polygon" (2001): signed crossings of the ray to the right.

    Args:
        rings: closed, each of shape (n, 2).
        at: shape (k, 2), none of them on a ring.
    """
    total = np.zeros(len(at), np.intp)
    for ring in rings:
        rows = max(1, 4_000_000 // len(ring))
        for begin in range(0, len(at), rows):
            part = slice(begin, begin + rows)
            x, y = at[part, :1], at[part, 1:]
            x0, y0, x1, y1 = ring[:-1, 0], ring[:-1, 1], ring[1:, 0], ring[1:, 1]
            side = (x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)
            up = (y0 <= y) & (y1 > y) & (side > 0)
            down = (y0 > y) & (y1 <= y) & (side < 0)
            total[part] += up.sum(axis=1) - down.sum(axis=1)
    return total
