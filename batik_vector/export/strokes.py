"""Outlines as a pen draws them: move, line, curve. Curves are fitted on demand."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Page
from batik_vector.geometry.outlines import Offsets, Outlines, Steps
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

Trim: TypeAlias = tuple[int, int, int, int]
"""Left, lower, right and upper edge of the trimmed page, in the steps of the outlines."""

MOVE, LINE, CONTROL, PULL, CURVE = range(5)
"""What a point is: where a ring begins, the end of a line, and the three points of a cubic Bézier."""


def trim_of(page: Page, below: int) -> Trim:
    """Return the trim of a page whose lower edge, as the outlines have it, lies ``below`` the trim's."""
    left, cell = page.margins.left, page.cell
    return left, below, left + cell.columns, below + cell.rows


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


def curved(outlines: Outlines, tolerance: float, trim: Trim) -> Strokes:
    """Return outlines drawn with cubic Béziers that stay within a tolerance (mm) of them.

    A curve keeps a node wherever it meets the trim, since its other half stands on the opposite edge.
    """
    from batik_vector.geometry.bezier import fit_cubics

    around, ends = outlines.repeating()
    left, low, right, top = (edge / STEPS_PER_MM for edge in trim)
    edges = (left, right), (low, top)
    cubics = fit_cubics(around / STEPS_PER_MM, ends, outlines.closed, tolerance, edges)
    control = np.rint(np.asarray(cubics.points) * STEPS_PER_MM).astype(np.int64)
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


def strokes(outlines: Outlines, tolerance: float | None, trim: Trim) -> Strokes:
    """Return outlines as lines, or as curves within a tolerance where one is given."""
    return straight(outlines) if tolerance is None else curved(outlines, tolerance, trim)
