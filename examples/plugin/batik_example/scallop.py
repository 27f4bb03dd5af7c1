"""The scallop: a round whose edge is made of bows, as of a collar or a doily."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from batik_vector.fields import Between, Says, Useful
from batik_vector.geometry.curves import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen


@frozen
class Scallop(Curve):
    """Scalloped round: r = radius (1 - depth + depth |cos(lobes θ / 2)|), with a corner between two bows."""

    lobes: Annotated[int, Between(3, 200), Useful(6, 24), Says("bows round it")] = 12
    depth: Annotated[
        float, Between(0, 0.9), Useful(0.05, 0.3), Says("depth of the notches, of the radius")
    ] = 0.15
    radius: Annotated[float, Between(1e-3, 1e3), Says("radius to the tops of the bows")] = 1.0

    def at(self, t: Array) -> Points:
        """Return the points at ``t``; t = 0 is the top of a bow, on +x."""
        angle = 2 * np.pi * t
        r = self.radius * (1 - self.depth + self.depth * np.abs(np.cos(self.lobes * angle / 2)))
        return np.column_stack([r * np.cos(angle), r * np.sin(angle)])

    def breaks(self) -> Array:
        """The notches: sampling must stop where a curve has a corner."""
        return (np.arange(self.lobes) + 0.5) / self.lobes
