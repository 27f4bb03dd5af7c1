"""Lobes: a flower drawn as one mark, petals welded to its heart, is taken apart into petals and heart."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from batik_vector.analysis.marks import BARE, Marks, Place, joined_with, measured
from batik_vector.analysis.rings import MOST, Rosette, members

FEWEST, SURE = 3, 5
"""Lobes at the least, and how many a mark has that is a flower even where it stands in a ring itself."""

HEART = 1.5
"""How many times as far as its size a flower reaches beyond a mark that is its heart."""

LEAST_SIZE = 0.1
"""Of the drawing's largest mark: smaller ones are not taken apart."""

RADII = 96
"""Circles on which lobes are counted."""

DEEP, SURELY_DEEP = 0.12, 0.3
"""How long lobes are at the least, to the mark's reach; and where it stands in a ring, as no folds are."""

HULL = 0.9
"""The share of its convex hull that a mark with lobes fills at the most."""

EVEN = 0.42
"""The part of the whole turn between two lobes at the most."""

ROUND = 32
"""Segments of a quarter of the circle at which lobes are cut."""


def taken_apart(marks: Marks, found: Sequence[Rosette]) -> Marks:
    """Return the marks with lobes and hearts in place of flowers that are one mark.

    Args:
        marks: of the drawing.
        found: the points about which they stand in rings. What stands in a ring, as a petal of some flower,
            is taken for a flower itself only if it has ``SURE`` lobes, and what stands in the middle of rings
            that reach ``HEART`` times as far is a flower's heart.
    """
    if not len(marks):
        return marks
    fewest, deep = np.full(len(marks), FEWEST), np.full(len(marks), DEEP)
    ringed = members([ring for rosette in found for ring in rosette.rings])
    fewest[ringed], deep[ringed] = SURE, SURELY_DEEP
    for rosette in found:
        away = np.hypot(*(marks.places - rosette.centre).T)
        fewest[(away <= 0.1 * marks.sizes) & (HEART * marks.sizes < rosette.reach)] = MOST
    hollow = (
        (marks.shapes[:, 2] < HULL) & (marks.sizes >= LEAST_SIZE * marks.sizes.max()) & (marks.inks != BARE)
    )
    parts: list[BaseGeometry] = []
    inks: list[int] = []
    whole = np.ones(len(marks), bool)
    for number in np.flatnonzero(hollow).tolist():
        pieces = _parts(
            marks.outlines[number], marks.places[number], int(fewest[number]), float(deep[number])
        )
        if pieces:
            whole[number] = False
            parts += pieces
            inks += [int(marks.inks[number])] * len(pieces)
    if not parts:
        return marks
    return joined_with(marks[whole], measured(np.array(parts, dtype=object), np.array(inks, np.intp)))


def _parts(outline: BaseGeometry, centre: Place, fewest: int, deep: float) -> list[BaseGeometry]:
    """Return the lobes of an outline about a point and the heart between them, or nothing."""
    ring = shapely.get_coordinates(outline)
    away = np.hypot(*(ring - centre).T)
    radii = np.linspace(away.min(), away.max(), RADII + 2)[1:-1]
    step = float(radii[1] - radii[0])
    beyond = away[:-1, None] > radii
    lobes = (beyond & ~np.roll(beyond, 1, axis=0)).sum(axis=0)
    # The run of circles with the most lobes, weighed with how deep they reach.
    cuts = np.concatenate([[0], np.flatnonzero(np.diff(lobes)) + 1, [RADII]])
    runs = [(int(lobes[a]) * float(b - a), int(a), int(b)) for a, b in pairwise(cuts)]
    runs = [run for run in runs if lobes[run[1]] >= fewest and (run[2] - run[1]) * step >= deep * away.max()]
    if not runs or not shapely.contains_xy(outline, *centre):
        return []
    radius = float(radii[max(runs)[1]])
    disc = shapely.Point(centre).buffer(radius, quad_segs=ROUND)
    pieces = [
        piece
        for piece in shapely.get_parts(shapely.difference(outline, disc))
        if piece.geom_type == "Polygon"
    ]
    largest = max(piece.area for piece in pieces)
    pieces = [piece for piece in pieces if piece.area > 0.02 * largest]
    middles = shapely.get_coordinates(shapely.centroid(pieces)) - centre
    angles = np.sort(np.arctan2(middles[:, 1], middles[:, 0]))
    gaps = np.diff(angles, append=angles[0] + 2 * math.pi)
    if len(pieces) < fewest or gaps.max() > EVEN * 2 * math.pi:
        return []
    heart = shapely.intersection(outline, disc)
    return [*pieces, *(piece for piece in shapely.get_parts(heart) if piece.geom_type == "Polygon")]
