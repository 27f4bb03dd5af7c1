"""From rings that may cross themselves to valid polygons, by a fill rule; and what collapses on the way."""

from __future__ import annotations

import enum
from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry import work
from batik_vector.geometry.sampling import Geometries, Indices, Points

LEVEL = 64
"""Points whose winding numbers are counted at once."""


class FillRule(enum.StrEnum):
    """Which faces of a self-crossing figure are inside."""

    NONZERO = "nonzero"
    """Every face that the rings wind round."""
    EVENODD = "evenodd"
    """Every other face, from the outside in."""
    OUTLINE = "outline"
    """All within the outer boundary."""


GRID = 1e-11
"""Step of the grid on which lost faces are looked for, as a part of the greatest coordinate."""
LOST = 1e-9
"""Part of the area from which faces count as lost."""


def settle(rings: Sequence[Points], rule: FillRule = FillRule.NONZERO) -> Geometries:
    """Return the region that rings enclose as valid polygons, outer rings anticlockwise.

    Args:
        rings: each of shape (n, 2), closed (the first point repeated at the end); they may cross
            themselves and one another, and every vertex of theirs on the boundary is kept.
        rule: what counts as inside.

    Returns:
        The polygons, as an array; they touch one another in points at most.

    Raises:
        TooLargeError: where they cross too often.
    """
    polygons = np.array([shapely.Polygon(ring) for ring in rings], dtype=object)
    if shapely.is_valid(polygons).all() and not _interfere(polygons):
        return oriented(polygons)
    lines = np.array([shapely.LineString(ring) for ring in rings], dtype=object)
    work.spend_on_lines(lines)
    faces = _faces(lines)
    if rule == FillRule.OUTLINE:
        inside = faces
    else:
        winding = winding_numbers(rings, shapely.get_coordinates(shapely.point_on_surface(faces)))
        inside = faces[winding != 0] if rule == FillRule.NONZERO else faces[winding % 2 == 1]
    merged = _merged(inside)
    if rule == FillRule.OUTLINE:
        merged = shapely.get_parts(shapely.union_all(shapely.polygons(shapely.get_exterior_ring(merged))))
    return oriented(merged)


def _faces(lines: Geometries) -> Geometries:
    """Return the faces that closed lines divide the plane into, but for the outermost.

    Where edges run over one another but for the last bits of their floats, GEOS may not find all crossings,
    and loses faces whose border then has a gap: these are looked for once more on a grid, where none is lost.
    """
    noded = shapely.get_parts(shapely.union_all(lines))
    found, cuts, dangles, _ = shapely.polygonize_full(noded)
    faces = np.asarray(shapely.get_parts(found), dtype=object)
    if shapely.is_empty(cuts) and shapely.is_empty(dangles):
        return faces
    grid = GRID * float(np.abs(shapely.get_coordinates(lines)).max())
    again = shapely.get_parts(shapely.polygonize(shapely.get_parts(shapely.union_all(lines, grid_size=grid))))
    lost = float(shapely.area(again).sum() - shapely.area(faces).sum())
    return np.asarray(again, dtype=object) if lost > LOST * float(shapely.area(again).sum()) else faces


def _merged(faces: Geometries) -> Geometries:
    """Return faces that share their edges to the bit as polygons without those edges."""
    try:
        return np.asarray(shapely.get_parts(shapely.coverage_union_all(faces)), dtype=object)
    except shapely.errors.GEOSException:
        # A face thinner than a float's last bit makes a ring of two points; the overlay takes it for nothing.
        return polygonal(shapely.union_all(faces))


def polygonal(marks: Geometries | shapely.Geometry) -> Geometries:
    """Return the polygons among the parts of geometries, however nested; empty ones are left out."""
    parts = shapely.get_parts(shapely.get_parts(marks))
    good = (shapely.get_type_id(parts) == shapely.GeometryType.POLYGON) & ~shapely.is_empty(parts)
    return np.asarray(parts[good], dtype=object)


def without_repeats(marks: Geometries) -> Geometries:
    """Return polygons and lines without points that repeat the one before.

    A hole that lies in a single point is gone; a polygon whose outer ring does is an empty one.
    """
    marks = np.array(marks, dtype=object)
    parts, whose = shapely.get_parts(marks, return_index=True)
    rings, owner = shapely.get_rings(parts, return_index=True)
    # Of a ring in one point GEOS can make none.
    for number in np.unique(whose[owner[~_spread(rings)]]).tolist():
        marks[number] = _uncollapsed(marks[number])
    return np.asarray(shapely.remove_repeated_points(marks), dtype=object)


def _uncollapsed(mark: shapely.Geometry) -> shapely.Geometry:
    """Return a polygon, or several, without the rings that lie in a single point."""
    kept = []
    for part in shapely.get_parts(mark):
        rings = shapely.get_rings(part)
        spread = _spread(rings)
        if spread[0]:
            kept.append(shapely.Polygon(rings[0], rings[1:][spread[1:]]))
    if isinstance(mark, shapely.Polygon):
        return kept[0] if kept else shapely.Polygon()
    return shapely.MultiPolygon(kept)


def _spread(rings: Geometries) -> NDArray[np.bool_]:
    """Return which rings have two points that differ."""
    bounds = shapely.bounds(rings).reshape(-1, 4)
    return np.asarray((bounds[:, :2] != bounds[:, 2:]).any(axis=1))


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
    start = np.concatenate([ring[:-1] for ring in rings])
    end = np.concatenate([ring[1:] for ring in rings])
    low, high = np.minimum(start[:, 1], end[:, 1]), np.maximum(start[:, 1], end[:, 1])
    total = np.zeros(len(at), np.intp)
    # Points of about one height, and of the edges those alone that reach it.
    order = np.argsort(at[:, 1], kind="stable")
    for begin in range(0, len(at), LEVEL):
        part = order[begin : begin + LEVEL]
        x, y = at[part, :1], at[part, 1:]
        near = (low <= y[-1]) & (high > y[0])
        (x0, y0), (x1, y1) = start[near].T, end[near].T
        side = (x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)
        up = (y0 <= y) & (y1 > y) & (side > 0)
        down = (y0 > y) & (y1 <= y) & (side < 0)
        total[part] = up.sum(axis=1) - down.sum(axis=1)
    return total
