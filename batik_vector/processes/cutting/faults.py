"""What a tool cannot cut: said with the key, the place, and the value that would do."""

from __future__ import annotations

import math

import numpy as np
import shapely

from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import Outlines, to_polygons
from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.cutting.narrow import NarrowPlace, narrowest_gap, narrowest_part, roominess
from batik_vector.units import STEPS_PER_MM

MARGIN = 2
"""Steps by which a place has to be broader than a cut: its borders are rounded to the grid."""


def check_kerf(regions: Geometries, kerf: int) -> None:
    """Refuse a kerf that is broader than the narrowest part, hole or gap.

    Args:
        regions: polygons in steps.
        kerf: in steps.

    Raises:
        GeometryError: with the narrowest place and the kerf that would do.
    """
    found = _narrower(regions, kerf)
    if found is None:
        return
    # Below what is found there may be more: what fits at one breadth need not at a smaller one.
    while (fits := max(0, math.floor(found[0].breadth) - MARGIN)) and (next_ := _narrower(regions, fits)):
        found = next_
    place, what = found
    raise GeometryError(
        f"kerf = {_mm(kerf)}, expected at most {_mm(fits)}: {what} is no broader than {_mm(place.breadth)} "
        f'at {_at(place)}; narrow = "accept" cuts what the beam can'
    )


def _narrower(regions: Geometries, kerf: int) -> tuple[NarrowPlace, str] | None:
    """Return the narrowest place where it is narrower than the cut, and what is narrow there."""
    # What lies behind the door of a bay may be shut at one breadth and open by a hair at a smaller.
    for breadth in (kerf + MARGIN, kerf):
        part, gap = (narrowest(regions, breadth) for narrowest in (narrowest_part, narrowest_gap))
        both = ((part, "what is drawn"), (gap, "a gap"))
        if found := [(place, what) for place, what in both if place is not None]:
            return min(found, key=lambda each: each[0].breadth)
    return None


def check_blade(contours: Outlines, offset: int) -> None:
    """Refuse a blade that trails by more than a contour is broad.

    Args:
        contours: closed strokes.
        offset: of the blade's tip, in steps.

    Raises:
        GeometryError: with the smallest contour and the offset that would do.
    """
    regions = to_polygons(contours)
    # The broadest disc in a region is broader than twice its area by its length.
    small = regions[shapely.area(regions) * 2 < shapely.length(regions) * offset]
    small = small[shapely.is_empty(shapely.buffer(small, -offset / 2))]
    if not len(small):
        return
    broad = np.array([roominess(each) for each in small])
    least = int(np.argmin(broad))
    x, y = shapely.get_coordinates(shapely.point_on_surface(small[least]))[0].tolist()
    place = NarrowPlace(x, y, float(broad[least]))
    raise GeometryError(
        f"blade_offset = {_mm(offset)}, expected at most {_mm(math.floor(place.breadth))}: a contour at "
        f"{_at(place)} is no broader, and {len(small)} are smaller than the blade trails"
    )


def check_tabs(lengths: np.ndarray, counts: np.ndarray, gap: float, tab: int) -> None:
    """Refuse tabs that would leave less than half of a contour to be cut.

    Args:
        lengths: of contours, in steps.
        counts: how many tabs each is to have.
        gap: how long the gap in the cut is, in steps.
        tab: how long the tab is, in steps.

    Raises:
        GeometryError: with the shortest contour and the length that would do.
    """
    long = np.flatnonzero(counts * gap > lengths / 2)
    if not len(long):
        return
    least = long[np.argmin(lengths[long] / counts[long])]
    fits = max(0, math.floor(lengths[least] / 2 / counts[least] - (gap - tab)))
    raise GeometryError(
        f"tab_length = {_mm(tab)}, expected at most {_mm(fits)}: {int(counts[least])} tabs of it are more "
        f"than half of a contour that is {_mm(lengths[least])} long"
    )


def _at(place: NarrowPlace) -> str:
    return f"({place.x / STEPS_PER_MM:.3f}, {place.y / STEPS_PER_MM:.3f}) mm"


def _mm(steps: float) -> str:
    return f"{round(steps) / STEPS_PER_MM:g} mm"
