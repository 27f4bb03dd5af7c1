"""Outlines as a pen draws them: move, line, curve. Curves are fitted on demand."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Page
from batik_vector.geometry.outlines import Offsets, Outlines, Steps
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.geometry.continuations import Edges
    from batik_vector.geometry.inside import Box
    from batik_vector.geometry.known import Known

PATH_POINTS = 400_000
"""Points in one path at most. A point takes up to 24 characters, and libxml2, which many readers use,
refuses an attribute longer than 10 million."""

MOVE, LINE, CONTROL, PULL, CURVE = range(5)
"""What a point is: where a ring begins, the end of a line, and the three points of a cubic Bézier."""


@frozen
class Strokes:
    """Points in drawing order, each with what it is; offsets as in :class:`Outlines`, over these points."""

    points: Steps
    kinds: NDArray[np.uint8]
    rings: Offsets
    marks: Offsets
    closed: NDArray[np.bool_]

    @property
    def first(self) -> NDArray[np.int64]:
        """Index of each ring's first point."""
        return self.rings[:-1]

    @property
    def last(self) -> NDArray[np.int64]:
        """Index of each ring's last point."""
        return self.rings[1:] - 1


def straight(outlines: Outlines) -> Strokes:
    """Return outlines drawn with lines alone."""
    kinds = np.full(len(outlines.points), LINE, np.uint8)
    kinds[outlines.rings[:-1]] = MOVE
    return Strokes(outlines.points, kinds, outlines.rings, outlines.marks, outlines.closed)


def curved(outlines: Outlines, tolerance: float, edges: Edges, page: Box, known: Known | None) -> Strokes:
    """Return outlines drawn with cubic Béziers that stay within a tolerance (mm) of them.

    Args:
        outlines: in steps from the page's corner.
        tolerance: in mm.
        edges: of the trim, in steps. A curve keeps a node wherever it meets them, since its other half stands
            on the opposite edge.
        page: what curves do not leave, in steps.
        known: what is known of the outlines' points at the trim.
    """
    from batik_vector.geometry.bezier import fit_cubics
    from batik_vector.geometry.inside import kept_inside

    around, ends = outlines.repeating()
    upright, level = (tuple(edge / STEPS_PER_MM for edge in pair) for pair in edges)
    known = None if known is None else known.taken(outlines.repeated())
    cubics = fit_cubics(around / STEPS_PER_MM, ends, outlines.closed, tolerance, (upright, level), known)
    control = np.rint(np.asarray(cubics.points) * STEPS_PER_MM).astype(np.int64)
    control = kept_inside(control, page)
    offsets = np.asarray(cubics.offsets, np.int64)
    count = np.diff(offsets)
    # Each ring starts with its own point; a cubic adds three points, a straight piece one.
    rank = np.r_[0, np.cumsum(count + 1)]
    points = np.zeros((rank[-1], 3, 2), np.int64)
    kinds = np.full((rank[-1], 3), 255, np.uint8)
    begin = rank[:-1]
    piece = np.arange(len(control)) + np.repeat(np.arange(1, len(count) + 1), count)
    points[begin, 2] = outlines.points[outlines.rings[:-1]]
    # A fitted ring begins at a corner, if it has one.
    points[begin[count > 0], 2] = control[offsets[:-1][count > 0], 0]
    kinds[begin, 2] = MOVE
    points[piece] = control[:, 1:]
    kinds[piece] = (CONTROL, PULL, CURVE)
    kinds[piece[np.asarray(cubics.straight, bool)]] = (255, 255, LINE)
    # The line that closes a ring is drawn by closing it.
    end = rank[1:] - 1
    shut = outlines.closed & (kinds[end, 2] == LINE)
    kinds[end[shut], 2] = 255
    used = kinds != 255
    before = np.r_[0, np.cumsum(used.sum(axis=1))]
    return Strokes(points[used], kinds[used], before[rank], outlines.marks, outlines.closed)


