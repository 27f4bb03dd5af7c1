"""Curves from functions of an angle: for notebooks and plug-ins, not for recipes, which hold no code."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from batik_vector.geometry.curves.base import FunctionCurve
from batik_vector.geometry.sampling import Array, Points


def polar(
    radius: Callable[[Array], Array], period: float = 2 * np.pi, stops: tuple[float, ...] = ()
) -> FunctionCurve:
    """Return the closed curve r = radius(θ) for θ in [0, period); ``stops`` are angles of corners."""

    def at(t: Array) -> Points:
        angle = t * period
        r = radius(angle)
        return np.column_stack([r * np.cos(angle), r * np.sin(angle)])

    return FunctionCurve(at, tuple(stop / period for stop in stops))
