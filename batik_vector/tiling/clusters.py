"""Which marks belong together as one motif: what is left out with any of them where whole motifs are kept.

A tile no longer knows its motifs but by name ("flower.petal"). Marks of one motif that lie close, measured
by their own size, are one copy of it: petals round their core. Where copies lie so close themselves that
all would be one without end, closer marks are asked for, and at last each is for itself.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Geometries
from batik_vector.outlines import Index, Outlines, Steps
from batik_vector.tiling.cutting import placed
from batik_vector.tiling.torus import Window, translate
from batik_vector.tiling.unroll import cell_of, followed, lattice_of

SHARES = (0.4, 0.2, 0.1, 0.0)
"""How far apart marks of one copy may lie, as a share of the smaller one's size; one after another."""


def clustered(sets: Sequence[Outlines], bodies: Sequence[int], cell: Cell) -> list[Steps]:
    """Return for each mark the bounds of all the marks that it belongs to, beside the mark: shape (k, 4).

    Args:
        sets: whole marks, in steps, with their names: those of each ink and kind.
        bodies: how far the marks of each set reach beyond their outlines, in steps.
        cell: whose lattice repeats them.
    """
    bounds = np.concatenate(
        [marks.bounds() + np.array([-b, -b, b, b]) for marks, b in zip(sets, bodies, strict=True)]
    )
    names = [name.split(".")[0] for marks in sets for name in marks.names]
    _, motif = np.unique(np.array(names, dtype=str), return_inverse=True)
    at = cell_of(np.rint((bounds[:, :2] + bounds[:, 2:]) / 2).astype(np.int64), cell) @ lattice_of(cell)
    hulls = translate(np.concatenate([_hulls(marks) for marks in sets]), -at)
    label, place = np.arange(len(bounds)), np.zeros((len(bounds), 2), np.int64)
    waiting = np.ones(len(bounds), bool)
    for share in SHARES:
        rows = np.flatnonzero(waiting)
        a, b, step = _near(hulls[rows], motif[rows], share, cell)
        of, cells, runs_on = followed(len(rows), (a, b, step))
        # A motif is settled when none of its copies goes on without end.
        settled = ~np.isin(motif[rows], motif[rows[runs_on]])
        done = rows[settled]
        label[done], place[done] = rows[of[settled]], cells[settled]
        waiting[done] = False
    # Where each mark lies in its cluster, and back.
    home = place @ lattice_of(cell) - at
    low, high = bounds[:, :2] + home, bounds[:, 2:] + home
    least, most = low.copy(), high.copy()
    np.minimum.at(least, label, low)
    np.maximum.at(most, label, high)
    guards = np.hstack([least[label] - home, most[label] - home])
    return np.split(guards, np.cumsum([len(marks) for marks in sets])[:-1])


def _hulls(marks: Outlines) -> Geometries:
    """Return the convex hull of each mark."""
    if not len(marks):
        return np.empty(0, dtype=object)
    owner = np.repeat(np.arange(len(marks)), marks.sizes())
    points = np.asarray(shapely.points(marks.points.astype(float)), dtype=object)
    return np.asarray(shapely.convex_hull(shapely.multipoints(points, indices=owner)), dtype=object)


def _near(hulls: Geometries, motif: Index, share: float, cell: Cell) -> tuple[Index, Index, Steps]:
    """Return the marks of one motif that lie close on the torus: (one, other, the other's cell)."""
    if not len(hulls):
        none = np.empty(0, np.intp)
        return none, none, np.empty((0, 2), np.int64)
    bounds = np.rint(shapely.bounds(hulls)).astype(np.int64)
    size = (bounds[:, 2:] - bounds[:, :2]).max(axis=1).astype(float)
    reach = int(np.ceil(share * size.max())) + 1
    low, high = bounds[:, :2].min(axis=0) - reach, bounds[:, 2:].max(axis=0) + reach
    window = Window(int(low[0]), int(low[1]), int(high[0]), int(high[1]))
    mark, shift = placed(
        bounds, cell, window, window.bottom - int((bounds[:, 3] - bounds[:, 1]).max()), window.top + 1
    )
    copies = translate(hulls[mark], shift)
    a, k = shapely.STRtree(copies).query(hulls, predicate="dwithin", distance=share * size)
    b = mark[k]
    apart: NDArray[np.float64] = shapely.distance(hulls[a], copies[k])
    keep = (motif[a] == motif[b]) & (apart <= share * size[b])
    return a[keep], b[keep], cell_of(shift[k[keep]], cell)
