"""What is left of regions within a margin, and curves that run round at a distance from their edges."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.fills.periodic import ASIDE, Period
from batik_vector.geometry.fills.symmetric import pieces
from batik_vector.geometry.nearness import nearer
from batik_vector.geometry.regions import oriented
from batik_vector.geometry.sampling import Array, Geometries, Indices

QUADRANT = 16
"""Chords of a quarter circle round a corner that points inwards."""

SLACK = 1.0125
"""By how much more an inset is taken: chords cut an arc's corner by 0.12 %, and GEOS simplifies what it
buffers by up to 1 % of the distance (``simplifyTolerance`` of its BufferInputLineSimplifier)."""

MOST_LEVELS = 2_000
"""Rings within one another that are drawn at most."""


MIDDLE = 1e-4
"""How far from a place a ring's middle may lie that goes round it, as a share of the root of its area."""


LEVEL = 1e-4
"""Differences of reach up to which two points of a ring reach equally far, in the unit of the plane."""


class Parts(NamedTuple):
    """Polygons, and the number of the region that each is a part of."""

    shapes: Geometries
    region: Indices

    def taken(self, which: NDArray[np.bool_] | Indices) -> Parts:
        """Return some of them, by number or by a mask."""
        return Parts(self.shapes[which], self.region[which])


def whole(regions: Geometries) -> Parts:
    """Return regions as parts of themselves."""
    return Parts(regions, np.arange(len(regions), dtype=np.intp))


def inset(parts: Parts, reach: float) -> Parts:
    """Return what lies farther than ``reach`` from all edges, as oriented polygons; nothing nearer."""
    if reach <= 0 or not len(parts.shapes):
        return parts
    made = shapely.buffer(parts.shapes, -reach * SLACK, quad_segs=QUADRANT)
    shapes, of = shapely.get_parts(made, return_index=True)
    there = ~shapely.is_empty(shapes)
    shapes, of = oriented(shapes[there]), of[there]
    # Far inwards GEOS leaves crumbs beside the edge: none of them is within.
    edges = np.asarray(shapely.boundary(parts.shapes), dtype=object)
    far = ~nearer(edges[of], shapes, reach)
    return Parts(shapes[far], parts.region[of[far]])


def opened(parts: Parts, radius: float) -> Parts:
    """Return what a disc of a radius covers that moves within: necks that are narrower are gone."""
    core = inset(parts, radius)
    if not len(core.shapes):
        return core
    grown = shapely.buffer(core.shapes, radius * (2 - SLACK), quad_segs=QUADRANT)
    return Parts(oriented(grown), core.region)


def levels(parts: Parts, first: float, steps: Iterator[float]) -> Iterator[tuple[int, Parts]]:
    """Yield the insets at ``first`` and on by steps, until nothing is left; with the number of each."""
    reach = first
    for number in range(MOST_LEVELS):
        within = inset(parts, reach)
        if not len(within.shapes):
            return
        yield number, within
        reach += next(steps)
        # What has nothing left here has nothing left further in.
        parts = parts.taken(np.isin(parts.region, within.region))


class Rings(NamedTuple):
    """Closed curves round parts: points (n, 2) one after another, and of each ring where it begins, its
    part, into how many stretches alike its marks must divide it, and how far on from its first point the
    first of them lies. An ``open`` one is a piece of a ring, that goes on elsewhere.
    """

    points: Array
    first: Indices
    part: Indices
    turns: Indices
    offset: Array
    open: NDArray[np.bool_]


def rings_of(
    parts: Parts, centres: Array, turns: int = 1, period: Period | None = None, reach: float = 0.0
) -> Rings:
    """Return the outlines of parts, with the part to the left, each begun where an axis of symmetry may lie.

    That is where it reaches farthest from the motif's centre, or along +x if it goes round that: both sides
    of a shape with an axis are then marked alike. What goes round the centre is so under ``turns`` turns. In
    a ground that keeps a group, what leaves its region is cut off there.

    Args:
        parts: with edges.
        centres: of the motif, for each region, shape (n, 2).
        turns: order of the motif's turns that must leave its marks as they are.
        period: of a ground: then each ring is taken once, and is its own centre.
        reach: how far the parts keep from the edges of a ground.
    """
    rings, part = shapely.get_rings(parts.shapes, return_index=True)
    if period is not None:
        rings, part = _of_ground(rings, part, parts, period, reach)
    cut = shapely.get_type_id(rings) == shapely.GeometryType.LINESTRING
    closed = _begun(rings[~cut], centres[parts.region[part[~cut]]], part[~cut], turns, period)
    return closed if not cut.any() else _joined(closed, rings[cut], part[cut])


def _of_ground(
    rings: Geometries, part: Indices, parts: Parts, period: Period, reach: float
) -> tuple[Geometries, Indices]:
    """Return of the rings of a ground each once, and the part of each; what runs on is cut off."""
    if period.group is not None:
        return pieces(rings, part, parts.shapes, period.group.region)
    own, broad = period.rings(rings, reach)
    if not broad.any():
        return rings[own], part[own]
    wide, high = period.window.tolist()
    window = shapely.box(ASIDE, ASIDE, wide + ASIDE, high + ASIDE)
    cut, of = pieces(rings[broad], part[broad], parts.shapes, window)
    return np.concatenate([rings[own], cut]), np.concatenate([part[own], of])


