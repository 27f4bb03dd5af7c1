"""Chains of boundary joined to rings: at each node the right next one, then all at once by pointer doubling.

See :mod:`batik_vector.tiling.cloth.chains`. Everything is whole numbers but the angles by which chains at one
node are put in order: of chains of one drawing these are far enough apart for floats.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import SeamError
from batik_vector.geometry.nets.components import components
from batik_vector.geometry.outlines import Index, Offsets, Outlines, Steps, runs
from batik_vector.tiling.cloth.chains import NO_SEAM, Contact, Copies, cancelled, numbered
from batik_vector.values import frozen


@frozen
class Rings:
    """Rings made of copies of chains, polygon by polygon, outer rings before their holes.

    Ring i is made of the copies ``rows[offsets[i]:offsets[i + 1]]``, and polygon j of the rings
    ``marks[j]`` to ``marks[j + 1]``; ``owner[j]`` is the least copy of a mark in it. ``straight`` tells for
    each row whether its first point lies between its neighbours on a straight line, and is not needed.
    """

    copies: Copies
    rows: Index
    straight: NDArray[np.bool_]
    offsets: Offsets
    marks: Offsets
    owner: Index

    def sizes(self) -> Offsets:
        """Return how many points each ring has."""
        chains = self.copies.chains
        counts = np.diff(chains.offsets)[self.copies.which[self.rows]] - 1 - self.straight
        return np.diff(np.concatenate([[0], np.cumsum(counts)])[self.offsets])

    def outlines(self, first: int, stop: int) -> tuple[Steps, Offsets]:
        """Return the points of some rings, and where each ring begins."""
        some = slice(self.offsets[first], self.offsets[stop])
        rows, straight = self.rows[some], self.straight[some]
        chains = self.copies.chains
        members, ends = runs(chains.offsets, self.copies.which[rows])
        keep = np.ones(len(members), bool)
        # A chain's last point is the next one's first.
        keep[ends[1:] - 1] = False
        keep[ends[:-1][straight]] = False
        shift = np.repeat(self.copies.shift[rows], np.diff(ends), axis=0)
        points = chains.points[members[keep]] + shift[keep]
        kept = np.concatenate([[0], np.cumsum(np.diff(ends) - 1 - straight)])
        return points, kept[self.offsets[first : stop + 1] - self.offsets[first]]


def rings_of(copies: Copies, group: Index | None = None, body: Index | None = None) -> Rings:
    """Weld areas across the seams on which their edges lie.

    Args:
        copies: the chains of all their boundaries.
        group: shape (n,), a number for each copy: areas of one group are welded. None welds them all.
        body: shape (owners,), which copies of marks are one polygon; found from what touches when left out.

    Raises:
        SeamError: where the boundaries do not close.
    """
    contact = cancelled(copies, group)
    if body is None:
        pairs = np.column_stack([copies.owner[contact.upper], copies.owner[contact.lower]])
        body = components(int(copies.owner.max()) + 1 if len(copies.owner) else 0, pairs)
    border, border_group = _border(copies, contact, group)
    follower, plain = _followers(border, border_group)
    before = np.empty(len(follower), np.intp)
    before[follower] = np.arange(len(follower))
    chains = border.chains
    out = chains.points[chains.offsets[:-1] + 1] - chains.start
    into = chains.end - chains.points[chains.offsets[1:] - 2]
    last, first = into[border.which[before]], out[border.which]
    straight = plain & (before != np.arange(len(before))) & aligned(last, first)
    label, rank = cycles(follower)
    return _sorted(border, straight, label, rank, body)


def aligned(a: Steps, b: Steps) -> NDArray[np.bool_]:
    """Return where two steps have one direction."""
    return np.asarray((a[:, 0] * b[:, 1] == a[:, 1] * b[:, 0]) & ((a * b).sum(axis=1) > 0))


def _border(copies: Copies, contact: Contact, group: Index | None) -> tuple[Copies, Index | None]:
    """Return the copies that are left as boundary: chains, and stretches of seams without twin."""
    rows = np.flatnonzero(copies.chains.axis[copies.which] == NO_SEAM)
    left = contact.left
    chains = copies.chains.and_edges(contact.start, contact.end, copies.chains.mark[copies.which[left]])
    border = Copies(
        chains,
        np.concatenate([copies.which[rows], len(copies.chains) + np.arange(len(left))]),
        np.concatenate([copies.shift[rows], np.zeros((len(left), 2), np.int64)]),
        np.concatenate([copies.owner[rows], copies.owner[left]]),
    )
    return border, None if group is None else np.concatenate([group[rows], group[left]])


def _followers(copies: Copies, group: Index | None) -> tuple[Index, NDArray[np.bool_]]:
    """Return which chain follows each, and which begin at a node that no other boundary passes.

    At a node with several boundaries, what comes in goes out along the same stretch of inside: areas that
    touch in a point stay apart. Where one ring then passes a node more than once, it is parted there into
    rings that touch: a hole and the outline, or two holes.
    """
    count = len(copies.which)
    start, end = copies.points(copies.chains.start), copies.points(copies.chains.end)
    both = np.concatenate([start, end])
    columns = (both[:, 0], both[:, 1]) if group is None else (np.tile(group, 2), both[:, 0], both[:, 1])
    node = numbered(*columns)
    begins, stops = node[:count], node[count:]
    leaving, coming = np.argsort(begins, kind="stable"), np.argsort(stops, kind="stable")
    if not np.array_equal(begins[leaving], stops[coming]):
        raise SeamError("the edges of the areas do not close: expected areas in normal form")
    follower = np.empty(count, np.intp)
    follower[coming] = leaving
    plain = np.bincount(begins, minlength=int(node.max()) + 1 if count else 0)[begins] == 1
    if plain.all():
        return follower, plain
    rays = _Rays(copies, begins, stops)
    before = rays.neighbour(-1, rays.node)
    follower[rays.row[rays.coming]] = rays.row[before][rays.coming]
    label, _ = cycles(follower)
    after = rays.neighbour(1, numbered(rays.node, label[rays.row]))
    follower[rays.row[rays.coming]] = rays.row[after][rays.coming]
    return follower, plain


class _Rays:
    """The chains at nodes with several, anticlockwise round each node.

    ``row`` is the copy; ``coming`` tells whether it comes in (or else leaves).
    """

    def __init__(self, copies: Copies, begins: Index, stops: Index) -> None:
        degree = np.bincount(begins)
        leaving, coming = np.flatnonzero(degree[begins] > 1), np.flatnonzero(degree[stops] > 1)
        chains = copies.chains
        out = chains.points[chains.offsets[:-1] + 1] - chains.start
        back = chains.points[chains.offsets[1:] - 2] - chains.end
        way = np.concatenate([back[copies.which[coming]], out[copies.which[leaving]]])
        row = np.concatenate([coming, leaving])
        comes = np.arange(len(row)) < len(coming)
        node = np.concatenate([stops[coming], begins[leaving]])
        angle = np.arctan2(way[:, 1].astype(float), way[:, 0].astype(float))
        # Of two areas that share an edge, the one behind it ends before the other begins.
        order = np.lexsort([~comes, angle, node])
        self.row, self.coming, self.node = row[order], comes[order], node[order]

    def neighbour(self, way: int, block: Index) -> Index:
        """Return the next (1) or previous (-1) ray round the node within a block of rays.

        ``block`` numbers the rays of each node, or some of them. Where coming and leaving rays do not take
        turns, as areas that lie over one another make them, each stands for its own nearest of the other.
        """
        order = np.argsort(block, kind="stable")
        sizes = np.bincount(block)[block[order]]
        first = np.searchsorted(block[order], block[order], side="left")
        place = np.arange(len(order)) - first
        found = np.empty(len(order), np.intp)
        found[order] = order[first + (place + way) % sizes]
        mixed = np.unique(block[self.coming[found] == self.coming])
        if len(mixed):
            bad = np.isin(block, mixed)
            ways = (np.flatnonzero(bad & self.coming), np.flatnonzero(bad & ~self.coming))
            comes, leaves = (rows[np.argsort(block[rows], kind="stable")] for rows in ways)
            found[comes], found[leaves] = leaves, comes
        return found


def cycles(follower: Index) -> tuple[Index, Index]:
    """Return for each item the least item of its cycle, and how many steps from that one it stands.

    Pointers are doubled, so that the rounds grow with the logarithm of the longest cycle.
    """
    label, jump = np.arange(len(follower)), follower
    while True:
        least = np.minimum(label, label[jump])
        if np.array_equal(least, label):
            break
        label, jump = least, jump[jump]
    back = np.empty(len(follower), np.intp)
    back[follower] = np.arange(len(follower))
    head = label == np.arange(len(label))
    back[head] = np.flatnonzero(head)
    rank = (~head).astype(np.intp)
    while not head[back].all():
        rank, back = rank + rank[back], back[back]
    return label, rank


def _sorted(copies: Copies, straight: NDArray[np.bool_], label: Index, rank: Index, body: Index) -> Rings:
    """Put rows in the order of polygons, rings and steps."""
    _, head, ring = np.unique(label, return_index=True, return_inverse=True)
    turned = _twice_area(copies, ring, len(head))
    polygon = body[copies.owner[head]]
    # By polygon, outlines (positive) first; rings keep the order of their first rows.
    order = np.lexsort([np.arange(len(head)), turned < 0, polygon])
    place = np.empty(len(order), np.intp)
    place[order] = np.arange(len(order))
    rows = np.lexsort([rank, place[ring]])
    sizes = np.bincount(place[ring], minlength=len(order))
    owners, marks = np.unique(polygon[order], return_index=True)
    return Rings(
        copies,
        rows,
        straight[rows],
        np.concatenate([[0], np.cumsum(sizes)]),
        np.append(marks, len(order)),
        owners,
    )


def _twice_area(copies: Copies, ring: Index, count: int) -> NDArray[np.int64]:
    """Return twice the signed area of each ring, from sums over chains that are made once."""
    chains = copies.chains
    points = chains.points
    cross = np.zeros(len(points), np.int64)
    cross[:-1] = points[:-1, 0] * points[1:, 1] - points[1:, 0] * points[:-1, 1]
    cross[chains.offsets[1:] - 1] = 0
    own = np.add.reduceat(cross, chains.offsets[:-1]) if len(chains) else np.empty(0, np.int64)
    step = (chains.end - chains.start)[copies.which]
    shift = copies.shift
    # Sums may run over the range of int64 on their way; they come back into it.
    total = own[copies.which] + shift[:, 0] * step[:, 1] - shift[:, 1] * step[:, 0]
    area = np.zeros(count, np.int64)
    np.add.at(area, ring, total)
    return area


def whole(rings: Rings) -> Outlines:
    """Return all polygons, without names."""
    points, ends = rings.outlines(0, len(rings.offsets) - 1)
    return Outlines(points, ends, rings.marks, np.ones(len(ends) - 1, bool))
