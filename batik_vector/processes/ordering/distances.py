"""Distances in whole sixteenths of a grid step: their sums are exact, so that every machine chooses alike."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Steps

Distances: TypeAlias = NDArray[np.float64]
"""Whole numbers of parts, held as floats: none is near 2^53, past which their sums would be rounded."""
Column: TypeAlias = NDArray[np.float64]
"""One coordinate of many places, in whole steps of 1 µm."""
PARTS = 16
"""Parts of a grid step. Square roots are rounded alike everywhere, their sums are not."""


def distances(a: Steps, b: Steps) -> Distances:
    """Return how far places lie apart, shape (...,), of coordinates of shape (..., 2)."""
    x, y = (np.asarray(a[..., axis] - b[..., axis], float) for axis in (0, 1))
    return lengths(x, y)


def lengths(x: Column, y: Column) -> Distances:
    """Return how long steps are, of so much across and so much up; both are used up."""
    x *= x
    y *= y
    x += y
    np.sqrt(x, out=x)
    x *= PARTS
    return np.rint(x, out=x)
