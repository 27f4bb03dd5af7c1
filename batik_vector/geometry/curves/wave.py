"""The wave: water and wind, and grounds of waving lines."""

from __future__ import annotations

from typing import Annotated, ClassVar

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves.base import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen


@frozen
class Wave(Curve):
    """Sine line y = amplitude · sin(2π · waves · x / length + phase), x from 0 to length.

    With a whole number of waves it ends as it begins, so that the next goes on from it without a kink.
    https://mathworld.wolfram.com/SineCurve.html
    """

    closed: ClassVar[bool] = False
    waves: Annotated[int, Between(1, 256), Says("waves from end to end")] = 1
    amplitude: Annotated[float, Between(0, 1e3), Says("height of a crest above the middle")] = 0.25
    phase: Annotated[float, Between(-360, 360), Says("degrees of a wave at which the line begins")] = 0.0
    length: Annotated[float, Between(1e-3, 1e3), Says("distance of the ends from each other")] = 1.0

    def at(self, t: Array) -> Points:
        """Return the points at ``t``; both ends stand at the same height to the bit."""
        # Whole waves are taken off first, for the sine of 2πk is not quite zero.
        angle = 2 * np.pi * ((self.waves * t) % 1.0) + np.radians(self.phase)
        return np.column_stack([self.length * t, self.amplitude * np.sin(angle)])

    def breaks(self) -> Array:
        """Starting points on every wave."""
        parts = 4 * self.waves
        return np.arange(1, parts) / parts
