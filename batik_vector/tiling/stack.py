"""Sheets of marks, laid one over another on the torus, become the layers of a tile.

A sheet is what one element of one placement draws, over all its copies. Sheets lie in painting order;
an upper one may cut those beneath it, with a gap of bare ground. What is left of every ink is wrapped
round the cell, cut at its edges and, where its ink says so, welded.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Geometries, Ink, Layer, Overlap
from batik_vector.errors import SeamError, TooLargeError
from batik_vector.geometry.regions import oriented
from batik_vector.tiling import overlay, seams
from batik_vector.tiling.endings import Places, lone_ends, own_ends
from batik_vector.tiling.once import drawn_once
from batik_vector.tiling.torus import (
    Lattice,
    Window,
    clip_areas,
    clip_lines,
    lines_of,
    polygons_of,
    to_mm,
    to_step_grid,
    translate,
    wrap,
)
from batik_vector.tiling.weld import welded
from batik_vector.units import STEPS_PER_MM

Borders = frozenset[tuple[str, int, int, int]]
Pieces = Callable[[Geometries, NDArray[np.intp]], tuple[Geometries, NDArray[np.intp]]]
"""Takes geometries apart: (geometries, names) → (simple parts, their names)."""

MAX_VERTICES = 50_000_000
"""Vertices past which the work is refused before it is begun."""

MAX_REPEATS = 5_000
"""Repeats that one mark may reach over: all its translates meet, and welding them costs their square."""

PHASES = 6
"""How many positions of the seam are tried before a tile is given up."""

PHASE_STEP = (13, 17)
"""By how many grid steps the design is moved for each new try."""


def _none() -> Geometries:
    return np.empty(0, dtype=object)


@dataclass(frozen=True)
class Sheet:
    """The marks of one element, in mm on cloth, not yet wrapped.

    ``ink`` is None for a sheet that only cuts. ``gap`` is how many mm of ground it keeps bare round its
    shape by cutting what lies beneath; None cuts nothing. ``cutter`` is the shape that cuts, where it is
    not the areas drawn (an outlined petal hides what lies under the whole petal). ``whole`` leaves out
    marks that would be cut, as nobody waxes half a dot; ``margin`` (mm) is how far a line drawn round
    the areas by another sheet reaches beyond them, so that both are kept or left out together.
    """

    name: str
    ink: Ink | None
    areas: Geometries = field(default_factory=_none)
    lines: Geometries = field(default_factory=_none)
    gap: float | None = None
    cutter: Geometries = field(default_factory=_none)
    whole: bool = False
    margin: float = 0.0


@dataclass
class _Marks:
    """Marks in grid steps, and for each of them the index of its sheet's name."""

    geometries: Geometries = field(default_factory=_none)
    names: NDArray[np.intp] = field(default_factory=lambda: np.empty(0, np.intp))

    def extend(self, other: _Marks) -> None:
        self.geometries = np.concatenate([other.geometries, self.geometries])
        self.names = np.concatenate([other.names, self.names])


def quad_segs(radius: float, tolerance: float) -> int:
    """Return into how many pieces a buffer must cut a quarter turn to keep the tolerance (both in mm)."""
    if radius <= tolerance:
        return 2
    return max(2, int(np.ceil(np.pi / 4 / np.arccos(1 - tolerance / radius))))


def assemble(
    sheets: Sequence[Sheet], inks: Sequence[Ink], cell: Cell, lattice: Lattice, tolerance: float
) -> tuple[tuple[Layer, ...], Borders]:
    """Return the layers of a tile, in the normal form, one for every ink that draws something.

    With them come the borders that run along the seam, and as borders of no length the places at which a
    line ends on it: see :class:`~batik_vector.artwork.Artwork`.

    Args:
        sheets: bottom first, in mm.
        inks: in painting order, bottom first.
        cell: the tile.
        lattice: on which the sheets repeat, in grid steps: the one of the unit, of which the tile may be
            several.
        tolerance: in mm, for the round corners of gaps.

    Raises:
        TooLargeError: with the estimate, where the marks reach over too many repeats.
        SeamError: where opposite edges disagree however the seam is placed.
    """
    _refuse_too_many(sheets, cell, lattice)
    for phase in range(PHASES):
        torus = _Torus(cell, lattice, np.array([PHASE_STEP], np.int64) * phase)
        layers = _assemble_on(torus, sheets, inks, tolerance)
        if layers is not None:
            return layers, frozenset(torus.borders)
    raise SeamError(f"opposite edges of the tile disagree at {PHASES} positions of the seam")


