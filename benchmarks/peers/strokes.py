"""Short strokes all over a square metre, in an order that helps nobody, and the least way that joins them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

SIDE_MM = 1000.0
LENGTH = 0.3
"""How long a stroke is, as a share of the strokes' spacing, in each of two directions, about."""


def strokes(count: int) -> NDArray[np.float64]:
    """Return strokes of two ends, shape (count, 2, 2), in mm, on whole micrometres."""
    draw = np.random.default_rng(1)
    begin = draw.integers(0, int(SIDE_MM * 1000), (count, 2))
    step = np.rint(draw.normal(size=(count, 2)) * (LENGTH * SIDE_MM * 1000 / count**0.5))
    return np.stack([begin, begin + step], axis=1) / 1000


def spanning_tree(lines: NDArray[np.float64]) -> float:
    """Return the length of the shortest tree that joins strokes at their ends (Prim), in their unit.

    No way through all of them can have shorter ways between them.
    """
    best, total = np.full(len(lines), np.inf), 0.0
    left = np.ones(len(lines), bool)
    at = 0
    for _ in range(len(lines) - 1):
        left[at] = False
        apart = lines[:, :, None] - lines[at][None, None]
        best = np.minimum(best, np.sqrt((apart**2).sum(axis=-1)).min(axis=(1, 2)))
        at = int(np.where(left, best, np.inf).argmin())
        total += float(best[at])
    return total
