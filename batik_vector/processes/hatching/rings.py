"""Rings within rings: outlines drawn in again and again until nothing is left."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from batik_vector.geometry.outlines import Index, Outlines, together
from batik_vector.processes.hatching.regions import Regions
from batik_vector.values import frozen


@frozen(eq=False)
class Level:
    """Rings equally far within: regions, and of which region of the level before each is a part."""

    regions: Regions
    parents: Index


def levels(regions: Regions, spacing: float) -> Iterator[Level]:
    """Yield regions and all that lies within them, by steps of a spacing.

    Where nothing lies a spacing within, but something half as far, that is the last: the pen would leave
    white in the middle.
    """
    level = Level(regions, np.arange(len(regions)))
    last = np.zeros(len(regions), bool)
    while len(level.regions):
        yield level
        going = np.flatnonzero(~last)
        inner, of = level.regions.taken(going).drawn_in(spacing)
        ended = np.setdiff1d(going, going[of])
        middle, of_ended = level.regions.taken(ended).drawn_in(spacing / 2)
        last = np.repeat([False, True], [len(inner), len(middle)])
        level = Level(
            Regions(
                np.concatenate([inner.polygons, middle.polygons]), np.concatenate([inner.marks, middle.marks])
            ),
            np.concatenate([going[of], ended[of_ended]]),
        )


def as_strokes(regions: Regions) -> tuple[Outlines, Index]:
    """Return the rings of regions as closed strokes, and the mark of each; none that shrank to a line."""
    outlines = regions.outlines()
    rings = shapely.get_num_interior_rings(regions.polygons) + 1
    sizes = np.diff(outlines.rings)
    strokes = Outlines(outlines.points, outlines.rings, np.arange(len(outlines.rings)), outlines.closed)
    kept = np.flatnonzero(sizes > 2)
    return strokes.taken(kept), np.repeat(regions.marks, rings)[kept]


def concentric(regions: Regions, spacing: float, *, edge_last: bool) -> tuple[Outlines, Index]:
    """Return rings as closed strokes from the outside in, or from the inside out, and the mark of each."""
    drawn = [as_strokes(level.regions) for level in levels(regions, spacing)]
    if edge_last:
        drawn.reverse()
    marks = np.concatenate([np.empty(0, np.intp), *(of for _, of in drawn)])
    return together([strokes for strokes, _ in drawn]), marks
