"""Edges of contours, each with what comes before and after it."""

from __future__ import annotations

import numpy as np

from batik_vector.audit.contours import Contours, Floats, Mask
from batik_vector.geometry.outlines import Index
from batik_vector.values import frozen


@frozen(eq=False)
class Edges:
    """Edges of contours, from ``begin`` to ``end``, shape (n, 2); -1 where none is ``before`` or ``after``.

    ``contour`` and ``travel`` say on which contour each begins, and how far along it, in steps. ``idle``
    ones are no edges: the points at which lines end.
    """

    begin: Floats
    end: Floats
    before: Index
    after: Index
    contour: Index
    travel: Floats
    idle: Mask


def edges_of(contours: Contours, ends: Floats) -> Edges:
    """Return the edges of contours, named by the points that they leave."""
    after = contours.after
    before = np.full(len(after), -1)
    some = np.flatnonzero(after >= 0)
    before[after[some]] = some
    step = ends - contours.points
    length = np.hypot(step[:, 0], step[:, 1])
    # The last point of a line leaves no edge.
    goes_on = np.append(after, -1)[after] >= 0
    after = np.where((after >= 0) & (goes_on | contours.closed[contours.of_point]), after, -1)
    travel = np.cumsum(length) - length
    of_point = contours.of_point
    travel -= travel[contours.starts[:-1]][of_point]
    return Edges(contours.points, ends, before, after, of_point, travel, contours.after < 0)
