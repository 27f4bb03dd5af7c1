"""Random regions with holes, pointed and round, slim and broad."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely

from batik_vector.geometry.sampling import Geometries


def region(seed: int, size: float = 16.0) -> Geometries:
    """Return the parts of a random star-shaped region with up to four holes, about so large (mm)."""
    chance = np.random.default_rng(seed)
    count = int(chance.integers(5, 40))
    turn = np.sort(chance.random(count)) * 2 * np.pi
    reach = size * (0.3 + 0.7 * chance.random(count))
    corners = np.column_stack([reach * np.cos(turn) * chance.uniform(0.5, 1.5), reach * np.sin(turn)])
    shape: Any = shapely.Polygon(corners).buffer(0).buffer(float(chance.choice([0, -0.8, 1.2])))
    for _ in range(int(chance.integers(0, 5))):
        middle = shapely.Point(chance.normal(size=2) * size * 0.3)
        shape = shape.difference(middle.buffer(chance.uniform(0.3, size * 0.2)))
    parts = shapely.get_parts(shape)
    return np.asarray(shapely.orient_polygons(parts[shapely.area(parts) > 1]), dtype=object)


def regions(first: int, count: int, size: float = 16.0) -> Geometries:
    """Return the parts of so many random regions."""
    return np.concatenate([region(seed, size) for seed in range(first, first + count)])
