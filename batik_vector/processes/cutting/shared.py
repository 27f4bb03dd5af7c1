"""Edges that regions share: cut once, for both sides of them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from batik_vector.geometry.outlines import Outlines, Steps, nothing, of_polygons, of_polylines
from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.cutting.overlays import united, without

NEAR = 1.0
"""Steps from an edge within which a corner of a neighbour lies on it: both were rounded to the grid."""


def as_seen(layers: Sequence[Geometries]) -> list[Geometries]:
    """Return layers of polygons, the lowest first, without what higher ones cover; all on the grid."""
    seen = list[Geometries]()
    above = np.empty(0, dtype=object)
    for regions in reversed(layers):
        seen.append(_uncovered(regions, above))
        above = np.concatenate([above, regions])
    return seen[::-1]


def _uncovered(regions: Geometries, above: Geometries) -> Geometries:
    if not len(regions) or not len(above):
        return regions
    mine, over = shapely.STRtree(above).query(regions, predicate="intersects")
    deep = ~np.asarray(shapely.touches(regions[mine], above[over]), bool)
    mine, over = mine[deep], over[deep]
    covered = np.bincount(mine, minlength=len(regions)) > 0
    if not covered.any():
        return regions
    cut = [without(regions[each], above[over[mine == each]]) for each in np.flatnonzero(covered).tolist()]
    return np.concatenate([regions[~covered], *cut])


def shared(layers: Sequence[Geometries]) -> tuple[Geometries, Outlines]:
    """Return what regions cover together, and the edges within it at which two of them meet.

    Args:
        layers: polygons in steps that do not overlap, of several inks.

    Returns:
        The polygons of them all, and each shared stretch once: as polylines, those closed that come back.
    """
    regions = np.concatenate([np.empty(0, dtype=object), *layers])
    layer = np.repeat(np.arange(len(layers)), [len(each) for each in layers])
    one, other = shapely.STRtree(regions).query(regions, predicate="dwithin", distance=NEAR)
    meets = layer[one] < layer[other]
    if not meets.any():
        return regions, nothing()
    near = np.zeros(len(regions), bool)
    near[one[meets]] = near[other[meets]] = True
    outlines = of_polygons(_noded(regions[near]))
    edges = np.column_stack([_edges(outlines), np.repeat(layer[near], outlines.sizes())])
    return np.concatenate([regions[~near], united(regions[near])]), _strokes(_twice(edges))


def _noded(regions: Geometries) -> Geometries:
    """Return polygons with a vertex wherever one of another lies on their edges."""
    outlines = of_polygons(regions)
    points, rings = outlines.repeating()
    begin = np.delete(np.arange(len(points)), rings[1:] - 1)
    segments = _lines(np.hstack([points[begin], points[begin + 1]]))
    corners, number = np.unique(outlines.points, axis=0, return_inverse=True)
    at, on = shapely.STRtree(segments).query(
        shapely.points(corners.astype(float)), predicate="dwithin", distance=NEAR
    )
    owner = np.repeat(np.arange(len(regions)), outlines.sizes())
    # Corners of its own stay as they are.
    own = np.isin(owner[on] * len(corners) + at, owner * len(corners) + number.ravel())
    at, on = at[~own], on[~own]
    if not len(at):
        return regions
    along = shapely.line_locate_point(segments[on], shapely.points(corners[at].astype(float)))
    order = np.lexsort([along, on])
    into = begin[on[order]] + 1
    more = np.insert(points, into, corners[at[order]], axis=0)
    moved = np.searchsorted(into, rings, side="right") + rings
    moved[0] = 0
    made = shapely.from_ragged_array(
        shapely.GeometryType.POLYGON, more.astype(float), (moved, outlines.marks)
    )
    return np.asarray(made, dtype=object)


def _edges(outlines: Outlines) -> Steps:
    """Return all edges from their lower end to their higher one, shape (n, 4)."""
    points, rings = outlines.repeating()
    begin = np.delete(np.arange(len(points)), rings[1:] - 1)
    one, two = points[begin], points[begin + 1]
    swap = (one[:, 0] > two[:, 0]) | ((one[:, 0] == two[:, 0]) & (one[:, 1] > two[:, 1]))
    return np.where(swap[:, None], np.hstack([two, one]), np.hstack([one, two]))


def _lines(edges: Steps) -> Geometries:
    """Return edges, shape (n, 4), as lines."""
    return np.asarray(shapely.linestrings(edges.reshape(-1, 2, 2).astype(float)), dtype=object)


def _twice(edges: Steps) -> Steps:
    """Return the edges, shape (n, 4), that occur in more than one layer, each once.

    Args:
        edges: shape (n, 5), each with its layer.
    """
    edges = edges[np.lexsort(edges.T[::-1])]
    again = (edges[1:, :4] == edges[:-1, :4]).all(axis=1) & (edges[1:, 4] != edges[:-1, 4])
    found = edges[1:][again, :4]
    fresh = np.append(True, (found[1:] != found[:-1]).any(axis=1)) if len(found) else np.empty(0, bool)
    return np.asarray(found[fresh])


def _strokes(edges: Steps) -> Outlines:
    """Return edges joined to polylines from fork to fork."""
    if not len(edges):
        return nothing()
    merged = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(_lines(edges))))
    return of_polylines(np.asarray(merged, dtype=object))


def lengthened(strokes: Outlines, by: float) -> Outlines:
    """Return strokes of which open ones go on straight at both ends, by so many steps."""
    opened = np.flatnonzero(~strokes.closed)
    if not by or not len(opened):
        return strokes
    points = strokes.points.copy()
    first, last = strokes.rings[:-1][opened], strokes.rings[1:][opened] - 1
    for end, inner in ((first, first + 1), (last, last - 1)):
        way = (strokes.points[end] - strokes.points[inner]).astype(float)
        size = np.sqrt(way[:, 0] ** 2 + way[:, 1] ** 2)
        points[end] += np.rint(way * (by / size)[:, None]).astype(np.int64)
    return Outlines(points, strokes.rings, strokes.marks, strokes.closed)
