"""Affine maps of the plane: turns, scales, shifts, mirrors and whatever they compose to."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.errors import GeometryError
from batik_vector.geometry.sampling import Geometries, Points

Complexes: TypeAlias = NDArray[np.complex128]
"""Points as x + iy, shape (n,)."""

SIMILAR = 1e-9
"""Relative: two lengths or coefficients closer than this are the same length. Compositions of some
hundred maps stay within it, and no cloth shows it."""


def unit_power(k: int, n: int) -> complex:
    """Return e^(2πik/n), exact at whole quarter turns and symmetric at eighths."""
    quarter, rest = divmod(4 * k, n)
    if 2 * rest > n:
        quarter, rest = quarter + 1, rest - n
    return _turned(quarter, 0.5 * math.pi * rest / n, 2 * abs(rest) == n)


def unit_turn(degrees: float) -> complex:
    """Return e^(iφ) for φ in degrees, exact at multiples of 90 and symmetric at odd ones of 45."""
    rest = math.remainder(degrees, 90.0)
    quarter = round((math.fmod(degrees, 360.0) - rest) / 90.0)
    return _turned(quarter, math.radians(rest), abs(rest) == 45.0)


def _turned(quarter: int, rest: float, eighth: bool) -> complex:
    if eighth:
        c, s = math.sqrt(0.5), math.copysign(math.sqrt(0.5), rest)
    else:
        c, s = math.cos(rest), math.sin(rest)
    # Swapping is exact where multiplying by i^k would leave signed zeros.
    for _ in range(quarter % 4):
        c, s = -s, c
    return complex(c + 0.0, s + 0.0)


@dataclass(frozen=True)
class Affine:
    """x' = a·x + b·y + e, y' = c·x + d·y + f (Tian et al. 2019, Eq. 2).

    ``A @ B`` applies B first.
    """

    a: float = 1.0
    b: float = 0.0
    c: float = 0.0
    d: float = 1.0
    e: float = 0.0
    f: float = 0.0

    def __post_init__(self) -> None:
        # A sum is finite where all its parts are; one that runs over is looked at again, part by part.
        if not math.isfinite(sum(self.row)) and not all(map(math.isfinite, self.row)):
            raise GeometryError(f"an affine map needs finite numbers, not {self.row}")

    @staticmethod
    def translation(shift: tuple[float, float]) -> Affine:
        """Move by ``shift``."""
        return Affine(e=float(shift[0]), f=float(shift[1]))

    @staticmethod
    def turn(degrees: float) -> Affine:
        """Turn about the origin, anticlockwise; multiples of 90° are exact."""
        return Affine.similarity(unit_turn(degrees))

    @staticmethod
    def scale(x: float, y: float | None = None) -> Affine:
        """Scale about the origin, by ``x`` in both directions unless ``y`` is given.

        Raises:
            GeometryError: for a scale of 0, which leaves no region.
        """
        y = x if y is None else y
        if x == 0 or y == 0:
            raise GeometryError("a scale of 0 leaves nothing to draw")
        return Affine(a=float(x), d=float(y))

    @staticmethod
    def mirror(degrees: float = 0.0) -> Affine:
        """Reflect in the line through the origin at ``degrees`` from the x axis."""
        u = unit_turn(2 * degrees)
        return Affine(u.real, u.imag, u.imag, -u.real)

    @staticmethod
    def similarity(factor: complex, shift: complex = 0j) -> Affine:
        """The map z ↦ factor·z + shift of complex numbers."""
        return Affine(factor.real, -factor.imag, factor.imag, factor.real, shift.real, shift.imag)

    @property
    def row(self) -> tuple[float, float, float, float, float, float]:
        """The six numbers (a, b, c, d, e, f)."""
        return self.a, self.b, self.c, self.d, self.e, self.f

    @property
    def determinant(self) -> float:
        """The factor on areas; negative where the map reflects."""
        return self.a * self.d - self.b * self.c

    @property
    def stretch(self) -> float:
        """The largest factor on lengths: the larger singular value."""
        z, w = self.wirtinger
        return abs(z) + abs(w)

    @property
    def wirtinger(self) -> tuple[complex, complex]:
        """The factors (p, q) of z ↦ p·z + q·z̄ + shift."""
        p = complex(self.a + self.d, self.c - self.b) / 2
        q = complex(self.a - self.d, self.c + self.b) / 2
        return p, q

    @property
    def linear(self) -> Affine:
        """The same map without its shift."""
        return Affine(self.a, self.b, self.c, self.d)

    @property
    def is_identity(self) -> bool:
        """Whether the map moves nothing at all."""
        return self.row == (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)

    def is_similarity(self) -> bool:
        """Whether shapes are kept: one factor on all lengths, reflected or not."""
        p, q = (abs(part) for part in self.wirtinger)
        return min(p, q) <= SIMILAR * max(p, q)

    def __matmul__(self, first: Affine) -> Affine:
        """Return the map that applies ``first`` and then this one."""
        if not isinstance(first, Affine):
            # Many maps know how to follow one.
            return NotImplemented
        a, b, c, d = self.a, self.b, self.c, self.d
        return Affine(
            a * first.a + b * first.c,
            a * first.b + b * first.d,
            c * first.a + d * first.c,
            c * first.b + d * first.d,
            a * first.e + b * first.f + self.e,
            c * first.e + d * first.f + self.f,
        )

    def inverse(self) -> Affine:
        """Return the map that undoes this one.

        Raises:
            GeometryError: where the map flattens the plane and cannot be undone.
        """
        det = self.determinant
        if abs(det) <= 1e-15 * self.stretch**2:
            raise GeometryError("an affine map that flattens the plane has no inverse")
        a, b, c, d = self.d / det, -self.b / det, -self.c / det, self.a / det
        return Affine(a, b, c, d, -(a * self.e + b * self.f), -(c * self.e + d * self.f))

    def at(self, points: Points) -> Points:
        """Return the images of points, shape (n, 2)."""
        x, y = points[:, 0], points[:, 1]
        out = np.empty((len(points), 2))
        out[:, 0] = self.a * x + self.b * y + self.e
        out[:, 1] = self.c * x + self.d * y + self.f
        return out

    def at_complex(self, z: Complexes) -> Complexes:
        """Return the images of points given as x + iy."""
        out = np.empty(z.shape, np.complex128)
        out.real = self.a * z.real + self.b * z.imag + self.e
        out.imag = self.c * z.real + self.d * z.imag + self.f
        return out

    def apply(self, geometries: Geometries) -> Geometries:
        """Return the images of shapely geometries, all in one call.

        Rings of polygons keep their sense also where the map reflects.

        Raises:
            GeometryError: where the map flattens the plane.
        """
        geometries = np.asarray(geometries, dtype=object)
        if abs(self.determinant) <= 1e-15 * self.stretch**2:
            raise GeometryError("an affine map that flattens the plane leaves no regions")
        if self.is_identity or not geometries.size:
            return geometries
        images: Geometries = np.asarray(shapely.transform(geometries, self.at), dtype=object)
        if self.determinant < 0:
            areal = shapely.get_dimensions(images) == 2
            images[areal] = shapely.reverse(images[areal])
        return images


IDENTITY = Affine()
"""The map that moves nothing."""
