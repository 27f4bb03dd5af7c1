"""The swirl variation: turns each circle about the origin by the square of its radius."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from batik_vector.geometry.maps.affine import Complexes
from batik_vector.geometry.maps.base import Variation
from batik_vector.geometry.sampling import Array, Indices
from batik_vector.values import frozen


@frozen
class Swirl(Variation):
    """V(x, y) = (x·sin r² − y·cos r², x·cos r² + y·sin r²), that is i·z·e^(−ir²).

    Smooth and injective, but far from the origin it winds very tightly.
    Draves & Reckase, "The Fractal Flame Algorithm", variation 3.
    """

    name: ClassVar[str] = "swirl"

    def at(self, z: Complexes, angle: Array | None, branch: int) -> Complexes:
        """Return i·z·e^(−ir²)."""
        square = z.real**2 + z.imag**2
        return np.asarray(z * (np.sin(square) + 1j * np.cos(square)))

    def wirtinger(self, z: Complexes, branch: int) -> tuple[Complexes, Complexes]:
        """(i·e^(−ir²)·(1 − ir²), z²·e^(−ir²))."""
        square = z.real**2 + z.imag**2
        turn = np.exp(-1j * square)
        return np.asarray(1j * turn * (1 - 1j * square)), np.asarray(z * z * turn)

    def parts(self, start: Complexes, end: Complexes) -> Indices:
        """Less than a radian of turn between samples: r² grows by at most 2·r·|dz| along an edge."""
        reach = np.maximum(np.abs(start), np.abs(end))
        return np.asarray(np.maximum(np.ceil(2 * reach * np.abs(end - start)), 1), np.intp)
