"""Contours of a field: where samples on a grid pass a level, as smooth rings, in bulk.

Marching squares (Lorensen & Cline 1987, in two dimensions) with crossings by linear interpolation; a saddle
is joined or parted by the mean of its corners. Every crossing is left by one ring and no ring ends, so that
rings are found by following them. Around the field all is below the level: what reaches its edge is closed
along it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.nesting import rings_of
from batik_vector.geometry.paths.outline import CONTROL, CURVE, LINE, MOVE, Outline
from batik_vector.geometry.sampling import Array, Indices, Points

OUTSIDE = -1e300
"""The value around a field: crossings towards it lie on the edge itself."""

# Sides of a square: 0 below, 1 to the right, 2 above, 3 to the left. Corners as bits: 1 lower left, 2 lower
# right, 4 upper right, 8 upper left. Segments lead from side to side with what is above the level on the
# left.
SEGMENTS: tuple[tuple[tuple[int, int], ...], ...] = (
    (),
    ((0, 3),),
    ((1, 0),),
    ((1, 3),),
    ((2, 1),),
    ((0, 3), (2, 1)),
    ((2, 0),),
    ((2, 3),),
    ((3, 2),),
    ((0, 2),),
    ((1, 0), (3, 2)),
    ((1, 2),),
    ((3, 1),),
    ((0, 1),),
    ((3, 0),),
    (),
)
JOINED: dict[int, tuple[tuple[int, int], ...]] = {5: ((0, 1), (2, 3)), 10: ((1, 2), (3, 0))}
"""Saddles whose middle is above the level."""


def rings(field: Array, level: float) -> tuple[Points, Indices]:
    """Return the outlines of what is above a level, its inside on the left, in steps of the grid.

    Args:
        field: shape (rows, columns); x counts columns and y rows.
        level: the value at which outlines run.

    Returns:
        Points of all rings, none repeated at the end, and where each ring begins among them, and the end.
    """
    rows, columns = field.shape
    value = np.full((rows + 2, columns + 2), OUTSIDE)
    value[1:-1, 1:-1] = field
    above = value > level
    across = above[:, 1:] != above[:, :-1]
    upward = above[1:] != above[:-1]
    low, left = np.flatnonzero(across), np.flatnonzero(upward)
    if not len(low):
        return np.empty((0, 2)), np.zeros(1, np.intp)
    number_across = np.zeros(across.size, np.int32)
    number_across[low] = np.arange(len(low))
    number_upward = np.zeros(upward.size, np.int32)
    number_upward[left] = len(low) + np.arange(len(left))
    wide = columns + 1
    # Every square with a crossing has one below or to its left, or stands right of or under one that has.
    corner = above.ravel()
    square = np.unique(np.concatenate([_squares(low, columns, rows), _upright(left, columns)]))
    row, column = square // wide, square % wide
    at = row * (columns + 2) + column
    case = (
        corner[at] + 2 * corner[at + 1] + 4 * corner[at + columns + 3] + 8 * corner[at + columns + 2]
    ).astype(np.int64)
    flat = value.ravel()
    saddle = np.flatnonzero((case == 5) | (case == 10))
    with np.errstate(over="ignore"):
        mean = (
            flat[at[saddle]]
            + flat[at[saddle] + 1]
            + flat[at[saddle] + columns + 3]
            + flat[at[saddle] + columns + 2]
        ) / 4
    case[saddle[mean > level]] += 16
    sides = (
        number_across[row * wide + column],
        number_upward[row * (columns + 2) + column + 1],
        number_across[(row + 1) * wide + column],
        number_upward[row * (columns + 2) + column],
    )
    following = np.zeros(len(low) + len(left), np.int64)
    for kind in np.unique(case).tolist():
        mine = case == kind
        for begin, end in JOINED[kind - 16] if kind >= 16 else SEGMENTS[kind]:
            following[sides[begin][mine]] = sides[end][mine]
    order, sizes = rings_of(following)
    points = np.concatenate([_crossings(value, low, level, True), _crossings(value, left, level, False)])
    return points[order] - 1, np.append(0, np.cumsum(sizes)).astype(np.intp)


def _squares(low: Indices, columns: int, rows: int) -> Indices:
    """Return the squares above and below crossings of horizontal edges."""
    wide = columns + 1
    row = low // wide
    return np.concatenate([low[row <= rows], (low - wide)[row > 0]])


def _upright(left: Indices, columns: int) -> Indices:
    """Return the squares right and left of crossings of upright edges."""
    row, column = left // (columns + 2), left % (columns + 2)
    wide = columns + 1
    return np.concatenate([(row * wide + column)[column <= columns], (row * wide + column - 1)[column > 0]])


def _crossings(value: Array, edges: Indices, level: float, across: bool) -> Points:
    """Return where edges of the grid pass the level."""
    columns = value.shape[1]
    wide = columns - 1 if across else columns
    row, column = edges // wide, edges % wide
    a = value[row, column]
    b = value[row, column + 1] if across else value[row + 1, column]
    part = (level - a) / (b - a)
    return np.column_stack([column + part, row]) if across else np.column_stack([column, row + part])


def smooth(points: Points, offsets: Indices, straight: NDArray[np.bool_]) -> Outline:
    """Return rings as quadratic B-splines with their points for control points: smooth, without overshoot.

    Args:
        points: of all rings, none repeated.
        offsets: where each begins, and the end.
        straight: points that stay where they are, with straight sides to others that do.
    """
    following = np.arange(len(points)) + 1
    following[offsets[1:] - 1] = offsets[:-1]
    leading = np.empty_like(following)
    leading[following] = np.arange(len(points))
    middle = (points + points[following]) / 2
    both = straight & straight[following]
    begin, end = middle[leading], middle
    # Five nodes a point: to it by a line where it stays, past it by a curve where not.
    nodes = np.empty((len(points), 3, 2))
    nodes[:, 0] = begin + (points - begin) * (2 / 3)
    nodes[:, 1] = end + (points - end) * (2 / 3)
    nodes[:, 2] = end
    kinds = np.tile(np.array([CONTROL, CONTROL, CURVE], np.uint8), (len(points), 1))
    keep = np.ones((len(points), 3), bool)
    nodes[straight, 1] = points[straight]
    kinds[straight] = [CONTROL, LINE, LINE]
    keep[straight, 0] = False
    keep[both, 2] = False
    ring = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    first = offsets[:-1]
    flat, kind = nodes[keep], kinds[keep]
    count = keep.sum(axis=1)
    start = np.cumsum(count) - count
    starts = begin[first].copy()
    corner = straight[leading[first]] & straight[first]
    starts[corner] = points[leading[first]][corner]
    xy = np.insert(flat, start[first], starts, axis=0)
    kind = np.insert(kind, start[first], MOVE)
    return Outline(xy, kind, np.ones(len(np.unique(ring)), bool))
