"""Rings within rings: outlines drawn in again and again until nothing is left."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from batik_vector.geometry.outlines import Index, Outlines, together
from batik_vector.processes.hatching.corners import Spikes, spiked
from batik_vector.processes.hatching.leftovers import leftovers, part_passed
from batik_vector.processes.hatching.regions import Regions
from batik_vector.values import frozen


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
    drawn = around.drawn_in(spacing, part_passed(spacing, width))
    regions, parents = drawn.regions, drawn.parents
    white = leftovers(around, drawn, spacing, width)
    rings, bounds = _rings(regions, white.spikes, width)
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


def as_strokes(regions: Regions) -> tuple[Outlines, Index]:
    """Return the rings of regions as closed strokes, and the mark of each; none that shrank to a line."""
    strokes, of = _rings(regions)
    return strokes, regions.marks[of]


def _rings(regions: Regions, spikes: Spikes | None = None, width: float = 0.0) -> tuple[Outlines, Index]:
    """Return the same, and the region of each; reaching out by spikes."""
    outlines = regions.outlines()
    strokes = Outlines(outlines.points, outlines.rings, np.arange(len(outlines.rings)), outlines.closed)
    of = np.repeat(np.arange(len(regions)), np.diff(regions.parts))
    kept = np.diff(strokes.rings) > 2
    if spikes:
        strokes = spiked(strokes, spikes, width)
    return (strokes, of) if kept.all() else (strokes.taken(np.flatnonzero(kept)), of[kept])


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
