"""Sheets of marks, laid one over another on the torus, become the layers of a tile.

Sheets lie in painting order; an upper one may cut those beneath it, with a gap of bare ground. What is left
of every ink is wrapped round the cell, cut at its edges and, where its ink says so, welded.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Geometries, Ink, Layer, Overlap
from batik_vector.errors import SeamError, TooLargeError
from batik_vector.geometry.outlines import Index
from batik_vector.tiling.torus.torus import Lattice, to_mm
from batik_vector.tiling.welding.congruent import Stock
from batik_vector.tiling.welding.cuts import cut, touched
from batik_vector.tiling.welding.duplicates import aligned, drawn_once
from batik_vector.tiling.welding.growth import grown_on_grid
from batik_vector.tiling.welding.sheets import Laid, Pile, Sheet, joined
from batik_vector.tiling.welding.weld import weld, weld_changed
from batik_vector.tiling.welding.wrapping import Borders, Lines, Torus
from batik_vector.units import STEPS_PER_MM

MAX_VERTICES = 50_000_000
"""Vertices past which the work is refused before it is begun."""

MAX_REPEATS = 5_000
"""Repeats that one mark may reach over: all its translates meet, and welding them costs their square."""

FEW_REPEATS = 16
"""A mark that reaches over more repeats than these meets everything so often that it is cut up first."""

PHASES = 6
"""How many positions of the seam are tried before a tile is given up."""

PHASE_STEP = (13, 17)
"""By how many grid steps the design is moved for each new try."""


class Cut(NamedTuple):
    """What upper sheets leave of lower ones.

    Attributes:
        areas: cut, not yet wrapped.
        late: those that reach over many repeats, to be cut by ``cutters`` when they lie in the cell.
        cutters: none of which reaches over many repeats.
        lines: of each sheet, in mm, not yet cut.
    """

    areas: Laid
    late: Laid
    cutters: Laid
    lines: list[Geometries]


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
    stock = Stock(remembers=True)
    pile = Pile(sheets, stock, tolerance, _farthest(lattice, tolerance))
    _refuse_too_many(pile, cell, lattice)
    left = _cut(pile, lattice)
    for phase in range(PHASES):
        torus = Torus(stock, cell, lattice, np.array(PHASE_STEP, np.int64) * phase)
        layers = _assemble_on(torus, pile, left, inks)
        if layers is not None:
            return layers, frozenset(torus.borders)
    raise SeamError(f"opposite edges of the tile disagree at {PHASES} positions of the seam")


def _farthest(lattice: Lattice, tolerance: float) -> float:
    """Return how far (mm) a shape must grow for its repeats to cover the plane; further it need not.

    No place is farther from the points of a lattice than the radius of the circle through the corners of the
    triangle that its two shortest vectors make, which has no obtuse angle.
    """
    a, b = sorted((complex(*each) for each in lattice), key=abs)
    while True:
        b -= a * round((b * a.conjugate()).real / abs(a) ** 2)
        if abs(b) >= abs(a):
            break
        a, b = b, a
    third = min(abs(b - a), abs(b + a))
    radius = abs(a) * abs(b) * third / (2 * abs((a.conjugate() * b).imag))
    # A circle grown is drawn with chords.
    return 1.001 * radius / STEPS_PER_MM + 2 * tolerance


def _refuse_too_many(pile: Pile, cell: Cell, lattice: Lattice) -> None:
    (ax, ay), (bx, by) = lattice
    lines = np.concatenate([np.empty(0, dtype=object), *(sheet.lines for sheet in pile.sheets)])
    of = np.repeat(np.arange(len(pile.sheets)), [len(sheet.lines) for sheet in pile.sheets])
    lines, of = lines[~shapely.is_empty(lines)], of[~shapely.is_empty(lines)]
    gaps = np.array([pile.reach(number) for number in range(len(pile.sheets))]) * STEPS_PER_MM
    grown = np.outer(gaps, [-1, -1, 1, 1])
    bounds = np.vstack(
        [
            pile.stock.bounds(pile.areas.copies) + grown[pile.areas.sheet],
            shapely.bounds(lines) * STEPS_PER_MM + grown[of],
        ]
    )
    if not len(bounds):
        return
    vertices = shapely.get_num_coordinates(pile.stock.shapes)[pile.areas.copies.kind]
    vertices = np.concatenate([vertices, shapely.get_num_coordinates(lines)])
    width, height = bounds[:, 2] - bounds[:, 0], bounds[:, 3] - bounds[:, 1]
    repeats = (width + cell.columns) * (height + cell.rows) / (ax * by - ay * bx)
    if repeats.max() > MAX_REPEATS:
        raise TooLargeError(
            f"a mark reaches over about {repeats.max():,.0f} repeats, past {MAX_REPEATS:,}: "
            "expected a larger tile or smaller marks"
        )
    total = float((repeats * vertices).sum())
    if total > MAX_VERTICES:
        raise TooLargeError(
            f"the marks reach over so many repeats that they have about {total:,.0f} vertices: "
            "expected a larger tile or smaller marks"
        )


def _assemble_on(torus: Torus, pile: Pile, left: Cut, inks: Sequence[Ink]) -> tuple[Layer, ...] | None:
    """Do the work of :func:`assemble` at one place of the seam; None where it falls badly."""
    drawn, lines = _wrapped(torus, left.areas), left.lines
    if len(left.late.sheet):
        # What cuts them along the seam does so on purpose.
        torus.areas(left.cutters.copies)
        cutters = Laid(left.cutters.copies.moved(torus.phase), left.cutters.sheet)
        late = cut(torus.stock, _wrapped(torus, left.late), cutters, torus.lattice)
        drawn = joined([drawn, late])
        drawn = drawn.taken(np.argsort(drawn.sheet, kind="stable"))
    strokes = [
        (sheet.ink.name, _strokes(torus, pile, number, lines[number]))
        for number, sheet in enumerate(pile.sheets)
        if sheet.ink is not None and len(lines[number])
    ]
    numbers = {ink.name: number for number, ink in enumerate(inks)}
    ink_of = np.array([-1 if sheet.ink is None else numbers[sheet.ink.name] for sheet in pile.sheets], int)
    drawn = _merged(torus, drawn, ink_of, inks)
    names = [sheet.name for sheet in pile.sheets]
    layers = []
    for number, ink in enumerate(inks):
        mine = drawn.taken(ink_of[drawn.sheet] == number)
        sealed = torus.sealed(ink.name, mine.copies, apart=ink.overlap != Overlap.OVERLAY)
        if sealed is None:
            return None
        own = [each for name, each in strokes if name == ink.name]
        drawn_lines, of = _together(own)
        once = drawn_once(aligned(drawn_lines, torus.window), of)
        torus.record_ends(ink.name, once[0])
        layers.append(_layer(ink, torus.stock, Laid(sealed, mine.sheet), once, names))
    return tuple(layer for layer in layers if len(layer.areas) or len(layer.lines))


def _wrapped(torus: Torus, laid: Laid) -> Laid:
    copies, of = torus.areas(laid.copies)
    return Laid(copies, laid.sheet[of])


def _together(parts: Sequence[Lines]) -> Lines:
    return (
        np.concatenate([np.empty(0, dtype=object), *(lines for lines, _ in parts)]),
        np.concatenate([np.empty(0, np.intp), *(sheets for _, sheets in parts)]),
    )


def _cut(pile: Pile, lattice: Lattice) -> Cut:
    """Return what sheets leave of one another."""
    cutters = _handy(pile.stock, pile.cutters(), lattice)
    out, lines = _left_out(pile, cutters, lattice)
    left = pile.drawn.taken(~out)
    late = _reach(pile.stock, left, lattice) > FEW_REPEATS
    return Cut(cut(pile.stock, left.taken(~late), cutters, lattice), left.taken(late), cutters, lines)


def _reach(stock: Stock, laid: Laid, lattice: Lattice) -> NDArray[np.float64]:
    """Return over how many repeats each copy reaches, about."""
    x0, y0, x1, y1 = stock.bounds(laid.copies).T
    return np.asarray(((x1 - x0) / lattice[0][0] + 1) * ((y1 - y0) / lattice[1][1] + 1))


def _handy(stock: Stock, laid: Laid, lattice: Lattice) -> Laid:
    """Return areas of which none reaches over many repeats: others are cut up and welded in one cell."""
    large = _reach(stock, laid, lattice) > FEW_REPEATS
    if not large.any():
        return laid
    cell = Torus(stock, Cell(lattice[0][0], lattice[1][1]), lattice, np.zeros(2, np.int64))
    pieces = _wrapped(cell, laid.taken(large))
    copies, first = weld(stock, pieces.copies, pieces.sheet)
    return joined([laid.taken(~large), Laid(copies, pieces.sheet[first])])


def _left_out(pile: Pile, cutters: Laid, lattice: Lattice) -> tuple[NDArray[np.bool_], list[Geometries]]:
    """Return which areas are left out, being whole or nothing and cut; and what lines of each sheet stay.

    A mark is asked for with the body of its line; a closed line stands for what it encloses.
    """
    stock = pile.stock
    lines = [sheet.lines for sheet in pile.sheets]
    out = np.zeros(len(pile.drawn.sheet), bool)
    for number, sheet in enumerate(pile.sheets):
        if not sheet.whole or sheet.ink is None or not len(cutters.sheet):
            continue
        mine = np.flatnonzero(pile.drawn.sheet == number)
        down = stock.mapped(pile.drawn.copies.taken(mine), partial(grown_on_grid, reach=sheet.margin))
        hit = _hit(stock, Laid(down.copies, np.full(len(down.each), number)), cutters, lattice)
        out[mine[down.each[hit]]] = True
        if len(sheet.lines):
            copies, of = stock.settled(_bodies(sheet.lines, sheet.ink.width / 2))
            hit = _hit(stock, Laid(copies, np.full(len(copies), number)), cutters, lattice)
            lines[number] = np.delete(sheet.lines, of[hit])
    return out, lines


def _hit(stock: Stock, marks: Laid, cutters: Laid, lattice: Lattice) -> NDArray[np.bool_]:
    """Return which marks something above would cut into; where one is large, each is asked piece by piece."""
    if (_reach(stock, marks, lattice) <= FEW_REPEATS).all():
        return touched(stock, marks, cutters, lattice)
    cell = Torus(stock, Cell(lattice[0][0], lattice[1][1]), lattice, np.zeros(2, np.int64))
    pieces, of = cell.areas(marks.copies)
    found = np.zeros(len(marks.sheet), bool)
    found[of[touched(stock, Laid(pieces, marks.sheet[of]), cutters, lattice)]] = True
    return found


def _bodies(lines: Geometries, reach: float) -> Geometries:
    """Return what lines (mm) cover when drawn; a closed one covers what it encloses."""
    shapes = lines.copy()
    closed = shapely.is_closed(shapes) & (shapely.get_num_points(shapes) > 3)
    xy, ring = shapely.get_coordinates(shapes[closed], return_index=True)
    if closed.any():
        shapes[closed] = shapely.make_valid(shapely.polygons(shapely.linearrings(xy, indices=ring)))
    return np.asarray(shapely.buffer(shapes, reach), dtype=object)


def _strokes(torus: Torus, pile: Pile, number: int, lines: Geometries) -> Lines:
    """Return what is left of a sheet's lines (mm): each ends where its body meets a gap, not its centre."""
    ink = pile.sheets[number].ink
    assert ink is not None
    strokes = torus.lines(lines, number, ink.name, pile.tolerance * STEPS_PER_MM / 2)
    if not len(strokes[0]):
        return strokes
    above = pile.cutters(above=number, extra=ink.width / 2)
    if not len(above.sheet):
        return strokes
    bodies, _ = weld(torus.stock, _wrapped(torus, above).copies)
    return torus.cut_lines(strokes, torus.stock.geometries(bodies), ink.name, pile.tolerance * STEPS_PER_MM)


