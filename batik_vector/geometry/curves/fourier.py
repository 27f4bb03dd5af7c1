"""Fourier descriptors: closed curves as sums of turning arrows."""

from __future__ import annotations

from typing import Annotated, TypeAlias

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Says, check
from batik_vector.geometry.curves.base import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen

Coordinate = Annotated[float, Between(-1e6, 1e6)]
Descriptor: TypeAlias = tuple[
    Annotated[int, Between(-256, 256)],
    Annotated[float, Between(-1e3, 1e3)],
    Annotated[float, Between(-360, 360)],
]
"""Turns per period, length, and degrees at the beginning, of an arrow."""


@frozen(kw_only=True)
class Fourier(Curve):
    """Fourier-descriptor curve z(t) = Σ length·e^(i(turns·t + phase)): arrows that turn, end on end.

    Arrows whose turns differ by multiples of n make a curve of n-fold symmetry. With `points` the arrows are
    those of a closed line through them, and `harmonics` how many turns of these are kept: few are smooth.
    Zahn & Roskies, "Fourier descriptors for plane closed curves" (1972); Hariadi et al., the paper's
    reference 21, makes batik of them.
    """

    arrows: Annotated[tuple[Descriptor, ...], Says("[turns, length, phase°] of each arrow")] = (
        (1, 1.0, 0.0),
        (-5, 0.3, 0.0),
    )
    points: Annotated[
        tuple[tuple[Coordinate, Coordinate], ...], Says("points of a closed line, instead of arrows")
    ] = ()
    harmonics: Annotated[int, Between(1, 256), Says("turns up to which the arrows of points are kept")] = 8

    def __post_init__(self) -> None:
        check(self)
        if self.points and len(self.points) < 3:
            raise GeometryError(f"points = a list of {len(self.points)}, expected 3 or more")
        turns, weights = self._terms()
        if not (np.abs(weights[turns != 0]) > 0).any():
            raise GeometryError("arrows = none that turns: expected one with turns and a length other than 0")

    def _terms(self) -> tuple[Array, np.ndarray[tuple[int, ...], np.dtype[np.complex128]]]:
        if not self.points:
            rows = np.array(self.arrows, float).reshape(-1, 3)
            return rows[:, 0], rows[:, 1] * np.exp(1j * np.radians(rows[:, 2]))
        z = np.array(self.points) @ np.array([1, 1j])
        step = np.roll(z, -1) - z
        length = np.abs(step)
        if not length.sum() > 0:
            raise GeometryError("points = all in one place, expected a line")
        # Exactly, side by side: the integral of a straight side against an arrow.
        after = np.cumsum(length) / length.sum()
        before = after - length / length.sum()
        turns = np.arange(-self.harmonics, self.harmonics + 1)
        weights = np.zeros(len(turns), complex)
        for number, turn in enumerate(turns.tolist()):
            weights[number] = _integral(z, step, before, after, turn)
        return turns.astype(float), weights

    def at(self, t: Array) -> Points:
        """Return the points at ``t``."""
        turns, weights = self._terms()
        z = np.exp(2j * np.pi * np.outer(t, turns)) @ weights
        return np.column_stack([z.real, z.imag])

    def breaks(self) -> Array:
        """Enough starting points that no arrow hides between two of them."""
        turns, _ = self._terms()
        parts = max(8, 4 * int(np.abs(turns).max()))
        return np.arange(1, parts) / parts


def _integral(
    z: np.ndarray[tuple[int, ...], np.dtype[np.complex128]],
    step: np.ndarray[tuple[int, ...], np.dtype[np.complex128]],
    before: Array,
    after: Array,
    turn: int,
) -> complex:
    """Return ∫ z(t)·e^(−2πi·turn·t) dt over a closed line of straight sides, by its length."""
    share = after - before
    moving = share > 0
    z, step = z[moving], step[moving]
    before, after, share = before[moving], after[moving], share[moving]
    if not turn:
        return complex(((z + step / 2) * share).sum())
    w = -2j * np.pi * turn
    first, last = np.exp(w * before), np.exp(w * after)
    slope = step / share
    # By parts: z·e^(wt)/w at the ends, less the slope's share.
    ends = ((z + step) * last - z * first) / w
    return complex((ends - slope * (last - first) / w**2).sum())
