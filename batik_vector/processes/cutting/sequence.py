"""The order of a cut: contours from the inside outward, and open cuts before the contour around them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely

from batik_vector.geometry.outlines import Index, Outlines, to_polygons, to_polylines, together
from batik_vector.processes.order import in_order


def in_sequence(strokes: Outlines) -> Outlines:
    """Return strokes in the order in which they are cut; names stay with them.

    Open ones may end on the contour around them, as edges do that inks share: where their middle lies says
    which that is. What no contour is around comes first.

    Args:
        strokes: one ring or polyline to a mark, with names.
    """
    closed, opened = np.flatnonzero(strokes.closed), np.flatnonzero(~strokes.closed)
    rings, cuts = (in_order(_chosen(strokes, each)) for each in (closed, opened))
    if not len(opened):
        return rings
    around = _around(cuts, rings)
    # Cuts come just before their contour: it has twice its place, and they one less.
    key = np.concatenate([2 * np.arange(len(rings)) + 1, 2 * around])
    return _chosen(together([rings, cuts]), np.argsort(key, kind="stable"))


def _chosen(strokes: Outlines, which: Index) -> Outlines:
    return replace(strokes.taken(which), names=[strokes.names[each] for each in which.tolist()])


def _around(cuts: Outlines, rings: Outlines) -> Index:
    """Return which ring is the smallest about each open stroke, and the first one about those in none."""
    found = np.zeros(len(cuts), np.intp)
    if not len(rings):
        return found
    regions = to_polygons(rings)
    middles = shapely.line_interpolate_point(to_polylines(cuts), 0.5, normalized=True)
    cut, ring = shapely.STRtree(regions).query(middles, predicate="within")
    order = np.lexsort([ring, shapely.area(regions)[ring], cut])
    cut, ring = cut[order], ring[order]
    first = np.append(True, cut[1:] != cut[:-1]) if len(cut) else np.empty(0, bool)
    found[cut[first]] = ring[first]
    return found
