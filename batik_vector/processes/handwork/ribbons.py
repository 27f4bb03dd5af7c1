"""Ribbons: lines with a body whose breadth varies along them, as areas."""

from __future__ import annotations

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Offsets, Steps
from batik_vector.geometry.regions import oriented
from batik_vector.geometry.sampling import Array, Geometries

QUARTER = 6
"""Chords of a quarter of a round end."""
SHARP = 0.9
"""Cosine of half the turn below which a corner is drawn round."""
TURNS = np.array([math.pi / 2 * k / QUARTER for k in range(4 * QUARTER)])
CIRCLE: Array = np.round(np.stack([np.cos(TURNS), np.sin(TURNS)], axis=1), 12)
"""Corners of a round end, as far out as it."""
OUT = 1 / round(math.cos(math.pi / 4 / QUARTER), 12)
"""By how much these corners lie further out, so that the chords between them come nowhere nearer."""


def ribbons(points: Steps, offsets: Offsets, radius: Array, *, round_ends: bool) -> Geometries:
    """Return the bodies of open lines, as valid polygons on whole steps that may overlap.

    Args:
        points: shape (n, 2), in steps, no two that follow one another the same.
        offsets: where each line begins, and where the last ends; each has two points at least.
        radius: half the breadth at each point, in steps; between points it goes from the one to the other.
        round_ends: whether lines end round, or straight across their last point.
    """
    if len(offsets) < 2:
        return np.empty(0, dtype=object)
    points, offsets, radius, joints = _parted(points, offsets, radius)
    line = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    before, after, first, last = _ways(points, offsets)
    mean = before + after
    half = np.sqrt(mean[:, 0] * mean[:, 0] + mean[:, 1] * mean[:, 1]) / 2
    mean = mean / np.where(half > 0, 2 * half, 1.0)[:, None]
    far = radius / np.maximum(half, SHARP)
    normal = np.stack([-mean[:, 1], mean[:, 0]], axis=1) * far[:, None]
    made = _outlines(points.astype(float), offsets, normal)
    sound = np.asarray(shapely.is_valid(made), bool) & ~_turned_back(points, offsets, normal)
    # A line that turns more tightly than it is broad, or comes back to itself, is put together of pieces.
    pieces = ~sound[line]
    ends = (first | last) & ~pieces & (round_ends | joints)
    found = [made[sound], _pieces(points, pieces & ~last, radius), _discs(points[ends], radius[ends])]
    every = np.concatenate(found)
    every = np.asarray(shapely.transform(every, lambda xy: np.floor(xy + 0.5)), dtype=object)
    good = np.asarray(shapely.is_valid(every), bool)
    if not good.all():
        mended = np.asarray(shapely.get_parts(shapely.make_valid(every[~good])), dtype=object)
        mended = mended[shapely.get_type_id(mended) == shapely.GeometryType.POLYGON]
        every = np.concatenate([every[good], mended])
    return oriented(every[shapely.area(every) > 0])


def _ways(points: Steps, offsets: Offsets) -> tuple[Array, Array, NDArray[np.bool_], NDArray[np.bool_]]:
    """Return the directions before and after each point, and which begin a line and which end one."""
    along = (points[1:] - points[:-1]).astype(float)
    length = np.sqrt(along[:, 0] * along[:, 0] + along[:, 1] * along[:, 1])
    way = along / np.where(length > 0, length, 1.0)[:, None]
    first, last = np.zeros(len(points), bool), np.zeros(len(points), bool)
    first[offsets[:-1]] = last[offsets[1:] - 1] = True
    before, after = np.empty((len(points), 2)), np.empty((len(points), 2))
    before[1:], after[:-1] = way, way
    before[first], after[last] = after[first], before[last]
    return before, after, first, last


def _parted(
    points: Steps, offsets: Offsets, radius: Array
) -> tuple[Steps, Offsets, Array, NDArray[np.bool_]]:
    """Return lines parted at sharp corners, closed ones halfway too, and which points are such a corner."""
    before, after, first, last = _ways(points, offsets)
    mean = before + after
    sharp = mean[:, 0] * mean[:, 0] + mean[:, 1] * mean[:, 1] < 4 * SHARP * SHARP
    begin, end = offsets[:-1], offsets[1:] - 1
    middle = ((begin + end) // 2)[(points[begin] == points[end]).all(axis=1)]
    sharp[middle] = True
    corner = np.flatnonzero(sharp & ~first & ~last)
    parted = np.sort(np.concatenate([np.arange(len(points)), corner]))
    joints = np.zeros(len(parted), bool)
    begins = corner + np.arange(1, len(corner) + 1)
    joints[begins] = joints[begins - 1] = True
    moved = offsets + np.searchsorted(corner, offsets)
    return points[parted], np.sort(np.concatenate([moved, begins])), radius[parted], joints


def _outlines(points: Array, offsets: Offsets, normal: Array) -> Geometries:
    """Return a ring along each line and back."""
    sizes = np.diff(offsets)
    start = 2 * offsets[:-1]
    rings = np.empty((2 * len(points), 2))
    line = np.repeat(np.arange(len(sizes)), sizes)
    k = np.arange(len(points)) - offsets[:-1][line]
    rings[start[line] + k] = points - normal
    rings[start[line] + 2 * sizes[line] - 1 - k] = points + normal
    ring = np.repeat(np.arange(len(sizes)), 2 * sizes)
    shells = shapely.linearrings(np.floor(rings + 0.5), indices=ring)
    return np.asarray(shapely.polygons(shells), dtype=object)


def _turned_back(points: Steps, offsets: Offsets, normal: Array) -> NDArray[np.bool_]:
    """Return which lines have a side that runs against them somewhere: it cuts off what lies within a bend.

    Near an end it may do so without crossing the outline.
    """
    along = (points[1:] - points[:-1]).astype(float)
    turn = normal[1:] - normal[:-1]
    least = (along * along).sum(axis=1) - np.abs((along * turn).sum(axis=1))
    back = least < 0
    back[offsets[1:-1] - 1] = False
    found = np.concatenate([[0], np.cumsum(back)])
    return np.asarray(found[offsets[1:] - 1] > found[offsets[:-1]], bool)


def _discs(points: Steps, radius: Array) -> Geometries:
    """Return round ends."""
    xy = points[:, None] + CIRCLE[None] * (radius * OUT)[:, None, None]
    return np.asarray(shapely.polygons(xy), dtype=object)


def _pieces(points: Steps, which: NDArray[np.bool_], radius: Array) -> Geometries:
    """Return what a round tip covers on its way from each of some points to the next one."""
    at = np.flatnonzero(which)
    one = points[at, None] + CIRCLE[None] * (radius[at] * OUT)[:, None, None]
    other = points[at + 1, None] + CIRCLE[None] * (radius[at + 1] * OUT)[:, None, None]
    hulls = shapely.convex_hull(shapely.multipoints(np.concatenate([one, other], axis=1)))
    return np.asarray(hulls, dtype=object)
