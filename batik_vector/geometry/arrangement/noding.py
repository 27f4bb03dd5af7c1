"""Noding: edges on whole steps, cut until they meet at their ends alone.

Crossings are found by exact arithmetic and rounded half up, so that what is the same a whole number of steps
away is cut alike. An edge on the rectangle's sides stays there, and no other is brought onto them: both sides
of a seam keep the nodes that they came with. A corner beside an edge that it was meant to lie on, off it by
the rounding of a crossing, is made a corner of that edge too, so that no hair is left between them.

Snap rounding: J. D. Hobby, Practical segment intersection with finite precision output, Computational
Geometry 13 (1999); here crossings are looked for again until there are none.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import Index, Steps
from batik_vector.geometry.sampling import Geometries
from batik_vector.values import frozen

Box: TypeAlias = tuple[int, int, int, int]
"""Left, bottom, right and top, in steps."""

NEAR = 0.75
"""Steps within which a corner lies on an edge: a rounded crossing is off its edges by no more than √½."""
HEALED = 8
"""Rounds in which such corners are taken for ones of the edge; after them, only those that lie on it."""
ASKED = 20_000
"""Edges that are asked at a time which others they may cross: there may be many pairs."""
ROUNDS = 60
"""Rounds until edges should cross no more; hardly any drawing needs more than five."""


@frozen(eq=False)
class Edges:
    """Edges, each once.

    ``ends`` has shape (n, 4), from the lower left end of each to its other end; ``turns`` has shape (n, k):
    by how much more often the outlines of each of k layers wind about what is left of it than what is right.
    """

    ends: Steps
    turns: NDArray[np.int32]

    def __len__(self) -> int:
        return len(self.ends)


def together(ends: Steps, turns: NDArray[np.int32], kept: NDArray[np.bool_] | None = None) -> Edges:
    """Return edges turned one way, those that coincide as one; what separates nothing is left out.

    Args:
        ends: shape (n, 4), in any direction.
        turns: shape (n, k), as seen along the direction given.
        kept: which stay although they separate nothing.
    """
    back = (ends[:, 0] > ends[:, 2]) | ((ends[:, 0] == ends[:, 2]) & (ends[:, 1] > ends[:, 3]))
    ends = np.where(back[:, None], ends[:, [2, 3, 0, 1]], ends)
    turns = np.where(back[:, None], -turns, turns)
    order = np.lexsort(ends.T[::-1])
    ends, turns = ends[order], turns[order]
    fresh = np.append(True, (ends[1:] != ends[:-1]).any(axis=1)) if len(ends) else np.empty(0, bool)
    first = np.flatnonzero(fresh)
    if not len(first):
        return Edges(ends, turns)
    summed = np.add.reduceat(turns, first, axis=0)
    stays = (summed != 0).any(axis=1)
    if kept is not None:
        stays |= np.logical_or.reduceat(kept[order], first)
    stays &= (ends[first, :2] != ends[first, 2:]).any(axis=1)
    return Edges(ends[first[stays]], summed[stays].astype(np.int32))


def noded(edges: Edges, box: Box) -> Edges:
    """Return edges that meet at their ends alone, those of the box among them.

    Args:
        edges: anywhere.
        box: whose sides are edges too, and are crossed nowhere but at ends.

    Raises:
        GeometryError: where they go on to cross.
    """
    edges = _split_at_sides(edges, box)
    for number in range(ROUNDS):
        near = NEAR if number < HEALED else 0.0
        on, points = _splits(edges, box, near)
        if not len(on):
            return edges
        edges = _split(edges, on, points, box)
    raise GeometryError("its edges cross ever anew where they are rounded to the grid")


def _on_side(ends: Steps, box: Box) -> NDArray[np.bool_]:
    """Return which edges lie along the line of one of the box's sides."""
    along = np.zeros(len(ends), bool)
    for axis, value in _sides(box):
        along |= (ends[:, axis] == value) & (ends[:, axis + 2] == value)
    return along


def _sides(box: Box) -> tuple[tuple[int, int], ...]:
    left, bottom, right, top = box
    return (0, left), (0, right), (1, bottom), (1, top)


