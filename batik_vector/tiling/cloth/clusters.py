"""Which marks belong together as one motif: what is left out with any of them where whole motifs are kept.

A tile no longer knows its motifs but by name ("flower.petal"). Where a motif's rarest element, the core, is
there k times and each lies nearest to equally many of every other element, these are its k copies. Where that
tells nothing, marks of one motif that lie close, measured by their own size, are one copy of it. Where copies
lie so close themselves that all would be one without end, closer marks are asked for, and at last each is
for itself.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Geometries
from batik_vector.geometry.outlines import Index, Outlines, Steps
from batik_vector.geometry.sampling import Array
from batik_vector.tiling.cloth.whole_marks import cell_of, followed, lattice_of
from batik_vector.tiling.cloth.windows import placed
from batik_vector.tiling.torus.torus import Window, translate
from batik_vector.values import frozen

ALIKE = 0.4
"""How far apart marks of one element may lie, as petals do, as a share of the smaller one's size."""
UNLIKE = 0.5
"""The same of different elements, as a petal and its core, as a share of the larger one's size."""
LEVELS = (1.0, 0.8, 0.64, 0.5, 0.4, 0.3, 0.2, 0.1, 0.0)
"""What is left of these distances, one after another, where copies would run on into each other."""


@frozen(eq=False)
class _Links:
    """Marks held to be of one copy: one, other, the other's cell from the one's, and from which level on."""

    one: Index
    other: Index
    step: Steps
    level: Array

    def kept(self, which: NDArray[np.bool_]) -> _Links:
        return _Links(self.one[which], self.other[which], self.step[which], self.level[which])


@frozen(eq=False)
class _Marks:
    """Marks in their home cell: their hulls, and the numbers of their motif and of their element."""

    hulls: Geometries
    motif: Index
    element: Index
    cell: Cell

    def copies(self, rows: Index, window: Window) -> tuple[Index, Steps, Geometries]:
        """Return the translates of some marks that meet a window: which, how far moved, and their hulls."""
        bounds = np.rint(shapely.bounds(self.hulls[rows])).astype(np.int64)
        tallest = int((bounds[:, 3] - bounds[:, 1]).max())
        at, shift = placed(bounds, self.cell, window, window.bottom - tallest, window.top + 1)
        return rows[at], shift, translate(self.hulls[rows[at]], shift)


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
    names = [name for marks in sets for name in marks.names]
    at = cell_of(np.rint((bounds[:, :2] + bounds[:, 2:]) / 2).astype(np.int64), cell) @ lattice_of(cell)
    hulls = translate(np.concatenate([_hulls(marks) for marks in sets]), -at)
    label, place = _followed(
        _Marks(hulls, _numbered(name.split(".")[0] for name in names), _numbered(names), cell)
    )
    # Where each mark lies in its cluster, and back.
    home = place @ lattice_of(cell) - at
    low, high = bounds[:, :2] + home, bounds[:, 2:] + home
    least, most = low.copy(), high.copy()
    np.minimum.at(least, label, low)
    np.maximum.at(most, label, high)
    guards = np.hstack([least[label] - home, most[label] - home])
    return np.split(guards, np.cumsum([len(marks) for marks in sets])[:-1])


def _numbered(names: Iterable[str]) -> Index:
    return np.unique(np.array(list(names), dtype=str), return_inverse=True)[1].astype(np.intp)


def _followed(marks: _Marks) -> tuple[Index, Steps]:
    """Return the cluster of each mark, and its cell from that of the cluster's first."""
    count = len(marks.hulls)
    label, place = np.arange(count), np.zeros((count, 2), np.int64)
    if not count:
        return label, place
    stars, near = _stars(marks), _near(marks)
    # Copies that are known by their cores take in what lies over them, and nothing else.
    known = np.isin(marks.motif[near.one], marks.motif[stars.one])
    near = near.kept(~known | (near.level <= 0))
    waiting = np.ones(count, bool)
    for level in (*LEVELS, -1.0):
        some = [links.kept(waiting[links.one] & (links.level <= level)) for links in (stars, near)]
        parts = [(links.one, links.other, links.step) for links in some]
        a, b, step = (np.concatenate(each) for each in zip(*parts, strict=True))
        of, cells, runs_on = followed(count, (a, b, step))
        # A motif is settled when none of its copies goes on without end.
        done = waiting & ~np.isin(marks.motif, marks.motif[runs_on])
        label[done], place[done] = of[done], cells[done]
        waiting &= ~done
        if not waiting.any():
            break
    return label, place


