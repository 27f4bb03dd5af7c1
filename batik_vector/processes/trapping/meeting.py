"""Where inks meet: the stretches of outlines that have one ink on one side and another on the other.

Edges are whole steps and have their ink to the left, so that two inks meet where the edge of one runs back
along an edge of the other. On a tile the far edges of the page are taken for the near ones, with which they
are one on the endless cloth; where an ink only goes on across them, its two edges cancel out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell
from batik_vector.geometry.outlines import Index, Outlines, Steps
from batik_vector.geometry.sampling import Geometries
from batik_vector.values import frozen

NEAR = 1.5
"""Steps from an edge within which a corner of a neighbour lies on it: both were rounded, by √½ at most."""


@frozen(eq=False)
class Edges:
    """Edges in the order of their rings, each with its ink to the left.

    ``ends`` has shape (n, 4); ``layer`` and ``ring`` have the numbers of the ink and of the ring.
    """

    ends: Steps
    layer: Index
    ring: Index

    def taken(self, which: Index | NDArray[np.bool_]) -> Edges:
        """Return some of them."""
        return Edges(self.ends[which], self.layer[which], self.ring[which])


@frozen(eq=False)
class Meetings:
    """Stretches at which two inks meet, as polylines in steps with ink ``left`` to the left of them."""

    lines: Geometries
    left: Index
    right: Index


def meetings(layers: Sequence[Outlines], cell: Cell | None = None) -> Meetings:
    """Return where inks meet.

    Args:
        layers: the areas of each ink, outer rings anticlockwise and holes clockwise.
        cell: of a tile, which meets its own repeats; a page that does not repeat has none.

    Returns:
        Each stretch twice, once along the outline of either ink.
    """
    edges = _edges(layers)
    if cell is not None:
        edges = _folded(edges, cell)
    return _runs(*_matched(_noded(edges)))


def with_corners(layers: Sequence[Outlines]) -> list[Outlines]:
    """Return areas with a corner wherever another's lies on their outlines: then both share edges."""
    edges = _edges(layers)
    more = _noded(edges)
    if len(more.ends) == len(edges.ends):
        return list(layers)
    found, ring = [], 0
    for number, outlines in enumerate(layers):
        mine = more.layer == number
        sizes = np.bincount(more.ring[mine] - ring, minlength=len(outlines.closed))
        rings = np.concatenate([[0], np.cumsum(sizes)])
        found.append(replace(outlines, points=more.ends[mine, :2], rings=rings))
        ring += len(outlines.closed)
    return found


def joined_pieces(areas: Outlines, cell: Cell) -> tuple[Index, Index]:
    """Return which areas of an ink go on across the seam as which others, each pair both ways."""
    edges = _noded(_folded(_edges([areas]), cell))
    twins = _twins(edges.ends)
    area = np.repeat(np.arange(len(areas)), np.diff(areas.marks))[edges.ring[twins.order]]
    same = np.flatnonzero(np.diff(twins.group) == 0)
    one, other = area[same], area[same + 1]
    return np.concatenate([one, other]), np.concatenate([other, one])


def _edges(layers: Sequence[Outlines]) -> Edges:
    ends, layer, ring, count = [np.empty((0, 4), np.int64)], list[Index](), list[Index](), 0
    for number, outlines in enumerate(layers):
        points, rings = outlines.repeating()
        begin = np.delete(np.arange(len(points)), rings[1:] - 1)
        ends.append(np.hstack([points[begin], points[begin + 1]]))
        sizes = np.diff(outlines.rings)
        layer.append(np.full(len(begin), number, np.intp))
        ring.append(np.repeat(np.arange(count, count + len(sizes)), sizes))
        count += len(sizes)
    none = np.empty(0, np.intp)
    return Edges(np.concatenate(ends), np.concatenate([none, *layer]), np.concatenate([none, *ring]))


def _folded(edges: Edges, cell: Cell) -> Edges:
    """Return edges with those along the far sides of a cell moved to the near ones, with which they are one.

    With a drop an edge may come to lie across a corner: it is there twice then, once on either side of it.
    """
    for axis, far, (right, up) in ((0, cell.columns, cell.lattice[0]), (1, cell.rows, cell.lattice[1])):
        on = (edges.ends[:, axis] == far) & (edges.ends[:, axis + 2] == far)
        if not on.any():
            continue
        long = cell.rows if axis == 0 else cell.columns
        moved = edges.ends[on] - np.array([right, up, right, up])
        low = np.minimum(moved[:, 1 - axis], moved[:, 3 - axis])
        high = np.maximum(moved[:, 1 - axis], moved[:, 3 - axis])
        found, whose = [edges.ends[~on]], [np.flatnonzero(~on)]
        for turn in (0, 1):
            shift = np.zeros(4, np.int64)
            shift[[1 - axis, 3 - axis]] = turn * long
            inside = (high + turn * long > 0) & (low + turn * long < long)
            found.append(moved[inside] + shift)
            whose.append(np.flatnonzero(on)[inside])
        order = np.argsort(own := np.concatenate(whose), kind="stable")
        edges = Edges(np.concatenate(found)[order], edges.layer[own[order]], edges.ring[own[order]])
    return edges


