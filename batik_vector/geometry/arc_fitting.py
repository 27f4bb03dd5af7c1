"""Circular arcs through polylines: what a machine that turns circles draws in one move in place of many.

From the bottom up (Keogh et al. 2001, "An online algorithm for segmenting time series", there for lines): at
first every vertex is a node; again and again those nodes are left out whose neighbours one arc joins best,
as long as it keeps to the vertices between. Of neighbouring nodes only one goes at a time, so all that go at
once are taken from all polylines in one stroke. An arc begins and ends on vertices exactly.

Nothing is computed here but what IEEE 754 rounds alike everywhere (no sums in unknown order, no libm, no
complex products), so that every machine leaves out the same nodes.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import Index, Offsets, Steps
from batik_vector.values import frozen

Array: TypeAlias = NDArray[np.float64]

LEAST_EDGES = 3
"""An arc stands for at least so many edges: through three vertices there is always a circle."""
MOST_RADIUS = 1e6
"""Steps (1 m). Controllers that compute with 32-bit floats, as grbl does, keep such a centre to 0.1 µm."""
LEVELS = 8
"""Errors are told apart in so many steps of the tolerance; those alike go in scattered order, all over."""
PARTS = 10
"""Centres are given in tenths of a step: with whole ones both ends would be off by up to 1.4 µm."""

_NEVER = np.iinfo(np.int64).max
_SCATTER = 2654435761
"""Knuth's multiplier: odd, so that numbers below 2³² stay apart."""


@frozen
class Arcs:
    """Polylines as moves between those of their vertices that stay.

    ``nodes`` has shape (k,), numbers of vertices, all ends of polylines among them. What leads to node i is
    by ``turns[i]`` a straight line (0) or an arc, counter-clockwise (1) or clockwise (-1), about the centre
    that lies ``centres[i]``, shape (2,), tenths of a step, from the node before. Arcs are no longer than half
    a turn.
    """

    nodes: Index
    turns: NDArray[np.int8]
    centres: NDArray[np.int64]


def fit_arcs(points: Steps, rings: Offsets, tolerance: float, sampling: float) -> Arcs:
    """Fit arcs to polylines.

    Args:
        points: shape (n, 2), whole steps; neighbours differ.
        rings: shape (k + 1,), polyline i is ``points[rings[i]:rings[i + 1]]``. A closed one repeats its first
            point.
        tolerance: in steps, how far an arc may stand from a vertex.
        sampling: in steps, how far the curve that was meant may stand from the edges of the polyline: between
            vertices, an arc is off an edge by that and the tolerance at most.

    Raises:
        GeometryError: for a tolerance that no fit can serve.
    """
    if not 0 < tolerance < np.inf or not 0 <= sampling < np.inf:
        raise GeometryError("cannot fit arcs without a tolerance")
    fitter = _Fitter(points, tolerance, sampling)
    node = np.arange(len(points), dtype=np.intp)
    # By its place in its own line, so that equal lines get equal arcs.
    scattered = (node - np.repeat(rings[:-1], np.diff(rings))) * _SCATTER & 0xFFFFFFFF
    fixed = np.zeros(len(points), bool)
    fixed[rings[:-1]] = fixed[rings[1:] - 1] = True
    cost = np.full(len(points), _NEVER)
    stale = ~fixed
    while True:
        cost[stale] = fitter.costs(node, np.flatnonzero(stale))
        key = np.where(cost == _NEVER, _NEVER, (np.minimum(cost, LEVELS) << 32) + scattered[node])
        gone = key < _NEVER
        gone[1:] &= key[1:] < key[:-1]
        gone[:-1] &= key[:-1] < key[1:]
        if not gone.any():
            break
        beside = np.zeros(len(node), bool)
        beside[:-1] |= gone[1:]
        beside[1:] |= gone[:-1]
        node, fixed, cost, beside = (each[~gone] for each in (node, fixed, cost, beside))
        stale = beside & ~fixed
    return _moves(fitter, node, rings)


def _moves(fitter: _Fitter, node: Index, rings: Offsets) -> Arcs:
    """Return the moves: arcs where they stand for enough edges, all the vertices elsewhere."""
    first = np.zeros(len(fitter.x), bool)
    first[rings[:-1]] = True
    long = (np.diff(node) >= LEAST_EDGES) & ~first[node[1:]]
    begin, end = node[:-1][long], node[1:][long]
    inside = np.zeros(len(fitter.x) + 1, np.int64)
    np.add.at(inside, begin + 1, 1)
    np.add.at(inside, end, -1)
    nodes = np.flatnonzero(np.cumsum(inside)[:-1] == 0)
    turns, centres = np.zeros(len(nodes), np.int8), np.zeros((len(nodes), 2), np.int64)
    at = np.searchsorted(nodes, end)
    turns[at], centres[at] = fitter.arcs(begin, end)
    return Arcs(nodes, turns, centres)