def _split_at_sides(edges: Edges, box: Box) -> Edges:
    """Cut edges where they cross the lines of the box's sides, and add the sides, cut there too."""
    left, bottom, right, top = box
    corners = np.array([[left, bottom], [right, bottom], [right, top], [left, top]], np.int64)
    for axis, value in _sides(box):
        low, high = edges.ends[:, axis], edges.ends[:, axis + 2]
        at = np.flatnonzero(((low < value) & (high > value)) | ((low > value) & (high < value)))
        found = edges.ends[at]
        back = found[:, axis] > found[:, axis + 2]
        found[back] = found[back][:, [2, 3, 0, 1]]
        run = found[:, axis + 2] - found[:, axis]
        rise = (found[:, 3 - axis] - found[:, 1 - axis]) * (value - found[:, axis])
        points = np.empty((len(at), 2), np.int64)
        points[:, axis] = value
        points[:, 1 - axis] = found[:, 1 - axis] + (2 * rise + run) // (2 * run)
        edges = _split(edges, at, points, box)
    nodes = np.concatenate([edges.ends[:, :2], edges.ends[:, 2:], corners])
    sides = [edges.ends]
    for axis, value in _sides(box):
        along = nodes[nodes[:, axis] == value, 1 - axis]
        along = np.unique(along[(along >= box[1 - axis]) & (along <= box[3 - axis])])
        side = np.empty((len(along) - 1, 4), np.int64)
        side[:, axis] = side[:, axis + 2] = value
        side[:, 1 - axis], side[:, 3 - axis] = along[:-1], along[1:]
        sides.append(side)
    ends = np.concatenate(sides)
    turns = np.zeros((len(ends), edges.turns.shape[1]), np.int32)
    turns[: len(edges)] = edges.turns
    return together(ends, turns, np.arange(len(ends)) >= len(edges))


def _splits(edges: Edges, box: Box, near: float) -> tuple[Index, Steps]:
    """Return which edges are to be cut and where: at corners on them, and where they cross."""
    lines = np.asarray(shapely.linestrings(edges.ends.reshape(-1, 2, 2).astype(float)), dtype=object)
    tree = shapely.STRtree(lines)
    on, points = _corners(edges, tree, box, near)
    inner = _inner(edges, on, points)
    on, points = on[inner], points[inner]
    # What is to be drawn to a corner first may cross no more; cut at both at once, edges that leave one line
    # side by side cross ever anew, a step further on.
    whole = np.ones(len(edges), bool)
    whole[on] = False
    one, other = _crossing_pairs(edges, lines, tree, np.flatnonzero(whole))
    if len(one):
        places = _crossings(edges.ends[one], edges.ends[other], box)
        on, points = np.concatenate([on, one, other]), np.concatenate([points, places, places])
    inner = _inner(edges, on, points)
    return on[inner], points[inner]


def _inner(edges: Edges, on: Index, points: Steps) -> NDArray[np.bool_]:
    """Tell which points are no end of the edge that they are on."""
    ends = edges.ends[on]
    return np.asarray((points != ends[:, :2]).any(axis=1) & (points != ends[:, 2:]).any(axis=1))


def _corners(edges: Edges, tree: shapely.STRtree, box: Box, near: float) -> tuple[Index, Steps]:
    """Return which edges have corners of others on them, and which."""
    corners = _once(edges.ends.reshape(-1, 2))
    reach = near + 0.01
    low, high = (corners - reach).T, (corners + reach).T
    at, on = tree.query(np.asarray(shapely.box(*low, *high), dtype=object))
    points, ends = corners[at], edges.ends[on]
    way, to = ends[:, 2:] - ends[:, :2], points - ends[:, :2]
    along = (way * to).sum(axis=1)
    length = (way * way).sum(axis=1)
    across = np.abs(way[:, 0] * to[:, 1] - way[:, 1] * to[:, 0])
    meets = (along > 0) & (along < length) & (across <= near * np.sqrt(length.astype(float)))
    # What lies on the rectangle's sides is a corner of the sides alone, and these have no others.
    inside = np.ones(len(points), bool)
    for axis, value in _sides(box):
        inside &= points[:, axis] != value
    meets &= np.where(_on_side(ends, box), across == 0, inside)
    return on[meets], points[meets]


def _once(points: Steps) -> Steps:
    """Return points in order, each once."""
    order = np.lexsort([points[:, 1], points[:, 0]])
    points = points[order]
    return points[np.append(True, (points[1:] != points[:-1]).any(axis=1))] if len(points) else points


def _crossing_pairs(
    edges: Edges, lines: Geometries, tree: shapely.STRtree, asked: Index
) -> tuple[Index, Index]:
    """Return which of some edges cross which others of them, each pair once.

    Those whose bounds meet are compared by numbers: to ask GEOS of each pair is many times dearer.
    """
    free = np.zeros(len(edges), bool)
    free[asked] = True
    found = [(asked[:0], asked[:0])]
    for first in range(0, len(asked), ASKED):
        some = asked[first : first + ASKED]
        one, other = tree.query(lines[some])
        one = some[one]
        new = (one < other) & free[other]
        one, other = one[new], other[new]
        crossing = _crossing(edges.ends[one], edges.ends[other])
        found.append((one[crossing], other[crossing]))
    return np.concatenate([one for one, _ in found]), np.concatenate([other for _, other in found])