def _refuse_too_many(sheets: Sequence[Sheet], cell: Cell, lattice: Lattice) -> None:
    (ax, ay), (bx, by) = lattice
    per_mm2 = STEPS_PER_MM**2 / (ax * by - ay * bx)
    total = 0.0
    for part in (part for sheet in sheets for part in (sheet.areas, sheet.lines)):
        marks = part[~shapely.is_empty(part)]
        if not len(marks):
            continue
        low_x, low_y, high_x, high_y = shapely.bounds(marks).T
        repeats = (high_x - low_x + cell.width) * (high_y - low_y + cell.height) * per_mm2
        if repeats.max() > MAX_REPEATS:
            raise TooLargeError(
                f"a mark reaches over about {repeats.max():,.0f} repeats, past {MAX_REPEATS:,}: "
                "expected a larger tile or smaller marks"
            )
        total += float((repeats * shapely.get_num_coordinates(marks)).sum())
    if total > MAX_VERTICES:
        raise TooLargeError(
            f"the marks reach over so many repeats that they have about {total:,.0f} vertices: "
            "expected a larger tile or smaller marks"
        )


def _assemble_on(
    torus: _Torus, sheets: Sequence[Sheet], inks: Sequence[Ink], tolerance: float
) -> tuple[Layer, ...] | None:
    """Do the work of :func:`assemble` at one place of the seam; None where it falls badly."""
    areas = {ink.name: _Marks() for ink in inks}
    lines = {ink.name: _Marks() for ink in inks}
    above: list[Sheet] = []
    cutters = _none()
    for number in range(len(sheets) - 1, -1, -1):
        sheet = sheets[number]
        if sheet.ink is not None:
            filled, centre_lines = _uncut(sheet, torus, cutters)
            drawn = torus.areas(filled, number)
            strokes = torus.lines(centre_lines, number, sheet.ink.name)
            if above and len(strokes.geometries):
                # A line ends where its body, and not its centre, meets the gap.
                shapes = [_cutting_shape(upper, tolerance, sheet.ink.width / 2) for upper in above]
                bodies, _ = welded(torus.areas(np.concatenate(shapes), 0).geometries)
                strokes = torus.cut_lines(strokes, bodies, sheet.ink.name)
            areas[sheet.ink.name].extend(_cut(drawn, cutters, polygons_of))
            lines[sheet.ink.name].extend(strokes)
        if sheet.gap is not None:
            above.append(sheet)
            shape = torus.areas(_cutting_shape(sheet, tolerance, 0.0), 0).geometries
            cutters, _ = welded(np.concatenate([cutters, shape]))
    names = [sheet.name for sheet in sheets]
    layers = []
    for ink in inks:
        merged = _merge(areas[ink.name], ink.overlap)
        merged.geometries = seams.mended(merged.geometries, torus.cell)
        if not torus.seam_holds(ink.name, merged.geometries):
            return None
        once = drawn_once(lines[ink.name].geometries, lines[ink.name].names)
        torus.record_ends(ink.name, once[0])
        layers.append(_layer(ink, merged, once, names))
    return tuple(layer for layer in layers if len(layer.areas) or len(layer.lines))


