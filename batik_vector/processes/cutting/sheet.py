"""Pieces nested on a sheet by their true shapes: each in turn, the largest first, goes as low as it can.

Sheet and pieces are drawn on squares, and a row of squares is a stretch of bits of one large whole number:
where a piece may lie is found for all places at once, by shifting the sheet over itself. The squares that a
piece touches are taken, so that it never comes nearer to another than the gap.

Bottom-left placing of the largest first: B. Chazelle, The bottom-left bin-packing heuristic, IEEE
Transactions on Computers C-32 (1983); on squares: M. Okano, A scanline-based algorithm for the 2D free-form
bin packing problem, Journal of the Operations Research Society of Japan 45 (2002).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index
from batik_vector.geometry.sampling import Array, Geometries
from batik_vector.values import frozen

SQUARES = 400_000
"""Squares of a sheet, about."""
FINEST = 250
"""Steps to a square's side, at least."""
BLOCK = 16
"""Squares in the side of a block that is looked at as one."""
ROUND = 8
"""Chords of a quarter of a circle about a piece's corners."""

Shape = tuple[tuple[tuple[int, int], ...], ...]
"""A piece on squares: for each row, from the lowest, its runs as (first, length)."""


@frozen
class Place:
    """Where a piece lies: on which sheet, by how many quarters it is turned, and how far then moved."""

    sheet: int
    quarters: int
    right: int
    up: int


