"""Noding: edges on whole steps, cut until they meet at their ends alone.

Crossings are found by exact arithmetic and rounded half up, so that what is the same a whole number of steps
away is cut alike. An edge on the rectangle's sides stays there, and no other is brought onto them: both sides
of a seam keep the nodes that they came with. A corner beside an edge that it was meant to lie on, off it by
the rounding of a crossing, is made a corner of that edge too, so that no hair is left between them.

Snap rounding: J. D. Hobby, Practical segment intersection with finite precision output, Computational
Geometry 13 (1999); here crossings are looked for again until there are none, of edges that were cut alone.
"""

from __future__ import annotations

from typing import Any, TypeAlias

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
SHORT = 1 << 19
"""Steps within which ends of crossing edges lie if 64 bits hold all that is made of them."""
ROUNDS = 60
"""Rounds until edges should cross no more; hardly any drawing needs more than five."""


@frozen(eq=False)
class Edges:
    """Edges, each once.

    ``ends`` has shape (n, 4), from the lower left end of each to its other end; ``turns`` has shape (n, k):
    by how much more often the outlines of each of k layers wind about what is left of it than what is right.
    ``fresh`` are those that came into being when edges were cut last.
    """

    ends: Steps
    turns: NDArray[np.int32]
    fresh: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.ends)

    def taken(self, which: NDArray[np.bool_]) -> Edges:
        """Return some of them."""
        return Edges(self.ends[which], self.turns[which], self.fresh[which])


def together(
    ends: Steps,
    turns: NDArray[np.int32],
    kept: NDArray[np.bool_] | None = None,
    fresh: NDArray[np.bool_] | None = None,
) -> Edges:
    """Return edges turned one way, those that coincide as one; what separates nothing is left out.

    Args:
        ends: shape (n, 4), in any direction.
        turns: shape (n, k), as seen along the direction given.
        kept: which stay although they separate nothing.
        fresh: which are so; all unless told.
    """
    back = (ends[:, 0] > ends[:, 2]) | ((ends[:, 0] == ends[:, 2]) & (ends[:, 1] > ends[:, 3]))
    ends = np.where(back[:, None], ends[:, [2, 3, 0, 1]], ends)
    turns = np.where(back[:, None], -turns, turns)
    order = np.lexsort([in_one(ends[:, 2:]), in_one(ends[:, :2])])
    ends, turns = ends[order], turns[order]
    new = np.append(True, (ends[1:] != ends[:-1]).any(axis=1)) if len(ends) else np.empty(0, bool)
    first = np.flatnonzero(new)
    if not len(first):
        return Edges(ends, turns, np.empty(0, bool))
    summed = np.add.reduceat(turns, first, axis=0)
    stays = (summed != 0).any(axis=1)
    if kept is not None:
        stays |= np.logical_or.reduceat(kept[order], first)
    stays &= (ends[first, :2] != ends[first, 2:]).any(axis=1)
    newly = np.ones(len(first), bool) if fresh is None else np.logical_or.reduceat(fresh[order], first)
    return Edges(ends[first[stays]], summed[stays].astype(np.int32), newly[stays])


def in_one(points: Steps) -> NDArray[np.int64]:
    """Return places, none past 2^31 steps, as numbers in the order of x, then y: sorted in half the time."""
    return np.asarray((points[:, 0] << 32) + points[:, 1], np.int64)


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
    over = np.zeros(len(edges), bool)
    for axis, value in _sides(box):
        low, high = edges.ends[:, axis], edges.ends[:, axis + 2]
        over |= ((low < value) & (high > value)) | ((low > value) & (high < value))
    # Few edges reach over a side: the others are not sorted anew for each.
    rest, edges = edges.taken(~over), edges.taken(over)
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
    edges = Edges(
        np.concatenate([rest.ends, edges.ends]),
        np.concatenate([rest.turns, edges.turns]),
        np.concatenate([rest.fresh, edges.fresh]),
    )
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
    """Return which edges are to be cut and where: at corners on them, and where they cross.

    Only pairs of which one is fresh are looked at: of any other pair all has been found in a round before.
    """
    reach = (near + 0.01) / 2
    ends = edges.ends.astype(float)
    low, high = np.minimum(ends[:, :2], ends[:, 2:]), np.maximum(ends[:, :2], ends[:, 2:])
    # What is as large as an edge and its surroundings; to compare numbers is many times cheaper than to ask
    # GEOS of each pair.
    around = np.asarray(shapely.linestrings(np.stack([low - reach, high + reach], axis=1)), dtype=object)
    tree = shapely.STRtree(around)
    asked = np.flatnonzero(edges.fresh)
    met, crossing = [_nothing()], [_nothing()]
    for first in range(0, len(asked), ASKED):
        some = asked[first : first + ASKED]
        one, other = tree.query(around[some])
        one = some[one]
        once = (one < other) | ~edges.fresh[other]
        one, other = one[once], other[once]
        on, points, crosses = _compared(edges.ends[one], edges.ends[other], one, other, near)
        met.append((on, points))
        crossing.append((one[crosses], np.stack([one[crosses], other[crosses]], axis=1)))
    on, points = (np.concatenate(each) for each in zip(*met, strict=True))
    there = _may_be_corner(edges, on, points, box)
    on, points = on[there], points[there]
    # What is to be drawn to a corner first may cross no more; cut at both at once, edges that leave one line
    # side by side cross ever anew, a step further on.
    whole = np.ones(len(edges), bool)
    whole[on] = False
    pairs = np.concatenate([pair for _, pair in crossing])
    one, other = pairs[whole[pairs].all(axis=1)].T
    if len(one):
        places = _crossings(edges.ends[one], edges.ends[other], box)
        on, points = np.concatenate([on, one, other]), np.concatenate([points, places, places])
        inner = _inner(edges, on, points)
        on, points = on[inner], points[inner]
    return on, points