def _crossing(one: Steps, other: Steps) -> NDArray[np.bool_]:
    """Return which pairs of edges cross within both."""
    p, r = one[:, :2], one[:, 2:] - one[:, :2]
    q, s = other[:, :2], other[:, 2:] - other[:, :2]

    def side(of: Steps, way: Steps, point: Steps) -> NDArray[np.int64]:
        turn: NDArray[np.int64] = way[:, 0] * (point - of)[:, 1] - way[:, 1] * (point - of)[:, 0]
        return np.sign(turn)

    apart = side(p, r, q) * side(p, r, other[:, 2:]) < 0
    return np.asarray(apart & (side(q, s, p) * side(q, s, one[:, 2:]) < 0))


def _crossings(one: Steps, other: Steps, box: Box) -> Steps:
    """Return where pairs of edges cross, rounded half up, as far inside the box or outside as the edges."""
    # Products of three lengths are larger than 64 bits hold.
    a, b = one.astype(object), other.astype(object)
    r, s = a[:, 2:] - a[:, :2], b[:, 2:] - b[:, :2]
    apart = b[:, :2] - a[:, :2]
    below = r[:, 0] * s[:, 1] - r[:, 1] * s[:, 0]
    part = apart[:, 0] * s[:, 1] - apart[:, 1] * s[:, 0]
    part, below = np.where(below < 0, -part, part), np.where(below < 0, -below, below)
    places = a[:, :2] + (2 * r * part[:, None] + below[:, None]) // (2 * below[:, None])
    points: Steps = places.astype(np.int64)
    for axis, value in _sides(box):
        low = np.minimum(one[:, axis], one[:, axis + 2])
        onto = points[:, axis] == value
        points[onto, axis] = np.where(low >= value, value + 1, value - 1)[onto]
    return points


def _split(edges: Edges, on: Index, points: Steps, box: Box) -> Edges:
    """Return edges cut at points, each of them at any number."""
    if not len(on):
        return edges
    way = edges.ends[on, 2:] - edges.ends[on, :2]
    along = ((points - edges.ends[on, :2]) * way).sum(axis=1)
    order = np.lexsort([points[:, 1], points[:, 0], along, on])
    on, points = on[order], points[order]
    cut, counts = np.unique(on, return_counts=True)
    whole = np.ones(len(edges), bool)
    whole[cut] = False
    stops = np.cumsum(counts + 1)
    begin, end = np.empty((int(stops[-1]), 2), np.int64), np.empty((int(stops[-1]), 2), np.int64)
    firsts, lasts = stops - counts - 1, stops - 1
    begin[firsts], end[lasts] = edges.ends[cut, :2], edges.ends[cut, 2:]
    rest = np.ones(len(begin), bool)
    rest[firsts] = False
    begin[rest] = points
    rest = np.ones(len(end), bool)
    rest[lasts] = False
    end[rest] = points
    ends = np.concatenate([edges.ends[whole], np.hstack([begin, end])])
    turns = np.concatenate([edges.turns[whole], np.repeat(edges.turns[cut], counts + 1, axis=0)])
    return together(ends, turns, _on_side(ends, box) & _within(ends, box))


def _within(ends: Steps, box: Box) -> NDArray[np.bool_]:
    left, bottom, right, top = box
    low, high = np.minimum(ends[:, :2], ends[:, 2:]), np.maximum(ends[:, :2], ends[:, 2:])
    inside = (low >= (left, bottom)).all(axis=1) & (high <= (right, top)).all(axis=1)
    return np.asarray(inside)


def edges_of(layers: list[Geometries]) -> Edges:
    """Return the edges of layers of polygons in steps, outer rings anticlockwise and holes clockwise."""
    found, owners = list[Steps](), list[NDArray[np.int32]]()
    for number, areas in enumerate(layers):
        rings = shapely.get_rings(areas)
        coords, ring = shapely.get_coordinates(rings, return_index=True)
        points = np.rint(coords).astype(np.int64)
        same = ring[1:] == ring[:-1]
        ends = np.hstack([points[:-1][same], points[1:][same]])
        turns = np.zeros((len(ends), len(layers)), np.int32)
        turns[:, number] = 1
        found.append(ends)
        owners.append(turns)
    none = np.empty((0, len(layers)), np.int32)
    return together(np.concatenate([np.empty((0, 4), np.int64), *found]), np.concatenate([none, *owners]))
