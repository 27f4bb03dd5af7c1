"""The map of an iterated function system: post ∘ (Σ_j w_j V_j) ∘ pre."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property
from typing import NamedTuple, TypeAlias

import numpy as np
import shapely

from batik_vector.errors import GeometryError
from batik_vector.geometry.maps.affine import IDENTITY, Affine, Complexes
from batik_vector.geometry.maps.affines import Affines
from batik_vector.geometry.maps.base import Variation
from batik_vector.geometry.sampling import Array, Geometries, Indices, Points
from batik_vector.values import frozen

STRETCH_CAP = 1e6
"""Where a map is infinitely steep (the origin of JuliaN with P2 < P1) a finite number must do. Curves
through such a point run straight into it, so finer sampling there would buy nothing."""

Tolerance: TypeAlias = float | Callable[[Points], Array]
"""One tolerance, or a function of points in the image where it varies; the images are then left dense,
to be thinned further on."""

MAX_BRANCHES = 4096


class Images(NamedTuple):
    """What became of an array of marks: the images, branch after branch and within one in source order.

    ``source[i]`` is the index of the mark that image i comes from, ``branch[i]`` the branch it lies on.
    A region that winds round the origin has one image on all branches together: it counts to branch 0.
    A mark that is cut (a fold, an arc that ends in the origin) has several images on one branch.
    """

    geometries: Geometries
    source: Indices
    branch: Indices


NO_IMAGES = Images(np.empty(0, dtype=object), np.empty(0, np.intp), np.empty(0, np.intp))


@frozen
class FlameMap:
    """F = post ∘ (Σ_j w_j V_j) ∘ pre, carrying whole curves and regions.

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

    def areas(self, polygons: Geometries, tolerance: Tolerance) -> Images:
        """Return the images of polygons.

        Args:
            polygons: valid polygons (no multipolygons), shape (n,).
            tolerance: how far an edge may stand from the exact image of the given edges.

        Returns:
            Valid polygons, outer rings anticlockwise.

        Raises:
            TornRingError: where a region contains or touches a point that goes to infinity, or winds
                round a branch point under a sum of variations.
        """
        polygons = np.asarray(polygons, dtype=object)
        affine = self.affine_branches()
        if affine is not None:
            return _affine_images(affine, shapely.orient_polygons(polygons))
        from batik_vector.geometry.maps.areas import area_images

        return area_images(self, polygons, tolerance)

    def lines(self, lines: Geometries, tolerance: Tolerance) -> Images:
        """Return the images of polylines; closed ones stay closed.

        A closed line that winds w times round the branch point of a JuliaN ``root`` has gcd(|w|, P1)
        images of P1/gcd turns each. A line through the branch point is split there.

        Args:
            lines: LineStrings, shape (n,).
            tolerance: how far an edge may stand from the exact image of the given edges.

        Raises:
            TornRingError: where a line runs through a point that goes to infinity, or winds round a
                branch point under a sum of variations.
        """
        lines = np.asarray(lines, dtype=object)
        affine = self.affine_branches()
        if affine is not None:
            return _affine_images(affine, lines)
        from batik_vector.geometry.maps.lines import line_images

        return line_images(self, lines, tolerance)

    def at(self, points: Points, branch: int = 0) -> Points:
        """Return the images of single points, shape (n, 2), on one branch (principal angles)."""
        z = self.pre.at_complex(np.ascontiguousarray(points, np.float64).view(np.complex128)[:, 0])
        image = self.post.at_complex(self.core(z, None, branch))
        return np.column_stack([image.real, image.imag])

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
            part = part if weight == 1 else weight * part
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


def core_tolerance(flame: FlameMap, tolerance: Tolerance) -> Tolerance:
    """Return the tolerance before post, for what is traced once and stands for all its turned branches."""
    if not callable(tolerance):
        return tolerance / flame.post.stretch
    given = tolerance
    spins = [1 + 0j]
    if len(flame.terms) == 1:
        spins = [flame.terms[0][1].spin(k) for k in range(flame.branches)]

    def allowed(points: Points) -> Array:
        z = np.ascontiguousarray(points).view(np.complex128)[:, 0]
        turned = [flame.post.at_complex(np.ascontiguousarray(z * spin)) for spin in spins]
        worst = np.min([given(each.view(np.float64).reshape(-1, 2)) for each in turned], axis=0)
        return np.asarray(worst / flame.post.stretch)

    return allowed


def _affine_images(maps: list[Affine], marks: Geometries) -> Images:
    count = len(marks)
    return Images(
        Affines.of(maps).apply(marks),
        np.tile(np.arange(count, dtype=np.intp), len(maps)),
        np.repeat(np.arange(len(maps), dtype=np.intp), count),
    )