def _nothing() -> tuple[Index, Steps]:
    return np.empty(0, np.intp), np.empty((0, 2), np.int64)


def _compared(
    a: Steps, b: Steps, one: Index, other: Index, near: float
) -> tuple[Index, Steps, NDArray[np.bool_]]:
    """Compare pairs of edges.

    Returns:
        which edges have an end of the other on them, or as near as asked, and where that is; and of each pair
        whether they cross within both.
    """
    found, sides = [_nothing()], list[NDArray[np.int64]]()
    for on, line, points in ((one, a, b), (other, b, a)):
        x, y = line[:, 0], line[:, 1]
        right, up = line[:, 2] - x, line[:, 3] - y
        squares = right * right + up * up
        far = near * np.sqrt(squares.astype(float))
        for end in (0, 2):
            across, along = points[:, end] - x, points[:, end + 1] - y
            turn = right * along - up * across
            sides.append(np.sign(turn))
            at = np.flatnonzero(np.abs(turn) <= far)
            way = right[at] * across[at] + up[at] * along[at]
            at = at[(way > 0) & (way < squares[at])]
            found.append((on[at], points[at, end : end + 2]))
    crosses = (sides[0] * sides[1] < 0) & (sides[2] * sides[3] < 0)
    on, places = (np.concatenate(each) for each in zip(*found, strict=True))
    return on, places, crosses


def _may_be_corner(edges: Edges, on: Index, points: Steps, box: Box) -> NDArray[np.bool_]:
    """Tell which points on edges, or beside them, may be made corners of these.

    What lies on the rectangle's sides is a corner of the sides alone, and these have no others.
    """
    ends = edges.ends[on]
    inside = np.ones(len(points), bool)
    for axis, value in _sides(box):
        inside &= points[:, axis] != value
    way, to = ends[:, 2:] - ends[:, :2], points - ends[:, :2]
    exact = way[:, 0] * to[:, 1] == way[:, 1] * to[:, 0]
    return np.where(_on_side(ends, box), exact, inside) & _inner(edges, on, points)


def _inner(edges: Edges, on: Index, points: Steps) -> NDArray[np.bool_]:
    """Tell which points are no end of the edge that they are on."""
    ends = edges.ends[on]
    return np.asarray((points != ends[:, :2]).any(axis=1) & (points != ends[:, 2:]).any(axis=1))


def _crossings(one: Steps, other: Steps, box: Box) -> Steps:
    """Return where pairs of edges cross, rounded half up, as far inside the box or outside as the edges."""
    points = np.empty((len(one), 2), np.int64)
    # Products of three lengths may be larger than 64 bits hold, and whole numbers without end are slow.
    long = np.abs(np.concatenate([one, other], axis=1) - one[:, [0, 1] * 4]).max(axis=1) >= SHORT
    points[~long] = _rounded(one[~long], other[~long])
    points[long] = _rounded(one[long].astype(object), other[long].astype(object))
    for axis, value in _sides(box):
        low = np.minimum(one[:, axis], one[:, axis + 2])
        onto = points[:, axis] == value
        points[onto, axis] = np.where(low >= value, value + 1, value - 1)[onto]
    return points


def _rounded(a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
    """Return where pairs of edges cross, rounded half up."""
    r, s = a[:, 2:] - a[:, :2], b[:, 2:] - b[:, :2]
    apart = b[:, :2] - a[:, :2]
    below = r[:, 0] * s[:, 1] - r[:, 1] * s[:, 0]
    part = apart[:, 0] * s[:, 1] - apart[:, 1] * s[:, 0]
    part, below = np.where(below < 0, -part, part), np.where(below < 0, -below, below)
    return np.asarray(a[:, :2] + (2 * r * part[:, None] + below[:, None]) // (2 * below[:, None]))


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
    fresh = np.arange(len(ends)) >= int(whole.sum())
    return together(ends, turns, _on_side(ends, box) & _within(ends, box), fresh)


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
