"""Marks taken whole: what the page's edges cut is one mark again, and what is drawn at both edges is one.

A mark that reaches over an edge, and is drawn again beyond the opposite one, is placed once, uncut. Where
the other half is missing, or each half is drawn for itself, what the page shows is joined on the torus. What
meets its own translates there, as bars do, has no end: it stays in the pieces that the page shows.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Geometries
from batik_vector.drafting.copies import same
from batik_vector.drafting.marks import Painted
from batik_vector.geometry.nets.components import components
from batik_vector.geometry.outlines import of_polygons, to_polygons
from batik_vector.geometry.regions import oriented
from batik_vector.importing.fills import solid
from batik_vector.tiling.cloth.whole_marks import unrolled_areas
from batik_vector.tiling.torus.torus import (
    Window,
    clip_areas,
    polygons_of,
    to_mm,
    to_step_grid,
    translate,
    translates,
)
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

Index = NDArray[np.intp]
Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


@frozen(eq=False)
class Whole:
    """Marks of which each is placed once, and pieces of endless ones, which lie on the page.

    ``order`` is the rank of each mark, and then of each piece, in painting order.
    """

    marks: Painted
    pieces: Painted
    order: Index

    @property
    def ink(self) -> Index:
        """The ink of each mark, and then of each piece."""
        return np.concatenate([self.marks.ink, self.pieces.ink])

    def only(self, which: Mask) -> Whole:
        """Return some of the marks and pieces."""
        count = len(self.marks)
        marks, pieces = self.marks.taken(which[:count]), self.pieces.taken(which[count:])
        return Whole(marks, pieces, self.order[which])


def made_whole(painted: Painted, cell: Cell, tolerance: float) -> Whole:
    """Return marks as they are on the torus of a cell.

    Args:
        painted: on the page and beyond it.
        cell: the page, with its drop.
        tolerance: mm; how far a mark and its twin at the opposite edge may differ.
    """
    bounds = shapely.bounds(painted.shapes).reshape(-1, 4)
    sides = np.array([cell.width, cell.height])
    hair = tolerance / 8
    over = ((bounds[:, :2] < -hair) | (bounds[:, 2:] > sides + hair)).any(axis=1)
    flush = ~over & ((bounds[:, :2] <= hair) | (bounds[:, 2:] >= sides - hair)).any(axis=1)
    kept, torn = _twins(painted, np.flatnonzero(over), cell, tolerance)
    pieces, of = _cut(painted, np.concatenate([torn, np.flatnonzero(flush)]), cell)
    joined, endless = _joined(pieces, of, painted, cell, np.setdiff1d(_alone(of), torn))
    alone = np.flatnonzero(~over & ~flush)
    order = np.concatenate([alone, kept, joined[1], endless[1]])
    marks = painted.taken(np.concatenate([alone, kept, joined[1]]))
    marks = replace(marks, shapes=np.concatenate([painted.shapes[alone], painted.shapes[kept], joined[0]]))
    rest = replace(painted.taken(endless[1]), shapes=endless[0])
    return Whole(marks, rest, order)


def _twins(painted: Painted, over: Index, cell: Cell, tolerance: float) -> tuple[Index, Index]:
    """Return of marks that reach over the page one for all its twins each, and those that lack a twin."""
    shapes, ink = painted.shapes[over], painted.ink[over]
    if not len(over):
        return over, over
    which, shift = translates(
        shapely.bounds(shapes) * STEPS_PER_MM, cell.lattice, Window(0, 0, cell.columns, cell.rows)
    )
    there = translate(shapes[which], shift / STEPS_PER_MM)
    page = shapely.box(0.0, 0.0, cell.width, cell.height)
    visible = shapely.area(shapely.intersection(there, page))
    seen = 2 * visible > tolerance / 8 * shapely.length(there)
    which, shift, there, visible = which[seen], shift[seen], there[seen], visible[seen]
    # A twin is a mark of its own, or the mark itself where it lies.
    twin = np.where((shift == 0).all(axis=1), which, -1)
    centres = shapely.centroid(shapes)
    asked, found = shapely.STRtree(centres).query(
        shapely.centroid(there), predicate="dwithin", distance=tolerance
    )
    right = (ink[found] == ink[which[asked]]) & (twin[asked] < 0)
    asked, found = asked[right], found[right]
    alike = same(there[asked], shapes[found], tolerance)
    twin[asked[alike]] = found[alike]
    lacking = np.zeros(len(over), bool)
    lacking[which[twin < 0]] = True
    label = components(len(over), np.column_stack([which[twin >= 0], twin[twin >= 0]]))
    torn = np.isin(label, label[lacking])
    # Of twins the one stands for all of which the page shows most.
    shows = np.zeros(len(over))
    home = (shift == 0).all(axis=1)
    shows[which[home]] = visible[home]
    order = np.lexsort([-shows, label])
    first = np.append(True, label[order][1:] != label[order][:-1])
    chosen = order[first]
    return over[np.sort(chosen[~torn[chosen]])], over[torn]


def _cut(painted: Painted, which: Index, cell: Cell) -> tuple[Geometries, Index]:
    """Return what the page shows of some marks, in grid steps, and the mark of each piece."""
    steps, of = polygons_of(to_step_grid(painted.shapes[which]), which)
    pieces, of = clip_areas(_snapped(steps, cell), of, Window(0, 0, cell.columns, cell.rows))
    some = solid(to_mm(pieces)) if len(pieces) else np.zeros(0, bool)
    order = np.argsort(of[some], kind="stable")
    return oriented(pieces[some][order]), of[some][order]


def _snapped(shapes: Geometries, cell: Cell) -> Geometries:
    """Return shapes (steps) with what lies within two steps of an edge of the page on it."""

    def near(xy: Floats) -> Floats:
        for axis, far in ((0, cell.columns), (1, cell.rows)):
            for edge in (0, far):
                xy[np.abs(xy[:, axis] - edge) <= 2, axis] = edge
        return xy

    moved = np.asarray(shapely.transform(shapes, near), dtype=object)
    sound = shapely.is_valid(moved) & (shapely.area(moved) > 0)
    return np.where(sound, moved, shapes)


def _joined(
    pieces: Geometries, of: Index, painted: Painted, cell: Cell, uncut: Index
) -> tuple[tuple[Geometries, Index], tuple[Geometries, Index]]:
    """Return pieces (steps) joined on the torus, and those of endless marks: in mm, with the mark of each."""
    shapes, marks, rest, endless = [pieces[:0]], [of[:0]], [pieces[:0]], [of[:0]]
    for ink in np.unique(painted.ink[of]).tolist():
        mine = np.flatnonzero(painted.ink[of] == ink)
        outlines = replace(of_polygons(pieces[mine]), names=[str(row) for row in mine.tolist()])
        found = unrolled_areas(outlines, cell, weld=True)
        row = np.array([int(name) for name in found.whole.names], np.intp)
        whole = to_polygons(found.whole)
        drawn = to_mm(whole)
        # What met nothing stays as it was drawn.
        alone = (shapely.area(whole) == shapely.area(pieces[row])) & np.isin(of[row], uncut)
        drawn[alone] = painted.shapes[of[row]][alone]
        shapes.append(drawn)
        marks.append(of[row])
        rest.append(to_mm(to_polygons(found.endless)))
        endless.append(of[np.array([int(name) for name in found.endless.names], np.intp)])
    return (
        (np.concatenate(shapes), np.concatenate(marks)),
        (np.concatenate(rest), np.concatenate(endless)),
    )


def _alone(of: Index) -> Index:
    """Return the marks of which there is one piece."""
    marks, count = np.unique(of, return_counts=True)
    return np.asarray(marks[count == 1])
