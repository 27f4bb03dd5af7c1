"""Selvedge lines, trim marks and calibration bars: outside the drawing, on a layer that plotters skip.

Distances are in mm on cloth, the printed area's lower left corner at (0, 0).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Ink, Margins
from batik_vector.geometry.outlines import MM, Outlines, of_polylines
from batik_vector.units import to_steps
from batik_vector.values import frozen

CLEAR = 2.0
"""Between the drawing's bleed and the nearest mark."""
ARM = 10.0
"""Length of a trim mark, and breadth of a registration cross."""
TICK = 5.0
BAR = 100.0
"""The calibration bar: who measures it knows whether the file came out at its size."""
PART = 10.0
STROKE = 4.0
"""Height of the strokes at the ends of the bar."""


def guide_ink(cloth: str) -> Ink:
    """Return the ink of the marks, black or white, whichever shows on a cloth of a colour on screen."""
    figures = cloth[1:] if len(cloth) == 7 else "".join(2 * figure for figure in cloth[1:])
    red, green, blue = (int(figures[at : at + 2], 16) for at in (0, 2, 4))
    # Brightness after ITU-R BT.601.
    dark = 0.299 * red + 0.587 * green + 0.114 * blue < 128
    return Ink("marks", "#ffffff" if dark else "#000000", 0.2)


@frozen
class Guides:
    """What the marks go by, in mm.

    ``width`` and ``height`` are of the printed area, ``bleed`` how far the drawing reaches beyond it,
    ``selvedge`` how much bare cloth is left and right of it. Repeats begin at the ordinates ``first`` +
    k · ``repeat``.
    """

    width: float
    height: float
    bleed: float
    selvedge: float
    first: float
    repeat: float

    @property
    def start(self) -> float:
        """How far from the printed area marks begin."""
        return self.bleed + CLEAR

    def margins(self) -> Margins:
        """Return how far the page reaches beyond the printed area to hold marks and selvedges."""
        outside = self.start + ARM + CLEAR
        side = to_steps(max(outside, self.selvedge + CLEAR))
        # The bar is left of nothing narrower than itself.
        right = to_steps(max(side / MM, self.start + BAR + 2 * CLEAR - self.width))
        below = outside if self._beside else outside + STROKE + CLEAR
        return Margins(side, to_steps(below), right, to_steps(outside))

    @property
    def _beside(self) -> bool:
        """Whether the bar lies between the trim marks and crosses at both corners, or on a row below them."""
        return self.width >= self.start + BAR + 2 * CLEAR

    def outlines(self) -> Outlines:
        """Return all marks as lines, in steps."""
        parts = [
            ("trim", self._trim()),
            ("cut", self._cut()),
            ("cross", self._crosses()),
            ("repeat", self._ticks()),
            ("bar", self._bar()),
        ]
        lines = [(name, line) for name, found in parts for line in found]
        ends = np.array([line for _, line in lines])
        return replace(
            of_polylines(np.asarray(shapely.linestrings(ends), dtype=object), MM),
            names=[f"marks.{name}" for name, _ in lines],
        )

    def _trim(self) -> Iterator[NDArray[np.float64]]:
        """Yield two lines at each corner that go on where the printed area's edges end."""
        for x, out in ((0.0, -1), (self.width, 1)):
            for y, up in ((0.0, -1), (self.height, 1)):
                near, far = self.start, self.start + ARM
                yield np.array([(x + out * near, y), (x + out * far, y)])
                yield np.array([(x, y + up * near), (x, y + up * far)])

    def _cut(self) -> Iterator[NDArray[np.float64]]:
        """Yield the cloth's own edges, where it has selvedges and these clear the bleed."""
        if self.selvedge > self.bleed:
            for x in (-self.selvedge, self.width + self.selvedge):
                yield np.array([(x, 0.0), (x, self.height)])

    def _crosses(self) -> Iterator[NDArray[np.float64]]:
        """Yield a cross outside each corner."""
        away, half = self.start + ARM / 2, ARM / 2 - CLEAR / 2
        for x in (-away, self.width + away):
            for y in (-away, self.height + away):
                yield np.array([(x - half, y), (x + half, y)])
                yield np.array([(x, y - half), (x, y + half)])

    def _ticks(self) -> Iterator[NDArray[np.float64]]:
        """Yield a tick left and right at each ordinate where a repeat begins."""
        for y in self.first + self.repeat * np.arange(self._count()):
            yield np.array([(-self.start, y), (-self.start - TICK, y)])
            yield np.array([(self.width + self.start, y), (self.width + self.start + TICK, y)])

    def _count(self) -> int:
        return max(int((self.height - self.first + 1e-9) // self.repeat) + 1, 0)

    def _bar(self) -> Iterator[NDArray[np.float64]]:
        """Yield a bar of 100 mm below the printed area, with a stroke at every 10 mm."""
        x, y = self.start + CLEAR, -self.start - (ARM / 2 if self._beside else ARM + CLEAR + STROKE / 2)
        yield np.array([(x, y), (x + BAR, y)])
        for part in range(int(BAR / PART) + 1):
            half = STROKE / 2 if part in (0, int(BAR / PART)) else STROKE / 4
            yield np.array([(x + part * PART, y - half), (x + part * PART, y + half)])
