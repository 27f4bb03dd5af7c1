"""Twelve leaves, slim and broad, straight and bent, smooth and lobed, 16 to 44 mm long."""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.artwork import Geometries


def leaf(length: float, width: float, bend: float, tip: float, lobes: int = 0) -> shapely.Polygon:
    """Return a leaf of 2 × ``length`` and about 2 × ``width``, its base to the left."""
    t = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    x, y = np.cos(t), np.sign(np.sin(t)) * np.abs(np.sin(t)) ** tip
    if lobes:
        y = y * (1 + 0.18 * np.cos(lobes * t))
    return shapely.Polygon(
        np.column_stack([length * x, width * y * (1 - 0.25 * x) + bend * length * (x * x - 0.5)])
    )


LEAVES: Geometries = np.array(
    [
        leaf(16, 6, 0.1, 1.5),
        leaf(20, 5, 0.2, 1.4),
        leaf(12, 6, 0, 1.2),
        leaf(18, 7, -0.15, 1.6),
        leaf(14, 4, 0.25, 1.3),
        leaf(10, 5, 0.1, 1.2),
        leaf(15, 7, 0, 1.4, 7),
        leaf(9, 4, 0.1, 1.5),
        leaf(22, 6, 0.12, 1.7),
        leaf(8, 3.2, 0.2, 1.2),
        leaf(13, 6.5, -0.1, 1.1, 9),
        leaf(11, 3.5, -0.2, 1.4),
    ],
    dtype=object,
)
