"""Julia and Mandelbrot sets as contour rings: what takes more than so many steps to escape."""

from __future__ import annotations

import functools
from typing import Annotated

import numpy as np

from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.fields import Between, Says, check
from batik_vector.geometry.curves.base import Outlined
from batik_vector.geometry.generators.contours import rings, smooth
from batik_vector.geometry.generators.escape import escapes
from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.sampling import Array
from batik_vector.values import frozen

MOST_SAMPLES = 4_000_000
"""Samples of a grid: 2,000 × 2,000."""

Coordinate = Annotated[float, Between(-4, 4)]


@frozen(kw_only=True)
class Escape(Outlined):
    """What both kinds of sets share: a window 1 broad, its samples, and the level of the rings."""

    escape: Annotated[
        float, Between(0.5, 500), Says("steps of escape at which the rings run; broken ones are between")
    ] = 8.0
    power: Annotated[int, Between(2, 12), Says("the power p of z ↦ zᵖ + c")] = 2
    centre: Annotated[tuple[Coordinate, Coordinate], Says("middle of the window, in the plane of z")] = (
        0.0,
        0.0,
    )
    span: Annotated[float, Between(1e-9, 8), Says("breadth of the window in that plane")] = 3.2
    ratio: Annotated[float, Between(0.1, 10), Says("height of the window to its breadth")] = 1.0
    samples: Annotated[int, Between(16, 4000), Says("samples across the window; as fine as they show")] = 400
    periodic: Annotated[
        bool, Says("wrap the window on a torus, by sines: a ground that is its own mirror image")
    ] = False

    def __post_init__(self) -> None:
        check(self)
        rows = self._rows
        if self.samples * rows > MOST_SAMPLES:
            raise TooLargeError(
                f"samples = {self.samples} make a grid of {self.samples} × {rows}, more than "
                f"{MOST_SAMPLES:,} together: expected fewer, or another ratio"
            )
        self.outline()

    @property
    def _rows(self) -> int:
        return max(round((self.samples - 1) * self.ratio) + 1, 2)

    def constant(self) -> complex | None:
        """Return c, or None where it is the point itself."""
        raise NotImplementedError

    def _field(self) -> Array:
        half = self.span / 2
        x, y = self.centre
        window = (x - half, y - half * self.ratio, x + half, y + half * self.ratio)
        most = int(np.ceil(self.escape)) + 2
        return escapes(self.constant(), self.power, window, (self.samples, self._rows), most, self.periodic)

    def outline(self) -> Outline:
        """Return the rings, round what escapes later."""
        return self._outline

    @functools.cached_property
    def _outline(self) -> Outline:
        field = self._field()
        points, offsets = rings(field, self.escape)
        if not len(points):
            low, high = float(field.min()), float(field.max())
            told = (
                f"all points escape after {low:.3g} to {high:.3g} steps"
                if high < self.escape + 1
                else "none do"
            )
            raise GeometryError(f"escape = {self.escape:g}: {told}, expected a level between")
        last = np.array([self.samples - 1, self._rows - 1])
        edge = ((points == 0) | (points == last)).any(axis=1)
        step = 1 / (self.samples - 1)
        drawn = smooth(points, offsets, edge)
        return drawn.moved((step, 0, 0, step, -0.5, -self.ratio / 2))


@frozen(kw_only=True)
class Julia(Escape):
    """Julia set of z ↦ zᵖ + c: rings round all that takes more than `escape` steps to leave for infinity.

    Several of them, one in another, are bands. Broken steps are Douady and Hubbard's potential. The paper's
    reference 31 prints such sets on cloth. https://mathworld.wolfram.com/JuliaSet.html
    """

    c: Annotated[
        tuple[Coordinate, Coordinate],
        Says("real and imaginary part of c", called="real part, imaginary part"),
    ] = (-0.8, 0.156)

    def constant(self) -> complex:
        """Return c."""
        return complex(*self.c)


@frozen(kw_only=True)
class Mandelbrot(Escape):
    """Mandelbrot set of z ↦ zᵖ + c: rings round all c by which 0 takes more than `escape` steps to leave.

    https://mathworld.wolfram.com/MandelbrotSet.html
    """

    centre: Annotated[tuple[Coordinate, Coordinate], Says("middle of the window, in the plane of c")] = (
        -0.6,
        0.0,
    )

    def constant(self) -> None:
        """Return none: it is the point."""
        return
