"""Islands: pieces of a sheet that openings go all round, how large they are, and which of them fall out."""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.geometry.outlines import Index
from batik_vector.geometry.sampling import Array, Geometries
from batik_vector.processes.cutting.overlays import united
from batik_vector.processes.stencilling.bridges import moved
from batik_vector.processes.stencilling.sheets import Sheet
from batik_vector.values import frozen


@frozen(eq=False)
class Islands:
    """The islands of a sheet, whole, one of each on the torus.

    ``shapes`` are polygons in steps, anywhere; ``first`` names the cluster of each, and ``across`` is the
    diameter of the smallest circle around each.
    """

    shapes: Geometries
    first: Index
    across: Array

    def __len__(self) -> int:
        return len(self.shapes)


def islands_of(sheet: Sheet) -> Islands:
    """Return the islands of a sheet."""
    clusters = sheet.clusters
    lies = [clusters.lies(part) for part in range(len(sheet.parts))]
    first = np.array([each for each, _ in lies], np.intp)
    closed = np.array([not clusters.span(each).rank for each in first.tolist()], bool)
    shift = sheet.torus.at(np.array([gain for _, gain in lies], np.int64).reshape(-1, 2))
    parts = moved(sheet.parts, shift) if len(sheet.parts) else sheet.parts
    names, counts = np.unique(first[closed], return_counts=True)
    shapes = np.empty(len(names), dtype=object)
    for number, (name, count) in enumerate(zip(names.tolist(), counts.tolist(), strict=True)):
        mine = parts[first == name]
        # Parts that a seam divides meet along it: they are one again.
        shapes[number] = mine[0] if count == 1 else _as_one(united(mine))
    across = 2 * shapely.minimum_bounding_radius(shapes) if len(shapes) else np.empty(0)
    return Islands(shapes, names, np.asarray(across, float))


def _as_one(areas: Geometries) -> shapely.Polygon | shapely.MultiPolygon:
    return areas[0] if len(areas) == 1 else shapely.MultiPolygon(areas.tolist())


def without_small(
    openings: Geometries, sheet: Sheet, islands: Islands, drop: float
) -> tuple[Geometries, int]:
    """Return openings with the islands of a sheet that are smaller than told, and how many these are.

    Args:
        openings: within the tile, in steps.
        sheet: what they leave.
        islands: of the sheet.
        drop: islands less across fall out, in steps.
    """
    gone = islands.first[islands.across < drop]
    if not len(gone):
        return openings, 0
    first = np.array([sheet.clusters.lies(part)[0] for part in range(len(sheet.parts))])
    return united(np.concatenate([openings, sheet.parts[np.isin(first, gone)]])), len(gone)
