"""Straight-sided figures: the regular polygon and the star."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves.base import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen


class _Corners(Curve):
    """A closed figure of straight sides between its corners."""

    def corners(self) -> Points:
        """Return the corners in drawing order, shape (n, 2)."""
        raise NotImplementedError

    def at(self, t: Array) -> Points:
        """Return the points at ``t``; corners stand at the whole multiples of 1/n."""
        corners = self.corners()
        n = len(corners)
        side = t * n
        whole = np.rint(side)
        side = np.where(np.abs(side - whole) < 1e-12 * n, whole, side)
        index = np.floor(side).astype(np.intp)
        part = (side - index)[:, None]
        return np.asarray(corners[index % n] * (1 - part) + corners[(index + 1) % n] * part)

    def breaks(self) -> Array:
        """The corners."""
        n = len(self.corners())
        return np.arange(1, n) / n


@frozen
class Polygon(_Corners):
    """Regular polygon with its first corner on +x."""

    sides: Annotated[int, Between(3, 360), Says("number of sides")] = 4
    radius: Annotated[float, Between(1e-3, 1e3), Says("distance of the corners from the centre")] = 1.0

    def corners(self) -> Points:
        """Return the corners, shape (sides, 2)."""
        angle = 2 * np.pi * np.arange(self.sides) / self.sides
        return np.column_stack([self.radius * np.cos(angle), self.radius * np.sin(angle)])


@frozen
class Star(_Corners):
    """Star of straight sides: points at ``radius``, notches between them at ``inner``."""

    points: Annotated[int, Between(2, 360), Says("number of points")] = 8
    radius: Annotated[float, Between(1e-3, 1e3), Says("distance of the points from the centre")] = 1.0
    inner: Annotated[float, Between(1e-3, 1e3), Says("distance of the notches from the centre")] = 0.5

    def corners(self) -> Points:
        """Return points and notches in turn, shape (2 · points, 2)."""
        angle = np.pi * np.arange(2 * self.points) / self.points
        radius = np.where(np.arange(2 * self.points) % 2 == 0, self.radius, self.inner)
        return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
