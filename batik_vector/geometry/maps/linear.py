"""The linear variation: V(z) = z."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from batik_vector.geometry.maps.affine import Complexes
from batik_vector.geometry.maps.base import Variation
from batik_vector.geometry.sampling import Array
from batik_vector.values import frozen


@frozen
class Linear(Variation):
    """V(x, y) = (x, y): leaves every point where it is.

    Draves & Reckase, "The Fractal Flame Algorithm", variation 0.
    """

    name: ClassVar[str] = "linear"

    def at(self, z: Complexes, angle: Array | None, branch: int) -> Complexes:
        """Return z."""
        return z

    def wirtinger(self, z: Complexes, branch: int) -> tuple[Complexes, Complexes]:
        """(1, 0)."""
        return np.ones_like(z), np.zeros_like(z)

    def factor(self, branch: int) -> complex | None:
        """1."""
        return 1 + 0j
