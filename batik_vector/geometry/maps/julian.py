"""JuliaN: the paper's layout function, in the three readings that MATH §3 tells apart."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, Literal

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Says, check
from batik_vector.geometry.maps.affine import Complexes, unit_power
from batik_vector.geometry.maps.base import Variation
from batik_vector.geometry.sampling import Array
from batik_vector.values import frozen

Reading = Literal["rotate", "root", "literal"]
READINGS: tuple[Reading, ...] = ("rotate", "root", "literal")


@frozen
class JuliaN(Variation):
    """JuliaN of power P1 and distance P2, k = 0 … |P1| − 1.

    ``rotate``: r' = r^(P2/P1), θ' = θ + 2πk/P1: P1 copies turned about the origin, undistorted at P2 = P1.
    ``root``: r' = r^(P2/P1), θ' = (θ + 2πk)/P1: at P2 = 1 the conformal root z^(1/P1).
    ``literal``: x' = r^(P1/P2)·cos(arccos(x/r) + 2π/P1), y' = r^(P1/P2)·sin(arcsin(y/r) + 2π/P2), one
    branch, folded along the axes: Eq. 22 as printed, for comparison with the paper only.

    Where the exponent of r is negative the origin goes to infinity, and what touches it is refused.
    Tian et al. 2019, Eq. 22; Draves & Reckase, "The Fractal Flame Algorithm", variation JuliaN.
    """

    name: ClassVar[str] = "julian"

    power: Annotated[int, Between(-64, 64), Says("number of copies about the origin, not 0", "P1")] = 4
    dist: Annotated[float, Between(-4096, 4096), Says("spread of the copies: power keeps shapes", "P2")] = 4.0
    reading: Annotated[Reading, Says("rotate (the paper's layouts), root (flam3's) or literal")] = "rotate"

    def __post_init__(self) -> None:
        check(self)
        if self.power == 0:
            raise GeometryError("power = 0: JuliaN needs at least one copy, expected -64 to -1 or 1 to 64")
        if abs(self.dist) < 1e-6:
            raise GeometryError(f"dist = {self.dist}: every point would land on the unit circle")

    @property
    def exponent(self) -> float:
        """The power of r."""
        return self.power / self.dist if self.reading == "literal" else self.dist / self.power

    @property
    def rate(self) -> float:
        """How fast the image's angle turns with the point's."""
        return 1 / self.power if self.reading == "root" else 1.0

    @property
    def branches(self) -> int:
        """|P1|, or 1 as printed."""
        return 1 if self.reading == "literal" else abs(self.power)

    @property
    def sheets(self) -> int:
        """|P1| under ``root``."""
        return abs(self.power) if self.reading == "root" else 1

    @property
    def singular(self) -> bool:
        """Not smooth at the origin, unless it is a plain turn."""
        return self.factor(0) is None

    @property
    def pole(self) -> bool:
        """Whether the exponent is negative."""
        return self.exponent < 0

    @property
    def folds(self) -> bool:
        """As printed, the plane is folded along the axes."""
        return self.reading == "literal"

    def factor(self, branch: int) -> complex | None:
        """e^(2πik/P1) where neither radius nor angle is bent."""
        if self.reading != "literal" and self.exponent == 1 and self.rate == 1:
            return self.spin(branch)
        return None

    def spin(self, branch: int) -> complex:
        """Return the last turn, e^(2πik/P1)."""
        return unit_power(branch * (1 if self.power > 0 else -1), abs(self.power))

    def creases(self, low: float, high: float) -> Array:
        """As printed: the axes."""
        return np.zeros(1) if self.folds and low < 0 < high else np.empty(0)

    def at(self, z: Complexes, angle: Array | None, branch: int) -> Complexes:
        """Return the image on one branch."""
        if self.reading == "literal":
            return self._literal(z)
        square = z.real**2 + z.imag**2
        q = self.exponent
        with np.errstate(divide="ignore", invalid="ignore"):
            if self.reading == "rotate":
                image = z if q == 1 else z * square ** ((q - 1) / 2)
            else:
                turned = (np.angle(z) if angle is None else angle) * self.rate
                image = square ** (q / 2) * (np.cos(turned) + 1j * np.sin(turned))
        if q > 0:
            image = np.where(square == 0, 0, image)
        return image if branch == 0 else np.asarray(image * self.spin(branch))

    def every(self, z: Complexes) -> list[Complexes]:
        """Return the image on every branch: the power is raised once."""
        image = self.at(z, None, 0)
        return [image, *(np.asarray(image * self.spin(branch)) for branch in range(1, self.branches))]

    def wirtinger(self, z: Complexes, branch: int) -> tuple[Complexes, Complexes]:
        """With w = r^q·e^(imθ): ((q + m)/2·w/z, (q − m)/2·w/z̄)."""
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            if self.reading == "literal":
                return self._literal_wirtinger(z)
            image, q, m = self.at(z, None, branch), self.exponent, self.rate
            return np.asarray((q + m) / 2 * image / z), np.asarray((q - m) / 2 * image / np.conj(z))

    def _angles(self, z: Complexes) -> tuple[Array, Array, Array, Array]:
        """The two angles as printed, and their slopes in θ."""
        theta = np.angle(z)
        left = np.abs(theta) > math.pi / 2
        first = np.abs(theta) + 2 * math.pi / self.power
        second = np.where(left, np.copysign(math.pi, theta) - theta, theta) + 2 * math.pi / self.dist
        return first, second, np.where(theta < 0, -1.0, 1.0), np.where(left, -1.0, 1.0)

    def _literal(self, z: Complexes) -> Complexes:
        first, second, _, _ = self._angles(z)
        square = z.real**2 + z.imag**2
        with np.errstate(divide="ignore", invalid="ignore"):
            radius = square ** (self.exponent / 2)
        return np.asarray(radius * np.cos(first) + 1j * (radius * np.sin(second)))

    def _literal_wirtinger(self, z: Complexes) -> tuple[Complexes, Complexes]:
        first, second, slope1, slope2 = self._angles(z)
        r = np.abs(z)
        scale = r ** (self.exponent - 1)
        outward = self.exponent * scale * (np.cos(first) + 1j * np.sin(second))
        around = scale * (-slope1 * np.sin(first) + 1j * slope2 * np.cos(second))
        unit = z / r
        along = np.conj(unit) / 2 * (outward - 1j * around)
        return np.asarray(along), np.asarray(unit / 2 * (outward + 1j * around))
