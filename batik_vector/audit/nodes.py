"""Nodes: stretches of path on which they follow closer on one another than a machine can take."""

from __future__ import annotations

import numpy as np

from batik_vector.audit.contours import Contours, Floats
from batik_vector.geometry.outlines import Index
from batik_vector.values import frozen

RUN = 16
"""Nodes in a row that are looked at together: controllers look some 16 moves ahead, so fewer do no harm."""


@frozen(eq=False)
class Dense:
    """Paths with too many nodes: which, how many to a step where they are densest, and where that is."""

    contour: Index
    density: Floats
    at: Floats


def dense(contours: Contours, ends: Floats, most: float) -> Dense:
    """Return the paths with more than so many nodes to a step, over ``RUN`` nodes in a row."""
    step = ends - contours.points
    travel = np.concatenate([[0.0], np.cumsum(np.hypot(*step.T))])
    if len(travel) <= RUN:
        return Dense(np.empty(0, np.intp), np.empty(0), np.empty((0, 2)))
    contour = contours.of_point
    first = np.flatnonzero(contour[: 1 - RUN] == contour[RUN - 1 :])
    # Between so many nodes lie as many edges less one.
    density = (RUN - 1) / np.maximum(travel[first + RUN - 1] - travel[first], 1e-9)
    first, density = first[density > most], density[density > most]
    order = np.lexsort((first, -density, contour[first]))
    best = order[np.append(True, np.diff(contour[first[order]]) != 0)] if len(order) else order
    rows = first[best]
    return Dense(contour[rows], density[best], contours.points[rows + RUN // 2])
