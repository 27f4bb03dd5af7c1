"""What a toss is to come to: how many marks of each motif, and which come first."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.errors import GeometryError
from batik_vector.geometry.sampling import Array
from batik_vector.tiling.layouts.grounds import Scattered
from batik_vector.tiling.tossing.darts import Rules, Spacing
from batik_vector.tiling.tossing.marks import Poses
from batik_vector.tiling.tossing.scatter import Scatter
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

USUAL_COVER = 0.62
"""Share of the repeat that marks and half the distance round each cover when no more fit: about."""

NARROWING = 0.72
"""What is left of the early distances from one throw to the next."""


@frozen
class Plan:
    """How many marks of each motif are wanted, and which come first.

    ``area`` is that of the repeat and ``areas`` those of the marks of each motif, with their images under
    the symmetry, at their usual size; ``bodies`` the same of what is drawn, at the least size. ``quota`` is
    what is asked of each motif, perhaps infinite; ``likely`` about how many there will be; ``fill`` which
    share of the area is to be covered.
    """

    area: float
    areas: Array
    bodies: Array
    quota: Array
    likely: Array
    fill: float | None

    @staticmethod
    def of(spec: Scattered, marks: Geometries, rules: Rules, scatter: Scatter) -> Plan:
        """Plan a toss of marks, given as their bodies in mm at the least size."""
        images = len(scatter.torus.operations)
        low, high = rules.size
        usual = (low * low + low * high + high * high) / 3 * images
        areas = shapely.area(scatter.kit.outlines) * usual
        bodies = shapely.area(marks) * STEPS_PER_MM**2 * images
        quota, fill = np.full(len(areas), np.inf), spec.fill
        if spec.count is not None:
            likely = quota = apportioned(spec.count, rules.weights)
        else:
            gap = spec.distance * STEPS_PER_MM
            room = float(rules.weights @ (np.sqrt(areas / images) + gap) ** 2) * images
            likely = rules.weights * scatter.torus.area * USUAL_COVER / room
        if fill is not None:
            drawn = float(rules.weights @ bodies) * usual / images
            likely = np.minimum(likely, rules.weights * fill * scatter.torus.area / drawn)
        return Plan(scatter.torus.area, areas, bodies, quota, likely, fill)

    def wanted(self, there: Poses) -> Array:
        """Return how many more of each motif are wanted."""
        lacks = self.quota - np.bincount(there.motif, minlength=len(self.quota))
        if self.fill is None:
            return np.asarray(lacks)
        more = self.fill * self.area - float((self.bodies[there.motif] * there.size**2).sum())
        # Half a mark too many is as good as half a mark too few.
        return np.minimum(lacks, np.floor(more / self.bodies + 0.5))

    def of_kind(self, kind: int, there: Poses) -> Array:
        """Return how many more are wanted of one motif before all come at once."""
        lacks = np.minimum(
            self.wanted(there), np.ceil(self.likely) - np.bincount(there.motif, minlength=len(self.quota))
        )
        return np.where(np.arange(len(lacks)) == kind, lacks, 0.0)

    def early(self, distance: float) -> Iterator[tuple[Spacing, int]]:
        """Yield the spacings, wide to narrow, in which motifs are thrown one after another, large ones first.

        Thrown at the least distance at once, few marks would lie in clusters with holes between them, and
        marks of one motif would gather.
        """
        if len(self.areas) == 1 and self.quota[0] == math.inf and self.fill is None:
            return
        total = float(self.likely.sum())
        breadth = 2 * np.sqrt(self.areas / math.pi)
        between = math.sqrt(self.area / total) - 0.8 * float(self.likely @ breadth) / total
        for kind in np.argsort(-self.areas, kind="stable").tolist():
            kin = math.sqrt(self.area / max(self.likely[kind], 1e-9)) - 0.8 * float(breadth[kind])
            share = 1.0
            while share * kin > 1.05 * distance and share > 0.1:
                general = max(distance, share * between)
                yield Spacing(general, max(general, share * kin)), kind
                share *= NARROWING


def apportioned(count: int, weights: Array) -> Array:
    """Return whole numbers that add up to a count, nearest to its shares by weight."""
    shares = weights * count
    whole = np.floor(shares)
    whole[np.argsort(whole - shares, kind="stable")[: count - int(whole.sum())]] += 1
    return np.asarray(whole)


def rules_of(spec: Scattered, motifs: int) -> Rules:
    """Return what the darts of a toss or a packing of so many motifs look like.

    Raises:
        GeometryError: where there is not one weight for each motif.
    """
    if spec.weights and len(spec.weights) != motifs:
        listed = ", ".join(f"{weight:g}" for weight in spec.weights[:8])
        raise GeometryError(f"weights = [{listed}]: expected one for each motif, {motifs} in all")
    weights = np.array(spec.weights or (1.0,) * motifs)
    return Rules(
        spec.turn, spec.turns, (1.0, spec.size[1] / spec.size[0]), spec.flip, weights / weights.sum()
    )
