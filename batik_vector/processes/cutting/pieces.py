"""Pieces of a sheet: what hangs together, with all that lies in its holes, laid on a sheet of given size."""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.geometry.outlines import Index, Outlines, of_polylines, to_polylines
from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.cutting.sheet import Place, nested, turned
from batik_vector.values import frozen

REACH = 2.0
"""Steps within which a shared edge belongs to a region."""


@frozen(eq=False)
class Pieces:
    """The filled outlines of pieces, and which of them each region belongs to."""

    shells: Geometries
    owner: Index


def pieces_of(regions: Geometries) -> Pieces:
    """Return the pieces that regions make: what lies in a hole goes with what is around it."""
    filled = np.asarray(shapely.polygons(shapely.get_exterior_ring(regions)), dtype=object)
    area = shapely.area(filled)
    inner, outer = shapely.STRtree(filled).query(shapely.point_on_surface(regions), predicate="intersects")
    # The largest outline that holds a region is its piece.
    order = np.lexsort([outer, -area[outer], inner])
    inner, outer = inner[order], outer[order]
    first = np.append(True, inner[1:] != inner[:-1])
    largest = outer[first]
    shells, owner = np.unique(largest, return_inverse=True)
    return Pieces(filled[shells], owner.ravel())


def laid_out(
    regions: Geometries,
    edges: Outlines,
    size: tuple[int, int],
    gap: int,
    quarters: tuple[int, ...],
    inset: int = 0,
) -> tuple[list[tuple[Geometries, Outlines]], list[int]] | None:
    """Return what comes to lie on each sheet, and how many pieces; None where one is larger than a sheet.

    Args:
        regions: polygons in steps.
        edges: strokes within them, which go with them.
        size: width and height of a sheet, in steps.
        gap: how far pieces keep apart, in steps.
        quarters: the turns that are tried.
        inset: how far from the sheet's edges nothing lies, in steps.
    """
    pieces = pieces_of(regions)
    places = nested(pieces.shells, size[0] - 2 * inset, size[1] - 2 * inset, gap, quarters)
    if places is None:
        return None
    lines = to_polylines(edges)
    with_ = pieces.owner[_region_of(lines, regions)]
    moved = _moved(regions, [places[each] for each in pieces.owner.tolist()], inset)
    shifted = _moved(lines, [places[each] for each in with_.tolist()], inset)
    sheet = np.array([place.sheet for place in places])
    count = int(sheet.max()) + 1
    found = [
        (moved[sheet[pieces.owner] == each], of_polylines(shifted[sheet[with_] == each]))
        for each in range(count)
    ]
    return found, np.bincount(sheet, minlength=count).tolist()


def _region_of(lines: Geometries, regions: Geometries) -> Index:
    """Return the region in which each line runs."""
    middles = shapely.line_interpolate_point(lines, 0.5, normalized=True)
    line, region = shapely.STRtree(regions).query(middles, predicate="dwithin", distance=REACH)
    found = np.zeros(len(lines), np.intp)
    found[line[::-1]] = region[::-1]
    return found


def _moved(marks: Geometries, places: list[Place], inset: int) -> Geometries:
    """Return marks where their places are, exactly."""
    coords = shapely.get_coordinates(marks)
    counts = shapely.get_num_coordinates(marks)
    quarters = np.repeat(np.array([place.quarters for place in places], np.int64), counts)
    moves = np.array([(place.right, place.up) for place in places], float).reshape(-1, 2) + inset
    for quarter in range(1, 4):
        coords[quarters == quarter] = turned(coords[quarters == quarter], quarter)
    coords += np.repeat(moves, counts, axis=0)
    return np.asarray(shapely.set_coordinates(np.array(marks, dtype=object), coords), dtype=object)
