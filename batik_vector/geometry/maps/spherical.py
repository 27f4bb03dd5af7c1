"""The spherical variation: inversion in the unit circle."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from batik_vector.geometry.maps.affine import Complexes
from batik_vector.geometry.maps.base import Variation
from batik_vector.geometry.sampling import Array
from batik_vector.values import frozen


@frozen
class Spherical(Variation):
    """V(x, y) = (x, y)/r²: turns the plane inside out about the unit circle.

    The origin goes to infinity: what contains or touches it is refused.
    Draves & Reckase, "The Fractal Flame Algorithm", variation 2.
    """

    name: ClassVar[str] = "spherical"

    @property
    def singular(self) -> bool:
        """Not smooth at the origin."""
        return True

    @property
    def pole(self) -> bool:
        """The origin goes to infinity."""
        return True

    def at(self, z: Complexes, angle: Array | None, branch: int) -> Complexes:
        """Return 1/z̄."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(z / (z.real**2 + z.imag**2))

    def wirtinger(self, z: Complexes, branch: int) -> tuple[Complexes, Complexes]:
        """(0, −1/z̄²)."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.zeros_like(z), np.asarray(-1 / np.conj(z) ** 2)
