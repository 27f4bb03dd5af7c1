"""Cubic Béziers in bulk: places on them, where they turn back, into how many pieces to divide them."""

from __future__ import annotations

import numpy as np

from batik_vector.geometry.sampling import Array, Points


def needed(control: Points, tolerance: float) -> Array:
    """Return into how many even pieces, not rounded, cubics of shape (m, 4, 2) are to be divided.

    Wang's bound: n pieces are off by at most max|P_i − 2·P_{i+1} + P_{i+2}|·3/(4·n²).
    """
    bend = control[:, :-2] - 2 * control[:, 1:-1] + control[:, 2:]
    return np.asarray(
        np.sqrt(0.75 * np.hypot(bend[..., 0], bend[..., 1]).max(axis=1, initial=0.0) / tolerance)
    )


def evaluated(control: Points, t: Points) -> Points:
    """Return the points of cubics, shape (m, 4, 2), each at its own parameter: shape (m, 2)."""
    return np.column_stack([bernstein(control[:, :, 0], t), bernstein(control[:, :, 1], t)])


def bernstein(values: Points, t: Points) -> Points:
    """Return polynomials in Bernstein form, shape (…, 4), at parameters."""
    a, b, c, d = np.moveaxis(values, -1, 0)
    s = 1 - t
    return np.asarray(s * s * (s * a + 3 * t * b) + t * t * (3 * s * c + t * d))


def turns_of(coefficients: Points) -> Points:
    """Return 0, where polynomials in Bernstein form, shape (m, 4), turn back, and 1, ascending: shape (m, 4).

    Where they turn back in fewer places, 0 stands for them.
    """
    p, q, r = np.diff(coefficients, axis=1).T
    # The derivative is a·t² + 2·b·t + p, a third of it.
    a, b = p - 2 * q + r, q - p
    with np.errstate(divide="ignore", invalid="ignore"):
        k = -(b + np.copysign(np.sqrt(b * b - a * p), b))
        found = np.stack([k / a, p / k], axis=1)
    found[~((found > 0) & (found < 1))] = 0.0
    t = np.concatenate([np.zeros((len(p), 1)), found, np.ones((len(p), 1))], axis=1)
    return np.sort(t, axis=1)
