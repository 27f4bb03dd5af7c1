"""Boxes that lie close to one another, found in a grid of squares as wide as any of them.

Few boxes are wider than that; what lies close to one of those is found by a tree.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.audit.contours import Floats, Mask
from batik_vector.geometry.outlines import Index

WIDE = 4.0
"""Boxes wider than this many times the reach are left to the tree."""

MOST_PAIRS = 1 << 18
"""Pairs of boxes that are compared at a time, so that they stay in the processor's cache."""


def close_pairs(box: Floats, reach: float) -> tuple[Index, Index]:
    """Return the pairs of boxes that are no farther apart than a reach along either axis.

    Args:
        box: left, lower, right and upper edge of each, shape (n, 4).
        reach: above nothing.

    Returns:
        The numbers of either, the smaller one first; no box with itself, and each pair once.
    """
    wide = (box[:, 2:] - box[:, :2]).max(axis=1, initial=0.0) > WIDE * reach
    one, other = [], []
    for p, q in (*_in_grid(box, np.flatnonzero(~wide), reach), _beside_wide(box, wide, reach)):
        one.append(np.minimum(p, q))
        other.append(np.maximum(p, q))
    return np.concatenate(one), np.concatenate(other)


def _in_grid(box: Floats, which: Index, reach: float) -> Iterator[tuple[Index, Index]]:
    if not len(which):
        return
    low, size = box[which, :2], box[which, 2:] - box[which, :2]
    # Corners of close boxes lie in squares that touch.
    square = float(size.max()) + reach
    column, row = np.floor((low - low.min(axis=0)) / square).astype(np.int64).T
    across = int(column.max()) + 3
    place = row * across + column
    order = np.argsort(place, kind="stable")
    which, place = which[order], place[order]
    # In the row of each the squares up to the next one, and in the row above three of them.
    begins = [np.arange(1, len(which) + 1), np.searchsorted(place, place + across - 1)]
    ends = [np.searchsorted(place, place + more, side="right") for more in (1, across + 1)]
    for begin, end in zip(begins, ends, strict=True):
        total = np.cumsum(end - begin)
        cuts = np.unique(np.searchsorted(total, np.arange(MOST_PAIRS, total[-1], MOST_PAIRS)))
        for rows in np.split(np.arange(len(which)), cuts):
            times = end[rows] - begin[rows]
            one = np.repeat(rows, times)
            other = np.arange(len(one)) + np.repeat(begin[rows] - np.cumsum(times) + times, times)
            p, q = which[one], which[other]
            close = np.ones(len(p), bool)
            for low_edge, high_edge in ((0, 2), (1, 3)):
                close &= box[p, low_edge] <= box[q, high_edge] + reach
                close &= box[q, low_edge] <= box[p, high_edge] + reach
            yield p[close], q[close]


def _beside_wide(box: Floats, wide: Mask, reach: float) -> tuple[Index, Index]:
    """Return the pairs of which one box, or both, are wide."""
    which = np.flatnonzero(wide)
    if not len(which):
        return which, which
    # Of a line from corner to corner the tree keeps the bounds.
    tree = shapely.STRtree(_diagonals(box))
    one, other = tree.query(_diagonals(box[which] + np.array([-reach, -reach, reach, reach])))
    one = which[one]
    once = np.where(wide[other], one < other, True)
    return one[once], other[once]


def _diagonals(box: Floats) -> Geometries:
    return np.asarray(shapely.linestrings(box.reshape(-1, 2, 2)), dtype=object)
