"""Strange attractors: what a circle becomes under the map of one, fold upon fold."""

from __future__ import annotations

import enum
from typing import Annotated

import numpy as np

from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.fields import Between, Says, check
from batik_vector.geometry.curves.base import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen

LONGEST = 2_000.0
"""Length that a folded circle may have, in its own breadth: beyond it the cloth is a grey haze."""

PROBES = 20_000
"""Places at which the length is measured before anything is drawn."""


class AttractorMap(enum.StrEnum):
    """The map of an attractor."""

    CLIFFORD = "clifford"
    """x' = sin(a·y) + c·cos(a·x), y' = sin(b·x) + d·cos(b·y)."""
    DE_JONG = "de-jong"
    """x' = sin(a·y) − cos(b·x), y' = sin(c·x) − cos(d·y)."""


Constant = Annotated[float, Between(-4, 4)]


@frozen(kw_only=True)
class Attractor(Curve):
    """A circle folded by the map of a strange attractor, `folds` times over: one closed smooth line.

    Chaos stretches and folds: with every fold the line comes nearer to the attractor and grows longer; its
    length is foretold, and bounded. Filled by "evenodd" it is a marbling. Pickover, "Computers, Pattern,
    Chaos and Beauty" (1990), has both maps, Clifford's and Peter de Jong's.
    """

    map: Annotated[AttractorMap, Says("whose map it is")] = AttractorMap.CLIFFORD
    a: Annotated[Constant, Says("constant of the map")] = -1.4
    b: Annotated[Constant, Says("constant of the map")] = 1.6
    c: Annotated[Constant, Says("constant of the map")] = 1.0
    d: Annotated[Constant, Says("constant of the map")] = 0.7
    folds: Annotated[int, Between(1, 12), Says("how often the circle is folded")] = 3
    radius: Annotated[float, Between(0.01, 10), Says("radius of the circle")] = 1.0
    centre: Annotated[
        tuple[Annotated[float, Between(-10, 10)], Annotated[float, Between(-10, 10)]],
        Says("middle of the circle"),
    ] = (0.0, 0.0)

    def __post_init__(self) -> None:
        check(self)
        points = self.at(np.linspace(0, 1, PROBES))
        size = float(np.ptp(points, axis=0).max())
        if not size > 1e-3 * self.radius:
            raise GeometryError(
                f"folds = {self.folds}: the circle shrinks to a point, and settles on no strange attractor: "
                "expected other constants, or fewer folds"
            )
        length = float(np.hypot(*np.diff(points, axis=0).T).sum())
        if length > LONGEST * size:
            raise TooLargeError(
                f"folds = {self.folds}: the line is more than {LONGEST:,.0f} times as long as it is broad "
                "and does not settle: expected fewer folds, or smaller constants"
            )

    def at(self, t: Array) -> Points:
        """Return the points at ``t``."""
        angle = 2 * np.pi * t
        x = self.centre[0] + self.radius * np.cos(angle)
        y = self.centre[1] + self.radius * np.sin(angle)
        a, b, c, d = self.a, self.b, self.c, self.d
        for _ in range(self.folds):
            if self.map == AttractorMap.CLIFFORD:
                x, y = np.sin(a * y) + c * np.cos(a * x), np.sin(b * x) + d * np.cos(b * y)
            else:
                x, y = np.sin(a * y) - np.cos(b * x), np.sin(c * x) - np.cos(d * y)
        return np.column_stack([x, y])

    def breaks(self) -> Array:
        """Enough starting points that no fold hides between two of them."""
        parts = 32 << min(self.folds, 6)
        return np.arange(1, parts) / parts
