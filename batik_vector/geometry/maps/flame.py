"""The map of an iterated function system: post ∘ (Σ_j w_j V_j) ∘ pre."""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.geometry.maps.affine import IDENTITY, Affine, Complexes
from batik_vector.geometry.maps.base import Variation
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen

STRETCH_CAP = 1e6
"""Where a map is infinitely steep (the origin of JuliaN with P2 < P1) a finite number must do. Curves
through such a point run straight into it, so finer sampling there would buy nothing."""

MAX_BRANCHES = 4096


@frozen
class FlameMap:
    """F = post ∘ (Σ_j w_j V_j) ∘ pre, as a value.

    Curves and regions are carried by it in :mod:`~batik_vector.geometry.maps.images`.
    ``terms`` are (weight, variation). The branches of a sum are all combinations of its terms' branches,
    the first term's running fastest.
    Draves & Reckase, "The Fractal Flame Algorithm", §3; Tian et al. 2019, Eqs. 7–23.
    """

    terms: tuple[tuple[float, Variation], ...]
    pre: Affine = IDENTITY
    post: Affine = IDENTITY

    def __post_init__(self) -> None:
        if not self.terms:
            raise GeometryError("a map needs at least one variation")
        for weight, variation in self.terms:
            if not math.isfinite(weight) or weight == 0:
                raise GeometryError(
                    f"the weight of {variation.name} is {weight}, expected a number other than 0"
                )
        if self.branches > MAX_BRANCHES:
            raise GeometryError(f"a map of {self.branches} branches, expected at most {MAX_BRANCHES}")

    @property
    def branches(self) -> int:
        """How many images each point has."""
        return math.prod(variation.branches for _, variation in self.terms)

    def at(self, points: Points, branch: int = 0) -> Points:
        """Return the images of single points, shape (n, 2), on one branch (principal angles)."""
        z = self.pre.at_complex(np.ascontiguousarray(points, np.float64).view(np.complex128)[:, 0])
        image = self.post.at_complex(self.core(z, None, branch))
        return np.column_stack([image.real, image.imag])

    def every(self, points: Points) -> list[Points]:
        """Return the images of single points, shape (n, 2), on every branch."""
        if len(self.terms) > 1:
            return [self.at(points, branch) for branch in range(self.branches)]
        ((weight, variation),) = self.terms
        z = self.pre.at_complex(np.ascontiguousarray(points, np.float64).view(np.complex128)[:, 0])
        images = [self.post.at_complex(_times(weight, part)) for part in variation.every(z)]
        return [np.column_stack([image.real, image.imag]) for image in images]

    def stretch(self, points: Points) -> Array:
        """Return the largest magnification of lengths at each point, shape (n,), over all branches.

        A chord that stands e off a curve at z stands at most about e·stretch(z) off its image. Near
        points where a map is infinitely steep the value is held at ``STRETCH_CAP``.
        """
        z = self.pre.at_complex(np.ascontiguousarray(points, np.float64).view(np.complex128)[:, 0])
        worst = np.zeros(len(z))
        # One term: its branches differ by turns only.
        for branch in range(self.branches if len(self.terms) > 1 else 1):
            p, q = np.zeros(len(z), complex), np.zeros(len(z), complex)
            for (weight, variation), digit in zip(self.terms, self.digits(branch), strict=True):
                along, across = variation.wirtinger(z, digit)
                with np.errstate(invalid="ignore"):
                    p, q = p + weight * along, q + weight * across
            steep = np.nan_to_num(np.abs(p) + np.abs(q), nan=STRETCH_CAP, posinf=STRETCH_CAP)
            worst = np.maximum(worst, steep)
        return np.minimum(worst * (self.pre.stretch * self.post.stretch), STRETCH_CAP)

    def affine_branches(self) -> list[Affine] | None:
        """Return every branch as an affine map, exactly, or None where one of them bends."""
        maps = []
        for branch in range(self.branches):
            total = 0j
            for (weight, variation), digit in zip(self.terms, self.digits(branch), strict=True):
                factor = variation.factor(digit)
                if factor is None:
                    return None
                total += weight * factor
            maps.append(self.post @ Affine.similarity(total) @ self.pre)
        return maps

    def digits(self, branch: int) -> tuple[int, ...]:
        """Return the branch of each term that makes up a branch of the sum."""
        found = []
        for _, variation in self.terms:
            branch, digit = divmod(branch, variation.branches)
            found.append(digit)
        return tuple(found)

    def core(self, z: Complexes, angle: Array | None, branch: int) -> Complexes:
        """Return Σ_j w_j V_j(z), between pre and post."""
        total: Complexes | None = None
        for (weight, variation), digit in zip(self.terms, self.digits(branch), strict=True):
            part = variation.at(z, angle, digit)
            part = _times(weight, part)
            total = part if total is None else total + part
        assert total is not None
        return total

    @cached_property
    def sheets(self) -> int:
        """After how many turns about the branch point an image closes."""
        return math.lcm(*(variation.sheets for _, variation in self.terms))

    @cached_property
    def singular(self) -> bool:
        """Whether the core is not smooth at its origin."""
        return any(variation.singular for _, variation in self.terms)

    @cached_property
    def poles(self) -> tuple[str, ...]:
        """The names of the terms that send their origin to infinity."""
        return tuple(variation.name for _, variation in self.terms if variation.pole)


def _times(weight: float, part: Complexes) -> Complexes:
    return part if weight == 1 else np.asarray(weight * part)
