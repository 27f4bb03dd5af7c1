"""Distances in whole sixteenths of a grid step: their sums are exact, so that every machine chooses alike."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Steps

Distances: TypeAlias = NDArray[np.int64]
PARTS = 16
"""Parts of a grid step. Square roots are rounded alike everywhere, their sums are not."""


def distances(a: Steps, b: Steps) -> Distances:
    """Return how far places lie apart, shape (...,), of coordinates of shape (..., 2)."""
    return lengths(a[..., 0] - b[..., 0], a[..., 1] - b[..., 1])


def lengths(x: NDArray[np.int64], y: NDArray[np.int64]) -> Distances:
    """Return how long steps are, of so much across and so much up."""
    found: NDArray[np.float64] = np.sqrt(x * x + y * y)
    found *= PARTS
    return np.asarray(np.rint(found), np.int64)
