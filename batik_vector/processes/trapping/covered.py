"""Marks that traps would cover whole, so that nothing is left of the darker ink alone."""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.artwork import Cell
from batik_vector.geometry.outlines import Index, of_polygons
from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.trapping.meeting import joined_pieces
from batik_vector.processes.trapping.spreading import Spread
from batik_vector.values import frozen

MOST = 0.98
"""Part of a mark's area that traps have to come to before it is looked at more closely."""
HAIR = 4.0
"""Steps of breadth, on average, below which what is left of a mark is nothing."""


@frozen
class CoveredMark:
    """A mark that is covered whole: where it is, in steps, and the breadth of trap that would leave of it."""

    x: float
    y: float
    breadth: float


def covered_marks(areas: Geometries, traps: Spread, cell: Cell | None) -> list[CoveredMark]:
    """Return the marks that traps cover whole; on a tile a mark goes on across the seam.

    Args:
        areas: of one ink, in steps.
        traps: of all inks that spread under it.
        cell: of a tile.
    """
    inside = np.bincount(traps.owner, weights=shapely.area(traps.areas), minlength=len(areas))
    asked = np.flatnonzero(inside >= MOST * shapely.area(areas))
    gone = np.array([each for each in asked.tolist() if _gone(areas[each], traps.areas[traps.owner == each])])
    if not len(gone):
        return []
    mark = _marks(areas, gone.astype(np.intp), cell)
    left = np.ones(len(areas), bool)
    left[gone] = False
    whole = ~np.isin(mark, mark[left])
    found = []
    for number in np.unique(mark[whole]).tolist():
        pieces = areas[mark == number]
        # What lies farther in than the trap is broad stays.
        circles = shapely.maximum_inscribed_circle(pieces, tolerance=1.0)
        radii = shapely.length(circles)
        best = int(np.argmax(radii))
        x, y = shapely.get_coordinates(circles[best])[0].tolist()
        found.append(CoveredMark(x, y, float(radii[best])))
    return sorted(found, key=lambda each: (each.breadth, each.x, each.y))


def _gone(area: shapely.Polygon, traps: Geometries) -> bool:
    left = shapely.get_parts(shapely.difference(area, shapely.union_all(traps)))
    return bool((2 * shapely.area(left) <= HAIR * shapely.length(left)).all())


def _marks(areas: Geometries, gone: Index, cell: Cell | None) -> Index:
    """Return for each area which mark it is of: pieces that are one across the seam have one number."""
    number = np.arange(len(areas))
    if cell is None:
        return number
    one, other = joined_pieces(of_polygons(areas), cell)
    if not np.isin(gone, one).any():
        return number
    while True:
        low = number.copy()
        np.minimum.at(low, one, number[other])
        if (low == number).all():
            return number
        number = low
