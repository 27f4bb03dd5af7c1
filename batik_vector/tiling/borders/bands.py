"""Bands: one period of a border is solved on a cylinder, cut once, and laid end to end.

As in :mod:`batik_vector.tiling.torus.torus` everything is in whole grid steps. The two ends of a period meet
in the same grid points, and these keep their distances from the band's edges however a period is stretched
along the band. So copies of different lengths meet to the bit, and nothing is solved twice.

In a band's own coordinates x runs along it and y from its outer edge inwards.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import field, replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Geometries, Ink, Layer, Overlap
from batik_vector.geometry.sampling import Array, Indices, Points
from batik_vector.tiling.torus import seams
from batik_vector.tiling.torus.torus import (
    Window,
    clip_areas,
    clip_lines,
    polygons_of,
    to_mm,
    to_step_grid,
    translate,
)
from batik_vector.tiling.welding.congruent import polygons
from batik_vector.tiling.welding.sheets import Sheet
from batik_vector.tiling.welding.stack import assemble
from batik_vector.tiling.welding.weld import welded
from batik_vector.units import STEPS_PER_MM, nearest_steps, to_steps
from batik_vector.values import frozen

MARGIN = 1000
"""Grid steps of bare cell kept round everything that is solved, so that nothing wraps."""

_BEACON = Ink("\0", "#000000")
"""Marks a place of the cell, to learn whether the seam was moved."""
_BEACON_AT = 200


def _none() -> Geometries:
    return np.empty(0, dtype=object)


def _no_codes() -> Indices:
    return np.empty(0, np.intp)


@frozen(eq=False)
class Marks:
    """Marks of one ink in grid steps: areas and lines, each with the code of its name.

    ``open_areas`` and ``open_lines`` say which of them a joint may have cut.
    """

    areas: Geometries = field(default_factory=_none)
    area_codes: Indices = field(default_factory=_no_codes)
    open_areas: NDArray[np.bool_] = field(default_factory=lambda: np.empty(0, bool))
    lines: Geometries = field(default_factory=_none)
    line_codes: Indices = field(default_factory=_no_codes)
    open_lines: NDArray[np.bool_] = field(default_factory=lambda: np.empty(0, bool))

    @property
    def vertices(self) -> int:
        """Vertices of areas and lines together."""
        return int(sum(shapely.get_num_coordinates(part).sum() for part in (self.areas, self.lines)))

    def moved(self, to: Callable[[Points], Points]) -> Marks:
        """Return the marks carried by a map of whole grid steps to whole grid steps."""
        if not len(self.areas) and not len(self.lines):
            return self
        return replace(
            self,
            areas=np.asarray(shapely.transform(self.areas, to), dtype=object),
            lines=np.asarray(shapely.transform(self.lines, to), dtype=object),
        )

    def repeated(self, shifts: Sequence[int]) -> Marks:
        """Return a copy of the marks at every shift along the band."""
        shift = np.array([(each, 0) for each in shifts], np.int64).reshape(-1, 2)

        def copies(marks: Geometries) -> Geometries:
            return translate(np.tile(marks, len(shift)), np.repeat(shift, len(marks), axis=0))

        def again(values: NDArray[np.generic]) -> NDArray[np.generic]:
            return np.tile(values, len(shift))

        return Marks(
            copies(self.areas),
            again(self.area_codes),  # type: ignore[arg-type]
            again(self.open_areas),  # type: ignore[arg-type]
            copies(self.lines),
            again(self.line_codes),  # type: ignore[arg-type]
            again(self.open_lines),  # type: ignore[arg-type]
        )

    def opened_at(self, window: Window) -> Marks:
        """Return the marks, those that reach an edge of the window taken for cut."""

        def at_edge(marks: Geometries) -> NDArray[np.bool_]:
            x0, y0, x1, y1 = shapely.bounds(marks).T if len(marks) else np.empty((4, 0))
            return np.asarray(
                (x0 <= window.left) | (y0 <= window.bottom) | (x1 >= window.right) | (y1 >= window.top), bool
            )

        return replace(
            self,
            open_areas=self.open_areas | at_edge(self.areas),
            open_lines=self.open_lines | at_edge(self.lines),
        )

    def clipped(self, window: Window) -> Marks:
        """Return what lies in a window; crossings of its edges are rounded alike on both of their sides."""
        areas, which = clip_areas(self.areas, np.arange(len(self.areas)), window)
        lines, of = clip_lines(self.lines, np.arange(len(self.lines)), window)
        return Marks(
            areas, self.area_codes[which], self.open_areas[which],
            lines, self.line_codes[of], self.open_lines[of],
        )  # fmt: skip


def together(parts: Iterable[Marks]) -> Marks:
    """Return the marks of all parts as one."""
    every = list(parts) or [Marks()]
    return Marks(
        np.concatenate([part.areas for part in every]),
        np.concatenate([part.area_codes for part in every]),
        np.concatenate([part.open_areas for part in every]),
        np.concatenate([part.lines for part in every]),
        np.concatenate([part.line_codes for part in every]),
        np.concatenate([part.open_lines for part in every]),
    )


@frozen
class Span:
    """A stretch of the band's drawing, within one period of it, and where along the side it is laid.

    All in grid steps; ``first`` and ``last`` count from where the drawing's period begins.
    """

    first: int
    last: int
    begin: int
    end: int


def spans(first: int, last: int, begin: int, end: int, period: int) -> list[Span]:
    """Return the drawing from ``first`` to ``last`` laid evenly from ``begin`` to ``end``, by periods."""
    whole = range((first // period + 1) * period, last, period)
    cuts = [first, *whole, last]
    # Rounded from where the stretch begins, so that equal stretches are cut alike wherever they lie.
    run, room = last - first, end - begin
    places = [begin + (2 * (cut - first) * room + run) // (2 * run) for cut in cuts]
    return [
        Span(a - a // period * period, a - a // period * period + b - a, u, v)
        for a, b, u, v in zip(cuts, cuts[1:], places, places[1:], strict=False)
        if v > u
    ]


class Band:
    """One period of one ink, and the pieces of it that are laid along a side."""

    def __init__(self, ink: Ink, marks: Marks, period: int, depth: int) -> None:
        self.ink, self.marks, self.period, self.depth = ink, marks, period, depth
        self._pieces: dict[tuple[int, int, int], Marks] = {}

    @property
    def merges(self) -> bool:
        """Whether marks of the ink that meet become one."""
        return self.ink.overlap != Overlap.OVERLAY

    def piece(self, first: int, last: int, width: int) -> Marks:
        """Return the drawing from ``first`` to ``last``, stretched to ``width`` and moved to x = 0."""
        key = first, last, width
        if key not in self._pieces:
            self._pieces[key] = self._cut(*key)
        return self._pieces[key]

    def _cut(self, first: int, last: int, width: int) -> Marks:
        marks = self.marks
        if (first, last) != (0, self.period):
            # A step beyond the edges of the band, where nothing is left to cut.
            marks = marks.clipped(Window(first, -1, last, self.depth + 1))
        if first or width != last - first:
            marks = on_grid(
                marks.moved(lambda xy: (xy - (first, 0)) * (width / (last - first), 1.0)), self.merges
            )
        return marks.opened_at(Window(0, 0, width, self.depth))

    def laid(self, along: Iterable[Span], mitres: tuple[bool, bool], length: int) -> Marks:
        """Return spans of the band laid along a side.

        Args:
            along: which, and where.
            mitres: whether the side's beginning and its end are cut along the 45° line of a corner.
            length: of the side.
        """
        parts: list[Marks] = []
        whole: dict[tuple[int, int, int], list[int]] = {}
        for span in along:
            near = mitres[0] and span.begin < self.depth, mitres[1] and span.end > length - self.depth
            key = span.first, span.last, span.end - span.begin
            if not any(near):
                whole.setdefault(key, []).append(span.begin)
                continue
            cut = self.piece(*key).repeated([span.begin])
            if near[0]:
                cut = mitred(cut)
            if near[1]:
                # Measured from the corner, so that both sides that meet there are cut alike.
                cut = mitred(cut.moved(lambda xy: (length, 0) + xy * (-1, 1)))
                cut = cut.moved(lambda xy: (length, 0) + xy * (-1, 1))
            parts.append(cut)
        parts += [self.piece(*key).repeated(begins) for key, begins in whole.items()]
        return together(parts)


def mitred(marks: Marks) -> Marks:
    """Return what lies at x ≥ y, in front of the 45° line of a corner at the origin.

    A shear turns that line into an upright one without leaving the grid; where an edge crosses it, it is
    cut in a grid point of the line itself, which a mirror image across the line has too.
    """
    if not len(marks.areas) and not len(marks.lines):
        return marks
    sheared = marks.moved(lambda xy: xy @ np.array([[1.0, 0.0], [-1.0, 1.0]]))
    window = _in_front(sheared)
    sheared = sheared.clipped(window).opened_at(replace(window, bottom=window.bottom - 1))
    return sheared.moved(lambda xy: xy @ np.array([[1.0, 0.0], [1.0, 1.0]]))


def _in_front(marks: Marks) -> Window:
    """Return a window that holds all of the marks at x ≥ 0."""
    _, y0, x, y1 = shapely.total_bounds(np.concatenate([marks.areas, marks.lines])).astype(int).tolist()
    return Window(0, y0 - 1, max(x, 0) + 1, y1 + 1)


def on_grid(marks: Marks, merges: bool) -> Marks:
    """Return marks, whose vertices are no whole steps, on the grid: valid, and none over another."""
    areas = to_step_grid(to_mm(marks.areas))
    areas, which = polygons_of(areas, np.arange(len(areas)))
    if merges:
        areas, first = welded(areas)
        which = which[first]
    lines = to_step_grid(to_mm(marks.lines))
    drawn = shapely.length(lines) > 0 if len(lines) else np.empty(0, bool)
    return Marks(
        areas, marks.area_codes[which], marks.open_areas[which],
        lines[drawn], marks.line_codes[drawn], marks.open_lines[drawn],
    )  # fmt: skip


def solved(
    sheets: Sequence[Sheet],
    inks: Sequence[Ink],
    box: tuple[int, int],
    periodic: bool,
    tolerance: float,
    code: Callable[[str], int],
) -> list[tuple[Ink, Marks]]:
    """Return the marks of sheets in a box, ink by ink, cut at its edges and merged as their inks say.

    Args:
        sheets: bottom first, in mm; the box has its lower left corner at (0, 0).
        inks: in painting order.
        box: width and height in grid steps.
        periodic: whether the sheets repeat with the width of the box; else they are there once.
        tolerance: in mm, for the round corners of gaps.
        code: of a name.
    """
    if not sheets:
        return []
    low, high = _extent(sheets, box)
    if periodic:
        low[0], high[0] = 0, box[0]
    columns, rows = (high - low).tolist()
    beacon = np.array([_BEACON_AT, _BEACON_AT, _BEACON_AT + 50, _BEACON_AT + 50]) / STEPS_PER_MM
    stack = [Sheet("", _BEACON, np.array([shapely.box(*beacon)], dtype=object))]
    stack += [_shifted(sheet, -low / STEPS_PER_MM) for sheet in sheets]
    cell = Cell(columns, rows)
    layers, _ = assemble(stack, [*inks, _BEACON], cell, cell.lattice, tolerance)
    moved = nearest_steps(shapely.total_bounds(layers[-1].areas)[:2]) - _BEACON_AT
    # Along the band it does not matter where the seam lies, and there it stays.
    back = low - moved.astype(np.int64) * (0 if periodic else 1, 1)
    return [(layer.ink, _in_box(layer, back, box, periodic, code)) for layer in layers[:-1]]


def _extent(sheets: Sequence[Sheet], box: tuple[int, int]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the corners of a rectangle that holds the box and all that the sheets draw and cut."""
    reach = max(
        (sheet.gap or 0.0) + (sheet.ink.width if sheet.ink else 0.0) + sheet.margin for sheet in sheets
    )
    every = np.concatenate(
        [part for s in sheets for part in (polygons(s.areas), s.lines, polygons(s.cutter))]
    )
    bounds = shapely.total_bounds(every) if len(every) else np.zeros(4)
    bounds = nearest_steps(bounds) + np.array([-1, -1, 1, 1]) * (to_steps(reach) + MARGIN)
    low = np.minimum(bounds[:2], (-MARGIN, -MARGIN)).astype(np.int64)
    high = np.maximum(bounds[2:], np.array(box) + MARGIN).astype(np.int64)
    return low, high


