"""Marks taken off the torus: what a seam divided is whole again, once and for all repeats.

A mark of the infinite field is either **whole**, an area or line of some extent that repeats with the
lattice, or **endless**: it meets its own translates, as bars and trellises do. Which of the two is decided
on the torus: its pieces are followed from cell to cell, and an endless one comes back to a piece in another
cell.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Ink, Layer, Overlap
from batik_vector.geometry.nets.components import components
from batik_vector.geometry.outlines import (
    MM,
    Index,
    Outlines,
    Steps,
    of_polygons,
    of_polylines,
    to_polygons,
    together,
)
from batik_vector.tiling.cloth.chains import Chains, Copies, cancelled, chains_of, numbered
from batik_vector.tiling.cloth.paths import Ends, ends_of, paths_of
from batik_vector.tiling.cloth.rings import rings_of, whole
from batik_vector.tiling.torus.torus import polygons_of
from batik_vector.values import frozen

Meetings = tuple[Index, Index, Steps]
"""Pieces that are one across a seam: (one, other, the other's cell from the one's, in lattice steps)."""


@frozen
class Unrolled:
    """The marks of one ink and kind: whole ones, each once, and the pieces in the cell of endless ones.

    ``strand`` numbers, for each piece, the endless mark on the torus that it is of; the pieces of a strand do
    not lie over one another.
    """

    whole: Outlines
    endless: Outlines
    strand: Index


def welds(ink: Ink) -> bool:
    """Return whether marks of an ink that meet are one; those of an overlay stay single."""
    return ink.overlap != Overlap.OVERLAY


def unrolled(layer: Layer, cell: Cell, lines: bool = False) -> Unrolled:
    """Return the areas of a layer, or its lines, off the torus."""
    if lines:
        return unrolled_lines(replace(of_polylines(layer.lines, MM), names=layer.line_names), cell)
    areas = replace(of_polygons(layer.areas, MM), names=layer.area_names)
    return unrolled_areas(areas, cell, welds(layer.ink))


def lattice_of(cell: Cell) -> Steps:
    """Return the two translations as the rows of a matrix, in grid steps."""
    return np.array(cell.lattice, np.int64)


def cell_of(points: Steps, cell: Cell) -> Steps:
    """Return in which cell of the lattice each point lies, shape (n, 2); left and lower edges are its own."""
    (ax, ay), (bx, by) = cell.lattice
    x, y = points[:, 0], points[:, 1]
    if bx == 0:
        i = x // ax
        return np.column_stack([i, (y - i * ay) // by])
    j = y // by
    return np.column_stack([(x - j * bx) // ax, j])


def unrolled_areas(areas: Outlines, cell: Cell, weld: bool) -> Unrolled:
    """Take areas off the torus.

    Args:
        areas: the pieces in the cell, in whole steps, with their names.
        cell: whose lattice repeats them.
        weld: areas that meet at a seam are one; or else only the halves of one mark that the seam cut.
    """
    bounds = areas.bounds()
    seam = ((bounds[:, :2] <= 0) | (bounds[:, 2:] >= [cell.columns, cell.rows])).any(axis=1)
    alone, cut = np.flatnonzero(~seam), np.flatnonzero(seam)
    names = np.asarray(areas.names, dtype=object)
    pieces = areas.taken(cut)
    chains = chains_of(pieces, ((0, cell.columns), (0, cell.rows)))
    meetings = _welds(chains, cell) if weld else _halves(chains, cell, names[cut])
    label, place, runs_on = followed(len(cut), meetings)
    mixed = _mixed(pieces, label, place, runs_on)
    marks = _Marks(pieces, names[cut], label, place @ lattice_of(cell))
    endless = np.flatnonzero(runs_on & ~mixed)
    found = Unrolled(
        together(
            [
                replace(areas.taken(alone), names=names[alone].tolist()),
                marks.joined(chains, np.flatnonzero(~runs_on & ~mixed)),
                *(marks.united(mark) for mark in np.unique(label[~runs_on & mixed])),
            ]
        ),
        replace(pieces.taken(endless), names=names[cut][endless].tolist()),
        label[endless],
    )
    for mark in np.unique(label[runs_on & mixed]):
        # Once its pieces are one in the cell, they may be followed as areas of a weld are.
        found = _both(found, unrolled_areas(marks.united(mark, lifted=False), cell, weld=True), len(cut))
    return found


@frozen
class _Marks:
    """Pieces that seams divided, with their names, the mark of each, and how far it lies from the first's."""

    pieces: Outlines
    names: NDArray[np.object_]
    label: Index
    shift: Steps

    def joined(self, chains: Chains, which: Index) -> Outlines:
        """Return whole marks made of some pieces."""
        rows = np.flatnonzero(np.isin(chains.mark, which))
        mark = chains.mark[rows]
        rings = rings_of(Copies(chains, rows, self.shift[mark], mark), self.label[mark], self.label)
        return replace(whole(rings), names=self.names[rings.owner].tolist())

    def united(self, mark: int, lifted: bool = True) -> Outlines:
        """Return the union of the pieces of a mark, lifted off the torus or as they lie in the cell."""
        mine = np.flatnonzero(self.label == mark)
        shapes = to_polygons(self.pieces.taken(mine, self.shift[mine] if lifted else None))
        union = shapely.union_all(shapes, grid_size=1.0)
        found, _ = polygons_of(np.array([union], dtype=object), np.zeros(1, np.intp))
        outlines = of_polygons(np.asarray(shapely.orient_polygons(found), dtype=object))
        return replace(outlines, names=[self.names[mark]] * len(found))


