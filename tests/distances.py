"""How far places lie from lines, by a tree of their segments: as GEOS has it, and soon for many of both."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray


def distances(lines: shapely.Geometry, places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how far places, shape (n, 2), lie from lines, in their unit."""
    points, line = shapely.get_coordinates(shapely.get_parts(lines), return_index=True)
    within = line[:-1] == line[1:]
    segments = np.asarray(shapely.linestrings(np.stack([points[:-1], points[1:]], axis=1)[within]))
    tree = shapely.STRtree(segments)
    _, found = tree.query_nearest(shapely.points(places), return_distance=True, all_matches=False)
    assert len(found) == len(places)
    return np.asarray(found, dtype=np.float64)
