"""Copies of marks in a window: which there are, which its edge crosses, and what the edge leaves of these.

Coordinates are whole grid steps.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import field, replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Geometries
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
from batik_vector.tiling.torus.torus import Window, clip_areas, clip_lines, lines_of, polygons_of
from batik_vector.values import frozen

PIECE = 400_000
"""Points that are handed over at once, about."""
FAR = np.int64(2**40)
"""Stands for an edge of the window that a mark does not reach."""

Touch = tuple[int, int]
"""Steps from a window's left or lower, and from its right or upper edge, within which a mark reaches it."""
CROSS, LINE, MEET = (0, 0), (0, 1), (1, 1)
"""Areas reach an edge that they cross; where borders lie beyond, one that they meet. A stretch of a line on
the right or upper edge is cut away, for it has its twin on the other."""


@frozen
class Filling:
    """How a window is filled.

    ``cut`` tells what becomes of whole marks that cross the window's edge: they are cut there, or left out.
    ``corners`` are polygons at the window's corners that stay bare, in steps. ``cut_away`` is what marks that
    reach into them lose: less than these, where they are welded to what lies there. ``piece`` is how many
    points are handed over at once, about; ``tell`` is called with the share of the window that is done.
    """

    cell: Cell
    window: Window
    cut: bool = True
    corners: Geometries = field(default_factory=lambda: np.empty(0, dtype=object))
    cut_away: Geometries | None = None
    piece: int = PIECE
    tell: Callable[[float], None] = lambda share: None


