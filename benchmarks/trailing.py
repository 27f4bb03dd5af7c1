"""Stars that a drag knife cuts, and how far its tip is off them when its holder goes some way.

As sharp as their corners are, and as short as their sides, are stars what such a knife finds hard.
"""

from __future__ import annotations

import cmath
from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from benchmarks.drawing import PITCH_MM, grid
from tests.processes.cutting.trailing import trailed

CORNERS = 10
OFFSET_MM = 0.25
"""How far the tip trails: a common blade's (Graphtec CB09U)."""
OUTER_MM, INNER_MM = 4.5, 2.0
UNIT_MM = 0.025
"""To which all corners are rounded: the unit of HP-GL, in which plottool counts."""
FINE_MM = 0.02


def stars(count: int) -> NDArray[np.float64]:
    """Return stars of five points in rows, counter-clockwise, of shape (count, 10, 2), in mm."""
    columns, rows = grid(count)
    angle = 2 * np.pi * np.arange(CORNERS) / CORNERS
    radius = np.where(np.arange(CORNERS) % 2, INNER_MM, OUTER_MM)
    star = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
    x, y = ((np.arange(n) + 0.5) * PITCH_MM for n in (columns, rows))
    places = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 1, 2)
    return np.asarray(np.rint((places + star) / UNIT_MM) * UNIT_MM)


def off(ways: Sequence[NDArray[np.float64]], heading: float) -> dict[str, float]:
    """Return how far a knife's tip is off the stars.

    Args:
        ways: of the holder, in mm, one to a star, in their order: the blade points as the one before left it.
        heading: into which direction it points before the first, in radians.

    Returns:
        ``corners``, how far the tip stays from a corner at most, and ``astray``, how far it leaves the star,
        both in mm; ``area``, by what share a star is too large or too small at most.
    """
    outlines = np.asarray(shapely.polygons(stars(len(ways))), dtype=object)
    tree = shapely.STRtree(outlines)
    corners, astray, area = 0.0, 0.0, 0.0
    for way in ways:
        places = [complex(x, y) for x, y in way.tolist()]
        tip = trailed(places, OFFSET_MM, heading, FINE_MM)
        heading = cmath.phase(places[-1] - tip[-1])
        track = np.array([(place.real, place.imag) for place in tip])
        line, loop = shapely.linestrings(track), shapely.polygons(track)
        star = outlines[tree.nearest(shapely.centroid(line))]
        ends, passed = shapely.points(shapely.get_coordinates(star)), shapely.points(track)
        corners = max(corners, float(shapely.distance(ends, line).max()))
        astray = max(astray, float(shapely.distance(passed, shapely.boundary(star)).max()))
        area = max(area, abs(float(shapely.area(loop) / shapely.area(star)) - 1))
    return {"corners": round(corners, 4), "astray": round(astray, 4), "area": round(area, 6)}
