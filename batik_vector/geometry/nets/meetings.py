"""Where the outlines of areas meet those of others, and on which side of them they go on.

All is exact: whether edges cross, whether a vertex lies on an edge, and in which order what meets at one
point lies round it. A crossing is rounded half up, from its fraction and not from a float, and is the same
whole step wherever its two edges lie and whichever way they run.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.nets.cells import Cells, Column, Mask, Places
from batik_vector.geometry.outlines import Index, Outlines
from batik_vector.values import frozen

LONG = 1 << 20
"""Steps: the crossings of edges that are no longer fit into 64 bits."""

Vector = tuple[Column, Column]


@frozen(eq=False)
class Rings:
    """Rings of areas as edges.

    ``after`` and ``before`` are the neighbours of an edge in its ring, ``ring`` says of which it is;
    ``outlines`` holds its beginning.
    """

    outlines: Outlines
    places: Places
    ring: Index
    before: Index
    after: Index

    @classmethod
    def of(cls, outlines: Outlines) -> Rings:
        """Return the edges of areas; owners are numbered as they stand."""
        points, ends = outlines.points, outlines.rings
        after = np.arange(1, len(points) + 1)
        after[ends[1:] - 1] = ends[:-1]
        before = np.arange(-1, len(points) - 1)
        before[ends[:-1]] = ends[1:] - 1
        x, y = np.ascontiguousarray(points[:, 0]), np.ascontiguousarray(points[:, 1])
        owner = np.repeat(np.arange(len(outlines)), outlines.sizes())
        ring = np.repeat(np.arange(len(ends) - 1), np.diff(ends))
        return cls(outlines, Places(x, y, x[after] - x, y[after] - y, owner), ring, before, after)


class Events(NamedTuple):
    """Meetings, each told twice: as seen from either outline.

    An outline meets on its edge ``edge``, so far along it as ``part`` says (from 0 up to 1), at a point on
    the grid ``x``, ``y``, one of area ``other``. ``covered`` says whether it goes on inside that, or along it
    where the other one or neither bounds what both cover. ``tied`` says whether they have more in common than
    points."""

    edge: Index
    part: NDArray[np.float64]
    x: Column
    y: Column
    other: Index
    covered: Mask
    tied: Mask


@frozen(eq=False)
class Meetings:
    """Events, and all pairs of edges of two owners that lie near one another, shape (n,).

    ``crosses`` says which of them cross; ``cells`` holds all edges.
    """

    events: Events
    e: Index
    f: Index
    crosses: Mask
    cells: Cells


def meetings(rings: Rings, rank: Index) -> Meetings | None:
    """Return where outlines of different owners meet; None where they meet too often, or on edges too long.

    Args:
        rings: of valid areas, outer ones anticlockwise and holes clockwise.
        rank: a number for each owner. Where two run along one another the one with the lower number is drawn.
    """
    places = rings.places
    cells = Cells.of(places)
    if cells is None:
        return None
    found = cells.shared().pairs()
    if found is None:
        return None
    e, f = found
    ex, ey, fx, fy = places.dx[e], places.dy[e], places.dx[f], places.dy[f]
    gap_x, gap_y = places.x[f] - places.x[e], places.y[f] - places.y[e]
    turn = ex * fy - ey * fx
    from_e = ex * gap_y - ey * gap_x
    from_f = fy * gap_x - fx * gap_y
    to_e, to_f = from_e + turn, from_f - turn
    crosses = ((from_e < 0) != (to_e < 0)) & ((from_f < 0) != (to_f < 0))
    crosses &= (from_e != 0) & (to_e != 0) & (from_f != 0) & (to_f != 0)
    crossing = np.flatnonzero(crosses)
    touching = np.flatnonzero((from_e == 0) | (from_f == 0))
    both = np.concatenate([e[crossing], f[crossing]])
    if len(both) and max(int(np.abs(each[both]).max()) for each in (places.dx, places.dy)) >= LONG:
        return None
    crossed = _crossings(places, e[crossing], f[crossing], from_e[crossing], from_f[crossing], turn[crossing])
    parts = [crossed, *_touches(rings, e[touching], f[touching], rank)]
    events = Events(*map(np.concatenate, zip(*parts, strict=True)))
    return Meetings(events, e, f, crosses, cells)


def _crossings(places: Places, e: Index, f: Index, from_e: Column, from_f: Column, turn: Column) -> Events:
    """Return the events of edges that cross in the inside of both, given on which side of either the other
    begins."""
    # So far along e, and so far along f, in fractions of one denominator.
    below = np.abs(turn)
    along_e, along_f = np.abs(from_f), np.abs(from_e)
    x = places.x[e] + (2 * places.dx[e] * along_e + below) // (2 * below)
    y = places.y[e] + (2 * places.dy[e] * along_e + below) // (2 * below)
    return Events(
        np.concatenate([e, f]),
        np.concatenate([along_e / below, along_f / below]),
        np.concatenate([x, x]),
        np.concatenate([y, y]),
        np.concatenate([places.owner[f], places.owner[e]]),
        # An edge goes on inside when it began to the right of the other.
        np.concatenate([from_f < 0, from_e < 0]),
        np.ones(2 * len(e), bool),
    )


def _touches(rings: Rings, e: Index, f: Index, rank: Index) -> list[Events]:
    """Return the events at vertices that lie on edges: half open, so that each is found once."""
    places = rings.places
    e, f = np.concatenate([e, f]), np.concatenate([f, e])
    # The beginning of e lies on f: at its beginning (told of one of the two) or inside.
    gap = places.x[e] - places.x[f], places.y[e] - places.y[f]
    way = places.dx[f], places.dy[f]
    on = (cross(way, gap) == 0) & (dot(way, gap) >= 0)
    size, off = np.maximum(*map(np.abs, way)), np.maximum(*map(np.abs, gap))
    on &= off < size
    at_vertex = off == 0
    once = np.arange(len(e)) < len(e) // 2
    chosen = np.flatnonzero(on & (~at_vertex | once))
    e, f, inside = e[chosen], f[chosen], ~at_vertex[chosen]
    part = off[chosen] / size[chosen]
    zero = np.zeros(len(e))
    return [
        _touch(rings, e, f, zero, np.zeros(len(e), bool), inside, rank),
        _touch(rings, f, e, part, inside, np.zeros(len(e), bool), rank),
    ]


def _touch(
    rings: Rings, e: Index, f: Index, part: NDArray[np.float64], amid_e: Mask, amid_f: Mask, rank: Index
) -> Events:
    """Return the events of e as it meets f at a vertex of one of them or both."""
    places = rings.places
    at = np.where(amid_e, f, e)
    way = places.dx[e], places.dy[e]
    out = places.dx[f], places.dy[f]
    before = np.where(amid_f, f, rings.before[f])
    back = -places.dx[before], -places.dy[before]
    inside = between(way, out, back)
    along, against = same_way(way, out), same_way(way, back)
    own, other = places.owner[e], places.owner[f]
    covered = inside | against | (along & (rank[other] < rank[own]))
    return Events(e, part, places.x[at], places.y[at], other, covered, inside | along | against)


def cross(a: Vector, b: Vector) -> Column:
    """Return the cross product of vectors: positive where the second turns to the left."""
    return np.asarray(a[0] * b[1] - a[1] * b[0])


def dot(a: Vector, b: Vector) -> Column:
    """Return the dot product of vectors."""
    return np.asarray(a[0] * b[0] + a[1] * b[1])


def same_way(a: Vector, b: Vector) -> Mask:
    """Return which vectors run the same way."""
    return np.asarray((cross(a, b) == 0) & (dot(a, b) > 0), bool)


def between(way: Vector, first: Vector, last: Vector) -> Mask:
    """Return which ways lie strictly inside the angle that opens anticlockwise from the first to the last."""
    left_of_first, right_of_last = cross(first, way) > 0, cross(way, last) > 0
    opening = cross(first, last)
    outside = (cross(last, way) >= 0) & (cross(way, first) >= 0)
    reflex = np.where(opening < 0, ~outside, left_of_first)
    return np.asarray(np.where(opening > 0, left_of_first & right_of_last, reflex), bool)
