"""Curves given by sums of waves: the general polar and parametric curve as plain data."""

from __future__ import annotations

import math
from typing import Annotated, TypeAlias

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Says, check
from batik_vector.geometry.curves.base import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen

Wave: TypeAlias = tuple[
    Annotated[int, Between(0, 256)],
    Annotated[float, Between(-1e3, 1e3)],
    Annotated[float, Between(-360, 360)],
]
"""Frequency (times per period), amplitude, phase in degrees: amplitude · cos(frequency · t + phase)."""


def _sum(waves: tuple[Wave, ...], angle: Array) -> Array:
    total = np.zeros_like(angle)
    for frequency, amplitude, phase in waves:
        total += amplitude * np.cos(frequency * angle + np.radians(phase))
    return total


def _highest(*series: tuple[Wave, ...]) -> int:
    return max((frequency for waves in series for frequency, _, _ in waves), default=1)


def _pauses(highest: int) -> Array:
    """Enough starting points that no wave hides between two of them."""
    parts = max(8, 4 * highest)
    return np.arange(1, parts) / parts


@frozen
class Polar(Curve):
    """Polar curve r(θ) = radius + Σ amplitude·cos(frequency·θ + phase), drawn over [0, 2π)."""

    radius: Annotated[float, Between(-1e3, 1e3), Says("mean radius")] = 1.0
    waves: Annotated[tuple[Wave, ...], Says("waves on the radius: [frequency, amplitude, phase°]")] = (
        (8, 0.1, 0.0),
    )

    def __post_init__(self) -> None:
        check(self)
        if self.radius == 0 and not any(amplitude for _, amplitude, _ in self.waves):
            raise GeometryError("radius 0 without waves is a point")

    def at(self, t: Array) -> Points:
        """Return the points at ``t``; t = 0 is in the direction +x."""
        # Without a mean radius, waves of odd frequencies draw the curve once in half a turn.
        odd = self.radius == 0 and all(frequency % 2 for frequency, amplitude, _ in self.waves if amplitude)
        angle = (np.pi if odd else 2 * np.pi) * t
        radius = self.radius + _sum(self.waves, angle)
        return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])

    def breaks(self) -> Array:
        """Starting points dense enough for the fastest wave."""
        return _pauses(_highest(self.waves))


@frozen
class Parametric(Curve):
    """Closed curve x(t) = Σ waves in x, y(t) = Σ waves in y, t over [0, 2π): a Fourier series.

    Every closed smooth curve is such a sum; Lissajous figures, epicycloids and ellipses are short ones.
    """

    x: Annotated[tuple[Wave, ...], Says("waves in x: [frequency, amplitude, phase°]")] = ((1, 1.0, 0.0),)
    y: Annotated[tuple[Wave, ...], Says("waves in y: [frequency, amplitude, phase°]")] = ((1, 1.0, -90.0),)

    def __post_init__(self) -> None:
        check(self)
        if not all(any(f and a for f, a, _ in waves) for waves in (self.x, self.y)):
            raise GeometryError("x and y each need a wave with a frequency and an amplitude")
        if self._retraces():
            raise GeometryError("the curve runs back over itself: another phase in x or y opens it")

    def at(self, t: Array) -> Points:
        """Return the points at ``t``."""
        # Frequencies with a common factor repeat the curve that many times: once is enough.
        angle = 2 * np.pi / self._common * t
        return np.column_stack([_sum(self.x, angle), _sum(self.y, angle)])

    @property
    def _common(self) -> int:
        return math.gcd(
            *(frequency for frequency, amplitude, _ in (*self.x, *self.y) if frequency and amplitude)
        )

    def breaks(self) -> Array:
        """Starting points dense enough for the fastest wave."""
        return _pauses(_highest(self.x, self.y) // self._common)

    def _retraces(self) -> bool:
        """Whether the second half of the curve is the first one drawn backwards."""
        t = np.arange(1, 64) / 64
        frequency, _, phase = next(wave for wave in self.x if wave[0] and wave[1])
        # A curve that turns back does so where every wave stands at an extreme, the first one too.
        for half in range(2 * frequency):
            turn = (half / 2 - phase / 360) / frequency * self._common
            if np.abs(self.at(turn + t / 2) - self.at(turn - t / 2)).max() < 1e-9:
                return True
        return False