def _hulls(marks: Outlines) -> Geometries:
    """Return the convex hull of each mark."""
    if not len(marks):
        return np.empty(0, dtype=object)
    owner = np.repeat(np.arange(len(marks)), marks.sizes())
    points = np.asarray(shapely.points(marks.points.astype(float)), dtype=object)
    return np.asarray(shapely.convex_hull(shapely.multipoints(points, indices=owner)), dtype=object)


def _stars(marks: _Marks) -> _Links:
    """Return the links of marks to the cores of their motifs, where these tell copies apart."""
    found = [
        _star(marks, np.flatnonzero(marks.motif == motif)) for motif in range(int(marks.motif.max()) + 1)
    ]
    a, b, step = (np.concatenate(each) for each in zip(*found, strict=True))
    return _Links(a, b, step, np.full(len(a), -1.0))


def _star(marks: _Marks, rows: Index) -> tuple[Index, Index, Steps]:
    """Return the links of one motif's marks to its cores, or none."""
    none = np.empty(0, np.intp), np.empty(0, np.intp), np.empty((0, 2), np.int64)
    elements, counts = np.unique(marks.element[rows], return_counts=True)
    copies = int(counts.min())
    if len(elements) == 1 or (counts % copies).any():
        return none
    core = elements[np.argmin(counts)]
    cores, others = rows[marks.element[rows] == core], rows[marks.element[rows] != core]
    middles = shapely.bounds(marks.hulls[others]).reshape(-1, 2, 2).mean(axis=1)
    # No point lies farther from a lattice than both its translations are long.
    far = int(np.abs(lattice_of(marks.cell)).sum() + marks.cell.columns + marks.cell.rows)
    low, high = middles.min(axis=0) - far, middles.max(axis=0) + far
    window = Window(int(low[0]), int(low[1]), int(high[0]), int(high[1]))
    mark, shift, hulls = marks.copies(cores, window)
    a, k = shapely.STRtree(hulls).query_nearest(shapely.points(middles), all_matches=False)
    a, b = others[a], mark[k]
    each = np.unique(np.column_stack([marks.element[a], b]), axis=0, return_counts=True)
    fair = dict(zip(elements.tolist(), (counts // copies).tolist(), strict=True))
    wanted = np.array([fair[element] for element in each[0][:, 0].tolist()])
    if (each[1] != wanted).any():
        return none
    return a, b, cell_of(shift[k], marks.cell)


def _near(marks: _Marks) -> _Links:
    """Return the links of marks of one motif that lie close on the torus."""
    bounds = shapely.bounds(marks.hulls)
    size = (bounds[:, 2:] - bounds[:, :2]).max(axis=1)
    reach = int(np.ceil(UNLIKE * size.max())) + 1
    low, high = bounds[:, :2].min(axis=0) - reach, bounds[:, 2:].max(axis=0) + reach
    window = Window(int(low[0]), int(low[1]), int(high[0]), int(high[1]))
    mark, shift, hulls = marks.copies(np.arange(len(size)), window)
    # The larger mark of a pair finds the smaller one.
    a, k = shapely.STRtree(hulls).query(marks.hulls, predicate="dwithin", distance=UNLIKE * size)
    one = marks.motif[a] == marks.motif[mark[k]]
    a, k = a[one], k[one]
    b = mark[k]
    alike = marks.element[a] == marks.element[b]
    allowed = np.where(alike, ALIKE * np.minimum(size[a], size[b]), UNLIKE * size[a])
    apart: Array = shapely.distance(marks.hulls[a], hulls[k])
    links = _Links(a, b, cell_of(shift[k], marks.cell), apart / np.maximum(allowed, 1.0))
    return links.kept(links.level <= 1)
