"""A page as the polylines of pens, for programs that know pens and no areas."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Ink, Page
from batik_vector.export.walk import GUIDE_PEN, Order, Outlines, walk
from batik_vector.units import STEPS_PER_MM


@dataclass
class Pen:
    """A pen, and the polylines that it draws.

    Each line is of shape (n, 2), in mm from the page's upper left corner, y down; a closed one ends where it
    begins.
    """

    number: int
    ink: Ink
    lines: list[NDArray[np.float64]] = field(default_factory=list)


def pens_of(page: Page) -> list[Pen]:
    """Return the pens of a page in the order of its layers, without guides, which no pen draws.

    Raises:
        ExportError: where a coordinate is not finite or out of range.
    """
    surface = _PenSurface()
    walk(page, surface, Order.GIVEN)
    return surface.pens


class _PenSurface:
    """Gathers the lines and the outlines of areas of each pen."""

    def __init__(self) -> None:
        self.pens: list[Pen] = []
        self._drawn = False

    def begin(self, page: Page) -> None:
        self._left, self._top = -page.margins.left, page.cell.rows + page.margins.top

    def ink(self, ink: Ink, pen: int) -> None:
        self._drawn = pen != GUIDE_PEN
        if self._drawn:
            self.pens.append(Pen(pen, ink))

    def areas(self, outlines: Outlines) -> None:
        self.lines(outlines)

    def lines(self, outlines: Outlines) -> None:
        if not self._drawn:
            return
        points, rings = outlines.flipped(self._top, -self._left).repeating()
        self.pens[-1].lines += np.split(points / STEPS_PER_MM, rings[1:-1])

    def end(self) -> None:
        pass
