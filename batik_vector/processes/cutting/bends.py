"""How strokes bend from side to side, and which of their points stand for a curve and for no corner."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Outlines, Steps
from batik_vector.processes.cutting.arclength import turn
from batik_vector.values import frozen

COARSEST = math.pi / 3
"""A sharper turn is a corner, however short the sides are that meet there."""
ALIKE = 1.5
"""How many times more one of two points that follow one another on a curve may turn than the other."""
FULL = 1 << 20
"""Length in steps of a direction that is told as an angle."""


@frozen(eq=False)
class Bends:
    """At each point the side that leads to it, the side that leads on, and the angle between, in radians.

    ``begins`` says where a stroke begins: what leads there is the last side of the stroke before.
    """

    into: Steps
    out: Steps
    angles: NDArray[np.float64]
    begins: NDArray[np.bool_]

    def curved(self, corner: float, sag: float) -> NDArray[np.bool_]:
        """Return which points stand for a curve.

        Args:
            corner: from how many radians on a bend is a corner, if no bend beside it is like it.
            sag: how far a curve may be from the sides that stand for it, in steps.
        """
        near = np.round(self._sags(), 3) <= sag
        return near & ~self.begins & ((np.abs(self.angles) < corner) | self._coarse())

    def _sags(self) -> NDArray[np.float64]:
        """Return how far the sides at each point stray from arcs that turn with them, in steps."""
        side = np.sqrt(np.asarray(self.out[:, 0] * self.out[:, 0] + self.out[:, 1] * self.out[:, 1], float))
        return np.asarray(np.maximum(side, np.roll(side, 1)) / 2 * np.tan(np.abs(self.angles) / 4))

    def _coarse(self) -> NDArray[np.bool_]:
        """Return which points are those of a coarse curve: the one before or behind turns about as much."""
        one, two = self.angles[:-1], self.angles[1:]
        least, most = np.minimum(one, two), np.maximum(one, two)
        alike = np.where(least > 0, most <= ALIKE * least, (most < 0) & (least >= ALIKE * most))
        found = np.zeros(len(self.angles), bool)
        found[1:] |= alike
        found[:-1] |= alike
        return found & (np.abs(self.angles) < COARSEST)


def bends_of(strokes: Outlines, heading: float) -> Bends:
    """Return how strokes bend.

    Args:
        strokes: open polylines, without points that repeat the one before.
        heading: the direction that leads to the first of them, in radians.
    """
    last = strokes.rings[1:] - 1
    out = np.zeros_like(strokes.points)
    out[:-1] = strokes.points[1:] - strokes.points[:-1]
    out[last] = out[np.maximum(last - 1, 0)]
    into = np.roll(out, 1, axis=0)
    into[strokes.rings[1:-1]] = out[last[:-1]]
    into[0] = np.rint([FULL * math.cos(heading), FULL * math.sin(heading)]).astype(np.int64)
    begins = np.zeros(len(out), bool)
    begins[strokes.rings[:-1]] = True
    return Bends(into, out, turn(into, out), begins)


def halved(strokes: Outlines, curved: NDArray[np.bool_]) -> tuple[Outlines, NDArray[np.bool_]]:
    """Return strokes with a point in the middle of each side that ends on a curve, and what is curved.

    Args:
        strokes: open polylines.
        curved: shape (n,), which of their points stand for a curve.
    """
    side = curved.copy()
    side[:-1] |= curved[1:]
    side[strokes.rings[1:] - 1] = False
    at = np.flatnonzero(side)
    middle = (strokes.points[at] + strokes.points[at + 1]) // 2
    fresh = (middle != strokes.points[at]).any(axis=1)
    at, middle = at[fresh], middle[fresh]
    points = np.insert(strokes.points, at + 1, middle, axis=0)
    rings = strokes.rings + np.searchsorted(at, strokes.rings)
    return replace(strokes, points=points, rings=rings), np.insert(curved, at + 1, False)
