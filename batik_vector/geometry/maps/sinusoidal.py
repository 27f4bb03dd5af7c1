"""The sinusoidal variation: folds the whole plane into a square."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from batik_vector.geometry.maps.affine import Complexes
from batik_vector.geometry.maps.base import Variation
from batik_vector.geometry.sampling import Array, Indices
from batik_vector.values import frozen


@frozen
class Sinusoidal(Variation):
    """V(x, y) = (sin x, sin y): everything lands in the square [−1, 1]².

    The plane is folded at x = π/2 + kπ and y = π/2 + kπ.
    Draves & Reckase, "The Fractal Flame Algorithm", variation 1.
    """

    name: ClassVar[str] = "sinusoidal"

    @property
    def folds(self) -> bool:
        """Regions are cut at the creases."""
        return True

    def at(self, z: Complexes, angle: Array | None, branch: int) -> Complexes:
        """Return sin x + i·sin y."""
        return np.asarray(np.sin(z.real) + 1j * np.sin(z.imag))

    def wirtinger(self, z: Complexes, branch: int) -> tuple[Complexes, Complexes]:
        """((cos x + cos y)/2, (cos x − cos y)/2)."""
        x, y = np.cos(z.real), np.cos(z.imag)
        return ((x + y) / 2).astype(complex), ((x - y) / 2).astype(complex)

    def creases(self, low: float, high: float) -> Array:
        """π/2 + kπ."""
        first, last = np.ceil(low / np.pi - 0.5), np.floor(high / np.pi - 0.5)
        return np.asarray((np.arange(first, last + 1) + 0.5) * np.pi)

    def parts(self, start: Complexes, end: Complexes) -> Indices:
        """At most a radian between samples."""
        return np.asarray(np.maximum(np.ceil(np.abs(end - start)), 1), np.intp)