def begins_block(drawn: Strokes, before: int, full: int) -> NDArray[np.bool_]:
    """Return which marks begin a block: those in which another ``full`` points are reached.

    Args:
        drawn: the strokes.
        before: how many points of the layer came before them.
        full: points of a block.
    """
    ends = before + drawn.rings[drawn.marks]
    return np.asarray(-(-ends[:-1] // full) * full < ends[1:])


def blocks(fresh: NDArray[np.bool_]) -> Iterator[tuple[int, int]]:
    """Yield the first mark of each block and the one behind its last; a first block may have begun before."""
    cuts = np.flatnonzero(fresh).tolist()
    return pairwise(sorted({0, *cuts, len(fresh)}))


def some(drawn: Strokes, first: int, last: int) -> Strokes:
    """Return the marks from ``first`` to before ``last``."""
    r0, r1 = drawn.marks[first], drawn.marks[last]
    p0, p1 = drawn.rings[r0], drawn.rings[r1]
    return Strokes(
        drawn.points[p0:p1],
        drawn.kinds[p0:p1],
        drawn.rings[r0 : r1 + 1] - p0,
        drawn.marks[first : last + 1] - r0,
        drawn.closed[r0:r1],
    )


def blocks_of(
    drawn: Strokes, before: int, going_on: bool, unfinished: bool
) -> Iterator[tuple[Strokes, bool]]:
    """Yield strokes in blocks of many marks each, and whether a path begins with them.

    Args:
        drawn: the strokes of a piece of a layer.
        before: how many points of the layer came before them.
        going_on: whether the first mark is the rest of the last one before.
        unfinished: whether more of the last mark may come.
    """
    fresh = begins_block(drawn, before, PATH_POINTS)
    if going_on:
        fresh[0] = False
    if unfinished and (len(fresh) > 1 or not going_on):
        fresh[-1] = True
    for first, last in blocks(fresh):
        yield some(drawn, first, last), bool(fresh[first])


class Pen:
    """Draws the outlines of a page: upwards from its lower left corner, or downwards from its upper one."""

    def __init__(self, page: Page, tolerance: float | None, downwards: bool = False) -> None:
        """Take a pen.

        Args:
            page: what is drawn.
            tolerance: of curves, in mm; without one all is drawn with lines.
            downwards: whether y points down.
        """
        self._page, self._tolerance, self._downwards = page, tolerance, downwards
        margins, cell = page.margins, page.cell
        low = margins.top if downwards else margins.bottom
        self._edges = (margins.left, margins.left + cell.columns), (low, low + cell.rows)
        width, height = cell.columns + margins.right, cell.rows + margins.bottom + margins.top
        self._box = 0, 0, margins.left + width, height
        self._layer: tuple[int, str] | None = None

    def strokes(self, outlines: Outlines, number: int, kind: str) -> Strokes:
        """Return outlines as they are drawn.

        Args:
            outlines: of the page, as it gives them.
            number: of their layer.
            kind: ``areas`` or ``lines``.
        """
        placed = self._placed(outlines)
        if self._tolerance is None:
            return straight(placed)
        return curved(placed, self._tolerance, self._edges, self._box, self._known(placed, number, kind))

    def _placed(self, outlines: Outlines) -> Outlines:
        margins = self._page.margins
        if self._downwards:
            return outlines.flipped(self._page.cell.rows + margins.top, margins.left)
        return outlines.moved(margins.left, margins.bottom)

    def _known(self, placed: Outlines, number: int, kind: str) -> Known | None:
        from batik_vector.geometry.continuations import ends_of, known_at, together

        assert self._tolerance is not None
        own = ends_of(placed, self._edges)
        others, shifts = own, np.zeros((1, 2), np.int64)
        # A tile goes on at the opposite edge, and may come in pieces.
        if isinstance(self._page, Artwork) and not self._page.bleed:
            if self._layer != (number, kind):
                pieces = self._page.areas(number) if kind == "areas" else self._page.lines(number)
                self._others = together([ends_of(self._placed(each), self._edges) for each in pieces])
                self._layer = number, kind
            others, shifts = self._others, self._shifts()
        return known_at(own, others, shifts, len(placed.points), self._tolerance)

    def _shifts(self) -> Steps:
        """Return where the tile's neighbours stand, and itself."""
        basis = np.array(self._page.cell.lattice) * (1, -1 if self._downwards else 1)
        return np.asarray(np.array([(i, j) for i in (0, -1, 1) for j in (0, -1, 1)]) @ basis, np.int64)
