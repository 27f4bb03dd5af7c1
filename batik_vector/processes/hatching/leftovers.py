"""What rings leave white: corners that are sharper than the pen, and necks where no ring has room.

Rings reach out into corners by spikes. Whatever else is left is as narrow as the pen, and gets its centre
line.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines
from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.hatching.centre_lines import centre_lines
from batik_vector.processes.hatching.corners import (
    FARTHEST,
    SHORT,
    SLACK,
    Spikes,
    in_corners,
    no_spikes,
    sharp,
)
from batik_vector.processes.hatching.regions import Drawn, Regions
from batik_vector.values import frozen

LEAST = 1 / 32
"""A part of the square of the pen's width: smaller places stay white."""


@frozen(eq=False)
class Leftovers:
    """What fills the places that rings leave white: spikes of the rings within, and lines of their own, each
    in one of the regions around.
    """

    spikes: Spikes
    lines: Outlines
    regions: Index


def part_passed(spacing: float, width: float) -> float:
    """Return after what part of a spacing corners are where the ink of the ring around ends."""
    return max(spacing, width) * (0.5 + SLACK) / spacing


def leftovers(around: Regions, drawn: Drawn, spacing: float, width: float) -> Leftovers:
    """Return what fills the places between rings and those within them.

    Args:
        around: bounded by the rings.
        drawn: what lies a spacing within each.
        spacing: from ring to ring, in steps. Where it is greater than the width, corners stay as they are.
        width: of the pen, in steps.
    """
    broad = max(spacing, width)
    corners, more = in_corners(drawn, broad)
    asked = np.ones(len(around), bool)
    asked[drawn.parents[drawn.own()]] = False
    asked[more] = True
    found = _others(around, drawn, np.flatnonzero(asked), broad)
    if spacing > width * (1 + 1e-9):
        return Leftovers(no_spikes(), found.lines, found.regions)
    spikes = Spikes(
        np.concatenate([corners.point, found.spikes.point]), np.concatenate([corners.tip, found.spikes.tip])
    )
    return Leftovers(spikes, found.lines, found.regions)


def _others(around: Regions, drawn: Drawn, asked: Index, broad: float) -> Leftovers:
    """Return what fills places of all shapes in some of the regions."""
    inner = np.flatnonzero(np.isin(drawn.parents, asked))
    parts = drawn.regions.taken(inner)
    parent = np.searchsorted(asked, drawn.parents[inner])
    within = np.full(len(asked), shapely.Polygon(), dtype=object)
    if len(parts):
        filled = np.unique(parent)
        within[filled] = shapely.multipolygons(parts.polygons(), indices=np.searchsorted(filled, parent))
    pointed = np.asarray(shapely.is_empty(within))
    pointed[parent[np.logical_or.reduceat(sharp(parts), parts.rings[parts.parts[:-1]])]] = True
    kept = np.flatnonzero(pointed)
    pieces, of = _white(around.taken(asked[kept]), within[kept], broad)
    of = kept[of]
    corner, tip, region, painted = _spikes(around, asked, within, pieces, of, broad)
    lines, piece = centre_lines(pieces[~painted], broad)
    # The point of the rings that is the corner.
    points = drawn.regions.points(inner)
    owner = np.repeat(parent, np.diff(parts.rings[parts.parts]))
    rows = np.concatenate([np.column_stack([owner, parts.x, parts.y]), np.column_stack([region, corner])])
    _, first, number = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    at = first[number.reshape(-1)[len(owner) :]]
    there = at < len(owner)
    return Leftovers(Spikes(points[at[there]], tip[there]), lines, asked[of[~painted][piece]])


def _white(regions: Regions, within: Geometries, broad: float) -> tuple[Geometries, Index]:
    """Return places that neither the ring around nor those within paint, and the region of each."""
    reach = broad * (0.5 + SLACK)
    free = regions.drawn_in(reach)
    pieces, of = free.regions.polygons(), free.parents
    cut = np.flatnonzero(~shapely.is_empty(within[of]))
    if len(cut):
        painted = shapely.buffer(within[of[cut]], reach, quad_segs=8)
        pieces[cut] = shapely.difference(pieces[cut], painted)
        pieces, number = shapely.get_parts(pieces, return_index=True)
        of = of[number]
    large = shapely.area(pieces) > broad * broad * LEAST
    return pieces[large], of[large]


def _spikes(
    around: Regions, asked: Index, within: Geometries, pieces: Geometries, of: Index, broad: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], Index, NDArray[np.bool_]]:
    """Return the spikes, from corner to tip, each in which of the asked regions; and which pieces are painted
    by one or do not need it.
    """
    kept = ~shapely.is_empty(within[of])
    some = np.flatnonzero(kept)
    places, piece = shapely.get_coordinates(pieces[some], return_index=True)
    points = np.asarray(shapely.points(places), dtype=object)
    away = np.rint(shapely.distance(points, within[of[some[piece]]]))
    farthest = np.lexsort((-away, piece))
    farthest = farthest[np.diff(piece[farthest], prepend=-1) > 0]
    ways = shapely.get_coordinates(shapely.shortest_line(points[farthest], within[of[some]])).reshape(
        -1, 2, 2
    )
    far, corner = ways[:, 0], ways[:, 1]
    length = np.sqrt(((far - corner) ** 2).sum(axis=1))
    share = np.maximum(length - broad * (0.5 + SHORT), 0.0) / np.maximum(length, 1.0)
    tip = corner + (far - corner) * share[:, None]
    lines = np.asarray(shapely.linestrings(np.stack([corner, tip], axis=1)), dtype=object)
    good = length * share <= broad * FARTHEST
    missed = shapely.distance(points, lines[piece]) > broad * (0.5 + SHORT + SLACK)
    good[piece[missed]] = False
    good[good] = shapely.covers(around.taken(asked[of[some[good]]]).polygons(), lines[good])
    kept[some] = good
    out = good & (share > 0)
    return corner[out], tip[out], of[some[out]], kept
