"""Splitting: convex cells, each cut in two by a chord, all at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Steps
from batik_vector.geometry.sampling import Array
from batik_vector.values import frozen


@frozen(eq=False)
class Cells:
    """Convex polygons, their corners anticlockwise.

    ``corners`` has shape (n, k, 2), in steps; those past ``count`` repeat the first. ``side`` says which
    crack runs from each corner to the next.
    """

    corners: Steps
    count: Index
    side: Index

    def __len__(self) -> int:
        return len(self.count)

    def taken(self, which: Index | NDArray[np.bool_]) -> Cells:
        """Return some of them."""
        return Cells(self.corners[which], self.count[which], self.side[which])


@frozen(eq=False)
class Chords:
    """A chord through each of some cells: the sides on which it begins and ends, and where."""

    sides: tuple[Index, Index]
    ends: tuple[Steps, Steps]


def together(one: Cells, other: Cells) -> Cells:
    """Return two sets of cells as one."""
    width = max(one.corners.shape[1], other.corners.shape[1])
    a, b = _wide(one, width), _wide(other, width)
    return Cells(
        np.concatenate([a.corners, b.corners]),
        np.concatenate([a.count, b.count]),
        np.concatenate([a.side, b.side]),
    )


def _wide(cells: Cells, width: int) -> Cells:
    more = width - cells.corners.shape[1]
    if not more:
        return cells
    corners = np.concatenate([cells.corners, np.repeat(cells.corners[:, :1], more, axis=1)], axis=1)
    side = np.concatenate([cells.side, np.repeat(cells.side[:, :1], more, axis=1)], axis=1)
    return Cells(corners, cells.count, side)


def moments(corners: Array) -> tuple[Array, Array, Array]:
    """Return area, middle and spread of polygons; spread is xx, xy, yy of how their area lies about it.

    Args:
        corners: shape (n, k, 2), anticlockwise; corners may repeat.
    """
    origin = corners[:, 0]
    x, y = (corners - origin[:, None]).transpose(2, 0, 1)
    u, v = np.roll(x, -1, axis=1), np.roll(y, -1, axis=1)
    cross = x * v - u * y
    area, sx, sy, xx, xy, yy = (
        _summed(each)
        for each in (
            cross / 2,
            cross * (x + u) / 6,
            cross * (y + v) / 6,
            cross * (x * x + x * u + u * u) / 12,
            cross * (2 * x * y + x * v + u * y + 2 * u * v) / 24,
            cross * (y * y + y * v + v * v) / 12,
        )
    )
    mx, my = sx / area, sy / area
    spread = np.stack([xx / area - mx * mx, xy / area - mx * my, yy / area - my * my], axis=1)
    return area, origin + np.stack([mx, my], axis=1), spread


def _summed(rows: Array) -> Array:
    """Return the sums of rows, added from left to right on every machine."""
    total = np.zeros(len(rows))
    for column in range(rows.shape[1]):
        total += rows[:, column]
    return total


def chords(cells: Cells, through: Array, way: Array) -> Chords:
    """Return the chords of cells through a place within each, in a direction."""
    x, y = (cells.corners - through[:, None]).transpose(2, 0, 1)
    far = way[:, :1] * y - way[:, 1:] * x
    there = np.arange(far.shape[1]) < cells.count[:, None]
    following = np.where(
        np.arange(far.shape[1]) + 1 < cells.count[:, None], np.roll(far, -1, axis=1), far[:, :1]
    )
    # Outlines run anticlockwise: they leave what lies left of the line once, and come back once.
    out = np.argmax(there & (far >= 0) & (following < 0), axis=1)
    into = np.argmax(there & (far < 0) & (following >= 0), axis=1)
    return Chords((out, into), (_met(cells, out, far), _met(cells, into, far)))


def _met(cells: Cells, side: Index, far: Array) -> Steps:
    """Return where the line meets a side of each cell, on whole steps."""
    row = np.arange(len(cells))
    nxt = np.where(side + 1 < cells.count, side + 1, 0)
    a, b = cells.corners[row, side], cells.corners[row, nxt]
    p, q = far[row, side], far[row, nxt]
    share = np.where(p == q, 0.5, p / np.where(p == q, 1.0, p - q))
    return np.floor(a + (b - a) * share[:, None] + 0.5).astype(np.int64)


def halves(cells: Cells, cut: Chords, crack: Index) -> tuple[Cells, Cells]:
    """Return what is right of the chord of each cell, and what is left; ``crack`` runs on that side now."""
    out, into = cut.sides
    return (
        _part(cells, out, into, cut.ends, crack),
        _part(cells, into, out, (cut.ends[1], cut.ends[0]), crack),
    )


def _part(cells: Cells, begin: Index, end: Index, ends: tuple[Steps, Steps], crack: Index) -> Cells:
    """Return cells from where a chord leaves one side, along the outline, to where it meets another."""
    k = cells.corners.shape[1]
    inner = (end - begin) % cells.count
    count = inner + 2
    width = int(count.max(initial=3))
    at = np.arange(width)[None, :]
    from_ = (begin[:, None] + at) % cells.count[:, None]
    row = np.arange(len(cells))[:, None]
    corners = cells.corners[row, np.minimum(from_, k - 1)]
    side = cells.side[row, np.minimum(from_, k - 1)]
    corners[:, 0] = ends[0]
    last = at == inner[:, None] + 1
    corners[last] = ends[1]
    side[last] = crack
    past = at > inner[:, None] + 1
    corners = np.where(past[:, :, None], corners[:, :1], corners)
    side = np.where(past, side[:, :1], side)
    return Cells(corners, count, side)
