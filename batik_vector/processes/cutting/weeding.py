"""Weeding: a box round what is cut, and lines across what is peeled off, so that it comes off in strips."""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.geometry.outlines import Outlines, nothing, of_polylines
from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.cutting.kerf import MITRE
from batik_vector.values import frozen

SHORT = 1000.0
"""Steps below which a piece of a weed line is left out: it would part nothing."""


@frozen
class Box:
    """A box in steps: its left, lower, right and upper edge."""

    left: int
    low: int
    right: int
    high: int

    @property
    def outline(self) -> Outlines:
        """Its outline."""
        corners = [
            (self.left, self.low),
            (self.right, self.low),
            (self.right, self.high),
            (self.left, self.high),
        ]
        points = np.array(corners, np.int64)
        return Outlines(points, np.array([0, 4]), np.array([0, 1]), np.ones(1, bool))

    def grown(self, by: int) -> Box:
        """Return a box larger by so much on each side."""
        return Box(self.left - by, self.low - by, self.right + by, self.high + by)

    def with_(self, other: Box) -> Box:
        """Return the smallest box that holds two."""
        return Box(
            min(self.left, other.left),
            min(self.low, other.low),
            max(self.right, other.right),
            max(self.high, other.high),
        )


def bounds(strokes: Outlines) -> Box:
    """Return the bounds of strokes."""
    left, low = strokes.points.min(axis=0).tolist()
    right, high = strokes.points.max(axis=0).tolist()
    return Box(left, low, right, high)


def weed_lines(regions: Geometries, box: Box, spacing: int, margin: int) -> Outlines:
    """Return level lines across a box that keep clear of regions; what lies in their holes is left alone.

    Args:
        regions: polygons in steps.
        box: which they end at.
        spacing: how far apart they are in steps, at most: they divide the box evenly.
        margin: how near they come to what is cut, in steps.
    """
    count = -(-(box.high - box.low) // spacing)
    heights = box.low + np.arange(1, count) * (box.high - box.low) // count
    if not len(heights):
        return nothing()
    ends = np.array([[[box.left, height], [box.right, height]] for height in heights.tolist()], float)
    lines = shapely.linestrings(ends)
    shells = shapely.polygons(shapely.get_exterior_ring(regions))
    kept = shapely.union_all(shapely.buffer(shells, float(margin), join_style="mitre", mitre_limit=MITRE))
    shapely.prepare(kept)
    free = shapely.get_parts(shapely.difference(lines, kept))
    free = free[shapely.length(free) >= SHORT]
    # What GEOS gives back may run either way.
    left, low, right, high = shapely.bounds(free).T
    found = shapely.linestrings(
        np.stack([np.stack([left, low], axis=1), np.stack([right, high], axis=1)], axis=1)
    )
    order = np.lexsort([left, low])
    return of_polylines(np.asarray(found, dtype=object)[order])
