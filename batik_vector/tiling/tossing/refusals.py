"""Tosses that are refused before they are thrown: too many marks, or more than the repeat can hold."""

from __future__ import annotations

import math

import numpy as np
import shapely

from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.geometry.sampling import Array
from batik_vector.tiling.layouts.grounds import Scattered, Toss
from batik_vector.tiling.tossing.darts import Dice, Spacing, thrown
from batik_vector.tiling.tossing.marks import Field, Kit, Poses
from batik_vector.tiling.tossing.plan import apportioned, rules_of
from batik_vector.tiling.tossing.scatter import Scatter, Torus
from batik_vector.units import STEPS_PER_MM, format_mm

MOST_MARKS = 20_000
"""Marks of one toss. A cloth of more is a ground: smaller, and repeated."""

DENSEST = math.pi / math.sqrt(12)
"""Share of a plane that equal discs cover when they lie as close as they can: Thue's theorem."""

CLOSEST, CLOSEST_DISCS = 0.85, 0.65
"""Shares of the repeat that no toss of many marks covers, with half the distance round each, and that the
largest discs in them do not: discs came to 0.52 with the most darts and settling."""

MANY = 24
"""Marks from which chance decides, and not how a few happen to fit into the repeat."""

SAMPLED, FAR_SHORT = 300, 0.9
"""Marks of a smaller repeat that is thrown at first where many times as many are asked for, and the share of
them below which the whole is not thrown. Where that was tried such a throw came within 0.02 of what the whole
held, and settling adds up to 0.03."""


def refuse_too_many(spec: Scattered, kit: Kit, torus: Torus) -> None:
    """Refuse a toss or a packing without a count where far more marks fit than one may have."""
    side = np.sqrt(shapely.area(kit.outlines)) + spec.distance * STEPS_PER_MM
    about = torus.area / float(np.mean(side)) ** 2
    if spec.count is None and about > MOST_MARKS:
        raise TooLargeError(
            f"about {about:,.0f} marks would fit, past {MOST_MARKS:,}: expected a count, larger marks or a "
            "smaller repeat"
        )


def refuse_impossible(spec: Scattered, kit: Kit, torus: Torus) -> None:
    """Refuse a count that cannot fit, or that no toss comes near; others are tried, and told when they fail.

    Outlines grown by half the distance stay apart, and so do the largest discs within them, whatever their
    size above the least; equal discs cover no more than π/√12 of a plane.
    """
    if spec.count is None or torus.stretch is not None:
        return
    images = len(torus.operations)
    half = spec.distance * STEPS_PER_MM / 2
    grown = float(shapely.area(shapely.buffer(kit.outlines, half, quad_segs=4)).min())
    discs = math.pi * float(kit.radii[:, 0].min() + half) ** 2
    by_area, by_discs = torus.area / grown / images, torus.area / discs / images
    at = f"at a distance of {format_mm(spec.distance)} mm, expected fewer, or smaller marks"
    most = int(min(by_area, by_discs * DENSEST))
    if 0 < most < spec.count:
        raise GeometryError(f"count = {spec.count}: by their area alone no more than {most} fit {at}")
    most = int(min(by_area * CLOSEST, by_discs * CLOSEST_DISCS))
    if isinstance(spec, Toss) and spec.count >= MANY and most < spec.count:
        raise GeometryError(f"count = {spec.count}: no toss is so close that more than {most} fit {at}")


def refuse_crowded(spec: Scattered, kit: Kit, torus: Torus, taken: Field) -> None:
    """Refuse a count of many marks of which a smaller repeat, as crowded, holds far too few."""
    plain = len(torus.operations) == 1 and torus.stretch is None and not len(taken)
    if not isinstance(spec, Toss) or not plain or (spec.count or 0) < 4 * SAMPLED:
        return
    assert spec.count is not None
    share = SAMPLED / spec.count
    side = round(math.sqrt(torus.area * share))
    scatter = Scatter(Torus(((side, 0), (0, side))), kit, spec.size[1] / spec.size[0], taken)
    rules = rules_of(spec, len(kit.outlines))
    quota = apportioned(SAMPLED, rules.weights)
    distance = spec.distance * STEPS_PER_MM
    if 2 * scatter.largest + distance > side:
        return

    def wanted(there: Poses) -> Array:
        return np.asarray(quota - np.bincount(there.motif, minlength=len(quota)))

    thrown(scatter, rules, Dice(0), Spacing(distance, distance), spec.tries, wanted)
    if len(scatter) < FAR_SHORT * SAMPLED:
        raise GeometryError(
            f"count = {spec.count}: about {int(len(scatter) / share)} fit at a distance of "
            f"{format_mm(spec.distance)} mm, expected that many, or smaller marks"
        )