def _shifted(sheet: Sheet, by: Array) -> Sheet:
    def shifted(marks: Geometries) -> Geometries:
        return np.asarray(shapely.transform(marks, lambda xy: xy + by), dtype=object) if len(marks) else marks

    return replace(
        sheet,
        areas=shifted(polygons(sheet.areas)),
        lines=shifted(sheet.lines),
        cutter=shifted(polygons(sheet.cutter)),
    )


def _in_box(
    layer: Layer, shift: NDArray[np.int64], box: tuple[int, int], periodic: bool, code: Callable[[str], int]
) -> Marks:
    codes = [np.array(list(map(code, names)), np.intp) for names in (layer.area_names, layer.line_names)]
    shut = [np.zeros(len(each), bool) for each in codes]
    marks = Marks(layer.areas, codes[0], shut[0], layer.lines, codes[1], shut[1])
    marks = marks.moved(lambda xy: nearest_steps(xy) + shift)
    beyond = 1 if periodic else 0
    marks = marks.clipped(Window(-beyond, 0, box[0] + beyond, box[1]))
    if not periodic or not len(marks.areas):
        return marks.opened_at(Window(0, 0, *box))
    # A step of bare cell below and above, so that the band's two edges are not held against each other.
    up = np.array([[0, 1]], np.int64)
    areas = seams.mended(
        translate(marks.areas, np.repeat(up, len(marks.areas), axis=0)), Cell(box[0], box[1] + 2)
    )
    return replace(marks, areas=translate(areas, np.repeat(-up, len(areas), axis=0)))
