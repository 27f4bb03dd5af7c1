"""The bent variation: stretches the left half-plane and flattens the lower one."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from batik_vector.geometry.maps.affine import Complexes
from batik_vector.geometry.maps.base import Variation
from batik_vector.geometry.sampling import Array
from batik_vector.values import frozen


@frozen
class Bent(Variation):
    """V(x, y) = (x or 2x where x < 0, y or y/2 where y < 0): a kink along both axes.

    Draves & Reckase, "The Fractal Flame Algorithm", variation 14.
    """

    name: ClassVar[str] = "bent"

    def at(self, z: Complexes, angle: Array | None, branch: int) -> Complexes:
        """Scale each half-plane."""
        x = np.where(z.real < 0, 2 * z.real, z.real)
        y = np.where(z.imag < 0, z.imag / 2, z.imag)
        return np.asarray(x + 1j * y)

    def wirtinger(self, z: Complexes, branch: int) -> tuple[Complexes, Complexes]:
        """Half the sum and half the difference of the two scales."""
        x, y = np.where(z.real < 0, 2.0, 1.0), np.where(z.imag < 0, 0.5, 1.0)
        return ((x + y) / 2).astype(complex), ((x - y) / 2).astype(complex)

    def creases(self, low: float, high: float) -> Array:
        """The two axes."""
        return np.zeros(1) if low < 0 < high else np.empty(0)
