"""The sides of squares in rows, each a line of its own, in an order that helps nobody."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

SIDE_MM = 5.0


def sides(count: int, *, twice: bool) -> NDArray[np.float64]:
    """Return the sides of count × count squares of 5 mm, shape (n, 2, 2), in mm.

    Args:
        count: squares in a row, and rows.
        twice: draw a side that two squares share for each of them.
    """
    along, across = (each.ravel() for each in np.meshgrid(np.arange(count), np.arange(count + 1)))
    level = np.stack([np.stack([along, across], axis=-1), np.stack([along + 1, across], axis=-1)], axis=1)
    lines = np.concatenate([level, level[:, :, ::-1]])
    if twice:
        inner = (across > 0) & (across < count)
        # The second square draws the side the other way.
        lines = np.concatenate([lines, lines[np.tile(inner, 2)][:, ::-1]])
    return np.asarray(np.random.default_rng(7).permutation(lines) * SIDE_MM)
