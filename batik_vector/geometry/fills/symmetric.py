"""Grounds that keep a wallpaper group: marks are laid in its fundamental region, and their images set down.

A row that leaves the region goes on in an image of it. Its length within is shared out evenly with half a
step at each end, so that its marks stand evenly over the edge too, whether that is a mirror or not. What
comes too near to its own image is moved onto the mirror or the centre of rotation between them.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.fills.periodic import Period, moved_each
from batik_vector.geometry.fills.thinning import near_pairs, settled
from batik_vector.geometry.sampling import Array, Geometries, Indices

Mask: TypeAlias = NDArray[np.bool_]

TOUCH_MM = 1e-3
"""How far apart floats, and regions on the grid, may put two images that are one place."""

MOVES = 4
"""How often places are moved towards their images: once for a mirror, oftener where several meet."""

BESIDE_MM = 1e-3
"""How far beside a curve it is looked on which side its part lies."""


def pieces(
    rings: Geometries, part: Indices, shapes: Geometries, region: shapely.Polygon
) -> tuple[Geometries, Indices]:
    """Return what of rings lies in a convex region, and the part of each piece.

    A ring all within stays a ring; other pieces are lines with their part to the left.

    Args:
        rings: outlines of parts, and of their holes.
        part: of each ring.
        shapes: of all parts.
        region: a convex polygon.
    """
    shapely.prepare(region)
    whole = shapely.contains_properly(region, rings)
    met = shapely.line_merge(shapely.intersection(rings[~whole], region))
    lines, of = shapely.get_parts(met, return_index=True)
    long = (shapely.get_dimensions(lines) == 1) & (shapely.length(lines) > TOUCH_MM)
    lines, of = lines[long], part[~whole][of[long]]
    middle = shapely.length(lines) / 2
    ends = [
        shapely.get_coordinates(shapely.line_interpolate_point(lines, middle + d)) for d in (0, BESIDE_MM)
    ]
    ahead = ends[1] - ends[0]
    left = ends[0] + np.column_stack([-ahead[:, 1], ahead[:, 0]])
    shapely.prepare(shapes)
    right_way = shapely.contains_xy(shapes[of], left[:, 0], left[:, 1])
    lines = np.where(right_way, lines, shapely.reverse(lines))
    return np.concatenate([rings[whole], lines]), np.concatenate([part[whole], of])


def settled_places(
    points: Array, rank: Indices, least: float, period: Period, onto_axes: bool
) -> tuple[Array, Indices]:
    """Return places of a region, thinned so that no images of any lie nearer than ``least``.

    Args:
        points: shape (n, 2), in the region of the period's group.
        rank: the lower has its way.
        least: in mm.
        period: with a group.
        onto_axes: move what lies too near to its own images between them, onto the mirror or the centre of
            rotation, instead of leaving it out.

    Returns:
        The places, and the numbers of those that are left.
    """
    moved = np.zeros(len(points), bool)
    for _ in range(MOVES if onto_axes else 0):
        mine, apart = _own_images(points, least, period)
        if not len(mine):
            break
        share = np.bincount(mine, minlength=len(points)) + 1.0
        total = np.column_stack([np.bincount(mine, step, len(points)) for step in apart.T])
        points = points + total / share[:, None]
        moved[mine] = True
    clash, _ = _own_images(points, least, period)
    stays = np.ones(len(points), bool)
    stays[clash] = False
    left = np.flatnonzero(stays)
    # Places on an axis have their way: what is moved there closes the row.
    order = np.lexsort((np.arange(len(left)), rank[left], ~moved[left]))
    place = np.empty(len(left), np.intp)
    place[order] = np.arange(len(left))
    copies, owner = period.images(points[left], least)
    a, b = near_pairs(copies, np.zeros(len(copies), np.intp), least)
    first = a < len(left)
    a, b = owner[a[first]], owner[b[first]]
    kept = settled(place, a[a != b], b[a != b])
    return points[left][kept], left[kept]


def settled_marks(marks: Geometries, bare: float, period: Period) -> Mask:
    """Return which marks of a region stay so that no images of any come nearer to another than ``bare``.

    The earlier has its way; what comes too near to its own image goes.
    """
    there, of = period.images_of(marks, bare)
    near, a = shapely.STRtree(marks).query(there, predicate="dwithin", distance=bare)
    b = of[near]
    alone = np.ones(len(marks), bool)
    alone[a[a == b]] = False
    both = (a != b) & alone[a] & alone[b]
    return alone & settled(np.arange(len(marks)), a[both], b[both])


def spread(marks: Geometries, period: Period) -> tuple[Geometries, Indices]:
    """Return the images of marks of a region, each once and in the window of the period, and whose they are.

    What is its own image, on a mirror or about a centre of rotation, is set down once.
    """
    assert period.group is not None
    centres = shapely.get_coordinates(shapely.centroid(marks))
    found, owner, places = list[Geometries](), list[Indices](), list[Array]()
    for operation in period.group.operations:
        image = operation.at(centres)
        home = period.home(image)
        fresh = np.ones(len(marks), bool)
        for earlier in places:
            fresh &= np.hypot(*period.apart_modulo(home - earlier).T) > TOUCH_MM
        which = np.flatnonzero(fresh)
        found.append(moved_each(operation.apply(marks[which]), (home - image)[which]))
        owner.append(which)
        places.append(home)
    return np.concatenate(found), np.concatenate(owner)


def _own_images(points: Array, least: float, period: Period) -> tuple[Indices, Array]:
    """Return which places lie near images of their own, and how far it is to each, shape (n, 2)."""
    copies, owner = period.images(points, least)
    apart = copies - points[owner]
    far = np.hypot(*apart.T)
    near = np.flatnonzero((far < least) & (far > TOUCH_MM))
    return owner[near], apart[near]
