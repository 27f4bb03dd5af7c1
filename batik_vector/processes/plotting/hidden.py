"""Hidden lines: what lies under the areas of higher inks is not drawn.

Strokes are cut where they pass the edges of areas, and each part between two passages is asked for once
whether it lies inside. What runs along an edge, as the border of what was knocked out does, is not under it:
areas are taken a hair smaller than they are, or larger by as much as strokes are to keep away from them.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines, of_polygons, to_polygons
from batik_vector.processes.ordering.distances import PARTS, distances
from batik_vector.processes.plotting.pieces import Pieces

Array: TypeAlias = NDArray[np.float64]

HAIR = 2
"""Steps by which a stroke must lie inside an area to be under it: ends are rounded to one."""

DASH = 10
"""Steps that must be seen at least of what comes out from under one area and goes under the next."""

QUARTER = 16
"""Chords of a quarter of a circle about an area's corner from which strokes keep away."""


def seen(strokes: Outlines, areas: Outlines, margin: int = 0) -> tuple[Outlines, Index, int]:
    """Return what of strokes does not lie under areas, in their order and without names.

    Args:
        strokes: one ring or polyline to a mark.
        areas: polygons.
        margin: how many steps strokes keep away from the areas.

    Returns:
        The strokes that are left, closed where a closed one is whole; for each of them the number of the
        stroke that it is a part of; and the length of what is hidden, in parts of a step.
    """
    covers = _covers(areas, margin)
    if not len(covers) or not len(strokes):
        return strokes, np.arange(len(strokes)), 0
    ways = Pieces.of(strokes)
    which, share = _passages(ways, covers)
    way = (ways.end - ways.begin)[which]
    parts = ways.cut(which, ways.begin[which] + np.rint(way * share[:, None]).astype(np.int64))
    fresh = np.insert(np.append(True, ways.stroke[1:] != ways.stroke[:-1]), which + 1, True)
    hidden = _under(parts, fresh, covers)
    length = int(distances(parts.begin[hidden], parts.end[hidden]).sum())
    # A passage through a vertex leaves a piece of no length, which is no gap.
    real = np.flatnonzero((parts.begin != parts.end).any(axis=1))
    left, source = parts.taken(real).staying(~hidden[real], strokes.closed)
    return left, source, length


def _covers(areas: Outlines, margin: int) -> NDArray[np.object_]:
    """Return areas a hair smaller, or larger by a margin, on whole steps."""
    # Together, so that nothing shows between two that meet.
    whole = shapely.union_all(to_polygons(areas))
    # Round joins for the hair too: GEOS' inward mitres were seen to turn a whole part into a hole.
    grown = shapely.buffer(whole, margin if margin else -HAIR, quad_segs=QUARTER if margin else 2)
    parts = shapely.get_parts(grown)
    return to_polygons(of_polygons(parts[~shapely.is_empty(parts)]))


def _passages(ways: Pieces, covers: NDArray[np.object_]) -> tuple[Index, Array]:
    """Return where segments pass edges, or touch them: (segments, shares of their length), along each."""
    coords, ring = shapely.get_coordinates(shapely.get_rings(covers), return_index=True)
    edge = np.flatnonzero(ring[1:] == ring[:-1])
    lines = shapely.linestrings(np.stack([coords[edge], coords[edge + 1]], axis=1))
    segments = shapely.linestrings(np.stack([ways.begin, ways.end], axis=1).astype(float))
    which, met = shapely.STRtree(np.asarray(lines, object)).query(segments)
    begin, way = ways.begin[which].astype(float), (ways.end - ways.begin)[which].astype(float)
    p, q = coords[edge[met]], coords[edge[met] + 1]
    side, to = q - p, p - begin
    turn = way[:, 0] * side[:, 1] - way[:, 1] * side[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (to[:, 0] * side[:, 1] - to[:, 1] * side[:, 0]) / turn
        beside = (to[:, 0] * way[:, 1] - to[:, 1] * way[:, 0]) / turn
    # A little more than the whole edge, so that no passage through a corner is missed.
    more = 1e-9
    real = (turn != 0) & (share >= -more) & (share <= 1 + more) & (beside >= -more) & (beside <= 1 + more)
    which, share = which[real], np.clip(share[real], 0.0, 1.0)
    order = np.lexsort((share, which))
    return which[order], share[order]


def _under(parts: Pieces, fresh: NDArray[np.bool_], covers: NDArray[np.object_]) -> NDArray[np.bool_]:
    """Return which pieces lie in covers: all from one passage to the next do, if the longest of them does."""
    run = np.cumsum(fresh) - 1
    order = np.lexsort((distances(parts.begin, parts.end), run))
    longest = order[np.append(np.diff(run) != 0, True)]
    middle = (parts.begin[longest] + parts.end[longest]) / 2
    of, cover = shapely.STRtree(covers).query(shapely.points(middle))
    shapely.prepare(covers)
    inside = shapely.contains_xy(covers[cover], middle[of, 0], middle[of, 1])
    under: NDArray[np.bool_] = np.zeros(len(longest), bool)
    under[of[inside]] = True
    length = np.bincount(run, distances(parts.begin, parts.end)) <= DASH * PARTS
    stroke = parts.stroke[longest]
    between = under[:-2] & under[2:] & (stroke[:-2] == stroke[2:])
    under[1:-1] |= between & length[1:-1]
    return np.asarray(under[run])
