"""Registration marks: crosses at the corners, by which several sheets come to lie alike."""

from __future__ import annotations

import numpy as np

from batik_vector.geometry.outlines import Outlines
from batik_vector.processes.cutting.weeding import Box


def crosses(box: Box, size: int) -> Outlines:
    """Return a cross at each corner of a box, from the lower left on: a level line and an upright one.

    Args:
        box: at whose corners they have their middles.
        size: how long their lines are, in steps.
    """
    half = size // 2
    middles = np.array(
        [(box.left, box.low), (box.right, box.low), (box.right, box.high), (box.left, box.high)], np.int64
    )
    arms = np.array([[(-half, 0), (half, 0)], [(0, -half), (0, half)]], np.int64)
    points = (middles[:, None, None, :] + arms[None, :, :, :]).reshape(-1, 2)
    return Outlines(points, np.arange(0, 17, 2), np.arange(9), np.zeros(8, bool))
