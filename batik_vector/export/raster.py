"""Areas as pixels of one bit: a pixel is black where its centre lies in an area, told in whole numbers.

Nothing is rounded: a centre on a border belongs to what lies right of it or below. So areas that share a
border leave no pixel between them and share none, and where a repeat is a whole number of pixels, what is
drawn of it is the same wherever it begins. Marks that overlap are one: what counts is the winding number of
the outlines about a centre, outer rings counted up and holes down. Each row of centres is crossed with the
edges by itself (scan conversion: Foley, van Dam, Feiner, Hughes, Computer Graphics, 2nd ed., 3.6), and rows
come in bands, so that no picture need fit in memory.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from fractions import Fraction

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Page
from batik_vector.errors import UnsupportedByFormatError
from batik_vector.export.numbers import check_range
from batik_vector.geometry.outlines import Outlines, of_polygons, to_polylines
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

Bits = NDArray[np.uint8]
"""Rows of pixels, shape (rows, bytes of a row): the highest bit is the left pixel, and 1 is black."""
Whole = NDArray[np.int64]

BAND = 256
"""Rows of a band."""
MAX_SIDE = 250_000
MAX_PIXELS = 10_000_000_000
"""Pixels of a side and in all: a cloth of 1.5 × 15 m at 360 dpi has 4.5 thousand millions."""
HALF_INCH = Fraction(12_700)
"""In steps."""
MOST = np.iinfo(np.int64).max
SAG = 0.05
"""Pixels by which chords about the ends of a line may lie within their arcs."""

_BYTES = np.arange(256, dtype=np.uint8)
_SPREAD = np.packbits(np.bitwise_xor.accumulate(np.unpackbits(_BYTES[:, None], axis=1), axis=1), axis=1)[:, 0]
"""Each byte with every bit changed by all that are set to its left: from where colours change to colours."""
_LAST = np.where(_SPREAD & 1, 255, 0).astype(np.uint8)
"""What that leaves to the bytes on its right."""


@frozen
class Sheet:
    """A page as ``width`` × ``height`` pixels.

    ``left`` and ``top`` (steps) are where its upper left corner lies on the page, ``across`` and ``down`` how
    many steps half a pixel is broad and high.
    """

    left: int
    top: int
    width: int
    height: int
    across: Fraction
    down: Fraction


def sheet_of(page: Page, dpi: float) -> Sheet:
    """Return how a page is divided into pixels.

    A tile is filled with whole ones, so that it repeats. Any other page has exactly so many to the inch, and
    the last of them reach beyond it.

    Raises:
        UnsupportedByFormatError: where there would be too many.
    """
    margins = page.margins
    columns = page.cell.columns + margins.left + margins.right
    rows = page.cell.rows + margins.bottom + margins.top
    half = HALF_INCH / Fraction(str(dpi))
    tile = isinstance(page, Artwork) and not page.bleed
    width, height = (
        max(1, round(side / (2 * half)) if tile else math.ceil(side / (2 * half))) for side in (columns, rows)
    )
    if width * height > MAX_PIXELS or max(width, height) > MAX_SIDE:
        most = min(dpi * (MAX_PIXELS / (width * height)) ** 0.5, dpi * MAX_SIDE / max(width, height))
        raise UnsupportedByFormatError(
            f"dpi = {dpi:g} would make a plate of {width:,} × {height:,} pixels: "
            f"{max(int(most), 1):,} dpi is the most for this page"
        )
    across, down = (Fraction(columns, 2 * width), Fraction(rows, 2 * height)) if tile else (half, half)
    return Sheet(-margins.left, page.cell.rows + margins.top, width, height, across, down)


def bands(page: Page, sheet: Sheet, rows: int = BAND) -> Iterator[Bits]:
    """Yield what all layers of a page cover, ``rows`` rows at a time, the uppermost first.

    Lines have the body of their ink, round at the ends.
    """
    edges = _Edges.of(_covered(page, sheet), sheet)
    for first in range(0, sheet.height, rows):
        yield edges.band(first, min(first + rows, sheet.height))


def _covered(page: Page, sheet: Sheet) -> Iterator[Outlines]:
    """Yield the areas of a page and the bodies of its lines."""
    for number, plate in enumerate(page.plates):
        for areas in page.areas(number):
            check_range(areas.points)
            yield areas
        radius = plate.ink.width * STEPS_PER_MM / 2
        for lines in page.lines(number) if radius > 0 else ():
            check_range(lines.points)
            sag = 2 * SAG * float(min(sheet.across, sheet.down))
            chords = max(8, math.ceil(math.pi / 4 / math.acos(max(1 - sag / radius, 0.5))))
            bodies = shapely.buffer(to_polylines(lines), radius, quad_segs=chords)
            yield of_polygons(np.asarray(shapely.orient_polygons(shapely.get_parts(bodies)), dtype=object))


@frozen(eq=False)
class _Edges:
    """Edges that cross rows of centres, in the order of the first that each crosses.

    ``x`` and ``y`` (steps, y down from the sheet's top) are of the upper end, ``dx`` and ``dy`` lead to the
    lower one; ``first`` and ``stop`` are the rows that it crosses, ``down`` how it runs.
    """

    sheet: Sheet
    x: Whole
    y: Whole
    dx: Whole
    dy: Whole
    first: NDArray[np.int32]
    stop: NDArray[np.int32]
    down: NDArray[np.bool_]

    @classmethod
    def of(cls, pieces: Iterable[Outlines], sheet: Sheet) -> _Edges:
        """Return the edges of areas, without those that pass between two rows."""
        parts = [_crossing(piece, sheet) for piece in pieces if len(piece.points)]
        made = [np.concatenate(each) for each in zip(*parts, strict=True)] if parts else _NONE
        order = np.argsort(made[4], kind="stable")
        x, y, dx, dy, first, stop, down = (each[order] for each in made)
        return cls(sheet, x, y, dx, dy, first, stop, down)

    def band(self, low: int, high: int) -> Bits:
        """Return rows ``low`` to ``high``."""
        count = int(np.searchsorted(self.first, high))
        chosen = np.flatnonzero(self.stop[:count] > low)
        begin = np.maximum(self.first[chosen], low).astype(np.int64)
        crossed = np.minimum(self.stop[chosen], high) - begin
        each = np.repeat(chosen, crossed)
        row = np.arange(len(each)) + np.repeat(begin - np.cumsum(crossed) + crossed, crossed)
        column = np.clip(self._columns(each, row), 0, self.sheet.width)
        return _filled(row - low, column, self.down[each], high - low, self.sheet.width)

    def _columns(self, edge: Whole, row: Whole) -> Whole:
        """Return the first column whose centre is not left of an edge, for a row that this crosses.

        The centre of row r lies (2 r + 1) · py / sy steps down. With t = (2 r + 1) · py − y · sy the edge is
        there at x + t · dx / (dy · sy), and column c is not left of it where (2 c + 1) · px / sx is no less.
        """
        px, sx = self.sheet.across.as_integer_ratio()
        py, sy = self.sheet.down.as_integer_ratio()
        x, y, dx, dy = (each[edge].astype(np.int64) for each in (self.x, self.y, self.dx, self.dy))
        along, rest = np.divmod(((2 * row + 1) * py - y * sy) * dx, dy)
        place = (x * sy + along) * sx - (-(rest * sx) // dy)
        return np.asarray(-((px * sy - place) // (2 * px * sy)), np.int64)


_NONE = [*[np.empty(0, np.int32)] * 6, np.empty(0, bool)]


def _crossing(piece: Outlines, sheet: Sheet) -> list[NDArray[np.generic]]:
    """Return the edges of a piece that cross rows, as the fields of :class:`_Edges` in their order."""
    from_x, from_y = piece.points[:, 0] - sheet.left, sheet.top - piece.points[:, 1]
    after = np.arange(1, len(piece.points) + 1)
    filled = piece.rings[1:] > piece.rings[:-1]
    after[piece.rings[1:][filled] - 1] = piece.rings[:-1][filled]
    half, scale = sheet.down.as_integer_ratio()
    rows = np.clip(-((half - from_y * scale) // (2 * half)), 0, sheet.height).astype(np.int32)
    down = rows < rows[after]
    kept = np.flatnonzero(rows != rows[after])
    down = down[kept]
    one, other = np.where(down, kept, after[kept]), np.where(down, after[kept], kept)
    x, y, dx, dy = from_x[one], from_y[one], from_x[other] - from_x[one], from_y[other] - from_y[one]
    _check_sizes(dx, dy, sheet)
    small = np.int32 if max(np.abs(each).max(initial=0) for each in (x, y, dx, dy)) < 2**31 else np.int64
    return [*(each.astype(small) for each in (x, y, dx, dy)), rows[one], rows[other], down]


def _check_sizes(dx: Whole, dy: Whole, sheet: Sheet) -> None:
    """Raise where whole numbers of 64 bits do not hold the crossings of an edge."""
    px, sx = sheet.across.as_integer_ratio()
    py, sy = sheet.down.as_integer_ratio()
    broad = int(np.abs(dx).max(initial=0))
    longest = broad * (int(dy.max(initial=0)) * sy + 2 * py)
    if max(longest, (2 * px * sheet.width + sx * broad) * sy * 4) > MOST:
        raise UnsupportedByFormatError("a plate with edges too long for its pixels: show less cloth")


def _filled(row: Whole, column: Whole, down: NDArray[np.bool_], rows: int, width: int) -> Bits:
    """Return the pixels between crossings, each given by its row, its column and how the edge runs."""
    stride = width // 8 + 1
    # The direction stands in the last bit: to sort numbers is faster than to sort their order.
    sorted_ = np.sort(((row * stride * 8 + column) << 1) | down)
    place = sorted_ >> 1
    inside = np.cumsum(np.where(sorted_ & 1, 1, -1)) != 0
    # What ends where the next begins, or begins and ends at one place, changes nothing.
    changes = place[inside != np.concatenate([[False], inside[:-1]])]
    alone, times = np.unique(changes, return_counts=True)
    places = alone[times % 2 == 1]
    bits = np.zeros(rows * stride, np.uint8)
    if len(places):
        byte = places >> 3
        starts = np.flatnonzero(np.concatenate([[True], byte[1:] != byte[:-1]]))
        bits[byte[starts]] = np.bitwise_or.reduceat((128 >> (places & 7)).astype(np.uint8), starts)
    changed = bits.reshape(rows, stride)
    made = _SPREAD[changed]
    made[:, 1:] ^= np.bitwise_xor.accumulate(_LAST[changed], axis=1)[:, :-1]
    return np.ascontiguousarray(made[:, : (width + 7) // 8])
