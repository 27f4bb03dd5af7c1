"""The last cut: finished layers are wrapped round the tile, and what lay on its seam is remembered.

Coordinates are whole grid steps.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, DropAxis, Geometries
from batik_vector.geometry import work
from batik_vector.geometry.congruence import alike, distinct
from batik_vector.geometry.outlines import Index, runs
from batik_vector.tiling.torus import overlay, seams
from batik_vector.tiling.torus.remembered import Asked, as_array, identities, interned
from batik_vector.tiling.torus.torus import (
    Lattice,
    Steps,
    Window,
    clip_areas,
    clip_lines,
    lines_of,
    to_step_grid,
    translate,
    translates,
    wrap,
)
from batik_vector.tiling.welding.congruent import Copies, Stock, together
from batik_vector.tiling.welding.endings import Places, lone_ends, on_edges, own_ends, tips
from batik_vector.tiling.welding.needles import needled, without_needles
from batik_vector.tiling.welding.weld import meeting, overlap

Borders = frozenset[tuple[str, int, int, int]]
Lines = tuple[Geometries, NDArray[np.intp]]
"""Polylines, and the number of the sheet that each lies in."""

CLOSE = 10.0
"""Steps from an edge beyond which lines run beside it and not on it, however coarse the tolerance."""

SLENDER = 10
"""How many times the reach a stretch is long that runs along an edge."""


class Torus:
    """A cell under its lattice, at one position of the seam.

    Attributes:
        borders: what :class:`~batik_vector.artwork.Artwork` tells of the seam, as far as it is known.
    """

    def __init__(self, stock: Stock, cell: Cell, lattice: Lattice, phase: Steps) -> None:
        self.stock, self.cell, self.lattice, self.phase = stock, cell, lattice, phase
        self.window = Window(0, 0, cell.columns, cell.rows)
        self.borders: list[tuple[str, int, int, int]] = []
        self._crossing: list[Copies] = []
        self._ends: dict[str, Places] = {}

    def areas(self, marks: Copies) -> tuple[Copies, Index]:
        """Wrap copies and cut them at the edges; return the pieces, in order, and whose they are."""
        bounds = self.stock.bounds(marks) + np.tile(self.phase, 2)
        which, shift = translates(bounds, self.lattice, self.window)
        there = marks.taken(which).moved(self.phase + shift)
        x0, y0, x1, y1 = self.stock.bounds(there).T
        window = self.window
        inside = (x0 > window.left) & (y0 > window.bottom) & (x1 < window.right) & (y1 < window.top)
        cut = np.flatnonzero(~inside)
        if not len(cut):
            return there, which
        pieces, each = self._clipped(there.taken(cut))
        order = np.argsort(np.concatenate([np.flatnonzero(inside), cut[each]]), kind="stable")
        copies = together([there.taken(inside), pieces])
        return copies.taken(order), np.concatenate([which[inside], which[cut[each]]])[order]

    def _clipped(self, marks: Copies) -> tuple[Copies, Index]:
        """Cut at the edges what reaches them; several marks at one place are cut once."""
        rows = np.column_stack([marks.kind, marks.shift])
        heads, row = alike(rows)
        marks_once = marks.taken(heads)
        self._crossing.append(marks_once)
        pieces, ends = self._pieces(marks_once)
        which, starts = runs(ends, row)
        each = np.repeat(np.arange(len(marks)), np.diff(starts))
        return self.stock.taken_up(pieces).taken(which), each

    def _pieces(self, marks: Copies) -> tuple[Geometries, Index]:
        """Return what of copies lies in the cell, one after another, and where the pieces of each begin."""
        if not self.stock.remembers:
            return self._cut_off(marks)
        known: Asked[list[shapely.Polygon]] = self.stock.asked(("clipped", self.window), marks)
        vertices = shapely.get_num_coordinates(self.stock.shapes[marks.kind])
        fresh = known.fresh()
        work.spend(float(vertices.sum() - vertices[fresh].sum()), per_vertex=work.PER_CUTTER_VERTEX)
        if fresh:
            pieces, ends = self._cut_off(marks.taken(np.array(fresh)))
            cut = interned(pieces).tolist()
            found = [cut[first:last] for first, last in itertools.pairwise(ends.tolist())]
            known.keep(fresh, found, vertices[fresh].tolist())
        answers = known.answers()
        return as_array([piece for each in answers for piece in each]), np.cumsum([0, *map(len, answers)])

    def _cut_off(self, marks: Copies) -> tuple[Geometries, Index]:
        """Do the work of :meth:`_pieces`."""
        shapes = self.stock.geometries(marks)
        pieces, of = clip_areas(shapes, np.arange(len(marks)), self.window)
        order = np.argsort(of, kind="stable")
        return pieces[order], np.searchsorted(of[order], np.arange(len(marks) + 1))

    def lines(self, marks: Geometries, sheet: int, ink: str, reach: float) -> Lines:
        """Wrap polylines in mm and cut them at the edges.

        Stretches that run along an edge no farther from it than ``reach`` (steps) are moved onto it.
        """
        pieces = to_step_grid(marks)
        pieces = pieces[shapely.length(pieces) > 0] if len(pieces) else pieces
        pieces = translate(pieces, np.repeat(self.phase[None, :], len(pieces), axis=0))
        pieces, names = wrap(pieces, np.full(len(pieces), sheet, np.intp), self.lattice, self.window)
        pieces = self._on_edges(pieces, min(reach, CLOSE))
        ends = self._ends.setdefault(ink, set())
        ends.update(own_ends(pieces, self.cell))
        pieces, names = clip_lines(pieces, names, self.window)
        ends.update(tips(pieces, self.cell))
        return pieces, names

    def _on_edges(self, lines: Geometries, reach: float) -> Geometries:
        """Return polylines whose stretches along the edges lie on these: beside a mirror a twin runs as near.

        Along an edge that the drop breaks nothing is moved: beyond its end it is no seam.
        """
        coords, owner = shapely.get_coordinates(lines, return_index=True)
        same = owner[1:] == owner[:-1]
        moved = np.zeros(len(coords), bool)
        sides = ((0, self.cell.columns), (1, self.cell.rows))
        broken = {DropAxis.COLUMN: 1, DropAxis.ROW: 0}[self.cell.axis] if self.cell.drop else None
        for axis, far in sides:
            long = same & (np.abs(np.diff(coords[:, 1 - axis])) > SLENDER * reach)
            for value in (0, far) if axis != broken else ():
                near = np.abs(coords[:, axis] - value) <= reach
                along = np.flatnonzero(long & near[1:] & near[:-1])
                at = np.concatenate([along, along + 1])
                moved[at] |= coords[at, axis] != value
                coords[at, axis] = value
        if not moved.any():
            return lines
        lines, which = lines.copy(), distinct(owner[moved])
        mine = np.isin(owner, which)
        lines[which] = shapely.set_coordinates(lines[which], coords[mine])
        lines[which] = shapely.remove_repeated_points(lines[which])
        return lines

    def cut_lines(self, lines: Lines, cutters: Geometries, ink: str, crumb: float) -> Lines:
        """Cut lines by cutters that do not overlap; one that is cut off up to the seam ends there.

        No pieces as short as ``crumb`` (steps) are left: a line that comes out of a gap at a sharp angle, or
        runs along its border, would leave a dot here and none at its image.
        """
        cut = self._cut_lines(lines, cutters, crumb)
        ended = lone_ends(cut[0], self.cell) - lone_ends(lines[0], self.cell)
        if ended:
            torn = [
                row
                for row in self._torn(seams.mismatch(cutters, self.cell))
                if row[2] - row[1] > seams.MEND_STEPS
            ]
            self._ends[ink] |= {place for place in ended if not _lies_in(place, torn)}
        return cut

    def _cut_lines(self, lines: Lines, cutters: Geometries, crumb: float) -> Lines:
        marks, names = lines
        mark, cutter = shapely.STRtree(cutters).query(marks, predicate="intersects")
        order = np.lexsort([cutter, mark])
        rows, number = np.unique(mark[order], return_inverse=True)
        if not len(rows):
            return lines
        away = np.asarray(shapely.multipolygons(cutters[cutter[order]], indices=number), dtype=object)
        pieces, of = lines_of(overlay.less(marks[rows], away), names[rows])
        # What reaches the seam goes on beyond it, and may be longer than it seems.
        kept = (shapely.length(pieces) > crumb) | ~shapely.contains_properly(self.window.box, pieces)
        whole = np.ones(len(marks), bool)
        whole[rows] = False
        return np.concatenate([marks[whole], pieces[kept]]), np.concatenate([names[whole], of[kept]])

    def record_ends(self, ink: str, lines: Geometries) -> None:
        """Note where lines end on the seam on purpose, as borders of no length."""
        lone = lone_ends(lines, self.cell)
        meant = self._ends.get(ink, set()) & lone
        if lone > meant:
            # What runs into a line that lies on the seam goes on in that.
            along = on_edges(lines)
            meant |= {place for place in lone if _lies_in(place, along)}
        self.borders += [(ink, 0, y, y) if x == 0 else (ink, 1, x, x) for x, y in sorted(meant)]

    def without_needles(self, areas: Copies) -> Copies:
        """Return areas that lie in the cell without what is thinner than the grid."""
        shapes, row = self.stock.used(areas)
        at = np.flatnonzero(self._needled(shapes)[row])
        if not len(at):
            return areas
        blunt = without_needles(self.stock.geometries(areas.taken(at)), self.window)
        return self._replaced(areas, at, blunt)

    def _needled(self, shapes: Geometries) -> NDArray[np.bool_]:
        if not self.stock.remembers:
            return needled(shapes)
        known = Asked[bool]("needled", identities(shapes)[:, None], (shapes,))
        return np.array(known.answers(lambda fresh: needled(shapes[fresh]).tolist()), bool)

    def sealed(self, ink: str, areas: Copies, *, apart: bool) -> Copies | None:
        """Return areas whose opposite edges agree, but for borders drawn along the seam on purpose.

        What rounding parted by a few steps is mended; None where more is torn, or where that pushes areas
        over one another that are to lie ``apart``.
        """
        x0, y0, x1, y1 = self.stock.bounds(areas).T
        window = self.window
        at = (x0 <= window.left) | (y0 <= window.bottom) | (x1 >= window.right) | (y1 >= window.top)
        breaks = self._breaks(areas.taken(at))
        if len(breaks):
            rim = self.stock.geometries(areas.taken(at))
            mended = seams.mended(rim, self.cell)
            if not shapely.is_valid(mended).all() or (apart and _overlap(mended)):
                return None
            breaks = seams.mismatch(mended, self.cell)
            if self._torn(breaks):
                return None
            self.borders += [(ink, axis, low, high) for axis, low, high in breaks.tolist()]
            areas = self._replaced(areas, at, mended)
        return areas

    def _breaks(self, rim: Copies) -> NDArray[np.int64]:
        """Return where opposite edges of the cell differ; nobody may write into it."""
        if not self.stock.remembers:
            return seams.mismatch(self.stock.geometries(rim), self.cell)
        shapes = self.stock.shapes[rim.kind]
        rows = np.column_stack([identities(shapes), rim.shift])
        known = Asked[NDArray[np.int64]].together(("breaks", self.cell), rows, (shapes,))
        (found,) = known.answers(lambda _: [seams.mismatch(self.stock.geometries(rim), self.cell)])
        found.flags.writeable = False
        return found

    def _replaced(self, areas: Copies, at: Index | NDArray[np.bool_], others: Geometries) -> Copies:
        """Return copies, some of which are other polygons."""
        new = self.stock.taken_up(others)
        areas = Copies(areas.kind.copy(), areas.shift.copy())
        areas.kind[at], areas.shift[at] = new.kind, new.shift
        return areas

    def _torn(self, breaks: NDArray[np.int64]) -> list[tuple[int, int, int]]:
        """Return what of breaks, rows of (axis, from, to), no mark's own border along the seam explains."""
        if not len(breaks):
            return []
        found = []
        allowed = self._allowed
        for axis in (0, 1):
            mine = seams.joined(breaks[breaks[:, 0] == axis, 1:])
            legal = seams.joined(allowed[allowed[:, 0] == axis, 1:])
            together = seams.joined(np.vstack([mine, legal]))
            found += [(axis, low, high) for low, high in seams.symmetric_difference(together, legal).tolist()]
        return found

    @property
    def _allowed(self) -> NDArray[np.int64]:
        """The edges of marks that run along the seam themselves, as (axis, from, to)."""
        return seams.on_seam(self.stock.geometries(together(self._crossing)), self.window)


def _overlap(areas: Geometries) -> bool:
    """Whether any two areas share more than their borders."""
    one, other = meeting(areas).T
    return bool(overlap(areas[one], areas[other]).any())


def _lies_in(place: tuple[int, int], stretches: Sequence[tuple[int, int, int]]) -> bool:
    """Whether a place on the seam lies within one of its stretches, given as (axis, from, to)."""
    return any(place[axis] == 0 and low < place[1 - axis] < high for axis, low, high in stretches)
