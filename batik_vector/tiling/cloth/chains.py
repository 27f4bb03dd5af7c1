"""Rings out of pieces: outlines that a seam cut are joined again, in whole numbers and without overlays.

The pieces lie side by side in the cells of a lattice. Their boundaries run anticlockwise, so an edge along a
seam has its twin, running back, on the other side: such twins cancel, interval by interval, and what is left
of all boundaries closes to rings again, for the boundary of a sum of areas has no boundary. Nothing is moved
and nothing is rounded; the cost grows with the crossings and not with the vertices, which stay unread.

Boundaries are cut into **chains** at **nodes**: where they touch a seam, or one another. At a node through
which several boundaries run, chains are joined by their order round it, as in a walk along the faces of a map
(half-edges; de Berg et al., Computational Geometry, chapter 2).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Offsets, Outlines, Steps
from batik_vector.values import frozen

NO_SEAM = -1


@frozen
class Chains:
    """Stretches of boundary between nodes.

    Chain i is ``points[offsets[i]:offsets[i + 1]]``, both ends included; it bounds the mark ``mark[i]``.
    ``axis[i]`` is 0 or 1 where the chain is an edge on a seam x = const or y = const, else ``NO_SEAM``.
    ``before[i]`` and ``after[i]`` are its neighbours along its ring.
    """

    points: Steps
    offsets: Offsets
    mark: Index
    axis: Index
    before: Index
    after: Index

    def __len__(self) -> int:
        return len(self.mark)

    @property
    def start(self) -> Steps:
        """Where each begins, shape (n, 2)."""
        return self.points[self.offsets[:-1]]

    @property
    def end(self) -> Steps:
        """Where each ends, shape (n, 2)."""
        return self.points[self.offsets[1:] - 1]

    def and_edges(self, start: Steps, end: Steps, mark: Index) -> Chains:
        """Return these chains and some of two points each behind them."""
        more = np.stack([start, end], axis=1).reshape(-1, 2)
        return Chains(
            np.concatenate([self.points, more]),
            np.concatenate([self.offsets, self.offsets[-1] + 2 * np.arange(1, len(mark) + 1)]),
            np.concatenate([self.mark, mark]),
            np.concatenate([self.axis, np.full(len(mark), NO_SEAM)]),
            self.before,
            self.after,
        )


def all_chains(parts: Sequence[Chains]) -> Chains:
    """Return several sets of chains as one; marks keep their numbers."""
    points = np.cumsum([0, *(len(part.points) for part in parts)])
    counts = np.cumsum([0, *(len(part) for part in parts)])
    shifted = list(zip(parts, points.tolist(), counts.tolist(), strict=False))
    return Chains(
        np.concatenate([part.points for part in parts]),
        np.concatenate([[0], *(part.offsets[1:] + at for part, at, _ in shifted)]),
        np.concatenate([part.mark for part in parts]),
        np.concatenate([part.axis for part in parts]),
        np.concatenate([part.before + row for part, _, row in shifted]),
        np.concatenate([part.after + row for part, _, row in shifted]),
    )


def chains_of(outlines: Outlines, seams: tuple[tuple[int, ...], tuple[int, ...]]) -> Chains:
    """Cut the rings of areas at seams and wherever they touch one another.

    Args:
        outlines: areas in whole steps, outer rings anticlockwise, holes clockwise.
        seams: the abscissas of the upright seams, and the ordinates of the level ones.
    """
    if not len(outlines):
        none = np.empty(0, np.intp)
        return Chains(outlines.points, np.zeros(1, np.int64), none, none, none, none)
    outlines = _with_contacts(outlines)
    points = outlines.points
    on = [np.isin(points[:, axis], seams[axis]) for axis in (0, 1)]
    node = on[0] | on[1] | _repeated(points)
    first = outlines.rings[:-1]
    # A ring without a node begins anywhere.
    node[first[~np.logical_or.reduceat(node, first)]] = True
    start = np.flatnonzero(node)
    ring = np.searchsorted(outlines.rings, start, side="right") - 1
    heads = np.searchsorted(ring, np.arange(len(first)), side="left")
    stop = np.append(start[1:], 0)
    last = np.append(ring[1:] != ring[:-1], True)
    sizes = np.diff(outlines.rings)
    # The last chain of a ring goes on, over the ring's end, to where the first begins.
    stop[last] = start[heads[ring[last]]] + sizes[ring[last]]
    counts = stop - start + 1
    offsets = np.concatenate([[0], np.cumsum(counts)])
    members = np.arange(offsets[-1]) + np.repeat(start - offsets[:-1], counts)
    end_of_ring = np.repeat(outlines.rings[ring + 1], counts)
    members -= (members >= end_of_ring) * np.repeat(sizes[ring], counts)
    chain_points = points[members]
    axis = _seam_axis(chain_points, offsets, seams)
    mark = np.searchsorted(outlines.marks, ring, side="right") - 1
    each_chain = np.arange(len(start))
    after = np.where(last, heads[ring], each_chain + 1)
    before = np.empty_like(after)
    before[after] = each_chain
    return Chains(chain_points, offsets, mark, axis, before, after)


def _seam_axis(points: Steps, offsets: Offsets, seams: tuple[tuple[int, ...], tuple[int, ...]]) -> Index:
    """Return on which kind of seam each chain is an edge, ``NO_SEAM`` for others."""
    found = np.full(len(offsets) - 1, NO_SEAM)
    a, b = points[offsets[:-1]], points[offsets[1:] - 1]
    for axis in (0, 1):
        on = (np.diff(offsets) == 2) & (a[:, axis] == b[:, axis]) & np.isin(a[:, axis], seams[axis])
        found[on] = axis
    return found


def _repeated(points: Steps) -> NDArray[np.bool_]:
    """Return which points are there more than once."""
    number = numbered(points[:, 0], points[:, 1])
    return np.asarray(np.bincount(number)[number] > 1)


def numbered(*columns: NDArray[np.int64]) -> Index:
    """Return a number for each row: equal rows have equal numbers, in the order of the rows."""
    if not len(columns[0]):
        return np.empty(0, np.intp)
    order = np.lexsort(columns[::-1])
    new = np.zeros(len(order), bool)
    for column in columns:
        new[1:] |= column[order[1:]] != column[order[:-1]]
    number = np.empty(len(order), np.intp)
    number[order] = np.cumsum(new)
    return number


def _with_contacts(outlines: Outlines) -> Outlines:
    """Return areas with a vertex wherever a vertex of theirs lies on the inside of an edge."""
    points, rings = outlines.points, outlines.rings
    after = np.arange(1, len(points) + 1)
    after[rings[1:] - 1] = rings[:-1]
    step = points[after] - points
    # An edge whose step is in lowest terms passes no grid point.
    long = np.flatnonzero(np.gcd(step[:, 0], step[:, 1]) > 1)
    if not len(long):
        return outlines
    ends = np.stack([points[long], points[after[long]]], axis=1).astype(float)
    tree = shapely.STRtree(np.asarray(shapely.linestrings(ends), dtype=object))
    vertex, edge = tree.query(shapely.points(points.astype(float)), predicate="intersects")
    at, here = long[edge], points[vertex]
    inside = (here != points[at]).any(axis=1) & (here != points[after[at]]).any(axis=1)
    if not inside.any():
        return outlines
    at, here = at[inside], here[inside]
    far = np.abs(here - points[at]).max(axis=1)
    order = np.lexsort([far, at])
    at, here, far = at[order], here[order], far[order]
    new = np.append(True, (at[1:] != at[:-1]) | (far[1:] != far[:-1]))
    at, here = at[new], here[new]
    return replace(
        outlines,
        points=np.insert(points, at + 1, here, axis=0),
        rings=rings + np.searchsorted(at, rings, side="left"),
    )


@frozen
class Copies:
    """Copies of chains: which, how far moved, and of which copy of a mark each is the boundary."""

    chains: Chains
    which: Index
    shift: Steps
    owner: Index

    def points(self, of: Steps) -> Steps:
        """Return a point of each copied chain where it lies; ``of`` holds it for each chain."""
        return of[self.which] + self.shift


@frozen
class Contact:
    """Where edges on seams met their twins.

    ``upper`` and ``lower`` are rows of the copies: edges that run towards larger and towards smaller
    coordinates and share a stretch. ``left``, with ``start`` and ``end``, are the stretches without twin and
    the rows they are of.
    """

    upper: Index
    lower: Index
    left: Index
    start: Steps
    end: Steps


def cancelled(copies: Copies, group: Index | None = None) -> Contact:
    """Cancel the edges on seams that run along one another in opposite directions.

    Args:
        copies: chains; those that are no edges on seams are passed over.
        group: shape (n,), a number for each copy: only edges of one group cancel. None is one group.
    """
    rows = np.flatnonzero(copies.chains.axis[copies.which] != NO_SEAM)
    some = replace(copies, which=copies.which[rows], shift=copies.shift[rows], owner=copies.owner[rows])
    start, end = some.points(some.chains.start), some.points(some.chains.end)
    axis = some.chains.axis[some.which]
    each = np.arange(len(rows))
    value, a, b = start[each, axis], start[each, 1 - axis], end[each, 1 - axis]
    line = numbered(axis, value) if group is None else numbered(group[rows], axis, value)
    low, high = np.minimum(a, b), np.maximum(a, b)
    base = line * (int((high.max() - low.min()) + 1) if len(low) else 1) - (low.min() if len(low) else 0)
    low, high = low + base, high + base
    forward = b > a
    upper, lower = (np.flatnonzero(way)[np.argsort(low[way], kind="stable")] for way in (forward, ~forward))
    first = np.searchsorted(high[lower], low[upper], side="right")
    stop = np.searchsorted(low[lower], high[upper], side="left")
    counts = np.maximum(stop - first, 0)
    p = np.repeat(np.arange(len(upper)), counts)
    n = np.arange(counts.sum()) + np.repeat(first - np.cumsum(counts) + counts, counts)
    p, n = upper[p], lower[n]
    shared = np.maximum(low[p], low[n]), np.minimum(high[p], high[n])
    parts = [_uncovered(mine, rest, low, high, shared) for mine, rest in ((upper, p), (lower, n))]
    left, begin, stop_at = (np.concatenate([part[i] for part in parts]) for i in range(3))
    from_, to = begin - base[left], stop_at - base[left]
    from_, to = np.where(forward[left], from_, to), np.where(forward[left], to, from_)
    starts, ends = start[left].copy(), end[left].copy()
    starts[np.arange(len(left)), 1 - axis[left]] = from_
    ends[np.arange(len(left)), 1 - axis[left]] = to
    return Contact(rows[p], rows[n], rows[left], starts, ends)


def _uncovered(
    edges: Index,
    covered: Index,
    low: NDArray[np.int64],
    high: NDArray[np.int64],
    shared: tuple[NDArray[np.int64], NDArray[np.int64]],
) -> tuple[Index, NDArray[np.int64], NDArray[np.int64]]:
    """Return the stretches of edges outside their shared ones: (edge, from, to).

    ``covered`` names the edge of each shared stretch; both are in the order of the edges.
    """
    # In front of every shared stretch, and behind the last of every edge.
    last = np.zeros(len(low), np.intp)
    last[covered] = np.arange(len(covered)) + 1
    begins = low[covered].copy()
    same = covered[1:] == covered[:-1]
    begins[1:][same] = shared[1][:-1][same]
    behind = low[edges].copy()
    some = last[edges] > 0
    behind[some] = shared[1][last[edges[some]] - 1]
    names = np.concatenate([covered, edges])
    starts, ends = np.concatenate([begins, behind]), np.concatenate([shared[0], high[edges]])
    keep = starts < ends
    return names[keep], starts[keep], ends[keep]
