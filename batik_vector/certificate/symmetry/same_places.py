"""Points of an outline that fall on points of the outline: most do, where an operation holds.

Who drew a pattern by copying has mapped vertices on vertices, and so does an operation that the copies
follow. A table tells at once which points have such a fellow; the few others are left to a search.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.certificate.symmetry.lattice import Matrix
from batik_vector.certificate.symmetry.outline import Indices, Points

LEAST_BITS, MOST_BITS = 12, 23
"""Places in a table, as powers of two: four for each point, and 64 MB for both tables at the most."""

Numbers = NDArray[np.float64]

SPREAD = np.uint64(0x9E3779B97F4A7C15)
"""2⁶⁴ by the golden ratio: what multiplies a key so that its upper bits are spread evenly (Knuth, The Art of
Computer Programming 3, 6.4)."""


STRAY = 8
"""How many times nearer the edge of a fellow is than a fellow may be."""


class SamePlaces:
    """Points on a torus, ready to be asked for one that stands where another does.

    Args:
        xy: shape (n, 2), mm, anywhere in the plane.
        kind: shape (n,).
        heading: shape (n, 2); points that head the other way are not the same. Zero is the same as any.
        along: shape (n, 2), the way of the edge on which each stands.
        basis: the lattice of the torus, as columns in mm.
        near: how far (mm) a point may stand from the place.
    """

    def __init__(
        self, xy: Points, kind: Indices, heading: Points, along: Points, basis: Matrix, near: float
    ) -> None:
        self.basis, self.inverse, self.near = basis, np.linalg.inv(basis), near
        # Twice as broad, so that most pairs fall in one bin of two tables of which one is half a bin beside.
        slope = np.hypot(*self.inverse.T)
        self.bins = np.maximum((1 / (slope * 2 * near)).astype(np.int64), 1)
        bits = int(np.clip(np.ceil(np.log2(4 * max(len(kind), 1))), LEAST_BITS, MOST_BITS))
        self.shift = np.uint64(64 - bits)
        self.kind = kind
        # Columns apart: sums over pairs of numbers are slow.
        self.heading_x, self.heading_y = heading.T.copy()
        length = np.hypot(*along.T)
        length[length == 0] = 1
        self.upright_x, self.upright_y = -along[:, 1] / length, along[:, 0] / length
        self.u, self.v = self._place(xy)
        self.tables = [np.full(1 << bits, -1, np.int32) for _ in range(2)]
        for half, table in enumerate(self.tables):
            table[self._key(self.u, self.v, kind, half)] = np.arange(len(kind), dtype=np.int32)

    def _place(self, xy: Points) -> tuple[Numbers, Numbers]:
        """Return lattice coordinates of points in mm, in [0, 1)."""
        (a, b), (c, d) = self.inverse
        x, y = xy[:, 0], xy[:, 1]
        u, v = a * x + b * y, c * x + d * y
        u -= np.floor(u)
        v -= np.floor(v)
        return u, v

    def _key(self, u: Numbers, v: Numbers, kind: Indices, half: int) -> NDArray[np.uint64]:
        column = (u * self.bins[0] + half / 2).astype(np.int64) % self.bins[0]
        row = (v * self.bins[1] + half / 2).astype(np.int64) % self.bins[1]
        number = (kind * self.bins[0] + column) * self.bins[1] + row
        return np.asarray((number.astype(np.uint64) * SPREAD) >> self.shift)

    def distances(self, xy: Points, kind: Indices, heading: Points) -> Numbers:
        """Return how far points stand from the edge on which their fellow stands, inf where none was met."""
        distance = np.full(len(xy), np.inf)
        u, v = self._place(xy)
        left = np.arange(len(xy))
        for half, table in enumerate(self.tables):
            fellow = table[self._key(u, v, kind[left], half)]
            du, dv = u - self.u[fellow], v - self.v[fellow]
            du -= np.rint(du)
            dv -= np.rint(dv)
            x = self.basis[0, 0] * du + self.basis[0, 1] * dv
            y = self.basis[1, 0] * du + self.basis[1, 1] * dv
            off = np.abs(x * self.upright_x[fellow] + y * self.upright_y[fellow])
            aims = heading[left, 0] * self.heading_x[fellow] + heading[left, 1] * self.heading_y[fellow]
            met = (fellow >= 0) & (self.kind[fellow] == kind[left]) & (aims >= 0)
            # At a corner another edge may be nearer by far.
            met &= (x * x + y * y <= self.near**2) & (off <= self.near / STRAY)
            distance[left[met]] = off[met]
            left, u, v = left[~met], u[~met], v[~met]
        return distance