class _Fitter:
    """Arcs between vertices, as good as one that ends on both can be."""

    def __init__(self, points: Steps, tolerance: float, sampling: float) -> None:
        self.x, self.y = points[:, 0].astype(np.float64), points[:, 1].astype(np.float64)
        self._tolerance, self._sampling = tolerance, sampling

    def costs(self, node: Index, which: Index) -> NDArray[np.int64]:
        """Return what it costs to leave out some nodes: their errors in parts of the tolerance, or never."""
        if not len(which):
            return np.empty(0, np.int64)
        chords = _Chords(self, node[which - 1], node[which + 1])
        height = chords.fitted()
        error, fits = chords.error(height, self._tolerance, self._sampling)
        fits &= error <= self._tolerance
        level = (np.where(fits, error, 0.0) / self._tolerance * LEVELS).astype(np.int64)
        return np.where(fits, level, _NEVER)

    def arcs(self, begin: Index, end: Index) -> tuple[NDArray[np.int8], NDArray[np.int64]]:
        """Return the turns and centres of arcs that fit."""
        if not len(begin):
            return np.empty(0, np.int8), np.empty((0, 2), np.int64)
        chords = _Chords(self, begin, end)
        height = chords.fitted()
        centre = chords.centre(height)
        half = chords.length / 2
        right = chords.ux * half - chords.uy * centre
        up = chords.uy * half + chords.ux * centre
        found = np.rint(np.stack([right, up], axis=1) * PARTS).astype(np.int64)
        return np.where(height > 0, -1, 1).astype(np.int8), found


class _Chords:
    """Runs of vertices, each seen along the chord from its first to its last: x along it, y to its left."""

    def __init__(self, fitter: _Fitter, begin: Index, end: Index) -> None:
        sizes = end - begin + 1
        self.ends = np.cumsum(sizes)
        self.heads = self.ends - sizes
        self.own = np.repeat(np.arange(len(begin)), sizes)
        at = np.arange(self.ends[-1]) + np.repeat(begin - self.heads, sizes)
        over, up = fitter.x[end] - fitter.x[begin], fitter.y[end] - fitter.y[begin]
        self.length = np.sqrt(over * over + up * up)
        # Where a ring would close there is no chord, and nothing fits.
        length = np.where(self.length > 0, self.length, 1.0)
        self.ux, self.uy = over / length, up / length
        over, up = fitter.x[at] - fitter.x[begin][self.own], fitter.y[at] - fitter.y[begin][self.own]
        ux, uy = self.ux[self.own], self.uy[self.own]
        # From the middle of the chord.
        self.x = over * ux + up * uy - (self.length / 2)[self.own]
        self.y = up * ux - over * uy

    def fitted(self) -> Array:
        """Return how high above the chord each arc stands, below it negative, 0 where there is none."""
        height = np.abs(self.y)
        peak = np.maximum.reduceat(height, self.heads)
        at = np.where(height == peak[self.own], np.arange(len(height)), len(height))
        top = np.minimum.reduceat(at, self.heads)
        x, y = self.x[top], self.y[top]
        quarter = self.length * self.length / 4
        safe = np.where(y == 0, 1.0, y)
        offset = (x * x - quarter + y * y) / (2 * safe)
        radius = np.sqrt(quarter + offset * offset)
        # The same as offset ± radius, without taking large numbers from one another.
        side = np.where(y < 0, -1.0, 1.0)
        below = offset * side < 0
        apart = np.where(below, radius - offset * side, 1.0)
        rise = np.where(below, quarter / apart, radius + offset * side)
        first = np.where(y == 0, 0.0, rise * side)
        off = self._off(first)
        low, high = np.minimum.reduceat(off, self.heads), np.maximum.reduceat(off, self.heads)
        return np.where(first == 0, 0.0, first + (low + high) / 2 * side)

    def centre(self, height: Array) -> Array:
        """Return how far above the chord the centres lie."""
        return height - np.where(height < 0, -1.0, 1.0) * self._radius(height)

    def _radius(self, height: Array) -> Array:
        safe = np.where(height == 0, 1.0, np.abs(height))
        return np.asarray((self.length * self.length / 4 + safe * safe) / (2 * safe))

    def _off(self, height: Array) -> Array:
        """Return how far outside its arc's circle each vertex lies."""
        y = self.y - self.centre(height)[self.own]
        return np.asarray(np.sqrt(self.x * self.x + y * y) - self._radius(height)[self.own])

    def error(self, height: Array, tolerance: float, sampling: float) -> tuple[Array, NDArray[np.bool_]]:
        """Return the largest error at a vertex of each run, and whether the arc will do but for that.

        It does if it is no longer than half a turn, not too flat, passes its vertices in their order, and is
        off none of its edges by too much.
        """
        radius, centre = self._radius(height), self.centre(height)
        fits = (height != 0) & (np.abs(height) <= self.length / 2) & (radius <= MOST_RADIUS)
        error = np.maximum.reduceat(np.abs(self._off(height)), self.heads)
        x, y = self.x, self.y - centre[self.own]
        turned = (x[:-1] * y[1:] - y[:-1] * x[1:]) * np.where(height < 0, 1.0, -1.0)[self.own[:-1]]
        middle_x, middle_y = (x[:-1] + x[1:]) / 2, (y[:-1] + y[1:]) / 2
        sunk = np.abs(radius[self.own[:-1]] - np.sqrt(middle_x * middle_x + middle_y * middle_y))
        bad = (turned <= 0) | (sunk > tolerance + sampling)
        # From the last vertex of a run to the first of the next there is no edge.
        bad[self.ends[:-1] - 1] = False
        fits[self.own[:-1][bad]] = False
        return error, fits
