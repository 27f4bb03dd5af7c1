"""Escape times: after how many steps of z ↦ zᵖ + c points leave for infinity, in whole and broken steps."""

from __future__ import annotations

import functools
import math

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.sampling import Array

FAR = 1000.0
"""Beyond it a point is gone: so far out that broken steps have no seams."""


@functools.lru_cache(maxsize=2)
def escapes(
    constant: complex | None,
    power: int,
    window: tuple[float, float, float, float],
    size: tuple[int, int],
    most: int,
    wrapped: bool,
) -> Array:
    """Return the escape times of a grid of points, shape (rows, columns); those that stay have ``most + 2``.

    Douady & Hubbard's potential gives the broken part: n + 1 − log_p(log|z| / log FAR).

    Args:
        constant: c of a Julia set; None draws the Mandelbrot set, whose points are c themselves.
        power: p.
        window: left, low, right and high end of the grid, whose samples lie on its edges.
        size: columns and rows.
        most: steps after which a point counts as staying.
        wrapped: whether the window is a torus: its points are then the sines of their place on it.
    """
    left, low, right, high = window
    x, y = np.linspace(left, right, size[0]), np.linspace(low, high, size[1])
    if wrapped:
        # From edge to edge once round: halves of the torus mirror one another.
        turn_x, turn_y = (2 * math.pi * np.linspace(0, 1, each) for each in size)
        x = (left + right) / 2 + (right - left) / 2 * _closed(np.sin(turn_x))
        y = (low + high) / 2 + (high - low) / 2 * _closed(np.sin(turn_y))
    z: NDArray[np.complex128] = (x[None, :] + 1j * y[:, None]).ravel()
    c = z.copy() if constant is None else np.full(len(z), constant)
    if constant is None:
        z = np.zeros(len(c), complex)
    found = np.full(len(z), most + 2.0)
    left_over = np.arange(len(z))
    for step in range(most + 2):
        z = z**power + c if power > 2 else z * z + c
        size_of = np.abs(z)
        gone = size_of > FAR
        if gone.any():
            broken = np.log(np.log(size_of[gone]) / math.log(FAR)) / math.log(power)
            found[left_over[gone]] = step + 1 - broken
            stay = ~gone
            z, c, left_over = z[stay], c[stay], left_over[stay]
        if not len(z):
            break
    field: Array = np.minimum(found, most + 2.0).reshape(size[1], size[0])
    field.flags.writeable = False
    return field


def _closed(values: Array) -> Array:
    """Return values whose last is the first to the bit."""
    values[-1] = values[0]
    return values