def _mixed(pieces: Outlines, label: Index, place: Steps, runs_on: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return which pieces are of a mark of which some lie over one another, or share edges off the seams.

    Only marks of overlays do.
    """
    polygons = to_polygons(pieces)
    a, b = shapely.STRtree(polygons).query(polygons)
    one = (a < b) & (label[a] == label[b]) & (runs_on[a] | (place[a] == place[b]).all(axis=1))
    a, b = a[one], b[one]
    over = [shapely.relate_pattern(polygons[a], polygons[b], how) for how in ("T********", "F***1****")]
    return np.isin(label, label[a[over[0] | over[1]]])


def _both(one: Unrolled, other: Unrolled, strands: int) -> Unrolled:
    """Return the marks of both; ``strands`` is more than any number of a strand of the first."""
    after = max(strands, int(one.strand.max(initial=0)) + 1)
    return Unrolled(
        together([one.whole, other.whole]),
        together([one.endless, other.endless]),
        np.concatenate([one.strand, other.strand + after]),
    )


def unrolled_lines(lines: Outlines, cell: Cell) -> Unrolled:
    """Take lines off the torus: those of one name whose ends meet at a seam are one.

    Args:
        lines: the pieces in the cell, in whole steps, with their names.
        cell: whose lattice repeats them.
    """
    names = np.asarray(lines.names, dtype=object)
    ends = seam_ends(lines, cell)
    open_ = np.flatnonzero(~ends.free.reshape(-1, 2).all(axis=1))
    closed = np.setdiff1d(np.arange(len(lines)), open_)
    _, code = np.unique(names.astype(str), return_inverse=True)
    at = cell_of(ends.point, cell)
    partner, _ = ends.partners(np.repeat(code, 2), ends.point - at @ lattice_of(cell))
    one = np.flatnonzero(partner >= 0)
    other = partner[one]
    label, place, runs_on = followed(len(lines), (one // 2, other // 2, at[one] - at[other]))
    bounded, endless = open_[~runs_on[open_]], open_[runs_on[open_]]
    paths = paths_of(lines, bounded, (place @ lattice_of(cell))[bounded], ends, label[bounded])
    made = paths.outlines(0, len(paths.loop))
    owner = bounded[paths.rows[paths.offsets[:-1]]]
    return Unrolled(
        together(
            [
                replace(lines.taken(closed), names=names[closed].tolist()),
                replace(made, names=names[owner].tolist()),
            ]
        ),
        replace(lines.taken(endless), names=names[endless].tolist()),
        label[endless],
    )


def seam_ends(lines: Outlines, cell: Cell) -> Ends:
    """Return the ends of lines in a cell; those that lie on no seam, and those of closed lines, are free."""
    first, last = lines.rings[:-1], lines.rings[1:] - 1
    point = np.stack([lines.points[first], lines.points[last]], axis=1).reshape(-1, 2)
    inner = ((point > 0) & (point < [cell.columns, cell.rows])).all(axis=1)
    return ends_of(lines, inner | np.repeat(lines.closed, 2))


def _neighbours(cell: Cell) -> list[tuple[int, int, int]]:
    """Return the cells that share the right (axis 0) or upper (axis 1) edge of the first: (axis, i, j)."""
    found = []
    a, b = lattice_of(cell)
    for axis, size, step, slide in ((0, cell.rows, a, b), (1, cell.columns, b, a)):
        for k in (-1, 0, 1):
            slip = (step + k * slide)[1 - axis]
            if (k == 0 or slide[axis] == 0) and -size < slip < size:
                found.append((axis, 1, k) if axis == 0 else (axis, k, 1))
    return found


def _across(chains: Chains, cell: Cell) -> tuple[Copies, Steps]:
    """Return the edges on the cell's right and upper edge, those of its neighbours there, and their cells.

    The owner of a copy is its mark, or behind all marks the neighbour's.
    """
    far = (cell.columns, cell.rows)
    value = chains.start[np.arange(len(chains)), np.maximum(chains.axis, 0)]
    marks = int(chains.mark.max()) + 1 if len(chains) else 0
    which, shift, owner, cells = [], [], [], [np.zeros((marks, 2), np.int64)]
    for axis in (0, 1):
        rows = np.flatnonzero((chains.axis == axis) & (value == far[axis]))
        which.append(rows)
        shift.append(np.zeros((len(rows), 2), np.int64))
        owner.append(chains.mark[rows])
    for number, (axis, i, j) in enumerate(_neighbours(cell), start=1):
        rows = np.flatnonzero((chains.axis == axis) & (value == 0))
        which.append(rows)
        shift.append(np.broadcast_to(np.array([i, j]) @ lattice_of(cell), (len(rows), 2)))
        owner.append(chains.mark[rows] + number * marks)
        cells.append(np.broadcast_to(np.array([i, j]), (marks, 2)))
    return Copies(chains, *(np.concatenate(each) for each in (which, shift, owner))), np.concatenate(cells)


def _welds(chains: Chains, cell: Cell) -> Meetings:
    """Return the pieces that share a stretch of a seam."""
    copies, cells = _across(chains, cell)
    contact = cancelled(copies)
    return _meetings(copies.owner[contact.upper], copies.owner[contact.lower], cells, chains)


def _meetings(a: Index, b: Index, cells: Steps, chains: Chains) -> Meetings:
    marks = int(chains.mark.max()) + 1 if len(chains) else 1
    pairs = np.unique(np.column_stack([np.minimum(a, b), np.maximum(a, b)]), axis=0)
    one, other = pairs[:, 0], pairs[:, 1]
    return one % marks, other % marks, cells[other] - cells[one]


def _halves(chains: Chains, cell: Cell, names: NDArray[np.object_]) -> Meetings:
    """Return the pieces that are one mark cut by a seam; see :func:`halves`."""
    copies, cells = _across(chains, cell)
    _, code = np.unique(names.astype(str), return_inverse=True)
    marks = int(chains.mark.max()) + 1 if len(chains) else 1
    one, other = halves(copies, code[copies.owner % marks])
    return _meetings(one, other, cells, chains)


def halves(copies: Copies, name: Index) -> tuple[Index, Index]:
    """Return the owners that are one mark cut by a seam: of one name, and equally broad where they meet.

    Where several are, they go on as straight as they can.

    Args:
        copies: edges on seams.
        name: shape (n,), a number for the name of each.
    """
    chains = copies.chains
    first, last = _stretches(copies)
    start, end = copies.points(chains.start)[first], copies.points(chains.end)[last]
    axis = chains.axis[copies.which[first]]
    each = np.arange(len(first))
    a, b = start[each, 1 - axis], end[each, 1 - axis]
    forward = b > a
    key = numbered(axis, start[each, axis], np.minimum(a, b), np.maximum(a, b), name[first])
    # Where the ring comes to the stretch's lower end, and where its twin's leaves it.
    comes, leaves = chains.before[copies.which[first]], chains.after[copies.which[last]]
    into = chains.end[comes] - chains.points[chains.offsets[comes + 1] - 2]
    out = chains.points[chains.offsets[leaves] + 1] - chains.start[leaves]
    way = np.where(forward[:, None], into, out).astype(float)
    order = np.lexsort([np.arctan2(way[:, 1], way[:, 0]), forward, key])
    side = (2 * key + forward)[order]
    rank = np.empty(len(order), np.intp)
    rank[order] = np.arange(len(order)) - np.searchsorted(side, side)
    twin = numbered(key, rank)
    upper, lower = np.flatnonzero(forward), np.flatnonzero(~forward)
    _, i, j = np.intersect1d(twin[upper], twin[lower], assume_unique=True, return_indices=True)
    return copies.owner[first[upper[i]]], copies.owner[first[lower[j]]]


def _stretches(copies: Copies) -> tuple[Index, Index]:
    """Return the first and the last row of each run of edges that follow one another along a seam."""
    chains, rows = copies.chains, np.arange(len(copies.which))
    place = numbered(copies.shift[:, 0], copies.shift[:, 1]) * (len(chains) + 1)
    key, wanted = place + copies.which, place + chains.after[copies.which]
    order = np.argsort(key, kind="stable")
    found = order[np.minimum(np.searchsorted(key[order], wanted), len(rows) - 1)] if len(rows) else rows
    goes_on = (key[found] == wanted) & (chains.axis[copies.which[found]] == chains.axis[copies.which])
    last = np.where(goes_on, found, rows)
    first = np.setdiff1d(rows, found[goes_on])
    while not np.array_equal(last[last], last):
        last = last[last]
    return first, last[first]


def followed(count: int, meetings: Meetings) -> tuple[Index, Steps, NDArray[np.bool_]]:
    """Follow pieces from cell to cell: (the mark of each, its cell from the first's, is it endless)."""
    a, b, step = meetings
    label = components(count, np.column_stack([a, b]))
    place = np.zeros((count, 2), np.int64)
    known = label == np.arange(count)
    while not known.all():
        for one, other, way in ((a, b, 1), (b, a, -1)):
            new = known[one] & ~known[other]
            place[other[new]] = place[one[new]] + way * step[new]
            known[other[new]] = True
    runs_on = np.zeros(count, bool)
    runs_on[label[a[(place[a] + step != place[b]).any(axis=1)]]] = True
    return label, place, runs_on[label]
