"""Nearest edges on a torus, for many points at once.

The torus is cut into bins in lattice coordinates; every edge is entered in all bins from which it can be
the nearest within a given reach, so a point has to look into its own bin alone.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from batik_vector.certificate.symmetry.outline import Edges, Indices, Points
from batik_vector.values import frozen

Matrix = NDArray[np.float64]
Numbers = NDArray[np.float64]

BINS = 250_000
"""Bins on the torus at most, for each kind of edges."""

ALL_BINS = 16 * BINS
"""Bins of all kinds of edges together at most: a tracing in hundreds of inks has few edges of each."""

CHUNK = 100_000
"""Pairs of point and edge measured in one go, which keeps them in the processor's cache or near it."""


@frozen(eq=False)
class Feet:
    """For each point the nearest edge: ``distance`` (n,), inf where none is within reach.

    ``offset`` (n, 2) leads from the point to its foot on the edge, ``normal`` (n, 2) stands upright on it.
    """

    distance: Numbers
    offset: Points
    normal: Points


class _Pairs(NamedTuple):
    """Points beside edges: where each point's pairs begin, its number, the edge, the way to it, squared."""

    starts: Indices
    point: Indices
    edge: Indices
    away: tuple[Numbers, Numbers]
    squared: Numbers


class Nearest:
    """Edges on the torus of a lattice, ready to be asked which is nearest to a point.

    Args:
        edges: in mm, anywhere in the plane.
        basis: the two translations as the columns of a matrix, in mm.
        reach: how far (mm) a nearest edge is looked for.
        short: edges up to this long (mm) are taken to run either way: rounding and the sampling of curves
            turn them about.
    """

    def __init__(self, edges: Edges, basis: Matrix, reach: float, short: float) -> None:
        self.basis, self.inverse = basis, np.linalg.inv(basis)
        slope = np.hypot(*self.inverse.T)  # lattice coordinates gained at most per mm
        self.reach = min(reach, float(0.2 / slope.max()))
        area = abs(float(np.linalg.det(basis)))
        length = float(np.hypot(*(edges.end - edges.begin).T).mean())
        bins = min(BINS, ALL_BINS // (int(edges.kind.max(initial=0)) + 1))
        pitch = max(2 * self.reach, length, float(np.sqrt(area / bins)))
        self.bins = np.maximum((1 / (slope * pitch)).astype(np.intp), 1)
        pieces = _split(edges, min(2 * pitch, float(0.2 / slope.max())))
        self._measure(pieces, short)
        self._enter(pieces, slope)

    def _measure(self, pieces: Edges, short: float) -> None:
        half = (pieces.end - pieces.begin) / 2
        self.half = np.hypot(*half.T)
        # Columns apart: sums over pairs of numbers are slow.
        self.way_x, self.way_y = half.T / self.half
        self.middle_u, self.middle_v = ((pieces.begin + half) @ self.inverse.T).T.copy()
        self.aimless = (pieces.kind % 2 == 1) | (2 * self.half <= short)

    def _enter(self, pieces: Edges, slope: Numbers) -> None:
        begin, end = pieces.begin @ self.inverse.T, pieces.end @ self.inverse.T
        low = np.floor((np.minimum(begin, end) - self.reach * slope) * self.bins).astype(np.intp)
        high = np.floor((np.maximum(begin, end) + self.reach * slope) * self.bins).astype(np.intp)
        size = np.minimum(high - low + 1, self.bins)
        row, number = spread(size[:, 0] * size[:, 1])
        u = (low[row, 0] + number // size[row, 1]) % self.bins[0]
        v = (low[row, 1] + number % size[row, 1]) % self.bins[1]
        key = (pieces.kind[row] * self.bins[0] + u) * self.bins[1] + v
        order = np.argsort(key, kind="stable")
        self.entries = row[order]
        kinds = int(pieces.kind.max()) + 1 if len(pieces) else 0
        counts = np.bincount(key, minlength=kinds * int(self.bins.prod()))
        self.starts = np.concatenate([[0], np.cumsum(counts)])

    def feet(self, xy: Points, kind: Indices, heading: Points) -> Feet:
        """Return the nearest edge of the same kind to each point.

        Args:
            xy: shape (n, 2), mm.
            kind: shape (n,).
            heading: shape (n, 2); edges of areas that run the other way do not count. Zero asks for none.
        """
        distance, offset, normal = np.full(len(xy), np.inf), np.zeros_like(xy), np.zeros_like(xy)
        for pairs in self._pairs(xy, kind, heading):
            least = np.minimum.reduceat(pairs.squared, pairs.starts)
            counts = np.diff(np.r_[pairs.starts, len(pairs.squared)])
            hits = np.flatnonzero(pairs.squared == np.repeat(least, counts))[::-1]
            best = np.empty(len(least), np.intp)
            best[np.repeat(np.arange(len(least)), counts)[hits]] = hits
            points = pairs.point[pairs.starts]
            distance[points] = np.sqrt(least)
            offset[points] = np.column_stack([part[best] for part in pairs.away])
            nearest = pairs.edge[best]
            normal[points] = np.column_stack([-self.way_y[nearest], self.way_x[nearest]])
        distance[distance > self.reach] = np.inf
        return Feet(distance, offset, normal)

    def distances(self, xy: Points, kind: Indices, heading: Points) -> Numbers:
        """Return how far the nearest edge of the same kind is, inf beyond the reach; see :meth:`feet`."""
        distance = np.full(len(xy), np.inf)
        for pairs in self._pairs(xy, kind, heading):
            distance[pairs.point[pairs.starts]] = np.sqrt(np.minimum.reduceat(pairs.squared, pairs.starts))
        distance[distance > self.reach] = np.inf
        return distance

    def _pairs(self, xy: Points, kind: Indices, heading: Points) -> Iterator[_Pairs]:
        """Yield points with all edges in their bins, points without any left out."""
        place = (xy @ self.inverse.T) % 1.0
        cell = np.minimum((place * self.bins).astype(np.intp), self.bins - 1)
        key = (kind * self.bins[0] + cell[:, 0]) * self.bins[1] + cell[:, 1]
        key = np.minimum(key, len(self.starts) - 2)
        first, count = self.starts[key], self.starts[key + 1] - self.starts[key]
        some = np.flatnonzero(count)
        reached = np.cumsum(count[some])
        begin = 0
        while begin < len(some):
            done = reached[begin - 1] if begin else 0
            stop = max(begin + 1, int(np.searchsorted(reached, done + CHUNK)))
            part = some[begin:stop]
            row, number = spread(count[part])
            point, edge = part[row], self.entries[first[part][row] + number]
            away_x, away_y = self._away(place[point], edge)
            squared = away_x * away_x + away_y * away_y
            aims = heading[point, 0] * self.way_x[edge] + heading[point, 1] * self.way_y[edge]
            squared[(aims < 0) & ~self.aimless[edge]] = np.inf
            yield _Pairs(np.flatnonzero(number == 0), point, edge, (away_x, away_y), squared)
            begin = stop

    def _away(self, place: Points, edge: Indices) -> tuple[Numbers, Numbers]:
        """Return the way from points (lattice coordinates) to their feet on edges, in mm."""
        u, v = place[:, 0] - self.middle_u[edge], place[:, 1] - self.middle_v[edge]
        u -= np.rint(u)
        v -= np.rint(v)
        x, y = self.basis[0, 0] * u + self.basis[0, 1] * v, self.basis[1, 0] * u + self.basis[1, 1] * v
        way_x, way_y, half = self.way_x[edge], self.way_y[edge], self.half[edge]
        along = np.clip(x * way_x + y * way_y, -half, half)
        return along * way_x - x, along * way_y - y


def spread(counts: Indices) -> tuple[Indices, Indices]:
    """Return for counts 2, 0, 3 the rows 0 0 2 2 2 and the numbers 0 1 0 1 2 within each."""
    row = np.repeat(np.arange(len(counts)), counts)
    return row, np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)


def _split(edges: Edges, longest: float) -> Edges:
    """Cut edges into equal pieces no longer than that."""
    step = edges.end - edges.begin
    count = np.maximum(1, np.ceil(np.hypot(*step.T) / longest)).astype(np.intp)
    row, number = spread(count)
    step = step[row] / count[row, None]
    begin = edges.begin[row] + number[:, None] * step
    return Edges(begin, begin + step, edges.kind[row])
