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
    grid = _Grid(field, level)
    across, upright = grid.above[:, 1:] != grid.above[:, :-1], grid.above[1:] != grid.above[:-1]
    low, left = np.flatnonzero(across), np.flatnonzero(upright)
    if not len(low):
        return np.empty((0, 2)), np.zeros(1, np.intp)
    # A square whose lower, upper and left sides are not crossed is all above the level, or all below.
    squares = np.flatnonzero(across[:-1] | across[1:] | upright[:, :-1])
    order, sizes = rings_of(grid.following(low, left, squares))
    points = np.concatenate([grid.crossings(low, True), grid.crossings(left, False)])
    return points[order] - 1, np.append(0, np.cumsum(sizes)).astype(np.intp)


class _Grid:
    """A field with a frame of samples below the level all round: only what is above is kept framed."""

    def __init__(self, field: Array, level: float) -> None:
        self.field, self.level = field, level
        self.rows, self.columns = field.shape[0] + 2, field.shape[1] + 2
        self.above = np.zeros((self.rows, self.columns), bool)
        np.greater(field, level, out=self.above[1:-1, 1:-1])

    def value(self, row: Indices, column: Indices) -> Array:
        """Return samples, counted with the frame."""
        last = self.field.shape
        inside = (row > 0) & (row <= last[0]) & (column > 0) & (column <= last[1])
        known = self.field[np.clip(row - 1, 0, last[0] - 1), np.clip(column - 1, 0, last[1] - 1)]
        return np.where(inside, known, OUTSIDE)

    def crossings(self, edges: Indices, across: bool) -> Points:
        """Return where edges of the grid, across or upright ones by their numbers, pass the level."""
        wide = self.columns - across
        row, column = edges // wide, edges % wide
        a, b = self.value(row, column), self.value(row + (not across), column + across)
        part = (self.level - a) / (b - a)
        return np.column_stack([column + part, row] if across else [column, row + part])

    def following(self, low: Indices, left: Indices, squares: Indices) -> NDArray[np.int64]:
        """Return for each crossing the next one of its ring: those of edges across first, then the upright.

        Args:
            low, left: the edges that are crossed, by their numbers, ascending.
            squares: those between, by the numbers of the edges below them.
        """
        wide = self.columns - 1
        row, column = squares // wide, squares % wide
        at = row * self.columns + column
        case, above = np.zeros(len(at), np.int64), self.above.ravel()
        for bit, beyond in enumerate((0, 1, self.columns + 1, self.columns)):
            case |= above[at + beyond].astype(np.int64) << bit
        saddle = np.flatnonzero((case == 5) | (case == 10))
        mine, other = row[saddle], column[saddle]
        corners = [self.value(mine + y, other + x) for y in (0, 1) for x in (0, 1)]
        case[saddle[np.mean(corners, axis=0) > self.level]] += 16
        # No edge of the frame is crossed. So every crossed one is the lower side of one square and the upper
        # side of another, or the left and the right one, and comes in the same order among those.
        bits = [(case >> bit & 1).astype(bool) for bit in range(4)]
        sides = (
            np.cumsum(bits[0] != bits[1]) - 1,
            len(low) + np.cumsum(bits[1] != bits[2]) - 1,
            np.cumsum(bits[3] != bits[2]) - 1,
            len(low) + np.cumsum(bits[0] != bits[3]) - 1,
        )
        following = np.zeros(len(low) + len(left), np.int64)
        for kind in np.unique(case).tolist():
            held = case == kind
            for begin, end in JOINED[kind - 16] if kind >= 16 else SEGMENTS[kind]:
                following[sides[begin][held]] = sides[end][held]
        return following


def smooth(points: Points, offsets: Indices, straight: NDArray[np.bool_]) -> Outline:
    """Return rings as quadratic B-splines with their points for control points: smooth, without overshoot.

    Args:
        points: of all rings, none repeated.
        offsets: where each begins, and the end.
        straight: points that stay where they are, with straight sides to others that do.
    """
    if not straight.any():
        return _bent(points, offsets)
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


def _bent(points: Points, offsets: Indices) -> Outline:
    """Return rings of which all points are control points."""
    z = np.ascontiguousarray(points).view(np.complex128).ravel()
    first, last = offsets[:-1], offsets[1:] - 1
    after = np.append(z[1:], 0)
    after[last] = z[first]
    end = (z + after) / 2
    begin = np.append(0, end[:-1])
    begin[first] = end[last]
    nodes = np.stack([begin + (z - begin) * (2 / 3), end + (z - end) * (2 / 3), end], axis=1).ravel()
    place = np.arange(len(nodes)) + np.repeat(np.arange(1, len(offsets)), 3 * np.diff(offsets))
    moves = 3 * first + np.arange(len(first))
    flat = np.empty(len(nodes) + len(first), complex)
    flat[place], flat[moves] = nodes, begin[first]
    kinds = np.full(len(flat), CONTROL, np.uint8)
    kinds[place[2::3]], kinds[moves] = CURVE, MOVE
    return Outline(flat.view(np.float64).reshape(-1, 2), kinds, np.ones(len(first), bool))
