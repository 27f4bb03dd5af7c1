"""What a curve is, and what it must give when it is asked."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, ClassVar, Literal

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.fields import check, given
from batik_vector.geometry.curves.function import Called, corners_of
from batik_vector.geometry.paths.data import path_of
from batik_vector.geometry.paths.outline import CURVE, LINE, MOVE, Outline
from batik_vector.geometry.paths.splines import through
from batik_vector.geometry.sampling import Array, Geometries, Points
from batik_vector.values import frozen


class Curve:
    """A plane curve drawn once by ``at(t)`` for t in [0, 1].

    Curves are frozen dataclasses: comparable values whose fields carry their bounds. A new one
    implements :meth:`at`, and where it has them :meth:`breaks`, :meth:`arcs`, :meth:`loops` and
    :meth:`turns`; or :meth:`outline`. Who has a function, points or a path needs no class:
    :meth:`from_function`, :meth:`from_points` and :meth:`from_path` make a curve of it.

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

    def arcs(self) -> int:
        """Return into how many arcs between breaks, equally long in t, it falls that are the first, turned.

        How the first is sampled, all are.
        """
        return 1

    def loops(self) -> list[tuple[float, float]]:
        """Return the parameter intervals of the rings that bound the curve's region.

        The intervals begin and end at breaks. Most curves are one ring; a rose is one per petal.
        """
        return [(0.0, 1.0)] if self.closed else []

    def turns(self) -> Array:
        """Return the angles (radians) at which the traced curve is drawn to make the whole figure."""
        return np.zeros(1)

    def outline(self) -> Outline | None:
        """Return the curve as lines and cubic Béziers, if it is made of them; it is then traced as such."""
        return None

    def region(self, tolerance: float) -> Geometries | None:
        """Return the curve's region as valid polygons, where it is known without settling any rings.

        It is then traced as their outlines, to the tolerance (the curve's units).
        """
        return None

    @staticmethod
    def from_function(
        function: Callable[[Any], Any],
        *,
        closed: bool | None = None,
        corners: Sequence[float] | None = None,
    ) -> Curve:
        """Return the curve of a function of t, which runs over [0, 1] and draws it once.

        Args:
            function: takes an array of parameters, shape (n,), and returns x and y (two arrays, or one of
                shape (n, 2)) or complex numbers x + iy; or takes one number and returns two, or a complex
                one, which is slower.
            closed: whether it bounds a region; left out, it does where it ends in the point it began in.
            corners: the parameters in (0, 1) where it turns sharply; left out, they are looked for.

        Raises:
            GeometryError: where the function gives anything else.
        """
        at = Called.of(function)
        closed = given(closed, bool | None, "closed")
        corners = corners_of(at) if corners is None else given(corners, tuple[float, ...], "corners")
        if closed is None:
            ends = at(np.array([0.0, 0.5, 1.0]))
            closed = bool(np.abs(ends[2] - ends[0]).max() <= MEET * np.abs(ends).max())
        return FunctionCurve(at, tuple(corners), closed)

    @staticmethod
    def from_points(
        points: Any, *, smooth: bool = False, closed: bool = True, corners: Sequence[int] = ()
    ) -> Curve:
        """Return the curve through points, shape (n, 2): straight from each to the next, or smooth.

        A smooth one is a cubic spline (see :mod:`~batik_vector.geometry.paths.splines`) that turns sharply at
        the points numbered in ``corners`` alone.

        Raises:
            GeometryError: for points that are not finite, too few of them, and corners that are none.
        """
        smooth, closed = given(smooth, bool, "smooth"), given(closed, bool, "closed")
        return OutlineCurve(through(points, smooth, closed, given(corners, tuple[int, ...], "corners")))

    @staticmethod
    def from_path(d: str, *, y: str = "down", centre: tuple[float, float] = (0.0, 0.0)) -> Curve:
        """Return what SVG path data draw; ``centre`` is the point of theirs that becomes the origin.

        Args:
            d: such as ``"M0 0C1 0 1 1 0 1Z"``; subpaths are one curve, the fill rule makes holes.
            y: ``"down"``, as SVG has it, or ``"up"``.
            centre: as the data have it.

        Raises:
            GeometryError: where they are no path data, or draw nothing.
        """
        d, y = given(d, str, "d"), given(y, Literal["down", "up"], "y")
        return OutlineCurve(path_of(d, y == "up", given(centre, tuple[float, float], "centre")))


MEET = 1e-6
"""A function that ends this near to where it began, as a share of its size, is closed."""


@frozen
class FunctionCurve(Curve):
    """A curve whose points at t in [0, 1] a function returns, shape (n, 2).

    ``stops`` are the parameters of its corners and cusps, ascending, in (0, 1). A closed curve ends
    where it begins. :meth:`Curve.from_function` finds out both, and takes more functions.
    """

    function: Callable[[Array], Points]
    stops: tuple[float, ...] = ()
    closed: bool = True  # type: ignore[misc]

    def at(self, t: Array) -> Points:
        """Return the points at ``t``."""
        return self.function(t)

    def breaks(self) -> Array:
        """The stops given."""
        return np.array(self.stops, float)


class Outlined(Curve):
    """A curve that is an outline: lines and cubic Béziers, in one subpath or several, each closed or open.

    Its parameter gives every line and every cubic as much as any other. ``closed`` says whether all its
    subpaths are.
    """

    def outline(self) -> Outline:
        """Return the outline."""
        raise NotImplementedError

    @property
    def closed(self) -> bool:  # type: ignore[override]
        """Whether every subpath is closed."""
        return bool(self.outline().closed.all())

    def at(self, t: Array) -> Points:
        """Return the points at ``t``."""
        return self.outline().shut().at(t)

    def breaks(self) -> Array:
        """Where lines and cubics meet."""
        kinds = self.outline().shut().kinds
        pieces = int(((kinds == LINE) | (kinds == CURVE)).sum())
        return np.arange(1, pieces) / pieces

    def loops(self) -> list[tuple[float, float]]:
        """One for each closed subpath."""
        shut = self.outline().shut()
        ends = np.cumsum((shut.kinds == LINE) | (shut.kinds == CURVE))
        begins = np.flatnonzero(shut.kinds == MOVE)
        edges = np.append(ends[begins], ends[-1]) / ends[-1]
        return [(float(edges[i]), float(edges[i + 1])) for i in np.flatnonzero(shut.closed)]


@frozen
class OutlineCurve(Outlined):
    """A curve from an outline that is at hand."""

    subpaths: Outline

    def outline(self) -> Outline:
        """Return the outline."""
        return self.subpaths


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
    # What is not finite makes no finite sum; NumPy takes ten times as long for each point.
    if not math.isfinite(points.sum()) and not (finite := np.isfinite(points).all(axis=1)).all():
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
