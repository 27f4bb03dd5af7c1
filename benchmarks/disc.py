"""The disc with a hole that fills are timed on, and how. Needs nothing of batik_vector: peers run apart."""

from __future__ import annotations

import time
from collections.abc import Callable

import shapely

TIMES = 5
SPACING, WIDTH, MARGIN = 0.85, 0.4, 0.7
LINES = 0.2
"""Spacing of the parallel lines, of which there are fewer, in mm."""


def region() -> shapely.Polygon:
    """Return a disc of 300 mm with a round hole."""
    disc = shapely.Point(0, 0).buffer(150, quad_segs=64)
    found: shapely.Polygon = disc.difference(shapely.Point(50, 20).buffer(30, quad_segs=40))  # type: ignore[assignment]
    return found


def least(work: Callable[[], int], times: int = TIMES) -> tuple[float, int]:
    """Return the least CPU time of several runs, and how many marks were made."""
    found = []
    for _ in range(times):
        begin = time.process_time()
        count = work()
        found.append(time.process_time() - begin)
    return min(found), count
