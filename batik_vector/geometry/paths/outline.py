"""An outline: subpaths of lines and cubic Béziers, as path data draw them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.paths.cubics import bernstein, turns_of
from batik_vector.geometry.paths.matrix import Matrix, moved
from batik_vector.geometry.sampling import Points
from batik_vector.values import frozen

MOVE, LINE, CONTROL, CURVE = range(4)
"""What a point is: where a subpath begins, the end of a line, a handle, the end of a cubic Bézier, whose
two handles stand before it."""


@frozen(eq=False)
class Outline:
    """Subpaths: ``points`` of shape (n, 2), ``kinds`` of shape (n,), ``closed`` of one for each MOVE."""

    points: Points
    kinds: NDArray[np.uint8]
    closed: NDArray[np.bool_]

    def moved(self, matrix: Matrix) -> Outline:
        """Return the outline under an affine map."""
        return replace(self, points=moved(self.points, matrix))


EMPTY = Outline(np.empty((0, 2)), np.empty(0, np.uint8), np.empty(0, bool))


def polyline(points: Points, closed: bool) -> Outline:
    """Return points, shape (n, 2), joined by lines."""
    if len(points) < 2:
        return EMPTY
    kinds = np.full(len(points), LINE, np.uint8)
    kinds[0] = MOVE
    return Outline(points, kinds, np.array([closed]))


def bounds_of(outline: Outline) -> tuple[float, float, float, float]:
    """Return how far an outline reaches: left, lower, right and upper bound in its own units."""
    end = np.flatnonzero(outline.kinds == CURVE)
    control = outline.points[end[:, None] + np.array([-3, -2, -1, 0])]
    plain = outline.points[outline.kinds != CONTROL]
    reached = []
    for axis in (0, 1):
        curved = control[:, :, axis]
        turns = bernstein(curved[:, None, :], turns_of(curved))
        reached.append(np.concatenate([plain[:, axis], turns.ravel()]))
    x, y = reached
    return float(x.min()), float(y.min()), float(x.max()), float(y.max())


def box(x: float, y: float, width: float, height: float) -> Outline:
    """Return an upright rectangle."""
    return polyline(np.array([[x, y], [x + width, y], [x + width, y + height], [x, y + height]]), True)


def joined(outlines: Sequence[Outline]) -> Outline:
    """Return several outlines as one."""
    if not outlines:
        return EMPTY
    return Outline(
        np.concatenate([each.points for each in outlines]),
        np.concatenate([each.kinds for each in outlines]),
        np.concatenate([each.closed for each in outlines]),
    )
