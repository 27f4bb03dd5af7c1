"""Lines in an order that helps nobody: strokes all over a square metre, and the sides of squares in rows.

Of the strokes also the least way that joins them.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

SQUARE_MM = 5.0
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
    """Return the length of the shortest tree that joins strokes at their ends, in their unit.

    No way through all of them can have shorter ways between them. Its edges are among those of the Delaunay
    triangles of all ends: whatever else would join two strokes is the longest of a ring of ways.
    """
    ends, at = np.unique(lines.reshape(-1, 2), axis=0, return_inverse=True)
    edges = shapely.delaunay_triangles(shapely.multipoints(ends), only_edges=True)
    places = shapely.get_coordinates(shapely.get_parts(edges)).reshape(-1, 2, 2)
    apart = np.hypot(*(places[:, 0] - places[:, 1]).T)
    number = {place: which for which, place in enumerate(map(tuple, ends.tolist()))}
    above = list(range(len(ends)))

    def top(which: int) -> int:
        while above[which] != which:
            above[which] = which = above[above[which]]
        return which

    for one, two in at.reshape(-1, 2).tolist():
        above[top(one)] = top(two)
    total = 0.0
    for edge in np.argsort(apart, kind="stable").tolist():
        one, two = (top(number[tuple(place)]) for place in places[edge].tolist())
        if one != two:
            above[one] = two
            total += float(apart[edge])
    return total


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
    return np.asarray(np.random.default_rng(7).permutation(lines) * SQUARE_MM)
