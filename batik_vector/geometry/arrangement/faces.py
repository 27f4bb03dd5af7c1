"""Faces: into what edges divide a rectangle, and which layers cover each.

What covers a face is counted across edges, from outside inward, and not looked up by a point within it: faces
as thin as a hair are told as surely as others, and both sides of a seam alike.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.errors import TooLargeError
from batik_vector.geometry.arrangement.chaining import chained
from batik_vector.geometry.arrangement.noding import Box, Edges, edges_of, in_one, noded
from batik_vector.geometry.outlines import Index, Steps
from batik_vector.geometry.regions import oriented
from batik_vector.geometry.sampling import Geometries
from batik_vector.values import frozen

MOST = 3_000_000
"""Edges past which they are not arranged: they are in memory several times over."""


@frozen(eq=False)
class Arrangement:
    """A rectangle divided into faces.

    ``faces`` are polygons on whole steps that fill it; neighbours share their edges corner by corner.
    ``covered`` has shape (layers, faces): which layers cover which face.
    """

    faces: Geometries
    covered: NDArray[np.bool_]

    def region(self, chosen: NDArray[np.bool_]) -> Geometries:
        """Return what some faces fill together, as polygons that meet in points at most."""
        if not chosen.any():
            return np.empty(0, dtype=object)
        merged = shapely.get_parts(shapely.coverage_union_all(self.faces[chosen]))
        return sorted_by_place(np.asarray(merged, dtype=object))


def arranged(layers: Sequence[Geometries], box: Box) -> Arrangement:
    """Return the faces into which the outlines of layers divide a rectangle.

    Args:
        layers: polygons on whole steps, valid, outer rings anticlockwise and holes clockwise; those of a
            layer may overlap and reach beyond the rectangle.
        box: the rectangle.

    Raises:
        TooLargeError: where there are too many edges.
        GeometryError: where edges go on to cross however often they are cut.
    """
    edges = edges_of([np.asarray(each, dtype=object) for each in layers])
    if len(edges) > MOST:
        raise TooLargeError(f"{len(edges):,} edges, expected at most {MOST:,}: take the tile, or less cloth")
    edges = noded(edges, box)
    lines = chained(edges.ends)
    faces = sorted_by_place(np.asarray(shapely.get_parts(shapely.polygonize(lines)), dtype=object))
    winding = _winding(faces, edges)
    left, bottom, right, top = box
    bounds = shapely.bounds(faces)
    inside = (bounds[:, :2] >= (left, bottom)).all(axis=1) & (bounds[:, 2:] <= (right, top)).all(axis=1)
    return Arrangement(faces[inside], winding[inside].T > 0)


def sorted_by_place(areas: Geometries) -> Geometries:
    """Return polygons whose rings begin at their lowest left corner, in the order of these."""
    begun = oriented(np.asarray(shapely.normalize(areas), dtype=object))
    if len(begun) < 2:
        return begun
    return begun[np.lexsort([shapely.area(begun), *shapely.bounds(begun).T[::-1]])]


def _winding(faces: Geometries, edges: Edges) -> NDArray[np.int32]:
    """Return how often the outlines of each layer wind about each face, shape (faces, layers)."""
    left, right = _sides(faces, edges)
    # The last row is what lies around them all.
    winding = np.zeros((len(faces) + 1, edges.turns.shape[1]), np.int32)
    known = np.zeros(len(faces) + 1, bool)
    known[-1] = True
    fresh = known.copy()
    while fresh.any():
        into_left = np.flatnonzero(fresh[right] & ~known[left])
        into_right = np.flatnonzero(fresh[left] & ~known[right])
        winding[left[into_left]] = winding[right[into_left]] + edges.turns[into_left]
        winding[right[into_right]] = winding[left[into_right]] - edges.turns[into_right]
        fresh = np.zeros_like(known)
        fresh[left[into_left]] = fresh[right[into_right]] = True
        known |= fresh
    return winding[:-1]


def _sides(faces: Geometries, edges: Edges) -> tuple[Index, Index]:
    """Return which face is left of each edge, and which right; one past the last is what lies around."""
    parts, owner = shapely.get_rings(faces, return_index=True)
    coords, ring = shapely.get_coordinates(parts, return_index=True)
    points: Steps = np.rint(coords).astype(np.int64)
    same = ring[1:] == ring[:-1]
    ends = np.hstack([points[:-1][same], points[1:][same]])
    face = owner[ring[:-1][same]]
    back = (ends[:, 0] > ends[:, 2]) | ((ends[:, 0] == ends[:, 2]) & (ends[:, 1] > ends[:, 3]))
    ends[back] = ends[back][:, [2, 3, 0, 1]]
    number = _rows_of(ends, edges.ends)
    left = np.full(len(edges), len(faces), np.intp)
    right = left.copy()
    left[number[~back]] = face[~back]
    right[number[back]] = face[back]
    return left, right


def _rows_of(rows: Steps, known: Steps) -> Index:
    """Return where each row stands among known ones, which are sorted and each there once."""
    both = np.concatenate([known, rows])
    begin, end = in_one(both[:, :2]), in_one(both[:, 2:])
    order = np.lexsort([end, begin])
    begin, end = begin[order], end[order]
    fresh = np.append(True, (begin[1:] != begin[:-1]) | (end[1:] != end[:-1]))
    place = np.empty(len(both), np.intp)
    place[order] = np.cumsum(fresh) - 1
    return place[len(known) :]
