"""The butterfly curve: four wings from one formula, drawn again and again a little differently."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves.base import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen

TURNS = 12
"""Turns after which the fringe begins again."""


@frozen
class Butterfly(Curve):
    """Butterfly curve r = e^sin t − wings·cos 4t + fringe·sin⁵((2t − π)/24), head up.

    With a fringe it is drawn once over 24π, in twelve turns that begin at the head. Without, it closes after
    2π; ``level`` is added to every radius, so that one butterfly lies within another.
    T. H. Fay, "The Butterfly Curve", American Mathematical Monthly 96 (1989) 442–443.
    """

    length: Annotated[float, Between(1e-3, 1e3), Says("distance of the tips of the wings, about")] = 1.0
    wings: Annotated[float, Between(1.2, 6), Says("how deeply the wings are parted")] = 2.0
    fringe: Annotated[float, Between(0, 1), Says("how far the turns lie apart; 0 draws one")] = 1.0
    level: Annotated[float, Between(-2, 2), Says("added to the radius: a wider or narrower butterfly")] = 0.0

    def at(self, t: Array) -> Points:
        """Return the points at ``t``; t = 0 is where the axis crosses the head's side."""
        angle = 2 * np.pi * self.turns_drawn * t + np.pi / 2
        radius = np.exp(np.sin(angle)) - self.wings * np.cos(4 * angle) + self.level
        if self.fringe:
            radius = radius + self.fringe * np.sin((2 * angle - np.pi) / 24) ** 5
        radius = radius * (self.length / REACH)
        return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])

    @property
    def turns_drawn(self) -> int:
        """Turns about the centre until the curve closes."""
        return TURNS if self.fringe else 1

    def breaks(self) -> Array:
        """Starting points dense enough for its lobes."""
        parts = 32 * self.turns_drawn
        return np.arange(1, parts) / parts


REACH = 4.2
"""How far the upper wings reach in Fay's own units: about e^sin 45° + 2."""
