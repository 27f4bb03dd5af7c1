"""The circle: the heart of the paper's core, and every dot (*cecek*)."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves.base import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen


@frozen
class Circle(Curve):
    """Circle about the origin: x = r cos t, y = r sin t. Tian et al. 2019, Eq. 19."""

    radius: Annotated[float, Between(1e-3, 1e3), Says("radius", "a3")] = 0.1

    def at(self, t: Array) -> Points:
        """Return the points at ``t``; t = 0 is on +x."""
        angle = 2 * np.pi * t
        return np.column_stack([self.radius * np.cos(angle), self.radius * np.sin(angle)])

    def breaks(self) -> Array:
        """The quarters, so that a circle keeps its four-fold symmetry when sampled."""
        return np.array([0.25, 0.5, 0.75])