class _Torus:
    """Wraps marks round the cell, cuts them at its edges, and remembers what of them lay on the seam."""

    def __init__(self, cell: Cell, lattice: Lattice, phase: NDArray[np.int64]) -> None:
        self.cell, self.lattice, self.phase = cell, lattice, phase
        self.window = Window(0, 0, cell.columns, cell.rows)
        self.allowed: list[NDArray[np.int64]] = []
        self.borders: list[tuple[str, int, int, int]] = []
        self.ends: dict[str, Places] = {}

    def areas(self, marks: Geometries, name: int | NDArray[np.intp]) -> _Marks:
        pieces, names = polygons_of(
            to_step_grid(marks), np.broadcast_to(np.asarray(name, np.intp), len(marks))
        )
        pieces = translate(pieces, np.repeat(self.phase, len(pieces), axis=0))
        pieces, names = wrap(pieces, names, self.lattice, self.window)
        self.allowed.append(seams.on_seam(pieces, self.window))
        return _Marks(*clip_areas(pieces, names, self.window))

    def lines(self, marks: Geometries, name: int, ink: str) -> _Marks:
        pieces = to_step_grid(marks)
        pieces = pieces[shapely.length(pieces) > 0] if len(pieces) else pieces
        pieces = translate(pieces, np.repeat(self.phase, len(pieces), axis=0))
        pieces, names = wrap(pieces, np.full(len(pieces), name, np.intp), self.lattice, self.window)
        self.ends.setdefault(ink, set()).update(own_ends(pieces, self.cell))
        return _Marks(*clip_lines(pieces, names, self.window))

    def cut_lines(self, lines: _Marks, cutters: Geometries, ink: str) -> _Marks:
        """Cut lines by cutters that do not overlap; one that is cut off up to the seam ends there."""
        cut = _cut(lines, cutters, lines_of)
        ended = lone_ends(cut.geometries, self.cell) - lone_ends(lines.geometries, self.cell)
        if ended:
            torn = [
                row
                for row in self._torn(seams.mismatch(cutters, self.cell))
                if row[2] - row[1] > seams.MEND_STEPS
            ]
            self.ends[ink] |= {place for place in ended if not _lies_in(place, torn)}
        return cut

    def record_ends(self, ink: str, lines: Geometries) -> None:
        """Note where lines end on the seam on purpose, as borders of no length."""
        meant = self.ends.get(ink, set()) & lone_ends(lines, self.cell)
        self.borders += [(ink, 0, y, y) if x == 0 else (ink, 1, x, x) for x, y in sorted(meant)]

    def seam_holds(self, ink: str, areas: Geometries) -> bool:
        """Whether opposite edges agree, but for borders that were drawn along the seam on purpose."""
        if not shapely.is_valid(areas).all():
            return False
        breaks = seams.mismatch(areas, self.cell)
        if self._torn(breaks):
            return False
        self.borders += [(ink, axis, low, high) for axis, low, high in breaks.tolist()]
        return True

    def _torn(self, breaks: NDArray[np.int64]) -> list[tuple[int, int, int]]:
        """Return what of breaks, rows of (axis, from, to), no mark's own border along the seam explains."""
        if not len(breaks):
            return []
        allowed = np.concatenate(self.allowed)
        found = []
        for axis in (0, 1):
            mine = seams.joined(breaks[breaks[:, 0] == axis, 1:])
            legal = seams.joined(allowed[allowed[:, 0] == axis, 1:])
            together = seams.joined(np.vstack([mine, legal]))
            found += [(axis, low, high) for low, high in seams.symmetric_difference(together, legal).tolist()]
        return found


def _lies_in(place: tuple[int, int], stretches: Sequence[tuple[int, int, int]]) -> bool:
    """Whether a place on the seam lies within one of its stretches, given as (axis, from, to)."""
    return any(place[axis] == 0 and low < place[1 - axis] < high for axis, low, high in stretches)


def _uncut(sheet: Sheet, torus: _Torus, cutters: Geometries) -> tuple[Geometries, Geometries]:
    """Return a sheet's areas and lines; of one that keeps whole marks only, those that nothing above cuts.

    A mark is asked for as a whole, wherever the seam divides it, and with the body of its line; a closed
    line stands for what it encloses.
    """
    if not sheet.whole or not len(cutters) or sheet.ink is None:
        return sheet.areas, sheet.lines
    areas = shapely.buffer(sheet.areas, sheet.margin) if sheet.margin else sheet.areas
    shapes = sheet.lines.copy()
    closed = shapely.is_closed(shapes) & (shapely.get_num_points(shapes) > 3)
    xy, ring = shapely.get_coordinates(shapes[closed], return_index=True)
    if closed.any():
        shapes[closed] = shapely.make_valid(shapely.polygons(shapely.linearrings(xy, indices=ring)))
    bodies = shapely.buffer(shapes, sheet.ink.width / 2)
    return (
        np.delete(sheet.areas, _touched(torus, np.asarray(areas, dtype=object), cutters)),
        np.delete(sheet.lines, _touched(torus, np.asarray(bodies, dtype=object), cutters)),
    )


