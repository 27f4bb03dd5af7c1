"""Narrow places: where a beam or a blade of some breadth would take a part apart, or join what is apart.

A disc that rolls within a region sees it whole as long as nothing of it comes off, no hole opens and none
is lost when the border moves inward by the disc's radius. Points of stars and leaves only become shorter.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.regions import polygonal
from batik_vector.geometry.sampling import Geometries
from batik_vector.values import frozen

TOUCH = 2.0
"""Steps within which borders count as touching: what meets in a point was meant to."""
QUARTER = 6
"""Chords of a quarter of a disc."""
HALVINGS = 10
"""How often the breadth of a narrow place is halved in on."""


@frozen
class NarrowPlace:
    """A place (steps), and how broad it is there (steps)."""

    x: float
    y: float
    breadth: float


def narrowest_part(regions: Geometries, breadth: float) -> NarrowPlace | None:
    """Return the narrowest place of regions where they are narrower than told, or None where none is.

    Args:
        regions: valid polygons in steps.
        breadth: in steps.
    """
    if not len(regions) or breadth <= TOUCH:
        return None
    return _least(_narrowest(regions, breadth))


def narrowest_gap(regions: Geometries, breadth: float) -> NarrowPlace | None:
    """Return the narrowest of holes, bays and gaps between regions, likewise; what touches has no gap."""
    if not len(regions) or breadth <= TOUCH:
        return None
    suspects = regions[_changes(regions, breadth)]
    around = list[Geometries]()
    for region in suspects:
        box = shapely.box(*shapely.bounds(shapely.buffer(region, breadth)).tolist())
        around.append(polygonal(shapely.difference(box, region)))
    found = _narrowest(np.concatenate(around), breadth) if around else []
    return _least([*found, *_between(regions, breadth)])


def _least(found: list[NarrowPlace]) -> NarrowPlace | None:
    return min(found, key=lambda place: (place.breadth, place.x, place.y), default=None)


def _between(regions: Geometries, breadth: float) -> list[NarrowPlace]:
    """Return the narrowest place between any two regions, if it is narrower than told."""
    one, other = shapely.STRtree(regions).query(regions, predicate="dwithin", distance=breadth)
    pairs = one < other
    one, other = one[pairs], other[pairs]
    apart = shapely.distance(regions[one], regions[other])
    apart[apart <= TOUCH] = breadth
    if not (apart < breadth).any():
        return []
    least = int(np.argmin(apart))
    line = shapely.shortest_line(regions[one[least]], regions[other[least]])
    x, y = shapely.get_coordinates(line).mean(axis=0).tolist()
    return [NarrowPlace(x, y, float(apart[least]))]


def roominess(region: shapely.Geometry) -> float:
    """Return how broad a region is at its broadest, in steps."""
    size = max(1.0, float(np.sqrt(shapely.area(region))) / 500)
    radius = shapely.maximum_inscribed_circle(np.array([region], dtype=object), tolerance=size)
    return 2 * float(shapely.length(radius)[0])


def _changes(regions: Geometries, breadth: float) -> NDArray[np.bool_]:
    """Return which regions fall apart, vanish, or gain or lose holes when their borders are moved.

    Args:
        regions: polygons.
        breadth: by half of which they move outward; inward where it is less than 0.
    """
    touch = TOUCH if breadth > 0 else -TOUCH
    return np.asarray((_form(regions, touch) != _form(regions, breadth)).any(axis=1))


def _form(regions: Geometries, breadth: float) -> NDArray[np.int64]:
    """Return how many parts and how many holes each region has when its border is moved, shape (n, 2)."""
    moved = np.asarray(shapely.buffer(regions, breadth / 2, quad_segs=QUARTER), dtype=object)
    parts, owner = shapely.get_parts(moved, return_index=True)
    there = ~shapely.is_empty(parts)
    parts, owner = parts[there], owner[there]
    holes = np.bincount(owner, weights=shapely.get_num_interior_rings(parts), minlength=len(regions))
    return np.stack([np.bincount(owner, minlength=len(regions)), holes.astype(np.int64)], axis=1)


def _narrowest(regions: Geometries, breadth: float) -> list[NarrowPlace]:
    """Return the narrowest place of all regions, where they are narrower than told; several as narrow.

    All are halved in on at once, since only the narrowest is asked for.
    """
    whole = _form(regions, -TOUCH)
    suspects = (_form(regions, -breadth) != whole).any(axis=1)
    regions, whole = regions[suspects], whole[suspects]
    low, high = TOUCH, breadth
    for _ in range(HALVINGS if len(regions) else 0):
        middle = (low + high) / 2
        thin = (_form(regions, -middle) != whole).any(axis=1)
        if thin.any():
            regions, whole, high = regions[thin], whole[thin], middle
        else:
            low = middle
    necks = [shapely.get_coordinates(_neck(region, high)).mean(axis=0).tolist() for region in regions]
    return [NarrowPlace(x, y, low) for x, y in necks]


def _neck(region: shapely.Geometry, breadth: float) -> Geometries:
    """Return a point in what a disc of that breadth does not reach: of the part with most ways into it."""
    inner = shapely.buffer(region, -breadth / 2, quad_segs=QUARTER)
    if shapely.is_empty(inner):
        return np.array([shapely.point_on_surface(region)], dtype=object)
    reached = shapely.buffer(inner, breadth / 2 + 1, quad_segs=4 * QUARTER)
    left = polygonal(shapely.difference(region, reached))
    if not len(left):
        return np.array([shapely.point_on_surface(region)], dtype=object)
    doors = shapely.intersection(shapely.boundary(left), shapely.buffer(reached, 1.0))
    ways = shapely.get_num_geometries(shapely.line_merge(doors))
    best = max(range(len(left)), key=lambda each: (int(ways[each]), float(shapely.area(left[each])), -each))
    return np.asarray(shapely.point_on_surface(left[best : best + 1]), dtype=object)
