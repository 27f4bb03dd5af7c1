"""Functions as people write them: called in bulk, and their curves searched for sharp turns."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.fields import given
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen

PROBE = np.array([0.137, 0.285, 0.439, 0.611, 0.853])
"""Where a function is tried, to see what it takes and gives. Five, so that x and y are told from points."""
PIECES = 512
"""Pieces in which corners are looked for: of two in the same one, one is found."""
TURN = 0.02
"""A corner turns by more (radians)."""
HALVINGS = 32
"""Each halves the stretch in which a corner lies; what is left of one in 512 is 5e-13."""
TINY = 1e-12
"""Share of a curve's size below which rounding would decide where it turns; at a cusp it is soon reached."""
PARTS = 27_720
"""What is written by hand has its corners at fractions: those that this number makes whole are meant."""


@frozen
class Called:
    """A function of t called with arrays, whatever it takes and gives: see ``Curve.from_function``."""

    function: Callable[[Any], Any]
    in_bulk: bool

    @staticmethod
    def of(function: Callable[[Any], Any]) -> Called:
        """Return a function, having tried which way it can be called.

        Raises:
            GeometryError: where it gives no points either way.
        """
        given(function, Callable[[Any], Any], "function")
        bulk, single = Called(function, True), Called(function, False)
        try:
            if bulk._tried().shape == (len(PROBE), 2):
                return bulk
        except (TypeError, ValueError):  # math's functions take no arrays, nor does an if
            pass
        try:
            shape = single._tried().shape
        except TypeError as error:
            raise GeometryError(f"the function of t cannot be called with a number: {error}") from error
        if shape != (len(PROBE), 2):
            raise GeometryError("the function of t gives no points, expected x and y, or a complex number")
        return single

    def _tried(self) -> Array:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            return self(PROBE)

    def __call__(self, t: Array) -> Points:
        """Return the points at parameters, shape (n, 2)."""
        if self.in_bulk:
            return _points(self.function(t), len(t))
        found = [np.atleast_2d(_points(self.function(each), 1)) for each in t.tolist()]
        return np.concatenate(found) if found else np.empty((0, 2))


def _points(found: Any, count: int) -> Points:
    """Return what a function gave for ``count`` parameters as points."""
    if isinstance(found, tuple | list) and len(found) == 2 and count != 2:
        # A constant stands for as many.
        x, y = np.broadcast_arrays(*(np.asarray(each) for each in found), np.empty(count))[:2]
        found = np.column_stack([x, y])
    found = np.asarray(found)
    if found.dtype.kind == "c":
        found = np.stack([found.real, found.imag], axis=-1).reshape(-1, 2)
    return np.asarray(found)


def corners_of(at: Callable[[Array], Points]) -> tuple[float, ...]:
    """Return the parameters within (0, 1) where a curve turns sharply, ascending.

    Pieces that turn are halved again and again towards where they turn the most: what still turns there is
    a corner, what no longer does is a bend.
    """
    t = np.linspace(0, 1, PIECES + 1)
    points = at(t)
    size = float(np.ptp(points, axis=0).max())
    suspect = _turn(points) > TURN
    low, high = t[:-2][suspect], t[2:][suspect]
    quarters = np.arange(5) / 4
    done = list[float]()
    for _ in range(HALVINGS):
        inner = low[:, None] + (high - low)[:, None] * quarters
        points = at(inner.ravel()).reshape(-1, 5, 2)
        tiny = np.ptp(points, axis=1).max(axis=1, initial=0.0) < TINY * size
        done += inner[tiny, 2].tolist()
        inner, points = inner[~tiny], points[~tiny]
        turns = np.stack([_turn(points[:, k : k + 3].reshape(-1, 2))[::3] for k in range(3)], axis=1)
        # Of equals the middle one: a corner in the middle stays there to the bit.
        best = (turns + np.array([0, 1e-6, 0])).argmax(axis=1)
        row = np.arange(len(inner))
        sharp = turns[row, best] > TURN
        low, high = inner[row, best][sharp], inner[row, best + 2][sharp]
    found = np.unique([*done, *((low + high) / 2).tolist()])
    whole = np.rint(found * PARTS) / PARTS
    found = np.unique(np.where(np.abs(found - whole) < 1e-9, whole, found))
    found = found[(found > 1e-9) & (found < 1 - 1e-9)]
    apart = np.append(True, np.diff(found) > 1e-9)[: len(found)]
    return tuple(found[apart].tolist())


def _turn(points: Points) -> Array:
    """Return by how much polylines turn at their inner points, in radians; where they rest, not at all."""
    step = np.diff(points, axis=0)
    cross = step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0]
    return np.asarray(np.abs(np.arctan2(cross, (step[:-1] * step[1:]).sum(axis=1))))
