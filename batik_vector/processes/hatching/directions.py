"""Directions as whole numbers, so that the side of a line on which a point lies is decided exactly."""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Steps
from batik_vector.values import frozen

UNIT = 1 << 20
"""How long a direction is, about: rounded to whole numbers it is off by half a step on a metre at most."""

Whole: TypeAlias = NDArray[np.int64]


@frozen
class Direction:
    """A direction (right, up) in whole numbers, ``UNIT`` long, about."""

    right: int
    up: int

    @staticmethod
    def of(angle: float) -> Direction:
        """Return the direction at so many degrees anticlockwise from the right."""
        # Turned back into the half circle: lines have no sense, and lie at 200° where they lie at 20°.
        turn = math.radians(math.fmod(math.fmod(angle, 180.0) + 180.0, 180.0))
        return Direction(round(math.cos(turn) * UNIT), round(math.sin(turn) * UNIT))

    @property
    def length(self) -> float:
        """How long it is."""
        return math.sqrt(self.right * self.right + self.up * self.up)

    def across(self, points: Steps) -> Whole:
        """Return how far to the left of the line through (0, 0) points lie, in 1/``length`` steps: (n,)."""
        found: Whole = points[:, 1] * self.right - points[:, 0] * self.up
        return found

    def along(self, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how far points lie ahead, likewise."""
        return x * self.right + y * self.up