@frozen(eq=False)
class _Twins:
    """Edges sorted so that those between the same two corners stand together, whichever way they run.

    ``order`` has their numbers, ``group`` which place each of them in this order is at, ``forth`` whether it
    runs from the lower left end.
    """

    order: Index
    group: Index
    forth: NDArray[np.bool_]

    def sizes(self) -> Index:
        """Return how many edges each place has."""
        return np.bincount(self.group)


def _twins(ends: Steps) -> _Twins:
    low = ends.reshape(-1, 2).min(axis=0, initial=0)
    span = int(ends[:, 1::2].max(initial=0) - low[1]) + 1
    one = (ends[:, 0] - low[0]) * span + ends[:, 1] - low[1]
    two = (ends[:, 2] - low[0]) * span + ends[:, 3] - low[1]
    first, second = np.minimum(one, two), np.maximum(one, two)
    order = np.lexsort([second, first])
    first, second = first[order], second[order]
    fresh = np.zeros(len(order), np.intp)
    fresh[1:] = (first[1:] != first[:-1]) | (second[1:] != second[:-1])
    return _Twins(order, np.cumsum(fresh), (one < two)[order])


def _noded(edges: Edges) -> Edges:
    """Return edges that have a corner wherever one of another ink lies on them."""
    twins = _twins(edges.ends)
    open_ = np.sort(twins.order[(twins.sizes() == 1)[twins.group]])
    if not len(open_):
        return edges
    ends = edges.ends[open_]
    corners, which = np.unique(np.vstack([ends[:, :2], ends[:, 2:]]), axis=0, return_inverse=True)
    lines = shapely.linestrings(ends.reshape(-1, 2, 2).astype(float))
    at, on = shapely.STRtree(lines).query(
        shapely.points(corners.astype(float)), predicate="dwithin", distance=NEAR
    )
    first, last = which.ravel()[: len(open_)], which.ravel()[len(open_) :]
    inner = (at != first[on]) & (at != last[on])
    at, on = at[inner], on[inner]
    way, to = ends[on, 2:] - ends[on, :2], corners[at] - ends[on, :2]
    along = (way * to).sum(axis=1)
    inner = (along > 0) & (along < (way * way).sum(axis=1))
    at, on, along = at[inner], on[inner], along[inner]
    if not len(at):
        return edges
    order = np.lexsort([along, on])
    into, points = open_[on[order]], corners[at[order]]
    # An edge ends at the first corner on it, and another goes on from each.
    begin = np.insert(edges.ends[:, :2], into + 1, points, axis=0)
    end = np.insert(edges.ends[:, 2:], into, points, axis=0)
    source = np.insert(np.arange(len(edges.ends)), into, into)
    return Edges(np.hstack([begin, end]), edges.layer[source], edges.ring[source])


def _matched(edges: Edges) -> tuple[Edges, Index]:
    """Return the edges along which an edge of another ink runs back, and whose that is."""
    if not len(edges.ends):
        return edges, np.empty(0, np.intp)
    twins = _twins(edges.ends)
    starts = np.append(np.flatnonzero(np.diff(twins.group, prepend=-1)), len(twins.group))
    sizes = np.diff(starts)
    layer = edges.layer[twins.order]
    two = starts[:-1][sizes == 2]
    # Where an ink goes on across an edge, as at the seam, it ends at nothing.
    two = two[(twins.forth[two] != twins.forth[two + 1]) & (layer[two] != layer[two + 1])]
    at, right = [np.concatenate([two, two + 1])], [np.concatenate([layer[two + 1], layer[two]])]
    for group in np.flatnonzero(sizes > 2).tolist():
        mine = np.arange(starts[group], starts[group + 1])
        ends = [k for k in mine if not (layer[mine[twins.forth[mine] != twins.forth[k]]] == layer[k]).any()]
        met = [(k, layer[j]) for k in ends for j in ends if twins.forth[j] != twins.forth[k]]
        at.append(np.array([k for k, _ in met], np.intp))
        right.append(np.array([other for _, other in met], np.intp))
    found, other = twins.order[np.concatenate(at)], np.concatenate(right)
    order = np.lexsort([found, other, edges.layer[found]])
    return edges.taken(found[order]), other[order]


def _runs(edges: Edges, right: Index) -> Meetings:
    """Return edges that follow one another as polylines."""
    if not len(right):
        return Meetings(np.empty(0, dtype=object), right, right)
    ends = edges.ends
    fresh = np.ones(len(ends), bool)
    fresh[1:] = (
        (ends[1:, :2] != ends[:-1, 2:]).any(axis=1)
        | (edges.layer[1:] != edges.layer[:-1])
        | (right[1:] != right[:-1])
        | (edges.ring[1:] != edges.ring[:-1])
    )
    first = np.flatnonzero(fresh)
    points = np.insert(ends[:, 2:], first, ends[first, :2], axis=0)
    stops = np.append(first, len(ends))[1:] + np.arange(1, len(first) + 1)
    made = shapely.from_ragged_array(
        shapely.GeometryType.LINESTRING, points.astype(float), (np.concatenate([[0], stops]),)
    )
    return Meetings(np.asarray(made, dtype=object), edges.layer[first], right[first])
