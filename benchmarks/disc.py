"""The disc with a hole that fills are timed on. Needs nothing of batik_vector: peers run apart."""

from __future__ import annotations

import math

import shapely

SPACING, WIDTH, MARGIN = 0.85, 0.4, 0.7
"""Of dots, in mm."""
LINES = 0.2
"""Spacing of the parallel lines, of which there are fewer, in mm."""
DOTS = 100_000
"""How many dots a disc of 300 mm has, about."""


def region(dots: int = DOTS) -> shapely.Polygon:
    """Return a disc with a round hole, so large that it has about so many dots."""
    size = math.sqrt(dots / DOTS)
    disc = shapely.Point(0, 0).buffer(150 * size, quad_segs=64)
    hole = shapely.Point(50 * size, 20 * size).buffer(30 * size, quad_segs=40)
    found: shapely.Polygon = disc.difference(hole)  # type: ignore[assignment]
    return found
