"""What a curve is, and how one is traced."""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar

import numpy as np

from batik_vector.fields import check
from batik_vector.geometry.sampling import REFINE_SHARE, Array, Indices, Points, refine, thin
from batik_vector.values import frozen

LEAST_CORNERS = 6
"""Vertices that a ring keeps however coarse the tolerance."""


class Curve:
    """A plane curve drawn once by ``at(t)`` for t in [0, 1].

    Curves are frozen dataclasses: comparable values whose fields carry their bounds. A new one
    implements :meth:`at`, and where it has them :meth:`breaks`, :meth:`loops` and :meth:`turns`.
    """

    closed: ClassVar[bool] = True

    def __post_init__(self) -> None:
        check(self)

    def at(self, t: Array) -> Points:
        """Return the points at parameters ``t`` (shape (n,), in [0, 1]) as an array of shape (n, 2)."""
        raise NotImplementedError

    def breaks(self) -> Array:
        """Return the parameters where sampling must stop: cusps, corners, poles of the parametrisation.

        Ascending, in (0, 1); 0 and 1 are always breaks. Between two of them the curve is smooth.
        """
        return np.empty(0)

    def loops(self) -> list[tuple[float, float]]:
        """Return the parameter intervals of the rings that bound the curve's region.

        The intervals begin and end at breaks. Most curves are one ring; a rose is one per petal.
        """
        return [(0.0, 1.0)] if self.closed else []

    def turns(self) -> Array:
        """Return the angles (radians) at which the traced curve is drawn to make the whole figure."""
        return np.zeros(1)


@frozen
class Trace:
    """A curve as polylines: ``strands`` draw it, ``rings`` bound its region; both use the same vertices.

    Every strand and ring has shape (n, 2); closed ones repeat their first point at the end.
    """

    strands: list[Points]
    rings: list[Points]


def trace(curve: Curve, tolerance: float | Callable[[Points], Array]) -> Trace:
    """Sample a curve so that no chord stands farther from it than the tolerance.

    Args:
        curve: the curve, in its own units.
        tolerance: in the curve's units; or a function of points giving it place by place, for curves
            that a map will stretch unevenly (the vertices are then left dense, to be thinned in the
            image).

    Returns:
        The strands and rings, one set for every one of the curve's turns.
    """
    t, points = _sample(curve, tolerance)
    if curve.closed:
        points[-1] = points[0]
    strands, rings = [], []
    for angle in curve.turns():
        turned = points if angle == 0 else points @ _rotation(float(angle)).T
        strands.append(turned)
        for begin, stop in curve.loops():
            i, j = np.searchsorted(t, [begin - 1e-12, stop - 1e-12])
            ring = turned[i : j + 1]
            rings.append(ring if np.array_equal(ring[0], ring[-1]) else np.vstack([ring, ring[:1]]))
    return Trace(strands, rings)


def _sample(curve: Curve, tolerance: float | Callable[[Points], Array]) -> tuple[Array, Points]:
    knots = np.concatenate([[0.0], curve.breaks(), [1.0]])
    # A few pieces to begin with between breaks, so that no bump hides between the probes.
    starts = _subdivide(knots, 8 if len(knots) > 8 else 32)

    def evaluate(_: Indices, t: Array) -> Points:
        return curve.at(t)

    fine = tolerance if callable(tolerance) else tolerance * REFINE_SHARE
    _, t = refine(evaluate, np.zeros(len(starts) - 1, np.intp), starts[:-1], starts[1:], fine)
    t = np.append(t, 1.0)
    points = curve.at(t)
    if callable(tolerance):
        return t, points
    given = np.zeros(len(t), bool)
    given[np.searchsorted(t, knots)] = True
    keep = thin(points, np.array([0, len(points)], np.intp), tolerance * (1 - REFINE_SHARE), given)
    for begin, stop in curve.loops():
        i, j = np.searchsorted(t, [begin - 1e-12, stop - 1e-12])
        if keep[i : j + 1].sum() <= LEAST_CORNERS:
            # So small, or the tolerance so coarse, that the ring would be a sliver: it keeps a shape.
            keep[np.linspace(i, j, LEAST_CORNERS + 1).round().astype(np.intp)] = True
    return t[keep], points[keep]


def _subdivide(knots: Array, parts: int) -> Array:
    inner = knots[:-1, None] + np.diff(knots)[:, None] * np.arange(parts) / parts
    return np.append(inner.ravel(), knots[-1])


def _rotation(angle: float) -> Points:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])
