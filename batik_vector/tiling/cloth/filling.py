"""A window filled from a tile's marks, piece by piece.

Whole marks are placed by translation; those that the window's edge crosses are cut once for each way in which
it crosses them. Endless marks are joined over all cells that the window meets, as rings of chains that are
written out only when their turn comes. So memory grows with the window's edge and with the seams that endless
marks cross, and not with what is drawn.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import (
    Index,
    Outlines,
    Steps,
    of_polygons,
    of_polylines,
    to_polygons,
    to_polylines,
    together,
)
from batik_vector.tiling.cloth.chains import Chains, Copies, all_chains, chains_of
from batik_vector.tiling.cloth.paths import paths_of
from batik_vector.tiling.cloth.rings import Rings, rings_of
from batik_vector.tiling.cloth.whole_marks import Unrolled, seam_ends
from batik_vector.tiling.cloth.windows import (
    CROSS,
    LINE,
    MEET,
    Cuttings,
    Filling,
    Touch,
    crossing,
    cuttings,
    numbers,
    placed,
)
from batik_vector.tiling.torus.torus import Window
from batik_vector.tiling.welding.duplicates import drawn_once
from batik_vector.tiling.welding.weld import welded

Seams = tuple[tuple[int, ...], tuple[int, ...]]
"""Abscissas of upright seams, ordinates of level ones."""


def bands(bounds: Steps, window: Window, count: int) -> list[tuple[int, int]]:
    """Return bands of equal height in which all marks that meet the window begin."""
    if not len(bounds):
        return []
    low = window.bottom - int((bounds[:, 3] - bounds[:, 1]).max())
    edges = np.linspace(low, window.top + 1, count + 1).astype(np.int64).tolist()
    return list(pairwise(edges))


class _Whole:
    """The copies of whole marks: those in the window in pieces, those that cross its edge gathered."""

    def __init__(self, marks: Outlines, filling: Filling, touch: Touch, guard: Steps | None) -> None:
        self._marks, self._filling, self._touch, self._guard = marks, filling, touch, guard
        self._crossing: list[tuple[Index, Steps]] = []

    def pieces(self) -> Iterator[Outlines]:
        """Yield the copies that lie in the window."""
        marks, (window, cell) = self._marks, (self._filling.window, self._filling.cell)
        bounds = marks.bounds()
        share = (window.right - window.left) * (window.top - window.bottom) / (cell.columns * cell.rows)
        rows = bands(bounds, window, max(1, round(share * len(marks.points) / self._filling.piece)))
        for low, high in rows:
            mark, shift = placed(bounds, cell, window, low, high)
            over = crossing(marks, mark, shift, self._filling, self._touch, self._guard)
            self._crossing.append((mark[over], shift[over]))
            yield from _taken(marks, mark[~over], shift[~over], self._filling.piece)
            self._filling.tell((high - rows[0][0]) / (rows[-1][1] - rows[0][0]))

    def cuttings(self) -> Cuttings:
        """Return what is left of the others, once all pieces have been taken."""
        crossing = self._crossing or [(np.empty(0, np.intp), np.empty((0, 2), np.int64))]
        mark, shift = (np.concatenate(each) for each in zip(*crossing, strict=True))
        return cuttings(self._marks, mark, shift, self._filling, self._touch)


def _taken(marks: Outlines, which: Index, shift: Steps, piece: int) -> Iterator[Outlines]:
    """Yield copies of marks, in pieces."""
    names = np.asarray(marks.names, dtype=object)
    cuts = np.flatnonzero(np.diff(np.cumsum(marks.sizes()[which]) // piece)) + 1
    for some, moved in zip(np.split(which, cuts), np.split(shift, cuts), strict=True):
        if len(some):
            yield replace(marks.taken(some, moved), names=names[some].tolist())


def filled_areas(
    areas: Unrolled,
    filling: Filling,
    weld: bool,
    border: Outlines | None = None,
    guard: Steps | None = None,
) -> Iterator[Outlines]:
    """Yield the areas that fill a window, in pieces.

    Args:
        areas: the marks of an ink.
        filling: window and lattice.
        weld: areas of the ink are one where they meet; or else each mark is for itself.
        border: areas outside the window, in whole steps, with names: one with what they meet at its edge.
        guard: the bounds of each whole mark together with what is left out with it, shape (k, 4).
    """
    joins = weld and border is not None
    touch = MEET if joins else CROSS
    heap = _Heap()
    marks = _Whole(areas.whole, filling, touch, guard)
    yield from marks.pieces()
    if filling.cut:
        cut = marks.cuttings()
        if joins:
            heap.add_cut(cut, ((), ()), joins)
        else:
            yield from _taken(cut.pieces, cut.which, cut.shift, filling.piece)
    _add_endless(heap, areas, filling, touch)
    if border is not None and joins:
        heap.add_border(border, filling.window)
    elif border is not None:
        yield from _taken(border, np.arange(len(border)), np.zeros((len(border), 2), np.int64), filling.piece)
    if heap:
        yield from heap.welded(weld, filling.piece)


def _add_endless(heap: _Heap, areas: Unrolled, filling: Filling, touch: Touch) -> None:
    """Add the copies of pieces of endless marks that lie in the window, cut where its edge crosses them."""
    pieces, window, cell = areas.endless, filling.window, filling.cell
    bounds = pieces.bounds()
    low, high = window.bottom - 2 * cell.rows, window.top + 1
    mark, shift = placed(bounds, cell, window, low, high)
    order = np.lexsort([mark, shift[:, 0], shift[:, 1]])
    mark, shift = mark[order], shift[order]
    over = crossing(pieces, mark, shift, filling, touch)
    seams = ((0, cell.columns), (0, cell.rows))
    heap.add(pieces, mark[~over], shift[~over], seams, areas.strand)
    cut = cuttings(pieces, mark[over], shift[over], filling, touch)
    heap.add_cut(cut, seams, touch == MEET, areas.strand[cut.mark])


class _Heap:
    """Copies of pieces of all kinds, gathered for welding: chains, and a name and strand for each owner."""

    def __init__(self) -> None:
        self._chains: list[Chains] = []
        self._count = self._owners = 0
        self._copies: list[tuple[Index, Steps, Index]] = []
        self._names: list[NDArray[np.object_]] = []
        self._strands: list[Index] = []
        self._corners: list[Outlines] = []
        self._corner_seams: tuple[set[int], set[int]] = (set(), set())

    def __bool__(self) -> bool:
        return bool(self._chains)

    def add(
        self, pieces: Outlines, which: Index, shift: Steps, seams: Seams, strand: Index | None = None
    ) -> None:
        """Add copies of pieces.

        Args:
            pieces: in their own coordinates, with names.
            which: the piece that each copy is of.
            shift: how far it is moved.
            seams: where pieces meet others, in their own coordinates.
            strand: a number for each piece: those of an overlay meet only others of their strand.
        """
        if not len(which):
            return
        chains = chains_of(pieces, seams)
        of = np.argsort(chains.mark, kind="stable")
        first, last = (np.searchsorted(chains.mark[of], which, side=side) for side in ("left", "right"))
        copy, row = numbers(first, last - 1)
        self._copies.append((of[row] + self._count, shift[copy], copy + self._owners))
        self._names.append(np.asarray(pieces.names, dtype=object)[which])
        self._strands.append(np.zeros(len(which), np.intp) if strand is None else strand[which])
        self._chains.append(chains)
        self._count += len(chains)
        self._owners += len(which)

    def add_cut(self, cut: Cuttings, seams: Seams, at_edge: bool, strand: Index | None = None) -> None:
        """Add copies of cut pieces; the edges that cut them are seams too, where borders lie beyond."""
        if not at_edge:
            self.add(cut.pieces, cut.which, cut.shift, seams, strand)
            return
        names = np.asarray(cut.pieces.names, dtype=object)
        some = np.flatnonzero(cut.corner)
        taken = cut.pieces.taken(cut.which[some], cut.shift[some])
        self._corners.append(replace(taken, names=names[cut.which[some]].tolist()))
        for axis in (0, 1):
            lines = cut.shift[some, axis][:, None] + np.array(seams[axis], np.int64)
            self._corner_seams[axis].update(np.unique(lines).tolist())
        ways, way = np.unique(cut.edges, axis=0, return_inverse=True)
        for number, (left, bottom, right, top) in enumerate(ways.tolist()):
            mine = np.flatnonzero(way.ravel() == number)
            place = np.full(len(cut.pieces), -1)
            place[mine] = np.arange(len(mine))
            copies = np.flatnonzero((place[cut.which] >= 0) & ~cut.corner)
            self.add(
                replace(cut.pieces.taken(mine), names=names[mine].tolist()),
                place[cut.which[copies]],
                cut.shift[copies],
                ((*seams[0], left, right), (*seams[1], bottom, top)),
            )

    def add_border(self, border: Outlines, window: Window) -> None:
        """Add what lies outside the window, and meets the field at its edge and at rounded corners.

        A corner is no line on which edges cancel: there GEOS welds.
        """
        beside = together([border, *self._corners])
        joined, first = welded(to_polygons(beside))
        made = of_polygons(np.asarray(shapely.orient_polygons(joined), dtype=object))
        names = np.asarray(beside.names, dtype=object)[first].tolist()
        x, y = (sorted(values) for values in self._corner_seams)
        seams = ((*x, window.left, window.right), (*y, window.bottom, window.top))
        each = np.arange(len(made))
        self.add(replace(made, names=names), each, np.zeros((len(each), 2), np.int64), seams)

    def welded(self, weld: bool, piece: int) -> Iterator[Outlines]:
        """Yield all areas, welded or strand by strand, in pieces."""
        columns = (np.concatenate(each) for each in zip(*self._copies, strict=True))
        copies = Copies(all_chains(self._chains), *columns)
        group = None if weld else np.concatenate(self._strands)[copies.owner]
        yield from _written(rings_of(copies, group), np.concatenate(self._names), piece)


def _written(rings: Rings, names: NDArray[np.object_], piece: int) -> Iterator[Outlines]:
    """Yield polygons made of rings, in pieces; one larger than a piece comes in several."""
    total = np.cumsum(rings.sizes())
    cuts = np.flatnonzero(np.diff(total // piece)) + 1
    for first, stop in pairwise([0, *cuts.tolist(), len(total)]):
        points, ends = rings.outlines(first, stop)
        inner = rings.marks[(rings.marks > first) & (rings.marks < stop)]
        marks = np.concatenate([[first], inner, [stop]])
        polygon = np.searchsorted(rings.marks, marks[:-1], side="right") - 1
        yield Outlines(
            points,
            ends,
            marks - first,
            np.ones(stop - first, bool),
            names[rings.owner[polygon]].tolist(),
            unfinished=bool(stop not in rings.marks),
        )


def filled_lines(
    lines: Unrolled, filling: Filling, border: Outlines | None = None, guard: Steps | None = None
) -> Iterator[Outlines]:
    """Yield the centre lines that fill a window, in pieces.

    Args:
        lines: the marks of an ink.
        filling: window and lattice.
        border: lines outside the window, in whole steps, with names.
        guard: the bounds of each whole mark together with what is left out with it, shape (k, 4).
    """
    marks = _Whole(lines.whole, filling, LINE, guard)
    yield from marks.pieces()
    if filling.cut:
        cut = marks.cuttings()
        for some in _taken(cut.pieces, cut.which, cut.shift, filling.piece):
            yield _once(some)
    yield from _endless_lines(lines, filling)
    if border is not None and len(border):
        yield border


def _endless_lines(lines: Unrolled, filling: Filling) -> Iterator[Outlines]:
    pieces, window, cell = lines.endless, filling.window, filling.cell
    if not len(pieces):
        return
    mark, shift = placed(pieces.bounds(), cell, window, window.bottom - 2 * cell.rows, window.top + 1)
    order = np.lexsort([mark, shift[:, 0], shift[:, 1]])
    mark, shift = mark[order], shift[order]
    paths = paths_of(pieces, mark, shift, seam_ends(pieces, cell), lines.strand[mark])
    names = np.asarray(pieces.names, dtype=object)[mark[paths.rows[paths.offsets[:-1]]]]
    cuts = np.flatnonzero(np.diff(np.cumsum(paths.sizes()) // filling.piece)) + 1
    zero = np.zeros((1, 2), np.int64)
    for first, stop in pairwise([0, *cuts.tolist(), len(paths.loop)]):
        some = replace(paths.outlines(first, stop), names=names[first:stop].tolist())
        each = np.arange(len(some))
        cut = cuttings(some, each, np.repeat(zero, len(each), axis=0), filling, LINE)
        yield _once(
            replace(cut.pieces.taken(cut.which), names=np.asarray(cut.pieces.names)[cut.which].tolist())
        )


def _once(lines: Outlines) -> Outlines:
    """Return lines without stretches drawn twice: cutting may bring two together that ran a hair apart."""
    names, code = np.unique(np.asarray(lines.names, dtype=str), return_inverse=True)
    kept, codes = drawn_once(to_polylines(lines), code)
    return replace(of_polylines(kept), names=names[codes].tolist())
