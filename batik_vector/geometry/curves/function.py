"""A curve from any Python function: for notebooks and plug-ins, not for recipes, which hold no code."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from batik_vector.geometry.curves.base import Curve
from batik_vector.geometry.sampling import Array, Points
from batik_vector.values import frozen


@frozen
class FunctionCurve(Curve):
    """A curve whose points at t in [0, 1] a function returns, shape (n, 2).

    ``stops`` are the parameters of its corners and cusps, ascending, in (0, 1). A closed curve ends
    where it begins.
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


def polar(
    radius: Callable[[Array], Array], period: float = 2 * np.pi, stops: tuple[float, ...] = ()
) -> FunctionCurve:
    """Return the closed curve r = radius(θ) for θ in [0, period); ``stops`` are angles of corners."""

    def at(t: Array) -> Points:
        angle = t * period
        r = radius(angle)
        return np.column_stack([r * np.cos(angle), r * np.sin(angle)])

    return FunctionCurve(at, tuple(stop / period for stop in stops))