def _begun(rings: Geometries, centre: Array, part: Indices, turns: int, period: Period | None) -> Rings:
    """Return rings, begun where an axis of symmetry may lie."""
    points, of = shapely.get_coordinates(rings, return_index=True)
    first = np.searchsorted(of, np.arange(len(rings)))
    discs = shapely.polygons(rings)
    if period is not None:
        centre = shapely.get_coordinates(shapely.centroid(discs))
    off = np.hypot(*(shapely.get_coordinates(shapely.centroid(discs)) - centre).T)
    about = off < MIDDLE * np.sqrt(shapely.area(discs))
    far: Array = np.hypot(*(points - centre[of]).T)
    outwards = np.where(about[of], points[:, 0], far)
    count = np.diff(np.append(first, len(points))) - 1
    order = np.lexsort((np.arange(len(points)), -outwards, of))
    begin = order[first] - first
    place = np.arange(len(points)) - first[of]
    turned = first[of] + (place + begin[of]) % count[of]
    points, outwards, last = points[turned], outwards[turned], first + count
    # An axis may cross an edge: then its two ends reach equally far.
    ahead, behind = (points[first + 1] - points[first], points[last - 1] - points[first])
    before = np.where(outwards[first] - outwards[last - 1] < LEVEL, -np.hypot(*behind.T) / 2, 0.0)
    offset = np.where(outwards[first] - outwards[first + 1] < LEVEL, np.hypot(*ahead.T) / 2, before)
    return Rings(points, first, part, np.where(about, turns, 1), offset, np.zeros(len(first), bool))


def _joined(closed: Rings, lines: Geometries, part: Indices) -> Rings:
    """Return rings and open pieces of others after them."""
    points, of = shapely.get_coordinates(lines, return_index=True)
    first = len(closed.points) + np.searchsorted(of, np.arange(len(lines)))
    nothing = np.zeros(len(lines))
    return Rings(
        np.concatenate([closed.points, points]),
        np.concatenate([closed.first, first]),
        np.concatenate([closed.part, part]),
        np.concatenate([closed.turns, np.ones(len(lines), np.intp)]),
        np.concatenate([closed.offset, nothing]),
        np.concatenate([closed.open, nothing == 0]),
    )


class Stations(NamedTuple):
    """Points on rings at even steps: (n, 2) each, the unit normals into the part, and the ring of each.

    ``rank`` counts from where the ring begins, to both sides alike.
    """

    points: Array
    normals: Array
    ring: Indices
    rank: Indices


def stations(rings: Rings, spacing: float) -> Stations:
    """Return places on rings: as many as fit at a spacing at least, sharing each ring evenly.

    An open piece has as many as its length is spacings, half a step from its ends: so has what it goes on in.
    """
    points, first = rings.points, rings.first
    length = np.hypot(*np.diff(points, axis=0, prepend=points[:1]).T)
    length[first] = 0.0
    along = np.cumsum(length)
    start = along[first]
    total = along[np.append(first[1:], len(points)) - 1] - start
    number = (total / spacing / rings.turns).astype(np.intp) * rings.turns
    number[rings.turns == 1] = np.maximum(number[rings.turns == 1], 1)
    number[rings.open] = np.rint(total / spacing)[rings.open]
    half = np.where(rings.open, total / np.maximum(number, 1) / 2, 0.0)
    ring = np.repeat(np.arange(len(first)), number)
    share = np.arange(len(ring)) - np.repeat(np.cumsum(number) - number, number)
    at = (rings.offset + half)[ring] + share * (total / np.maximum(number, 1))[ring]
    turn = (number // rings.turns)[ring]

    def where(offset: float) -> Array:
        around = start[ring] + (at + offset) % np.maximum(total, 1e-300)[ring]
        return _on(points, along, first, ring, around)

    ahead = where(spacing / 8) - where(-spacing / 8)
    ahead /= np.maximum(np.hypot(*ahead.T), 1e-300)[:, None]
    normals = np.column_stack([-ahead[:, 1], ahead[:, 0]])
    return Stations(where(0.0), normals, ring, np.minimum(share % turn, -share % turn))


def _on(points: Array, along: Array, first: Indices, ring: Indices, s: Array) -> Array:
    """Return the points of rings at lengths along all of them."""
    last = np.append(first[1:], len(points)) - 1
    right = np.clip(np.searchsorted(along, s, side="right"), first[ring] + 1, last[ring])
    left = right - 1
    step = along[right] - along[left]
    share = np.where(step > 0, (s - along[left]) / np.where(step > 0, step, 1.0), 0.0).clip(0, 1)
    found: Array = points[left] + share[:, None] * (points[right] - points[left])
    return found