def _touched(torus: _Torus, shapes: Geometries, cutters: Geometries) -> NDArray[np.intp]:
    """Return which shapes (mm) cutters on the torus would cut into."""
    if not len(shapes):
        return np.empty(0, np.intp)
    pieces = torus.areas(shapes, np.arange(len(shapes)))
    a, b = shapely.STRtree(cutters).query(pieces.geometries, predicate="intersects")
    cut = shapely.relate_pattern(pieces.geometries[a], cutters[b], "T********")
    return np.unique(pieces.names[a[cut]])


def _cutting_shape(sheet: Sheet, tolerance: float, extra: float) -> Geometries:
    """Return what a sheet cuts away beneath it (mm): its shape, grown by its gap and by ``extra``."""
    shape = sheet.cutter if len(sheet.cutter) else sheet.areas
    grow = (sheet.gap or 0.0) + extra
    parts = []
    if len(shape):
        parts.append(shapely.buffer(shape, grow, quad_segs=quad_segs(grow, tolerance)) if grow > 0 else shape)
    if len(sheet.lines) and sheet.ink is not None and not len(sheet.cutter):
        grow += sheet.ink.width / 2
        parts.append(shapely.buffer(sheet.lines, grow, quad_segs=quad_segs(grow, tolerance)))
    return np.concatenate(parts) if parts else _none()


def _cutters_of(marks: Geometries, cutters: Geometries) -> tuple[NDArray[np.intp], Geometries]:
    """Return which marks are touched by cutters (which do not overlap), and for each those that touch it."""
    mark, cutter = shapely.STRtree(cutters).query(marks, predicate="intersects")
    order = np.lexsort([cutter, mark])
    rows, number = np.unique(mark[order], return_inverse=True)
    if not len(rows):
        return rows, np.empty(0, dtype=object)
    return rows, np.asarray(shapely.multipolygons(cutters[cutter[order]], indices=number), dtype=object)


def _cut(marks: _Marks, cutters: Geometries, pieces_of: Pieces) -> _Marks:
    """Cut marks by cutters that do not overlap; ``pieces_of`` takes apart what is left of each."""
    if not len(marks.geometries) or not len(cutters):
        return marks
    rows, away = _cutters_of(marks.geometries, cutters)
    if not len(rows):
        return marks
    left = overlay.less(marks.geometries[rows], away)
    pieces, names = pieces_of(left, marks.names[rows])
    whole = np.ones(len(marks.geometries), bool)
    whole[rows] = False
    return _Marks(
        np.concatenate([marks.geometries[whole], pieces]), np.concatenate([marks.names[whole], names])
    )


def _merge(marks: _Marks, overlap: Overlap) -> _Marks:
    """Weld the marks of an ink where they meet; an overlay keeps them, and drops exact repeats."""
    areas = marks.geometries
    if len(areas) < 2:
        return marks
    if overlap == Overlap.OVERLAY:
        # A vertex on a straight edge, as cutting leaves, makes no other mark.
        bare = shapely.normalize(shapely.simplify(areas, 0))
        _, first = np.unique(shapely.to_wkb(bare), return_index=True)
        first.sort()
        return _Marks(areas[first], marks.names[first])
    joined, first = welded(areas)
    return _Marks(joined, marks.names[first])


def _layer(ink: Ink, areas: _Marks, lines: tuple[Geometries, NDArray[np.intp]], names: list[str]) -> Layer:
    """Return a layer in mm from marks in grid steps."""
    polygons = oriented(areas.geometries) if len(areas.geometries) else areas.geometries
    return Layer(
        ink,
        to_mm(polygons),
        to_mm(lines[0]),
        tuple(names[i] for i in areas.names),
        tuple(names[i] for i in lines[1]),
    )
