"""Bodies of lines: the outlines of strokes, written down by walking round them.

A body is walked with itself on the left, along its lines at half their width to the right. Where the walk
turns right the two edges meet in one point; where it turns left an arc goes round the outer side, and where a
line ends the arc is half a circle.
"""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.geometry.lsystems.turtle import Complex
from batik_vector.geometry.regions import FillRule, oriented, polygonal, settle
from batik_vector.geometry.sampling import Array, Geometries, Indices, Points
from batik_vector.geometry.work import foretell_union, spend_on_union

STRAIGHT = 1e-9
"""Turns of less (radians) are none."""
MOST_ARC = 64
"""Points of an arc at most."""
SHARP = 2.6
"""Right turns of more (radians) meet far from their corner: the walk then goes through the corner itself."""


def around(
    corners: Complex, arrive: Complex, leave: Complex, radius: Array, tolerance: float
) -> tuple[Points, Indices]:
    """Return the points of a walk, and of which corner each is.

    Args:
        corners: where the walk turns, in its order.
        arrive, leave: the directions of length 1 before and behind.
        radius: half the width there.
        tolerance: how far a chord may stand off its arc.
    """
    turn = np.angle(leave / arrive)
    turn[turn < STRAIGHT - np.pi] = np.pi
    step = 2 * np.arccos(np.clip(1 - tolerance / np.maximum(radius, 1e-300), 0.0, 1 - 1e-9))
    pieces = np.where(turn > STRAIGHT, np.ceil(turn / step - 1e-9), 0)
    pieces = np.clip(pieces, 0, MOST_ARC).astype(np.intp)
    # A half circle of one chord would be no body.
    pieces[turn > 3.1] = np.maximum(pieces[turn > 3.1], 2)
    count = np.where(turn > STRAIGHT, pieces + 1, np.where(turn < -STRAIGHT, 1, 0))
    owner = np.repeat(np.arange(len(corners)), count)
    rank = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    share = rank / np.maximum(pieces[owner], 1)
    arc = -1j * arrive[owner] * np.exp(1j * turn[owner] * share)
    meeting = -1j * (arrive + leave)
    with np.errstate(divide="ignore", invalid="ignore"):
        meeting = np.where(turn > -SHARP, meeting / (1 + np.cos(turn)), 0)
    offset = np.where(turn[owner] > 0, arc, meeting[owner])
    points = corners[owner] + radius[owner] * offset
    return np.column_stack([points.real, points.imag]), owner


def bodies(points: Complex, offsets: Indices, widths: Array, tolerance: float) -> Geometries:
    """Return the bodies of strands, welded.

    Args:
        points: of all strands, where no two in a row are the same.
        offsets: where each strand begins, and the end.
        widths: breadth of the stroke at each point.
        tolerance: how far a chord may stand off a round end.

    Raises:
        TooLargeError: where strokes cross too often to be welded.
    """
    count = np.diff(offsets)
    single = count > 1
    first, last = offsets[:-1][single], offsets[1:][single] - 1
    # There and back: of n points come 2n − 2 corners.
    there = np.concatenate([_forth_and_back(int(a), int(b)) for a, b in zip(first, last, strict=True)])
    sizes = 2 * (last - first)
    ring = np.repeat(np.arange(len(sizes)), sizes)
    begin = np.cumsum(sizes) - sizes
    following = np.arange(len(there)) + 1
    following[begin + sizes - 1] = begin
    way = points[there[following]] - points[there]
    leave = way / np.abs(way)
    arrive = np.empty_like(leave)
    arrive[following] = leave
    outline, owner = around(points[there], arrive, leave, widths[there] / 2, tolerance)
    rings = shapely.linearrings(outline, indices=ring[owner])
    shapes: Geometries = np.asarray(shapely.polygons(rings), dtype=object)
    sound = np.asarray(shapely.is_valid(shapes))
    mended = [settle([shapely.get_coordinates(each)], FillRule.NONZERO) for each in shapes[~sound]]
    strokes = np.concatenate([shapes[sound], *mended])
    foretell_union([strokes])
    made = welded(strokes)
    spend_on_union(strokes, made)
    return made


def welded(shapes: Geometries) -> Geometries:
    """Return areas united."""
    return oriented(polygonal(np.array([shapely.union_all(shapes)], dtype=object)))


def _forth_and_back(first: int, last: int) -> Indices:
    return np.concatenate([np.arange(first, last), np.arange(last, first, -1)])
