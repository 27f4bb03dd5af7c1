"""The spiral: Miao *wotuo* whorls and fern heads, an open line."""

from __future__ import annotations

from typing import Annotated, ClassVar

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves.base import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen


@frozen
class Spiral(Curve):
    """Archimedean spiral r = inner + (radius − inner)·t over a number of turns, from the inside outwards.

    https://mathworld.wolfram.com/ArchimedesSpiral.html
    """

    closed: ClassVar[bool] = False
    revolutions: Annotated[float, Between(0.05, 100), Says("turns from the inner end to the outer")] = 3.0
    radius: Annotated[float, Between(1e-3, 1e3), Says("distance of the outer end from the centre")] = 1.0
    inner: Annotated[float, Between(0, 1e3), Says("distance of the inner end from the centre")] = 0.1

    def at(self, t: Array) -> Points:
        """Return the points at ``t``; t = 1 is the outer end, on +x."""
        angle = 2 * np.pi * self.revolutions * (t - 1)
        radius = self.inner + (self.radius - self.inner) * t
        return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])

    def breaks(self) -> Array:
        """Starting points on every turn."""
        parts = max(2, int(4 * self.revolutions))
        return np.arange(1, parts) / parts
