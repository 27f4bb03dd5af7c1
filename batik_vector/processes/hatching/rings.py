"""Rings within rings: outlines drawn in again and again until nothing is left."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from batik_vector.geometry.outlines import Index, Outlines, Steps, together
from batik_vector.processes.hatching.leftovers import Spikes, leftovers
from batik_vector.processes.hatching.regions import Regions
from batik_vector.values import frozen

FOOT = 8
"""The foot of a spike is an eighth of the pen's width on either side of the corner."""


@frozen(eq=False)
class Level:
    """Rings equally far within, and lines in what they and the rings around them leave white.

    ``parents`` has the region of the level before that each region is a part of. Of each stroke ``bounds``
    has the region that it is an outline of, beyond all where it is none, and ``within`` the region of the
    level before that it lies in.
    """

    regions: Regions
    parents: Index
    strokes: Outlines
    bounds: Index
    within: Index
    marks: Index


def levels(regions: Regions, spacing: float, width: float) -> Iterator[Level]:
    """Yield regions and all that lies within them, by steps of a spacing; lengths are in steps."""
    strokes, bounds = _rings(regions)
    level = Level(regions, np.arange(len(regions)), strokes, bounds, bounds, regions.marks[bounds])
    while len(level.regions):
        yield level
        level = _next(level.regions, spacing, width)
    if len(level.strokes):
        yield level


def _next(around: Regions, spacing: float, width: float) -> Level:
    left = around.shrunk(spacing)
    regions, parents = around.parts(left)
    white = leftovers(around, left, spacing, width)
    rings, bounds = _rings(regions)
    rings = _spiked(rings, parents[bounds], white.spikes, width)
    within = np.concatenate([parents[bounds], white.regions])
    beyond = np.full(len(white.lines), len(regions))
    return Level(
        regions,
        parents,
        together([rings, white.lines]),
        np.concatenate([bounds, beyond]),
        within,
        around.marks[within],
    )


def _spiked(rings: Outlines, within: Index, spikes: Spikes, width: float) -> Outlines:
    """Return rings that reach out by spikes: before and after each the corner is left out.

    Args:
        rings: closed outlines.
        within: the region around each.
        spikes: what they reach out for.
        width: of the pen, in steps: an eighth of it is the foot of a spike, on either side.
    """
    ring = np.repeat(np.arange(len(within)), np.diff(rings.rings))
    corner, tip = (np.rint(each).astype(np.int64) for each in (spikes.corner, spikes.tip))
    rows = np.concatenate(
        [np.column_stack([within[ring], rings.points]), np.column_stack([spikes.region, corner])]
    )
    _, first, number = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    at = first[number.reshape(-1)[len(ring) :]]
    # A corner has one spike, and what was cut off it none.
    at, which = np.unique(at, return_index=True)
    found = at < len(ring)
    at, tip = at[found], tip[which[found]]
    before, after = at - 1, at + 1
    starts, stops = rings.rings[ring[at]], rings.rings[ring[at] + 1]
    before, after = np.where(at == starts, stops - 1, before), np.where(after == stops, starts, after)
    foot = width / FOOT
    feet = [_toward(rings.points[at], rings.points[other], foot) for other in (before, after)]
    points = rings.points.copy()
    points[at] = feet[0]
    points = np.insert(points, np.repeat(at + 1, 2), np.stack([tip, feet[1]], axis=1).reshape(-1, 2), axis=0)
    more = 2 * np.bincount(ring[at], minlength=len(within))
    return Outlines(points, rings.rings + np.concatenate([[0], np.cumsum(more)]), rings.marks, rings.closed)


def _toward(places: Steps, others: Steps, distance: float) -> Steps:
    """Return places so far on the way to others, by a third of the way at most."""
    way = others - places
    length = np.sqrt((way * way).sum(axis=1))
    share = np.minimum(distance / np.maximum(length, 1.0), 1 / 3)
    moved: Steps = np.rint(places + way * share[:, None]).astype(np.int64)
    return moved


def as_strokes(regions: Regions) -> tuple[Outlines, Index]:
    """Return the rings of regions as closed strokes, and the mark of each; none that shrank to a line."""
    strokes, of = _rings(regions)
    return strokes, regions.marks[of]


def _rings(regions: Regions) -> tuple[Outlines, Index]:
    """Return the same, and the region of each."""
    outlines = regions.outlines()
    rings = shapely.get_num_interior_rings(regions.polygons) + 1
    strokes = Outlines(outlines.points, outlines.rings, np.arange(len(outlines.rings)), outlines.closed)
    kept = np.flatnonzero(np.diff(outlines.rings) > 2)
    return strokes.taken(kept), np.repeat(np.arange(len(regions)), rings)[kept]


def concentric(regions: Regions, spacing: float, width: float, *, edge_last: bool) -> tuple[Outlines, Index]:
    """Return rings as strokes from the outside in, or from the inside out, and the mark of each.

    Args:
        regions: bounded by the outmost rings.
        spacing: from ring to ring, in steps.
        width: of the pen, in steps.
        edge_last: whether the inmost are drawn first.
    """
    found = list(levels(regions, spacing, width))
    if edge_last:
        found.reverse()
    marks = np.concatenate([np.empty(0, np.intp), *(level.marks for level in found)])
    return together([level.strokes for level in found]), marks