def nested(
    pieces: Geometries, width: int, height: int, gap: int, quarters: Sequence[int] = (0,)
) -> list[Place] | None:
    """Return a place for each piece on sheets, from whose edges they keep half the gap.

    Args:
        pieces: polygons in steps.
        width: of a sheet, in steps.
        height: likewise.
        gap: how far pieces lie apart at least, in steps.
        quarters: the turns that are tried, in quarters.

    Returns:
        One place for each, or None where one is too large for a sheet.
    """
    side = max(FINEST, math.isqrt(width * height // SQUARES))
    sheets = [_Sheet(width // side, height // side)]
    area, bounds = shapely.area(pieces), shapely.bounds(pieces)
    tall = np.maximum(bounds[:, 2] - bounds[:, 0], bounds[:, 3] - bounds[:, 1])
    found: list[Place | None] = [None] * len(pieces)
    if not _may_hold(bounds, width, height, gap, quarters):
        return None
    forms = [_Form(piece, gap, side, quarters) for piece in pieces]
    for number in np.lexsort([np.arange(len(pieces)), -area, -tall]).tolist():
        form = forms[number]
        if not any(sheets[0].holds(shape) for _, shape, _, _ in form.turned):
            return None
        found[number] = _laid(form, sheets, side)
    return [place for place in found if place is not None]


def _may_hold(bounds: Array, width: int, height: int, gap: int, quarters: Sequence[int]) -> bool:
    """Return whether no piece is broader or taller than a sheet, however it is turned."""
    across, up = bounds[:, 2] - bounds[:, 0] + gap, bounds[:, 3] - bounds[:, 1] + gap
    fits = np.zeros(len(bounds), bool)
    for quarter in quarters:
        wide, tall = (up, across) if quarter % 2 else (across, up)
        fits |= (wide <= width) & (tall <= height)
    return bool(fits.all())


def _laid(form: _Form, sheets: list[_Sheet], side: int) -> Place:
    """Lay a piece on the first sheet that has room for it, a new one if need be, as low as it goes."""
    for number in range(len(sheets) + 1):
        if number == len(sheets):
            sheets.append(_Sheet(sheets[0].columns, sheets[0].rows))
        best: tuple[int, int, int, int] | None = None
        for each, (_, shape, _, _) in enumerate(form.turned):
            at = sheets[number].lowest(shape)
            if at is not None:
                column, row = at
                top = (row + len(shape), column + _columns(shape), each, 0)
                best = min(filter(None, (best, (top[0], top[1], each, row * sheets[0].stride + column))))
        if best is not None:
            quarter, shape, x, y = form.turned[best[2]]
            row, column = divmod(best[3], sheets[0].stride)
            sheets[number].take(shape, column, row)
            return Place(number, quarter, column * side - x, row * side - y)
    raise AssertionError("an empty sheet has room")


class _Form:
    """A piece, every way that it is tried: the turn, its squares, and where their lower left corner is."""

    def __init__(self, piece: shapely.Geometry, gap: int, side: int, quarters: Sequence[int]) -> None:
        # The chords about a corner lie within its arc.
        distance = gap / 2 / math.cos(math.pi / 4 / ROUND) + 1
        grown = shapely.buffer(shapely.Polygon(shapely.get_exterior_ring(piece)), distance, quad_segs=ROUND)
        self.turned = [(quarter, *_squares(_quartered(grown, quarter), side)) for quarter in quarters]


def _squares(region: shapely.Geometry, side: int) -> tuple[Shape, int, int]:
    """Return the squares that a region touches, and where the lower left corner of them all is."""
    left, low, right, high = shapely.bounds(region).tolist()
    x, y = math.floor(left), math.floor(low)
    columns, rows = math.ceil((right - x) / side), math.ceil((high - y) / side)
    shapely.prepare(region)
    # Block by block first: within most of them all squares are alike.
    column, row = np.meshgrid(np.arange(0, columns, BLOCK), np.arange(0, rows, BLOCK))
    blocks = _boxes(x, y, side, column, row, BLOCK)
    met, full = shapely.intersects(region, blocks), shapely.covers(region, blocks)
    taken = np.repeat(np.repeat(full, BLOCK, axis=0), BLOCK, axis=1)
    within = np.arange(BLOCK)
    rims = np.flatnonzero((met & ~full).ravel())
    columns_of = column.ravel()[rims, None, None] + within[None, None, :] + 0 * within[None, :, None]
    rows_of = row.ravel()[rims, None, None] + within[None, :, None] + 0 * within[None, None, :]
    taken[rows_of, columns_of] = shapely.intersects(region, _boxes(x, y, side, columns_of, rows_of, 1))
    return _runs(taken[:rows, :columns]), x, y


def _boxes(x: int, y: int, side: int, column: Index, row: Index, size: int) -> Geometries:
    """Return blocks of so many squares, of which the lower left is in a column and a row."""
    left, low = x + column * side, y + row * side
    return np.asarray(shapely.box(left, low, left + size * side, low + size * side), object)


def _runs(taken: NDArray[np.bool_]) -> Shape:
    found = list[tuple[tuple[int, int], ...]]()
    for row in taken:
        edges = np.flatnonzero(np.diff(np.concatenate([[0], row.astype(np.int8), [0]])))
        found.append(tuple(zip(edges[::2].tolist(), (edges[1::2] - edges[::2]).tolist(), strict=True)))
    return tuple(found)


def _columns(shape: Shape) -> int:
    return max(first + size for row in shape for first, size in row)


def _quartered(region: shapely.Geometry, quarters: int) -> shapely.Geometry:
    """Return a region turned about (0, 0)."""
    return shapely.transform(region, lambda coords: turned(coords, quarters))


def turned(points: Array, quarters: int) -> Array:
    """Return places, shape (n, 2), turned about (0, 0) by quarters of a turn."""
    x, y = points[:, 0], points[:, 1]
    return np.stack([(x, y), (-y, x), (-x, -y), (y, -x)][quarters % 4], axis=1)


class _Sheet:
    """The squares of a sheet that are taken, row upon row in one whole number."""

    def __init__(self, columns: int, rows: int) -> None:
        self.columns, self.rows, self.stride = columns, rows, columns + 1
        # A column beside the sheet is taken, and so is all above it.
        self.taken = 0
        for row in range(rows):
            self.taken |= 1 << (row * self.stride + columns)
        self._seen: dict[Shape, int] = {}
        self._wide: dict[int, int] = {}

    def holds(self, shape: Shape) -> bool:
        """Return whether a shape fits on an empty sheet."""
        return len(shape) <= self.rows and _columns(shape) <= self.columns

    def lowest(self, shape: Shape) -> tuple[int, int] | None:
        """Return the column and row of the lowest free place, of equally low ones the leftmost."""
        if not self.holds(shape):
            return None
        places = (self.rows - len(shape) + 1) * self.stride
        barred = 0
        for number, row in enumerate(shape):
            for first, size in row:
                barred |= self._barred(size) >> (number * self.stride + first)
        free = ~barred & ((1 << places) - 1)
        # What was barred once stays so: like pieces begin to look where the last one came to lie.
        begin = self._seen.get(shape, 0)
        free = free >> begin << begin
        if not free:
            return None
        at = (free & -free).bit_length() - 1
        self._seen[shape] = at
        return at % self.stride, at // self.stride

    def _barred(self, size: int) -> int:
        """Return the squares from which a run of so many meets one that is taken."""
        if size == 1:
            return self.taken
        if size not in self._wide:
            half = 1 << ((size - 1).bit_length() - 1)
            some = self._barred(half)
            self._wide[size] = some | some >> (size - half)
        return self._wide[size]

    def take(self, shape: Shape, column: int, row: int) -> None:
        """Take the squares of a shape."""
        for number, runs in enumerate(shape):
            for first, size in runs:
                self.taken |= ((1 << size) - 1) << ((row + number) * self.stride + column + first)
        self._wide.clear()
