"""What follows the contour of regions: dots in rows along it, bands, and strokes from it inwards."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import shapely

from batik_vector.geometry.fills.bodies import bodies, strokes
from batik_vector.geometry.fills.insets import Parts, inset, levels, opened, rings_of, stations
from batik_vector.geometry.fills.periodic import Period
from batik_vector.geometry.fills.symmetric import settled_places
from batik_vector.geometry.fills.thinning import by_length, clear, thinned
from batik_vector.geometry.sampling import Array, Geometries, Indices

CROWDED = 0.96
"""Share of the spacing below which a place along the contour is left out."""

HALVINGS = 8
"""By how many halvings the reach of a stroke is found: to a 256th of its length."""

GAP = 0.3
"""Bare ground that strokes which run together keep between their tips, as a share of their spacing."""


def along(
    parts: Parts,
    centres: Array,
    turns: int,
    reach: float,
    spacing: float,
    most: int = 0,
    period: Period | None = None,
    onto_axes: bool = True,
) -> tuple[Array, Indices]:
    """Return places along the contour of regions, in rows from the edge inwards, and the region of each.

    Args:
        parts: whole regions.
        centres, turns: as for :func:`~batik_vector.geometry.fills.insets.rings_of`.
        reach: from the edge to the first row.
        spacing: from row to row, and about from place to place: each row shares its length out evenly.
        most: rows at most; 0 for as many as there is room for.
        period: of a ground.
        onto_axes: whether marks may be moved onto the mirrors of the ground's group, being their own images.
    """
    points, region, rank, ranks = [np.empty((0, 2))], [np.empty(0, np.intp)], [np.empty(0, np.intp)], 0
    for number, within in levels(parts, reach, itertools.repeat(spacing)):
        if most and number >= most:
            break
        found = rings_of(within, centres, turns, period, reach + number * spacing)
        if not len(found.part):
            continue
        at = stations(found, spacing)
        points.append(at.points)
        region.append(within.region[found.part[at.ring]])
        rank.append(ranks + at.rank)
        ranks += int(at.rank.max(initial=0)) + 1
    places, of = np.concatenate(points), np.concatenate(region)
    if period is not None and period.group is not None:
        places, left = settled_places(places, np.concatenate(rank), CROWDED * spacing, period, onto_axes)
        return places, of[left]
    kept = thinned(places, of, CROWDED * spacing, np.concatenate(rank))
    return places[kept], of[kept]


def bands(
    parts: Parts,
    margin: float,
    spacing: float,
    width: float,
    taper: float,
    most: int,
    tolerance: float,
    period: Period | None = None,
) -> tuple[Geometries, Indices]:
    """Return bands along the contour, each within the one before, and the region of each.

    A band goes round what is at least a spacing broad: where a region narrows it turns back, and rounds
    corners as a tool does.

    Args:
        parts: whole regions.
        margin: from the edge to the first band.
        spacing: from band to band, from middle to middle.
        width: of the first band.
        taper: share of a band's width and spacing that the next one has.
        most: bands at most; 0 for as many as there is room for.
        tolerance: of their outlines.
        period: of a ground.
    """
    steps = (spacing * taper**k * (1 + taper) / 2 for k in itertools.count())
    marks, region = [np.empty(0, dtype=object)], [np.empty(0, np.intp)]
    reach = margin + width / 2
    for number, within in levels(parts, reach, steps):
        narrow = taper**number
        if (most and number >= most) or width * narrow < 4 * tolerance:
            break
        room = opened(within, spacing * narrow / 2)
        rings, of = shapely.get_rings(room.shapes, return_index=True)
        # Bands of a ground that keeps a group are cut to its region later.
        if period is not None and period.group is None:
            own, _ = period.rings(rings, reach + number * spacing)
            rings, of = rings[own], of[own]
        kept = clear(rings, room.region[of], (spacing + width) / 2 * narrow, by_length(rings))
        marks.append(bodies(rings[kept], width * narrow, tolerance))
        region.append(room.region[of[kept]])
    return np.concatenate(marks), np.concatenate(region)


def fringe(
    parts: Parts,
    centres: Array,
    turns: int,
    margin: float,
    spacing: float,
    width: float,
    length: float,
    tolerance: float,
    period: Period | None = None,
) -> tuple[Geometries, Indices]:
    """Return strokes (*sawut*) that run from the edge inwards, square to it, and the region of each.

    A stroke ends where the edge opposite is as near as its own, and before it comes nearer to its neighbours
    than a share of the spacing; what still crosses others is left out.

    Args:
        parts: whole regions.
        centres, turns: as for :func:`~batik_vector.geometry.fills.insets.rings_of`.
        margin: from the edge to the strokes.
        spacing: from stroke to stroke along the edge.
        width: of a stroke.
        length: of a stroke, at most.
        tolerance: of their outlines.
        period: of a ground.
    """
    within = inset(parts, margin + width / 2)
    if not len(within.shapes):
        return within
    found = rings_of(within, centres, turns, period, margin + width / 2)
    if not len(found.part):
        return within.shapes[:0], within.region[:0]
    at = stations(found, spacing)
    bare = width + GAP * max(spacing - width, 0.0)
    reach = np.minimum(length - width, _until_close(at.points, at.normals, at.ring, bare))
    part = found.part[at.ring]
    reach = np.minimum(reach, _until_halfway(within, at.points, at.normals, part, reach, bare))
    kept = reach >= min(width, length - width)
    begin, normals, reach, part = at.points[kept], at.normals[kept], reach[kept], part[kept]
    rank = at.rank[kept]
    end = begin + reach[:, None] * normals
    lines = np.asarray(shapely.linestrings(np.stack([begin, end], axis=1)), dtype=object)
    kept = clear(lines, within.region[part], bare * 0.98, rank)
    return strokes(begin[kept], end[kept], width, tolerance), within.region[part][kept]


def _until_close(points: Array, normals: Array, ring: Indices, clear: float) -> Array:
    """Return how far strokes can run, all alike, before a neighbour on the ring is nearer than ``clear``.

    The distance of two that have run t is |Δp + tΔn|, and t where that is ``clear`` a root of a quadratic.
    """
    most = np.full(len(points), np.inf)
    if not len(points):
        return most
    begin = np.searchsorted(ring, np.arange(ring[-1] + 1))
    after = np.arange(1, len(points) + 1)
    after[np.append(begin[1:], len(points)) - 1] = begin
    apart, bend = points[after] - points, normals[after] - normals
    a, b = (bend**2).sum(axis=1), (apart * bend).sum(axis=1)
    c = (apart**2).sum(axis=1) - clear**2
    root = b**2 - a * c
    meet = (root > 0) & (b < 0) & (a > 1e-12) & (c > 0)
    t = np.full(len(points), np.inf)
    t[meet] = (-b[meet] - np.sqrt(root[meet])) / a[meet]
    np.minimum.at(most, np.arange(len(points)), t)
    np.minimum.at(most, after, t)
    return most


def _until_halfway(
    within: Parts, points: Array, normals: Array, part: Indices, most: Array, clear: float
) -> Array:
    """Return how far strokes run before another edge is as near as half of ``clear`` more than their own."""
    edges = np.asarray(shapely.boundary(within.shapes), dtype=object)
    shapely.prepare(edges)
    shapely.prepare(within.shapes)
    # The stubs know of one distance for all.
    within_each: Any = shapely.dwithin
    low, high = np.zeros(len(points)), most + clear / 2
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        tip = points + middle[:, None] * normals
        spots = shapely.points(tip)
        # The nearest edge is the stroke's own as long as it is as far as the stroke is long.
        free = ~within_each(edges[part], spots, 0.97 * middle) & shapely.contains_xy(
            within.shapes[part], tip[:, 0], tip[:, 1]
        )
        low, high = np.where(free, middle, low), np.where(free, high, middle)
    return np.where(low >= most, low, low - clear / 2)
