"""Many affine maps at once: the copies of a layout, as rows of one array."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import overload

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import GeometryError
from batik_vector.geometry.maps.affine import IDENTITY, Affine, Complexes, unit_turn
from batik_vector.geometry.ragged import Ragged
from batik_vector.geometry.sampling import Array, Geometries, Indices, Points
from batik_vector.values import frozen


@frozen(eq=False)
class Affines(Sequence[Affine]):
    """Affine maps in their order: row i of ``rows``, shape (n, 6), is (a, …, f) of an :class:`Affine`.

    ``A @ B`` applies B first. With several maps on both sides, row i of the one goes with row i of the other;
    :meth:`after` takes all pairs.
    """

    rows: Array

    def __post_init__(self) -> None:
        if not math.isfinite(self.rows.sum()) and not np.isfinite(self.rows).all():
            bad = self.rows[~np.isfinite(self.rows).all(axis=1)][0]
            raise GeometryError(f"an affine map needs finite numbers, not {tuple(bad.tolist())}")

    @staticmethod
    def of(maps: Sequence[Affine]) -> Affines:
        """Return maps as an array of them."""
        if isinstance(maps, Affines):
            return maps
        return Affines(np.array([each.row for each in maps], np.float64).reshape(-1, 6))

    @staticmethod
    def translations(shifts: Points) -> Affines:
        """Move by each of the shifts, shape (n, 2)."""
        rows = np.zeros((len(shifts), 6))
        rows[:, 0] = rows[:, 3] = 1.0
        rows[:, 4:] = shifts
        return Affines(rows)

    @staticmethod
    def similarities(factors: Complexes) -> Affines:
        """The maps z ↦ factor·z of complex numbers, one for each factor."""
        rows = np.zeros((len(factors), 6))
        rows[:, 0] = rows[:, 3] = factors.real
        rows[:, 1], rows[:, 2] = -factors.imag, factors.imag
        return Affines(rows)

    @staticmethod
    def scales(x: Array, y: Array) -> Affines:
        """Scale about the origin, along x and along y; both of shape (n,)."""
        rows = np.zeros((len(x), 6))
        rows[:, 0], rows[:, 3] = x, y
        return Affines(rows)

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[Affine]:
        return (Affine(*row) for row in self.rows.tolist())

    @overload
    def __getitem__(self, which: int) -> Affine: ...
    @overload
    def __getitem__(self, which: slice) -> Affines: ...
    def __getitem__(self, which: int | slice) -> Affine | Affines:
        if isinstance(which, slice):
            return Affines(self.rows[which])
        return Affine(*self.rows[which].tolist())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Affines) and np.array_equal(self.rows, other.rows)

    def __hash__(self) -> int:
        return hash(self.rows.tobytes())

    def __matmul__(self, first: Affine | Affines) -> Affines:
        """Return the maps that apply ``first`` and then these."""
        return Affines(
            _composed(self.rows, np.array([first.row]) if isinstance(first, Affine) else first.rows)
        )

    def __rmatmul__(self, last: Affine) -> Affines:
        """Return the maps that apply these and then ``last``."""
        return Affines(_composed(np.array([last.row]), self.rows))

    def after(self, inner: Affines) -> Affines:
        """Return every one of these maps after every inner one, the inner ones running fastest."""
        pairs = _composed(self.rows[:, None, :], inner.rows[None, :, :])
        return Affines(pairs.reshape(-1, 6))

    def moved(self, shifts: Points) -> Affines:
        """Return the maps followed by moves, shape (n, 2), or (1, 2) for one of all."""
        return Affines(np.hstack([self.linear, self.shifts + shifts]))

    def taken(self, which: Indices | NDArray[np.bool_]) -> Affines:
        """Return some of the maps, by number or by a mask."""
        return Affines(self.rows[which])

    @property
    def linear(self) -> Array:
        """The maps without their shifts, rows (a, b, c, d), shape (n, 4)."""
        return self.rows[:, :4]

    @property
    def shifts(self) -> Points:
        """Where the origin goes, shape (n, 2)."""
        return self.rows[:, 4:]

    @property
    def determinants(self) -> Array:
        """The factors on areas, shape (n,); negative where a map reflects."""
        a, b, c, d = self.linear.T
        return np.asarray(a * d - b * c)

    @cached_property
    def stretches(self) -> Array:
        """The largest factors on lengths, shape (n,)."""
        a, b, c, d = self.linear.T / 2
        return np.asarray(np.hypot(a + d, c - b) + np.hypot(a - d, c + b))

    @cached_property
    def are_translates(self) -> bool:
        """Whether the maps differ by their shifts only."""
        return bool((self.linear == self.linear[:1]).all())

    def at(self, points: Points) -> NDArray[np.float64]:
        """Return the images of points, shape (m, 2), under every map: shape (n, m, 2)."""
        x, y = points.T
        out = np.empty((len(self), len(points), 2))
        for axis in (0, 1):
            rows = self.rows[:1] if self.are_translates else self.rows
            along, across = rows[:, 2 * axis, None], rows[:, 2 * axis + 1, None]
            np.add(along * x + across * y, self.rows[:, 4 + axis, None], out=out[:, :, axis])
        return out

    def apply(self, geometries: Geometries) -> Geometries:
        """Return the images of polygons or of lines under every map, those under one map together.

        Rings of polygons keep their sense also where a map reflects.

        Args:
            geometries: all of one type, shape (k,).

        Returns:
            Shape (n·k,).

        Raises:
            GeometryError: where a map flattens the plane.
        """
        if len(self) == 1:
            return self[0].apply(geometries)
        if (np.abs(self.determinants) <= 1e-15 * self.stretches**2).any():
            raise GeometryError("an affine map that flattens the plane leaves no regions")
        if not len(geometries) or not len(self):
            return np.empty(0, dtype=object)
        marks = Ragged.of(np.asarray(geometries, dtype=object))
        return marks.images(self.at(marks.points), self.determinants < 0)


ONE = Affines.of([IDENTITY])
"""One copy, as it is."""


def turns(degrees: Sequence[float]) -> Affines:
    """Return the turns about the origin, anticlockwise; multiples of 90° are exact."""
    return Affines.similarities(np.array([unit_turn(each) for each in degrees], np.complex128))


def _composed(last: Array, first: Array) -> Array:
    """Return rows of maps that apply ``first`` and then ``last``; the rows lie along the last axis."""
    a, b, c, d, e, f = np.moveaxis(last, -1, 0) if last.ndim > 2 else last.T
    p, q, r, s, t, u = np.moveaxis(first, -1, 0) if first.ndim > 2 else first.T
    rows = a * p + b * r, a * q + b * s, c * p + d * r, c * q + d * s, a * t + b * u + e, c * t + d * u + f
    out = np.empty((*rows[0].shape, 6))
    for k, column in enumerate(rows):
        out[..., k] = column
    return out
