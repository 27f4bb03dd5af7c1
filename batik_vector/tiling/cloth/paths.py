"""Polylines that a seam cut, joined again end to end, in whole numbers.

A line may be walked either way, so each copy of a line is two states: forwards (even) and backwards (odd).
States follow one another where ends meet; a path that ends turns back into itself, so that all walks are
cycles, and pointer doubling orders them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Offsets, Outlines, Steps, runs
from batik_vector.tiling.cloth.chains import numbered
from batik_vector.tiling.cloth.rings import aligned, cycles
from batik_vector.values import frozen

NONE = -1


@frozen
class Ends:
    """The two ends of open lines: end 2k where line k begins, end 2k + 1 where it ends.

    ``way`` points from the end along the line; ``free`` tells which ends no seam has cut.
    """

    point: Steps
    way: Steps
    free: NDArray[np.bool_]

    def partners(self, group: Index, point: Steps | None = None) -> tuple[Index, NDArray[np.bool_]]:
        """Return the end that each is joined with, or ``NONE``, and which joints two ends have to themselves.

        Lines that cross at a point go straight on: each end is joined with the one opposite. An odd number
        of ends is left as it is.

        Args:
            group: shape (n,), a number for each end: only ends of one group are joined.
            point: where the ends lie, shape (n, 2), where that is not ``point``.
        """
        at = self.point if point is None else point
        cut = np.flatnonzero(~self.free)
        node = numbered(group[cut], at[cut, 0], at[cut, 1])
        angle = np.arctan2(self.way[cut, 1].astype(float), self.way[cut, 0].astype(float))
        order = np.lexsort([angle, node])
        sizes = np.bincount(node)[node[order]] if len(node) else node
        first = np.searchsorted(node[order], node[order], side="left")
        opposite = order[first + (np.arange(len(order)) - first + sizes // 2) % np.maximum(sizes, 1)]
        partner = np.full(len(self.free), NONE)
        even = sizes % 2 == 0
        partner[cut[order[even]]] = cut[opposite[even]]
        pair = np.zeros(len(self.free), bool)
        pair[cut[order]] = sizes == 2
        return partner, pair


def ends_of(lines: Outlines, free: NDArray[np.bool_]) -> Ends:
    """Return the ends of open lines; ``free`` has shape (2 n,)."""
    first, last = lines.rings[:-1], lines.rings[1:] - 1
    point = np.stack([lines.points[first], lines.points[last]], axis=1).reshape(-1, 2)
    beside = np.stack([lines.points[first + 1], lines.points[last - 1]], axis=1).reshape(-1, 2)
    return Ends(point, beside - point, free)


@frozen
class Paths:
    """Lines made of copies of lines, end to end.

    Path i is made of the copies ``rows[offsets[i]:offsets[i + 1]]``, run backwards where ``backwards`` says
    so; ``straight`` rows begin between their neighbours on a straight line. ``loop`` tells which paths close.
    """

    lines: Outlines
    which: Index
    shift: Steps
    rows: Index
    backwards: NDArray[np.bool_]
    straight: NDArray[np.bool_]
    offsets: Offsets
    loop: NDArray[np.bool_]

    def sizes(self) -> Offsets:
        """Return how many points each path has, the last of an open one left out."""
        counts = np.diff(self.lines.rings)[self.which[self.rows]] - 1 - self.straight
        return np.diff(np.concatenate([[0], np.cumsum(counts)])[self.offsets])

    def outlines(self, first: int, stop: int) -> Outlines:
        """Return some paths, without names."""
        some = slice(self.offsets[first], self.offsets[stop])
        rows, straight = self.rows[some], self.straight[some]
        members, ends = runs(self.lines.rings, self.which[rows])
        sizes = np.diff(ends)
        place = np.arange(len(members)) - np.repeat(ends[:-1], sizes)
        turn = np.repeat(self.backwards[some], sizes)
        members = np.where(turn, members + np.repeat(sizes, sizes) - 1 - 2 * place, members)
        offsets = self.offsets[first : stop + 1] - self.offsets[first]
        counts = np.diff(np.concatenate([[0], np.cumsum(sizes - 1 - straight)])[offsets])
        # Fewer than three places enclose nothing: there and back is an open line.
        closed = self.loop[first:stop] & (counts >= 3)
        # A row's last point is the next one's first, but at the end of a path.
        keep = np.ones(len(members), bool)
        drop = np.ones(len(rows), bool)
        drop[offsets[1:][~closed] - 1] = False
        keep[ends[1:][drop] - 1] = False
        keep[ends[:-1][straight]] = False
        points = self.lines.points[members[keep]] + np.repeat(self.shift[rows], sizes, axis=0)[keep]
        rings = np.concatenate([[0], np.cumsum(counts + ~closed)])
        return Outlines(points, rings, np.arange(len(rings)), closed)


def paths_of(lines: Outlines, which: Index, shift: Steps, ends: Ends, group: Index) -> Paths:
    """Join copies of open lines where their ends meet.

    Args:
        lines: the lines, in whole steps.
        which: shape (k,), which are copied.
        shift: shape (k, 2), how far each copy is moved.
        ends: of the lines.
        group: shape (k,), a number for each copy: only copies of one group are joined.
    """
    both = (2 * which[:, None] + [0, 1]).ravel()
    mine = Ends(ends.point[both] + np.repeat(shift, 2, axis=0), ends.way[both], ends.free[both])
    partner, pair = mine.partners(np.repeat(group, 2))
    state = np.arange(len(both))
    follower = np.where(partner[state ^ 1] == NONE, state ^ 1, partner[state ^ 1])
    label, rank = cycles(follower)
    size = np.bincount(label, minlength=len(state))[label]
    loop = label != label[state ^ 1]
    # An open path's cycle holds it twice, there and back: it begins at the lesser of its two beginnings.
    begins = np.flatnonzero(~loop & (partner == NONE))
    head = np.full(len(state), len(state))
    np.minimum.at(head, label[begins], begins)
    head = np.where(loop, label, head[label])
    place = (rank - rank[np.minimum(head, len(state) - 1)]) % size
    keep = np.where(loop, label < label[state ^ 1], place < size // 2)
    rows = np.flatnonzero(keep)
    rows = rows[np.lexsort([place[rows], head[rows]])]
    first = np.flatnonzero(np.diff(head[rows], prepend=-1))
    straight = pair[rows] & aligned(mine.way[rows], -mine.way[partner[rows]])
    straight[first] &= loop[rows[first]]
    offsets = np.append(first, len(rows))
    return Paths(lines, which, shift, rows // 2, rows % 2 == 1, straight, offsets, loop[rows[first]])
