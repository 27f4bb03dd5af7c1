"""What a curve is, and what it must give when it is asked."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.fields import check
from batik_vector.geometry.sampling import Array, Points


class Curve:
    """A plane curve drawn once by ``at(t)`` for t in [0, 1].

    Curves are frozen dataclasses: comparable values whose fields carry their bounds. A new one
    implements :meth:`at`, and where it has them :meth:`breaks`, :meth:`loops` and :meth:`turns`.

    A ``closed`` curve that ends elsewhere than it begins is closed by a straight edge.
    """

    closed: ClassVar[bool] = True

    def __post_init__(self) -> None:
        check(self)

    def at(self, t: Array) -> Points:
        """Return the points at parameters ``t`` (shape (n,), in [0, 1]) as an array of shape (n, 2)."""
        raise GeometryError(f"{type(self).__name__} says nowhere how it runs: expected a method at(t)")

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


def points_at(curve: Curve, t: Array) -> Points:
    """Return the points of a curve, having seen that they are what :meth:`Curve.at` promises.

    Raises:
        GeometryError: naming the curve's class, where they are not.
    """
    points = _numbers(curve, "at(t)", curve.at(t))
    if points.shape != (len(t), 2):
        raise _fault(
            curve, f"at(t) returns shape {points.shape} for t of shape {t.shape}, expected ({len(t)}, 2)"
        )
    finite = np.isfinite(points).all(axis=1)
    if not finite.all():
        raise _fault(curve, f"at(t) is not finite at t = {t[~finite][0]:g}: it runs through a pole")
    return points


def knots_of(curve: Curve) -> Array:
    """Return the breaks of a curve with 0 and 1 at their ends.

    Raises:
        GeometryError: naming the curve's class, where they do not ascend within (0, 1).
    """
    breaks = _numbers(curve, "breaks()", curve.breaks())
    knots = np.concatenate([[0.0], breaks.ravel(), [1.0]])
    if not (np.diff(knots) > 0).all():
        raise _fault(curve, "its breaks (stops) do not ascend, expected ascending numbers between 0 and 1")
    return knots


def _numbers(curve: Curve, method: str, given: Any) -> Array:
    """Return what a curve's method gives as an array of floats."""
    try:
        found = np.asarray(given)
    except ValueError:
        raise _fault(curve, f"{method} returns rows of different lengths, expected real numbers") from None
    if found.dtype.kind not in "iuf":
        kind = found.dtype if isinstance(given, np.ndarray) else type(given).__name__
        raise _fault(curve, f"{method} returns {kind}, expected an array of real numbers")
    return found.astype(float, copy=False)


def _fault(curve: Curve, words: str) -> GeometryError:
    return GeometryError(f"{type(curve).__name__}: {words}")