def placed(bounds: Steps, cell: Cell, window: Window, low: int, high: int) -> tuple[Index, Steps]:
    """Return the translates of marks whose bounds meet a window and begin in a band: (mark, shift).

    Args:
        bounds: shape (k, 4), of the marks.
        cell: whose lattice moves them.
        window: the rectangle to fill.
        low: where the band begins.
        high: before which it ends; a mark belongs to the band in which its lower edge lies.
    """
    (ax, ay), (bx, by) = cell.lattice
    x0, y0, x1, y1 = bounds.T
    down, up = np.maximum(low - y0, window.bottom - y1), np.minimum(high - 1 - y0, window.top - y0)
    left, right = window.left - x1, window.right - x0
    if bx == 0:
        mark, i = numbers(-(-left // ax), right // ax)
        again, j = numbers(-((i * ay - down[mark]) // by), (up[mark] - i * ay) // by)
        mark, i = mark[again], i[again]
    else:
        mark, j = numbers(-(-down // by), up // by)
        again, i = numbers(-((j * bx - left[mark]) // ax), (right[mark] - j * bx) // ax)
        mark, j = mark[again], j[again]
    return mark, np.column_stack([i * ax + j * bx, i * ay + j * by])


def numbers(first: Steps, last: Steps) -> tuple[Index, Steps]:
    """Write out the whole numbers from first to last of each row: (row, number)."""
    counts = np.maximum(last - first + 1, 0)
    row = np.repeat(np.arange(len(first)), counts)
    return row, first[row] + np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)


def reaching(bounds: Steps, shift: Steps, window: Window, touch: Touch) -> Steps:
    """Return for each copy the window's edges as the mark sees them, ``FAR`` for those it does not reach."""
    at = bounds + np.tile(shift, 2)
    edges = np.array([window.left, window.bottom, window.right, window.top])
    over = np.column_stack([at[:, :2] - touch[0] < edges[:2], at[:, 2:] + touch[1] > edges[2:]])
    return np.where(over, edges - np.tile(shift, 2), FAR * np.array([-1, -1, 1, 1]))


@frozen
class Cuttings:
    """What the window's edge leaves of copies of marks.

    Each of the ``pieces`` is of the mark in ``mark`` and was cut by the edges in its row of ``edges``; copy k
    is the piece ``which[k]``, moved by ``shift[k]``. ``corner`` tells which copies a bare corner has cut.
    """

    pieces: Outlines
    mark: Index
    edges: Steps
    which: Index
    shift: Steps
    corner: NDArray[np.bool_]


def cuttings(marks: Outlines, mark: Index, shift: Steps, filling: Filling, touch: Touch) -> Cuttings:
    """Cut copies of marks at the window's edge, each way of crossing once, and at its corners."""
    edges = reaching(marks.bounds()[mark], shift, filling.window, touch)
    ways, way = np.unique(edges, axis=0, return_inverse=True)
    names = np.asarray(marks.names, dtype=object)
    made, windows, marks_of = list[Outlines](), [np.empty((0, 4), np.int64)], [np.empty(0, np.intp)]
    which, shifts = [np.empty(0, np.intp)], [np.empty((0, 2), np.int64)]
    count = 0
    for number, rectangle in enumerate(ways):
        copies = np.flatnonzero(way.ravel() == number)
        one, back = np.unique(mark[copies], return_inverse=True)
        pieces, source = _clipped(marks.taken(one), Window(*rectangle.tolist()), touch == LINE)
        first, last = (np.searchsorted(source, back, side=side) for side in ("left", "right"))
        copy, piece = numbers(first, last - 1)
        made.append(replace(pieces, names=names[one[source]].tolist()))
        marks_of.append(one[source])
        windows.append(np.broadcast_to(rectangle, (len(source), 4)))
        which.append(piece + count)
        shifts.append(shift[copies[copy]])
        count += len(source)
    cut = Cuttings(
        together(made),
        np.concatenate(marks_of),
        np.concatenate(windows),
        np.concatenate(which),
        np.concatenate(shifts),
        np.zeros(sum(len(each) for each in which), bool),
    )
    return _without_corners(cut, filling, touch == LINE)


def crossing(
    marks: Outlines, mark: Index, shift: Steps, filling: Filling, touch: Touch, guard: Steps | None = None
) -> NDArray[np.bool_]:
    """Return which copies of marks the window's edge or a bare corner cuts.

    ``guard`` are the bounds of each mark together with what is left out with it, shape (k, 4).
    """
    bounds = marks.bounds() if guard is None else guard
    nearest = np.abs(reaching(bounds[mark], shift, filling.window, touch)).min(axis=1)
    over = np.asarray(nearest < FAR, dtype=bool)
    over[in_corners(marks, mark, shift, filling, touch == LINE)] = True
    return over


def in_corners(marks: Outlines, mark: Index, shift: Steps, filling: Filling, line: bool) -> Index:
    """Return which copies of marks reach into the bare corners."""
    if not len(filling.corners):
        return np.empty(0, np.intp)
    at = marks.bounds()[mark] + np.tile(shift, 2)
    low, high = at[:, None, :2], at[:, None, 2:]
    bare = shapely.bounds(filling.corners)
    beside = np.all((low <= bare[:, 2:]) & (high >= bare[:, :2]), axis=2)
    copy, corner = np.nonzero(beside)
    # In pairs: with NumPy 1 shapely refuses a pattern for arrays that broadcast to a table.
    shapes = _shapes(marks.taken(mark[copy], shift[copy]), line)
    into = shapely.relate_pattern(shapes, filling.corners[corner], "T********")
    return np.unique(copy[into])


def _shapes(marks: Outlines, line: bool) -> Geometries:
    return to_polylines(marks) if line else to_polygons(marks)


def _without_corners(cut: Cuttings, filling: Filling, line: bool) -> Cuttings:
    """Cut the bare corners out of copies of pieces; what they reach become pieces of their own."""
    over = in_corners(cut.pieces, cut.which, cut.shift, filling, line)
    if not len(over):
        return cut
    shapes = _shapes(cut.pieces.taken(cut.which[over], cut.shift[over]), line)
    away = filling.corners if filling.cut_away is None else filling.cut_away
    left = shapely.difference(shapes, shapely.union_all(away), grid_size=1.0)
    found, source = (lines_of if line else polygons_of)(left, over)
    pieces = of_polylines(found) if line else of_polygons(shapely.orient_polygons(found))
    shift = cut.shift[source]
    pieces = replace(pieces, points=pieces.points - np.repeat(shift, pieces.sizes(), axis=0))
    names = np.asarray(cut.pieces.names, dtype=object)[cut.which[source]].tolist()
    rest = np.delete(np.arange(len(cut.which)), over)
    return Cuttings(
        together([cut.pieces, replace(pieces, names=names)]),
        np.concatenate([cut.mark, cut.mark[cut.which[source]]]),
        np.concatenate([cut.edges, cut.edges[cut.which[source]]]),
        np.concatenate([cut.which[rest], len(cut.pieces) + np.arange(len(source))]),
        np.concatenate([cut.shift[rest], shift]),
        np.arange(len(rest) + len(source)) >= len(rest),
    )


def _clipped(marks: Outlines, window: Window, line: bool) -> tuple[Outlines, Index]:
    """Cut marks to a window: the pieces, and which mark each is of, in ascending order."""
    each = np.arange(len(marks))
    if line:
        pieces, source = clip_lines(to_polylines(marks), each, window)
    else:
        pieces, source = clip_areas(to_polygons(marks), each, window)
    order = np.argsort(source, kind="stable")
    pieces, source = pieces[order], source[order]
    return of_polylines(pieces) if line else of_polygons(np.asarray(shapely.orient_polygons(pieces))), source
