"""What a petal's outline is like: straight-sided, curved, or wavy. Tian et al. 2019, Table 1."""

from __future__ import annotations

import enum
import math

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from batik_vector.analysis.marks import Numbers, Place, Points

BASE = 0.2
"""The inner share of a petal's length that is not judged: others lie over it, and cut it."""

STRAIGHT = 0.06
"""How far an outline may stand from straight sides, to the petal's breadth; an ellipse stands off 0.15."""

CORNERS, BASE_CORNERS = 3, 2
"""Corners of a petal with straight sides: the tip and those beside it, and where its base is cut off."""

STEPS, SMOOTH = 512, 2.5
"""Points by which waves are counted, and how many of them around each are taken together."""

SWING = math.radians(20)
"""The turn of a hollow between two bulges of a wavy outline, at the least."""

HOLLOWS = 3
"""Hollows of a wavy outline, at the least: a pointed petal may have one beside its tip on either side."""


class PetalShape(enum.StrEnum):
    """Table 1's three shapes."""

    RHOMBUS = "rhombus"
    CURVED = "curved"
    WAVY = "wavy"


def petal_shape(petal: BaseGeometry, centre: Place) -> PetalShape:
    """Return the shape of a petal (a polygon in mm) of a flower about ``centre``."""
    ring = shapely.get_coordinates(petal.exterior)[:-1]  # type: ignore[attr-defined]
    away = np.hypot(*(ring - centre).T)
    base = away.min() + BASE * (away.max() - away.min())
    if _hollows(ring, centre, base) >= HOLLOWS:
        return PetalShape.WAVY
    corners = _corners(ring)
    free = int((np.hypot(*(corners - centre).T) > base).sum())
    straight = free <= CORNERS and len(corners) - free <= BASE_CORNERS
    return PetalShape.RHOMBUS if straight else PetalShape.CURVED


def _corners(ring: Points) -> Points:
    """Return the corners of the polygon with the fewest that keeps near an outline."""
    away = ring - ring.mean(axis=0)
    _, _, axes = np.linalg.svd(away, full_matrices=False)
    breadth = float(np.ptp(away @ axes[1]))
    # It begins at a tip, which then is no corner for being the first.
    ring = np.roll(ring, -int(np.argmax((away * away).sum(axis=1))), axis=0)
    line = shapely.linestrings(np.vstack([ring, ring[:1]]))
    return np.asarray(shapely.get_coordinates(shapely.simplify(line, STRAIGHT * breadth))[:-1])


def _hollows(ring: Points, centre: Place, base: float) -> int:
    """Return how often an outline turns inwards, beyond its base, by ``SWING`` or more."""
    closed = np.vstack([ring, ring[:1]])
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(closed, axis=0).T))])
    at = np.arange(STEPS) * (way[-1] / STEPS)
    x, y = np.interp(at, way, closed[:, 0]), np.interp(at, way, closed[:, 1])
    wave = np.fft.fftfreq(STEPS) * 2 * math.pi
    points = np.fft.ifft(np.fft.fft(x + 1j * y) * np.exp(-((SMOOTH * wave) ** 2) / 2))
    step = np.roll(points, -1) - points
    turn: Numbers = np.angle(step / np.roll(step, 1))
    turn *= np.sign(turn.sum())
    # It is gone through from its base, so that no hollow is met in two halves; what turns there is left out.
    first = int(np.argmin(np.abs(points - complex(*centre))))
    turn, far = np.roll(turn, -first), np.roll(np.abs(points - complex(*centre)), -first)
    turn = np.where(far > base, turn, np.maximum(turn, 0.0))
    return _falls(np.cumsum(turn))


def _falls(heading: Numbers) -> int:
    """Return how many falls of ``SWING`` or more a heading makes between its rises."""
    falls, falling = 0, False
    high = low = float(heading[0])
    for value in heading.tolist():
        if falling:
            low = min(low, value)
            if value >= low + SWING:
                falling, high = False, value
        else:
            high = max(high, value)
            if value <= high - SWING:
                falls, falling, low = falls + 1, True, value
    return falls
