"""The superellipse: the paper's leaf."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from batik_vector.fields import Between, Says, Useful
from batik_vector.geometry.curves.base import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen


@frozen
class Superellipse(Curve):
    """Superellipse (Lamé curve), x = r1·sgn(cos t)·|cos t|^a, y = r2·sgn(sin t)·|sin t|^b.

    Implicitly |x/r1|^(2/a) + |y/r2|^(2/b) = 1. For b > 1 the ends at (±r1, 0) are cusps: a leaf.
    Tian et al. 2019, Eq. 5 and 6, over the whole period [0, 2π): the paper's [0, π] is the upper half.
    """

    a: Annotated[
        float,
        Between(0.02, 50),
        Useful(0.1, 1.2),
        Says("how full the leaf is towards its tips", "a", "fullness"),
    ] = 0.2
    b: Annotated[
        float,
        Between(0.02, 50),
        Useful(0.6, 20),
        Says("how pointed the tips are; above 1 they are cusps", "b", "points"),
    ] = 10.0
    length: Annotated[float, Between(1e-3, 1e3), Says("half the long axis", "r1 = 2l")] = 1.0
    width: Annotated[float, Between(1e-3, 1e3), Says("half the short axis", "r2 = l/2")] = 0.25

    def at(self, t: Array) -> Points:
        """Return the points at ``t``; exact at the four tips."""
        quarter = np.floor(t * 4)
        part = t * 4 - quarter
        # sin of part and of its complement: exact 0 and 1 at the ends, where cos(π/2) is not.
        rising, falling = np.sin(np.pi / 2 * part), np.sin(np.pi / 2 * (1 - part))
        turn = quarter.astype(np.intp) % 4
        odd = turn % 2 == 1
        cosine, sine = np.where(odd, rising, falling), np.where(odd, falling, rising)
        x = self.length * cosine**self.a * np.where((turn == 1) | (turn == 2), -1.0, 1.0)
        y = self.width * sine**self.b * np.where(turn >= 2, -1.0, 1.0)
        return np.column_stack([x, y])

    def breaks(self) -> Array:
        """The four tips."""
        return np.array([0.25, 0.5, 0.75])
