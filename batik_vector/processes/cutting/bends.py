"""How strokes bend from side to side, and which of their points stand for a curve and for no corner."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Outlines, Steps
from batik_vector.processes.cutting.arclength import turn
from batik_vector.values import frozen

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

    def curved(self, corner: float, sag: float, radius: float) -> NDArray[np.bool_]:
        """Return which points stand for a curve.

        Args:
            corner: from how many radians on a bend is a corner.
            sag: how far a curve may be from the sides that stand for it, in steps.
            radius: of the narrowest curve, in steps.
        """
        side = np.sqrt(np.asarray(self.out[:, 0] * self.out[:, 0] + self.out[:, 1] * self.out[:, 1], float))
        other, bent = np.roll(side, 1), np.abs(self.angles)
        near = np.round(np.maximum(side, other) / 2 * np.tan(bent / 4), 3) <= sag
        near &= np.minimum(side, other) >= np.round(radius * bent, 3)
        return np.asarray(near & ~self.begins & (bent < corner))


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
