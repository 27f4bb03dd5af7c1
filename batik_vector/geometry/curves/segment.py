"""The straight line: *sawut* strokes, and grounds of parallel lines."""

from __future__ import annotations

from typing import Annotated, ClassVar

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves.base import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen


@frozen
class Segment(Curve):
    """Straight line from (0, 0) to (length, 0).

    https://mathworld.wolfram.com/LineSegment.html
    """

    closed: ClassVar[bool] = False
    length: Annotated[float, Between(1e-3, 1e3), Says("length of the line")] = 1.0

    def at(self, t: Array) -> Points:
        """Return the points at ``t``; t = 0 is the origin."""
        return np.column_stack([self.length * t, np.zeros_like(t)])
