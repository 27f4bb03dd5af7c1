"""Joints: what the laying of a band cut is joined again, so that no edge is left where none was drawn.

Whole grid steps, as in :mod:`batik_vector.tiling.borders.bands`: both sides of a joint have the same vertices
on it, and joining moves nothing.
"""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.geometry.sampling import Indices
from batik_vector.tiling.borders.bands import Marks
from batik_vector.tiling.welding.duplicates import drawn_once
from batik_vector.tiling.welding.weld import meeting, united, welded


def closed(marks: Marks, merges: bool) -> Marks:
    """Return marks joined again where joints cut them, all that is then whole marked as such.

    Args:
        marks: of one ink, in grid steps.
        merges: whether areas that meet become one; else only the parts of one mark do.
    """
    cut = np.flatnonzero(marks.open_areas)
    areas, codes = marks.areas, marks.area_codes
    if len(cut) > 1:
        joined, first = welded(areas[cut]) if merges else united(areas[cut], halves(areas[cut], codes[cut]))
        areas = np.concatenate([np.delete(areas, cut), straightened(joined)])
        codes = np.concatenate([np.delete(codes, cut), codes[cut][first]])
    lines, line_codes = _joined_lines(marks)
    return Marks(areas, codes, np.zeros(len(areas), bool), lines, line_codes, np.zeros(len(lines), bool))


def halves(areas: Geometries, codes: Indices) -> Indices:
    """Return the pairs, shape (n, 2), that are one mark cut: what they share ends in vertices of both."""
    pairs = meeting(areas)
    a, b = pairs.T
    pairs = pairs[(codes[a] == codes[b]) & shapely.relate_pattern(areas[a], areas[b], "F***1****")]
    a, b = pairs.T
    ends = shapely.boundary(shapely.line_merge(shapely.intersection(areas[a], areas[b])))
    corners = shapely.extract_unique_points(areas)
    return np.asarray(pairs[shapely.covers(corners[a], ends) & shapely.covers(corners[b], ends)])


def _joined_lines(marks: Marks) -> tuple[Geometries, Indices]:
    cut = marks.open_lines
    if not cut.any():
        return marks.lines, marks.line_codes
    parts, codes = [marks.lines[~cut]], [marks.line_codes[~cut]]
    for code in np.unique(marks.line_codes[cut]):
        mine = marks.lines[cut & (marks.line_codes == code)]
        whole = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(mine)))
        parts.append(whole)
        codes.append(np.full(len(whole), code, np.intp))
    return drawn_once(np.concatenate(parts), np.concatenate(codes))


def straightened(areas: Geometries) -> Geometries:
    """Return polygons (whole grid steps) without the vertices that their straight edges run through."""
    if not len(areas):
        return areas
    _, coords, (rings, polygons) = shapely.to_ragged_array(areas)
    xy = np.rint(coords).astype(np.int64)
    lasts = rings[1:] - 1
    before, after = np.roll(xy, 1, axis=0), np.roll(xy, -1, axis=0)
    before[rings[:-1]] = xy[lasts - 1]
    step, on = xy - before, after - xy
    flat = (step[:, 0] * on[:, 1] == step[:, 1] * on[:, 0]) & ((step * on).sum(axis=1) > 0)
    flat[lasts] = False
    keep = ~flat
    # The last vertex of a ring repeats its first, whichever that has become.
    kept = np.flatnonzero(keep)
    xy[lasts] = xy[kept[np.searchsorted(kept, rings[:-1])]]
    offsets = np.concatenate([[0], np.cumsum(keep)])[rings]
    thinned = shapely.from_ragged_array(
        shapely.GeometryType.POLYGON, xy[keep].astype(float), (offsets, polygons)
    )
    return np.asarray(thinned, dtype=object)
