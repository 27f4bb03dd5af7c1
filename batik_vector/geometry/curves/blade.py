"""The blade: leaf, petal, feather and fin, from the base along a bent midrib to the tip."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Says, check
from batik_vector.geometry.curves.base import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen

NARROWEST = 0.95
"""How near the half breadth may come to the radius of the midrib: past it the inner side would fold."""


@frozen
class Blade(Curve):
    """Blade: half breadth width·(u/m)^base·((1−u)/(1−m))^tip at a share u of its length, m = base/(base+tip).

    It runs from the origin along +x; its midrib is an arc of a circle that turns by ``bend`` in all.
    Powers below 1 round an end off (½ as an ellipse has it), 1 makes a corner of it and
    more a point. Petals, leaves, feathers and fins are of this family: outlines like the beta distribution's.
    """

    length: Annotated[float, Between(1e-3, 1e3), Says("length of the midrib")] = 1.0
    width: Annotated[float, Between(1e-3, 1e3), Says("half the breadth where it is broadest")] = 0.25
    base: Annotated[float, Between(0.35, 6), Says("power at the base: below 1 round, above drawn out")] = 0.7
    tip: Annotated[float, Between(0.35, 6), Says("power at the tip, likewise")] = 1.0
    bend: Annotated[float, Between(-300, 300), Says("degrees by which the midrib turns, to the left")] = 0.0
    lean: Annotated[float, Between(-1, 1), Says("how much broader its left side is than its right")] = 0.0
    teeth: Annotated[int, Between(0, 64), Says("waves along each side; 0 leaves it smooth")] = 0
    depth: Annotated[float, Between(0, 0.6), Says("depth of the waves, as a share of the breadth")] = 0.12

    def __post_init__(self) -> None:
        check(self)
        swell = 1 + abs(self.lean)
        tightest = self.width * swell * abs(math.radians(self.bend)) / self.length
        if tightest > NARROWEST:
            most = math.floor(math.degrees(NARROWEST * self.length / (self.width * swell)))
            raise GeometryError(
                f"bend = {self.bend:g} folds a blade so broad over itself: expected {-most} to {most}, "
                "or a smaller width"
            )

    def at(self, t: Array) -> Points:
        """Return the points at ``t``: 0 is the base, ½ the tip; up the right side and down the left."""
        left = t > 0.5
        # Slow at both ends, where a root of u is steep.
        share = np.sin(np.pi * np.minimum(t, 1 - t)) ** 2
        return self.spread(share, np.where(left, 1.0, -1.0))

    def spread(self, share: Array, side: Array) -> Points:
        """Return the points at shares of the length, ``side`` half breadths left of the midrib."""
        # Across a full breadth the lean shifts the sides, and leaves the midrib where it is.
        across = self.half(share) * side * (1 + self.lean * np.sign(side))
        angle = math.radians(self.bend) * share
        # The chord of the midrib so far; by sinc, as a slight bend has its centre far off.
        chord = self.length * share * np.sinc(angle / (2 * np.pi))
        x = chord * np.cos(angle / 2) - across * np.sin(angle)
        y = chord * np.sin(angle / 2) + across * np.cos(angle)
        return np.column_stack([x, y])

    def half(self, share: Array) -> Array:
        """Return the half breadth at shares of the length."""
        middle = self.base / (self.base + self.tip)
        breadth = self.width * (share / middle) ** self.base * ((1 - share) / (1 - middle)) ** self.tip
        if not self.teeth:
            return np.asarray(breadth)
        return np.asarray(breadth * (1 - self.depth * (0.5 - 0.5 * np.cos(2 * np.pi * self.teeth * share))))

    def breaks(self) -> Array:
        """The tip, and enough besides that no wave hides."""
        parts = 2 * max(1, 4 * self.teeth)
        return np.arange(1, parts) / parts
