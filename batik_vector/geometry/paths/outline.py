"""An outline: subpaths of lines and cubic Béziers, as path data draw them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.paths.cubics import bernstein, evaluated, turns_of
from batik_vector.geometry.paths.matrix import Matrix, moved
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen

MOVE, LINE, CONTROL, CURVE = range(4)
"""What a point is: where a subpath begins, the end of a line, a handle, the end of a cubic Bézier, whose
two handles stand before it."""

JOINED = 1e-9
"""Ends of a closed subpath this near to one another, as a share of the outline's size, are one point."""


@frozen(eq=False)
class Outline:
    """Subpaths: ``points`` of shape (n, 2), ``kinds`` of shape (n,), ``closed`` of one for each MOVE.

    Outlines of the same numbers are equal, so that curves may hold them as values.
    """

    points: Points
    kinds: NDArray[np.uint8]
    closed: NDArray[np.bool_]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Outline) and self._bytes == other._bytes

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _bytes(self) -> tuple[bytes, bytes, bytes]:
        return self.points.tobytes(), self.kinds.tobytes(), self.closed.tobytes()

    @cached_property
    def _hash(self) -> int:
        return hash(self._bytes)

    def moved(self, matrix: Matrix) -> Outline:
        """Return the outline under an affine map."""
        return Outline(moved(self.points, matrix), self.kinds, self.closed)

    def at(self, t: Array) -> Points:
        """Return the points at ``t`` in [0, 1]: as much of it for each line and each cubic in turn.

        Where a subpath ends, the next one begins.
        """
        end = np.flatnonzero((self.kinds == LINE) | (self.kinds == CURVE))
        step = t * len(end)
        whole = np.rint(step)
        step = np.where(np.abs(step - whole) < 1e-12 * len(end), whole, step)
        number = np.minimum(np.floor(step).astype(np.intp), len(end) - 1)
        part, node = step - number, end[number]
        start = self.points[np.where(self.kinds[node] == CURVE, node - 3, node - 1)]
        places = start * (1 - part[:, None]) + self.points[node] * part[:, None]
        bent = self.kinds[node] == CURVE
        control = self.points[node[bent, None] + np.array([-3, -2, -1, 0])]
        places[bent] = evaluated(control, part[bent])
        return np.asarray(places)

    def shut(self, reach: float = 0.0) -> Outline:
        """Return the outline with closed subpaths that end where they begin, by a line if need be.

        Ends nearer to one another than ``reach``, or than a part in 10⁹ of the outline's size, are one point.
        """
        first = np.flatnonzero(self.kinds == MOVE)
        last = np.append(first[1:], len(self.kinds)) - 1
        first, last = first[self.closed], last[self.closed]
        side = max((float(np.ptp(column)) for column in self.points.T if len(column)), default=0.0)
        reach = max(JOINED * side, reach)
        gap = self.points[last] - self.points[first]
        near = np.hypot(gap[:, 0], gap[:, 1]) <= reach
        points = self.points.copy()
        points[last[near]] = points[first[near]]
        apart = last[~near] + 1
        if not len(apart):
            return replace(self, points=points)
        kinds = np.insert(self.kinds, apart, LINE)
        return Outline(np.insert(points, apart, points[first[~near]], axis=0), kinds, self.closed)


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
    (left, right), (low, high) = (_reach(outline.kinds, column) for column in outline.points.T)
    return left, low, right, high


def _reach(kinds: NDArray[np.uint8], at: Array) -> tuple[float, float]:
    """Return how far an outline reaches along an axis, on which its points lie at such places."""
    plain = at[kinds != CONTROL]
    low, high = plain.min(), plain.max()
    # A curve reaches no further than its handles.
    beyond = np.flatnonzero((at < low) | (at > high))
    if len(beyond):
        # Behind a handle the end of its curve is the first point that is none.
        last = np.where(kinds[beyond + 1] == CURVE, beyond + 1, beyond + 2)
        curved = at[last[:, None] + np.array([-3, -2, -1, 0])]
        turns = bernstein(curved[:, None, :], turns_of(curved))
        low, high = turns.min(initial=low), turns.max(initial=high)
    return float(low), float(high)


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
