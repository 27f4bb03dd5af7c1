"""The hypocycloid: the paper's pistil."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Says, Useful, check
from batik_vector.geometry.curves.base import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen


@frozen
class Hypocycloid(Curve):
    """Hypocycloid with q = m/n: x = (r/q)((q−1)cos t + cos((q−1)t)), y = (r/q)((q−1)sin t − sin((q−1)t)).

    With g = gcd(m, n) it closes after 2πn/g and has m/g cusps; g copies turned by 2π/m show all m.
    Tian et al. 2019, Eq. 13; over the paper's [0, 20π] the curve is traced up to ten times.
    """

    m: Annotated[int, Between(2, 96), Useful(5, 24), Says("cusps", "m", "cusps")] = 16
    n: Annotated[int, Between(1, 48), Says("how far apart joined cusps stand", "n", "steps")] = 5
    length: Annotated[float, Between(1e-3, 1e3), Says("distance of the cusps from the centre", "r1")] = 0.8

    def __post_init__(self) -> None:
        check(self)
        if self.m == self.n:
            raise GeometryError(f"m = n = {self.m} is a point: {self._neighbours()}")
        if self.m == 2 * self.n:
            raise GeometryError(f"m = {self.m} is twice n = {self.n}, a line segment: {self._neighbours()}")
        if self.m < self.n:
            raise GeometryError(
                f"m = {self.m} below n = {self.n} swings past its radius: {self._neighbours()}"
            )

    def _neighbours(self) -> str:
        """Name the values of m nearest to the one asked for that draw a star of full size."""
        good = [m for m in range(self.n + 1, 97) if m != 2 * self.n]
        near = sorted(sorted(good, key=lambda m: (abs(m - self.m), m))[:3])
        return f"with n = {self.n} try m = {', '.join(map(str, near))}"

    @property
    def copies(self) -> int:
        """How many turned copies of the closed curve show all m cusps."""
        return math.gcd(self.m, self.n)

    def at(self, t: Array) -> Points:
        """Return the points at ``t``; t = 0 is a cusp on +x."""
        angle = 2 * np.pi * (self.n // self.copies) * t
        q = self.m / self.n
        r = self.length / q
        x = r * ((q - 1) * np.cos(angle) + np.cos((q - 1) * angle))
        y = r * ((q - 1) * np.sin(angle) - np.sin((q - 1) * angle))
        return np.column_stack([x, y])

    def breaks(self) -> Array:
        """The cusps."""
        return np.arange(1, self.arcs()) / self.arcs()

    def arcs(self) -> int:
        """One from each cusp to the next."""
        return self.m // self.copies

    def turns(self) -> Array:
        """The angles of the copies."""
        return np.asarray(np.arange(self.copies) * (2 * np.pi / self.m), float)
