"""Marks as areas: dots, round-ended strokes, and shapes set down at many places."""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
import shapely

from batik_vector.geometry.sampling import Array, Geometries, Indices

Marks: TypeAlias = tuple[Geometries, Indices]
"""Areas, and the number of the region that each lies in."""


def chords(radius: float, tolerance: float) -> int:
    """Return how many chords draw a circle to a tolerance: a multiple of four, 12 to 64."""
    share = min(max(tolerance / max(radius, 1e-300), 1e-6), 1.0)
    return int(min(max(4 * math.ceil(math.pi / math.acos(1 - share) / 4), 12), 64))


def circle(radius: float, tolerance: float) -> Array:
    """Return the corners of a dot round the origin, anticlockwise, shape (n, 2)."""
    turn = 2 * np.pi * (np.arange(chords(radius, tolerance)) + 0.5) / chords(radius, tolerance)
    return radius * np.column_stack([np.cos(turn), np.sin(turn)])


def stamped(shape: Array, places: Array, turns: Array | None = None) -> Geometries:
    """Return a shape, corners (n, 2), set down at places (m, 2), each turned by radians where given."""
    if not len(places):
        return np.empty(0, dtype=object)
    closed = np.vstack([shape, shape[:1]])
    if turns is None:
        corners = places[:, None] + closed[None]
    else:
        cos, sin = np.cos(turns)[:, None], np.sin(turns)[:, None]
        x, y = closed.T
        corners = places[:, None] + np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)
    return _polygons(corners)


def strokes(begin: Array, end: Array, width: float, tolerance: float) -> Geometries:
    """Return straight strokes with round ends, between points (n, 2)."""
    if not len(begin):
        return np.empty(0, dtype=object)
    half = width / 2
    along = end - begin
    length = np.hypot(*along.T)
    ahead = np.where(length[:, None] > 0, along / np.where(length > 0, length, 1.0)[:, None], [1.0, 0.0])
    turn = np.linspace(-np.pi / 2, np.pi / 2, chords(half, tolerance) // 2 + 1)
    forward, side = half * np.cos(turn), half * np.sin(turn)
    left = np.column_stack([-ahead[:, 1], ahead[:, 0]])
    tip = forward[None, :, None] * ahead[:, None] + side[None, :, None] * left[:, None]
    corners = np.concatenate([end[:, None] + tip, begin[:, None] - tip], axis=1)
    closed = np.concatenate([corners, corners[:, :1]], axis=1)
    return _polygons(closed)


def _polygons(corners: Array) -> Geometries:
    """Return polygons of as many corners each, closed, shape (n, m, 2)."""
    ends = np.arange(len(corners) + 1)
    made = shapely.from_ragged_array(
        shapely.GeometryType.POLYGON, corners.reshape(-1, 2), (ends * corners.shape[1], ends)
    )
    return np.asarray(made, dtype=object)


def bodies(lines: Geometries, width: float, tolerance: float) -> Geometries:
    """Return lines with a body of a width and round ends; what a line touches twice is one."""
    return np.asarray(
        shapely.buffer(lines, width / 2, quad_segs=chords(width / 2, tolerance) // 4), dtype=object
    )


def net(one: Marks, other: Marks) -> Marks:
    """Return two sets of marks, of which none overlap in their own set, as one where they meet.

    Args:
        one, other: marks, and the region of each.
    """
    names = np.union1d(one[1], other[1])
    if not len(names):
        return one
    first, second = (
        _together(marks, np.searchsorted(names, region), len(names)) for marks, region in (one, other)
    )
    joined = shapely.union(first, second)
    shapes, of = shapely.get_parts(joined, return_index=True)
    return np.asarray(shapes, dtype=object), names[of]


def _together(marks: Geometries, number: Indices, count: int) -> Geometries:
    order = np.argsort(number, kind="stable")
    out = np.full(count, shapely.MultiPolygon(), dtype=object)
    shapely.multipolygons(marks[order], indices=number[order], out=out)
    return out
