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
from numpy.typing import NDArray

from batik_vector.outlines import (
    Index,
    Outlines,
    Steps,
    of_polylines,
    to_polylines,
)
from batik_vector.tiling.chains import NO_SEAM, Chains, Copies, all_chains, chains_of
from batik_vector.tiling.cutting import (
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
from batik_vector.tiling.once import drawn_once
from batik_vector.tiling.paths import paths_of
from batik_vector.tiling.rings import Rings, rings_of
from batik_vector.tiling.torus import Window
from batik_vector.tiling.unroll import Unrolled, halves, seam_ends
from batik_vector.tiling.weld import components

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
    _add_endless(heap, areas.endless, filling, touch)
    if border is not None:
        edges = filling.window
        zero = np.zeros((len(border), 2), np.int64)
        if joins:
            heap.add(
                border, np.arange(len(border)), zero, ((edges.left, edges.right), (edges.bottom, edges.top))
            )
        else:
            yield from _taken(border, np.arange(len(border)), zero, filling.piece)
    if heap:
        yield from heap.welded(weld, filling.piece)


def _add_endless(heap: _Heap, pieces: Outlines, filling: Filling, touch: Touch) -> None:
    """Add the copies of pieces of endless marks that lie in the window, cut where its edge crosses them."""
    window, cell = filling.window, filling.cell
    bounds = pieces.bounds()
    low, high = window.bottom - 2 * cell.rows, window.top + 1
    mark, shift = placed(bounds, cell, window, low, high)
    order = np.lexsort([mark, shift[:, 0], shift[:, 1]])
    mark, shift = mark[order], shift[order]
    over = crossing(pieces, mark, shift, filling, touch)
    seams = ((0, cell.columns), (0, cell.rows))
    heap.add(pieces, mark[~over], shift[~over], seams)
    heap.add_cut(cuttings(pieces, mark[over], shift[over], filling, touch), seams, touch == MEET)


class _Heap:
    """Copies of pieces of all kinds, gathered for welding: chains, and a name for each owner."""

    def __init__(self) -> None:
        self._chains: list[Chains] = []
        self._count = self._owners = 0
        self._copies: list[tuple[Index, Steps, Index]] = []
        self._names: list[NDArray[np.object_]] = []

    def __bool__(self) -> bool:
        return bool(self._chains)

    def add(self, pieces: Outlines, which: Index, shift: Steps, seams: Seams) -> None:
        """Add copies of pieces; ``seams`` are where these meet others, in their own coordinates."""
        if not len(which):
            return
        chains = chains_of(pieces, seams)
        of = np.argsort(chains.mark, kind="stable")
        first, last = (np.searchsorted(chains.mark[of], which, side=side) for side in ("left", "right"))
        copy, row = numbers(first, last - 1)
        self._copies.append((of[row] + self._count, shift[copy], copy + self._owners))
        self._names.append(np.asarray(pieces.names, dtype=object)[which])
        self._chains.append(chains)
        self._count += len(chains)
        self._owners += len(which)

    def add_cut(self, cut: Cuttings, seams: Seams, at_edge: bool) -> None:
        """Add copies of cut pieces; the edges that cut them are seams too, where borders lie beyond."""
        if not at_edge:
            self.add(cut.pieces, cut.which, cut.shift, seams)
            return
        names = np.asarray(cut.pieces.names, dtype=object)
        ways, way = np.unique(cut.edges, axis=0, return_inverse=True)
        for number, (left, bottom, right, top) in enumerate(ways.tolist()):
            mine = np.flatnonzero(way.ravel() == number)
            place = np.full(len(cut.pieces), -1)
            place[mine] = np.arange(len(mine))
            copies = np.flatnonzero(place[cut.which] >= 0)
            self.add(
                replace(cut.pieces.taken(mine), names=names[mine].tolist()),
                place[cut.which[copies]],
                cut.shift[copies],
                ((*seams[0], left, right), (*seams[1], bottom, top)),
            )

    def welded(self, weld: bool, piece: int) -> Iterator[Outlines]:
        """Yield all areas, welded or as single marks, in pieces."""
        columns = (np.concatenate(each) for each in zip(*self._copies, strict=True))
        copies = Copies(all_chains(self._chains), *columns)
        names = np.concatenate(self._names)
        if weld:
            yield from _written(rings_of(copies), names, piece)
            return
        edges = np.flatnonzero(copies.chains.axis[copies.which] != NO_SEAM)
        _, code = np.unique(names.astype(str), return_inverse=True)
        some = Copies(copies.chains, copies.which[edges], copies.shift[edges], copies.owner[edges])
        body = components(len(names), np.column_stack(halves(some, code[some.owner])))
        yield from _written(rings_of(copies, body[copies.owner], body), names, piece)


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