def _merged(torus: Torus, drawn: Laid, ink_of: Index, inks: Sequence[Ink]) -> Laid:
    """Weld the marks of an ink where they meet; an overlay keeps them, and drops exact repeats.

    What is thinner than the grid goes: from an overlay first, of which two may repeat one another but for it.
    A slit that is filled may have run beside another mark, which then is welded, too.
    """
    over = np.array([ink.overlap == Overlap.OVERLAY for ink in inks], bool)
    ink = ink_of[drawn.sheet]
    mine = drawn.taken(~over[ink])
    copies, first = weld(torus.stock, mine.copies, ink_of[mine.sheet])
    mine = Laid(torus.without_needles(copies), mine.sheet[first])
    changed = np.flatnonzero(mine.copies.kind != copies.kind)
    copies, first = weld_changed(torus.stock, mine.copies, ink_of[mine.sheet], changed)
    welded = Laid(copies, mine.sheet[first])
    laid = drawn.taken(over[ink])
    laid = Laid(torus.without_needles(laid.copies), laid.sheet)
    kept = [
        laid.taken(_first_drawn(torus.stock, laid, np.flatnonzero(ink_of[laid.sheet] == each)))
        for each in np.flatnonzero(over)
    ]
    return joined([welded, *kept])


def _first_drawn(stock: Stock, drawn: Laid, which: Index) -> Index:
    """Return those of some copies that repeat none before them."""
    # A vertex on a straight edge, as cutting leaves, makes no other mark.
    bare = shapely.normalize(shapely.simplify(stock.geometries(drawn.copies.taken(which)), 0))
    _, first = np.unique(shapely.to_wkb(bare), return_index=True)
    return which[np.sort(first)]


def _layer(ink: Ink, stock: Stock, areas: Laid, lines: Lines, names: Sequence[str]) -> Layer:
    """Return a layer in mm from marks in grid steps."""
    polygons = stock.in_mm(areas.copies)
    return Layer(
        ink,
        polygons,
        to_mm(lines[0]),
        tuple(map(names.__getitem__, areas.sheet)),
        tuple(map(names.__getitem__, lines[1])),
    )
