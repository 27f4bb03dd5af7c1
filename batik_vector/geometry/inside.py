"""Cubic Béziers kept inside a box: curves fitted to what an edge has cut may stand over that edge by a hair.

A cubic lies within the hull of its four points, so that drawing in the inner two is always enough.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Steps

Box: TypeAlias = tuple[int, int, int, int]
"""Left, lower, right and upper edge."""

ALONG = 0.9
"""A handle that is shortened to no less than this share keeps its direction; others are pushed aside, which
changes the curve less."""

HALVINGS = 7
"""How finely it is looked for how far handles must be drawn in."""


def kept_inside(control: Steps, box: Box) -> Steps:
    """Return cubics that stay in a box with as little change as will do.

    Where a cubic begins or ends on the box's edge, all of its points are brought inside; of others the curve
    is. Cubics with an end outside are left alone. What moves does so by no more than it stood outside, about.

    Args:
        control: shape (m, 4, 2), control points in whole steps.
        box: in steps.
    """
    low, high = np.array(box[:2]), np.array(box[2:])
    outside: NDArray[np.bool_] = np.asarray(((control < low) | (control > high)).any(axis=2))
    odd = np.flatnonzero(outside[:, 1:3].any(axis=1) & ~outside[:, (0, 3)].any(axis=1))
    if not len(odd):
        return control
    given = control[odd]
    ends = given[:, (0, 3)]
    most = given.copy()
    most[:, 1:3] = _drawn_in(ends, given[:, 1:3], low, high)
    touching = ((ends == low) | (ends == high)).any(axis=(1, 2))
    share = np.where(touching, 1.0, 0.0)
    least = ~touching & ~_within(given, low, high)
    # Nothing of the handles is the curve's own where it stays inside: they may stand out.
    wrong, right = np.zeros(len(odd)), np.ones(len(odd))
    for _ in range(HALVINGS):
        middle = (wrong + right) / 2
        fits = _within(_between(given, most, middle), low, high)
        wrong, right = np.where(fits, wrong, middle), np.where(fits, middle, right)
    share[least] = right[least]
    result = control.copy()
    result[odd] = _between(given, most, share)
    return result


def _drawn_in(ends: Steps, handles: Steps, low: Steps, high: Steps) -> Steps:
    """Return handles inside the box: shortened a little, or else pushed onto its edge."""
    reach = (handles - ends).astype(float)
    room = np.where(reach > 0, high - ends, low - ends)
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.where(reach != 0, room / reach, 1.0).min(axis=2)
    shorter = ends + np.rint(reach * np.minimum(part, 1.0)[..., None]).astype(np.int64)
    return np.asarray(np.clip(np.where((part >= ALONG)[..., None], shorter, handles), low, high))


def _between(given: Steps, most: Steps, share: NDArray[np.float64]) -> Steps:
    return np.rint(given + (most - given) * share[:, None, None]).astype(np.int64)


def _within(control: Steps, low: Steps, high: Steps) -> NDArray[np.bool_]:
    """Return which cubics nowhere leave the box."""
    p0, p1, p2, p3 = np.moveaxis(control.astype(float), 1, 0)
    # The derivative, over 3: c + 2 b u + a u².
    a, b, c = p3 - p0 + 3 * (p1 - p2), p0 - 2 * p1 + p2, p1 - p0
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(b * b - a * c)
        # Citardauq's and the usual formula, each where the other would cancel.
        q = -(b + np.where(b < 0, -root, root))
        turns = np.stack([q / a, c / q])
    turns = np.where((turns > 0) & (turns < 1), turns, 0.0)
    v = 1 - turns
    at = v**3 * p0 + 3 * v * v * turns * p1 + 3 * v * turns * turns * p2 + turns**3 * p3
    slack = 1e-6
    return np.asarray(((at >= low - slack) & (at <= high + slack)).all(axis=(0, 2)))
