"""Affine maps as SVG names their numbers: (a, b, c, d, e, f) takes (x, y) to (a·x + c·y + e, b·x + d·y + f).

Plain tuples, since there is one for every group of a drawing and none for a vertex.
"""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Matrix: TypeAlias = tuple[float, float, float, float, float, float]
IDENTITY: Matrix = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)


def times(a: Matrix, b: Matrix) -> Matrix:
    """Return the map that does b, then a."""
    return (
        a[0] * b[0] + a[2] * b[1],
        a[1] * b[0] + a[3] * b[1],
        a[0] * b[2] + a[2] * b[3],
        a[1] * b[2] + a[3] * b[3],
        a[0] * b[4] + a[2] * b[5] + a[4],
        a[1] * b[4] + a[3] * b[5] + a[5],
    )


def inverse_of(matrix: Matrix) -> Matrix:
    """Return the map that undoes an affine map."""
    a, b, c, d, e, f = matrix
    det = a * d - b * c
    return d / det, -b / det, -c / det, a / det, (c * f - d * e) / det, (b * e - a * f) / det


def moved(points: NDArray[np.float64], matrix: Matrix) -> NDArray[np.float64]:
    """Return points, shape (n, 2), under a map."""
    a, b, c, d, e, f = matrix
    x, y = points[:, 0], points[:, 1]
    found = np.empty_like(points, float)
    found[:, 0], found[:, 1] = a * x + c * y + e, b * x + d * y + f
    return found


def spread(matrix: Matrix) -> tuple[float, float]:
    """Return by how much a map stretches lengths, at most and at least: its singular values."""
    a, b, c, d = matrix[:4]
    mean, apart = math.hypot(a + d, b - c) / 2, math.hypot(a - d, b + c) / 2
    return mean + apart, abs(mean - apart)
