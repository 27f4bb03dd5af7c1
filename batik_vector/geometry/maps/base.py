"""What a variation is: one of the V_j that a map of an iterated function system sums."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from batik_vector.geometry.maps.affine import Complexes
from batik_vector.geometry.sampling import Array, Indices


class Variation:
    """A plane map z ↦ V(z), possibly of several branches.

    Variations are frozen dataclasses whose fields carry their bounds. A new one implements :meth:`at`
    and :meth:`wirtinger`, and says below where it is not smooth; then every map that sums it knows how
    to carry curves and regions through it. Points are complex numbers x + iy.
    """

    name: ClassVar[str] = ""

    @property
    def branches(self) -> int:
        """How many images each point has."""
        return 1

    @property
    def sheets(self) -> int:
        """After how many turns about the origin the image closes: more than 1 means a branch cut."""
        return 1

    @property
    def singular(self) -> bool:
        """Whether the map is not smooth at the origin."""
        return False

    @property
    def pole(self) -> bool:
        """Whether the origin goes to infinity."""
        return False

    @property
    def folds(self) -> bool:
        """Whether the plane is folded at the creases, so that regions must be cut there."""
        return False

    def at(self, z: Complexes, angle: Array | None, branch: int) -> Complexes:
        """Return V(z) on one branch.

        Args:
            z: the points.
            angle: their polar angles, followed continuously along a curve; None stands for the
                principal ones. Only variations with several sheets look at it.
            branch: from 0 to ``branches - 1``.
        """
        raise NotImplementedError

    def every(self, z: Complexes) -> list[Complexes]:
        """Return V(z) on every branch, by principal angles: as :meth:`at` does, to the bit."""
        return [self.at(z, None, branch) for branch in range(self.branches)]

    def wirtinger(self, z: Complexes, branch: int) -> tuple[Complexes, Complexes]:
        """Return (∂V/∂z, ∂V/∂z̄); |∂z| + |∂z̄| is the largest local stretch."""
        raise NotImplementedError

    def factor(self, branch: int) -> complex | None:
        """Return m where the branch is z ↦ m·z exactly, else None."""
        return None

    def spin(self, branch: int) -> complex:
        """Return e^(iφ) with V_branch = e^(iφ)·V_0: branches differ by a turn about the origin only."""
        return 1 + 0j

    def creases(self, low: float, high: float) -> Array:
        """Return the c in [low, high] for which the lines x = c and y = c are creases."""
        return np.empty(0)

    def parts(self, start: Complexes, end: Complexes) -> Indices:
        """Return into how many parts an edge must be cut, lest a whole wave hide between samples."""
        return np.ones(len(start), np.intp)
