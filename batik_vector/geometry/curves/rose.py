"""The rose: the paper's petal and core."""

from __future__ import annotations

import itertools
import math
from typing import Annotated

import numpy as np

from batik_vector.fields import Between, Says, Useful
from batik_vector.geometry.curves.base import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen


@frozen
class Rose(Curve):
    """Rose (rhodonea), r = length·cos(nθ/d) with n/d in lowest terms.

    Drawn once over πd when n·d is odd, else 2πd; a first petal points along +x. Every petal begins and
    ends in the centre, so as a region it is built petal by petal.
    Tian et al. 2019, Eq. 9; https://mathworld.wolfram.com/RoseCurve.html
    """

    n: Annotated[
        int, Between(1, 128), Useful(2, 12), Says("petals: n when n·d is odd, 2n when even", "n", "petals")
    ] = 2
    d: Annotated[int, Between(1, 64), Says("how often the petals overlap", called="overlap")] = 1
    length: Annotated[float, Between(1e-3, 1e3), Says("length of a petal", "a1")] = 1.0

    @property
    def petals(self) -> int:
        """How many petals the whole figure has."""
        n, d = self._lowest()
        return n if n * d % 2 else 2 * n

    def _lowest(self) -> tuple[int, int]:
        g = math.gcd(self.n, self.d)
        return self.n // g, self.d // g

    def at(self, t: Array) -> Points:
        """Return the points at ``t``; t = 0 is the centre, where the petal along +x begins."""
        n, d = self._lowest()
        lobe = t * self.petals
        whole = np.rint(lobe)
        # Exactly 0 in the centre, so that petals meet there in one point.
        part = np.where(np.abs(lobe - whole) < 1e-13 * np.maximum(whole, 1), whole, lobe)
        phase = np.pi * (part - 0.5)
        near = np.floor(part)
        sign = np.where(near.astype(np.intp) % 2 == 0, 1.0, -1.0)
        radius = self.length * np.sin(np.pi * (part - near)) * sign
        angle = phase * d / n
        return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])

    def breaks(self) -> Array:
        """Every passage through the centre."""
        return np.arange(1, self.petals) / self.petals

    def arcs(self) -> int:
        """One for each petal."""
        return self.petals

    def loops(self) -> list[tuple[float, float]]:
        """One ring per petal."""
        edges = np.arange(self.petals + 1) / self.petals
        return [(float(a), float(b)) for a, b in itertools.pairwise(edges)]


@frozen
class Petal(Curve):
    """One petal of the rose r = length·cos(nθ), |θ| ≤ π/2n, from the centre along +x and back."""

    n: Annotated[
        int, Between(1, 64), Useful(2, 6), Says("the rose it is of; the larger, the slimmer", "n", "slimness")
    ] = 2
    length: Annotated[float, Between(1e-3, 1e3), Says("length of the petal", "a1")] = 1.0

    def at(self, t: Array) -> Points:
        """Return the points at ``t``; t = 0 and 1 are the centre, exactly."""
        radius = self.length * np.sin(np.pi * np.minimum(t, 1 - t))
        angle = np.pi * (t - 0.5) / self.n
        return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])

    def breaks(self) -> Array:
        """The tip, so that both halves are sampled alike."""
        return np.array([0.5])
