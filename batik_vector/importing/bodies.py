"""What a drawing paints along the edges of its page, as bodies in painting order.

Only what reaches an edge is looked at: there it is decided whether tiles meet without a seam. A stroke counts
with its whole body, cap, join and dash.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Geometries
from batik_vector.importing.inks import Marks
from batik_vector.importing.painting import Bodies, Paint
from batik_vector.importing.pens import Pen, bodies
from batik_vector.importing.scene import Shape
from batik_vector.values import frozen

REACH = 0.025
"""How near to an edge of the page, as a share of the page, what lies beside it is kept: pages are rounded to
whole pixels, and what page would be right can be told from what lies near."""
ON_EDGE_MM = 0.02
"""How near (mm) to an edge a line ends that ends on it."""

LONGER = 4.0
"""Breadths by which a line that ends on an edge is drawn on: enough for one that comes in at 15°."""
FLAT = np.cos(np.radians(10))
"""How far a line may lead along the edge and still count as crossing it."""

Indices = NDArray[np.intp]
Floats = NDArray[np.float64]


def bodies_on_rim(marks: Marks, cell: Cell, tolerance: float) -> Bodies:
    """Return what is painted along the edges of a page.

    Args:
        marks: everything that is painted, uncut, in mm.
        cell: the page.
        tolerance: mm; of round caps and joins.
    """
    sides = np.array([cell.width, cell.height])
    filled = np.flatnonzero(_reaching(marks.areas, np.zeros(len(marks.areas)), sides))
    breadth = np.array([shape.width for shape in marks.shapes], np.float64)
    mitre = np.array([max(shape.pen.limit, 1.5) for shape in marks.shapes], np.float64)
    half = (breadth * mitre / 2)[marks.line_shape]
    stroked = np.flatnonzero(_reaching(marks.lines, half, sides))
    ends = _ends(marks, stroked, sides)
    shapes, owner = _stroked(marks, stroked, ends, tolerance)
    keep = _reaching(shapes, np.zeros(len(shapes)), sides)
    shapes, owner = shapes[keep], owner[keep]
    number = np.concatenate([marks.area_shape[filled], marks.line_shape[owner]])
    over = np.concatenate([np.zeros(len(filled), np.intp), np.ones(len(owner), np.intp)])
    order = np.lexsort([over, number])
    paint, paints = _paints(marks.shapes, number[order], over[order])
    return Bodies(
        np.concatenate([marks.areas[filled], shapes])[order],
        paint,
        paints,
        np.where(over == 1, breadth[number], 0.0)[order],
        np.concatenate([np.full(len(filled), -1, np.intp), owner])[order],
        ends.places,
        ends.line,
        ends.nick,
    )


def _reaching(marks: Geometries, reach: NDArray[np.float64], sides: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Tell which marks come to an edge of the page, on whichever side of it they lie."""
    if not len(marks):
        return np.zeros(0, bool)
    bounds = shapely.bounds(marks)
    reach = reach[:, None] + REACH * sides
    low, high = bounds[:, :2] - reach, bounds[:, 2:] + reach
    there = ((low <= sides) & (high >= 0)).all(axis=1)
    return np.asarray(there & ((low <= 0) | (high >= sides)).any(axis=1))


@frozen(eq=False)
class _Ends:
    """Ends of lines on the page's edges: the ``line``, whether it is its ``last`` point, its place, the
    ``way`` on from it (unit vectors), and the depth of the ``nick`` that it leaves, see :class:`Bodies`."""

    line: Indices
    last: NDArray[np.bool_]
    places: Floats
    way: Floats
    nick: Floats


def _ends(marks: Marks, rows: Indices, sides: Floats) -> _Ends:
    """Return the ends of some lines that lie on the page's edges."""
    opened = rows[~shapely.is_closed(marks.lines[rows])] if len(rows) else rows
    line, last = np.repeat(opened, 2), np.tile([False, True], len(opened))
    lines = marks.lines[line]
    place, inner = (
        shapely.get_coordinates(shapely.get_point(lines, np.where(last, -1 - i, i))).reshape(-1, 2)
        for i in (0, 1)
    )
    on = (np.abs(place) <= ON_EDGE_MM) | (np.abs(place - sides) <= ON_EDGE_MM)
    some = on[:, 0] | on[:, 1]
    line, last, place, on = line[some], last[some], place[some], on[some]
    way = place - inner[some]
    way /= np.maximum(np.hypot(way[:, 0], way[:, 1]), 1e-12)[:, None]
    # A line that comes from outside and ends on the edge is none of the page's.
    outward = ((place <= ON_EDGE_MM) & (way < 0)) | ((place >= sides - ON_EDGE_MM) & (way > 0))
    leaves = on & outward
    some = leaves[:, 0] | leaves[:, 1]
    line, last, place, on, way = line[some], last[some], place[some], on[some], way[some]
    # What of the way leads along the edge; a line that comes in square leaves no nick.
    aslant = np.where(on[:, 0], way[:, 1], way[:, 0])
    shape = marks.line_shape[line]
    butt = np.array([marks.shapes[i].pen.cap == "flat" for i in shape.tolist()], bool)
    breadth = np.array([marks.shapes[i].width for i in shape.tolist()], np.float64)
    return _Ends(line, last, place, way, np.where(butt & (np.abs(aslant) < FLAT), aslant * breadth / 2, 0.0))


def _stroked(marks: Marks, rows: Indices, ends: _Ends, tolerance: float) -> tuple[Geometries, Indices]:
    """Return the bodies of lines and the line of each; whole lines are drawn on where they end on an edge."""
    lines = marks.lines.copy()
    for i, row in enumerate(ends.line.tolist()):
        shape = marks.shapes[marks.line_shape[row]]
        if shape.pen.dashes:  # They would fall elsewhere along the line.
            continue
        breadth = shape.width
        xy = shapely.get_coordinates(lines[row])
        beyond = ends.places[i] + ends.way[i] * LONGER * breadth
        lines[row] = shapely.LineString(np.vstack([xy, beyond] if ends.last[i] else [beyond, xy]))
    kinds: dict[tuple[float, Pen], list[int]] = {}
    for row in rows.tolist():
        shape = marks.shapes[marks.line_shape[row]]
        kinds.setdefault((shape.width, shape.pen), []).append(row)
    found, owners = [lines[:0]], [rows[:0]]
    for (breadth, pen), mine in kinds.items():
        drawn, number = bodies(lines[mine], breadth, pen, tolerance)
        parts, piece = shapely.get_parts(drawn, return_index=True)
        found.append(parts)
        owners.append(np.array(mine, np.intp)[number[piece]])
    shapes, owner = np.concatenate(found), np.concatenate(owners)
    some = ~shapely.is_empty(shapes)
    return shapes[some], owner[some]


def _paints(shapes: Sequence[Shape], number: Indices, over: Indices) -> tuple[Indices, tuple[Paint, ...]]:
    """Return the number of each body's paint, and the paints; bodies that look alike have one."""
    known: dict[object, int] = {}
    paints: list[Paint] = []
    which = np.empty(len(number), np.intp)
    for i, (shape, kind) in enumerate(zip(number.tolist(), over.tolist(), strict=True)):
        ink = shapes[shape].stroke if kind else shapes[shape].fill
        look = shapes[shape].looks[kind] or Paint(ink, ink)
        key = (look.colour, round(look.opacity, 6), id(look.ramp) if look.ramp else 0)
        if key not in known:
            known[key] = len(paints)
            paints.append(look)
        which[i] = known[key]
    return which, tuple(paints)
