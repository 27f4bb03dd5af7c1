"""Rings drawn in by their edges, all rings at once: every edge moves inwards by the same distance, and the
corners go where the moved edges meet.

Edges that come to nothing on the way are left out in the order in which they do, as far as they are
neighbours; others have nothing to do with one another. Where two edges come to meet head on, the ring is
told not to be whole. One that is whole may still cross itself; where it does not, the moving edges passed
each place once, and what is left is the true outline.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Offsets
from batik_vector.values import frozen

Floats = NDArray[np.float64]

BEYOND = 1.05
"""How much farther in than the arc a corner that points inwards may be: one that turns by more than 36° is
cut off where the arc has its middle."""
_CUT = 2.0 / BEYOND**2 - 1.0
"""The cosine of that turn."""
_NEEDLE = 0.02
"""What the cosine of a turn is above -1 at least: beyond 168° corners lie too far off."""
_STRAIGHT = 0.02
"""The sine of a turn: edges that turn by less do not meet well."""
_LEAST = 1e-3
"""Steps: edges of less have no direction."""


@frozen(eq=False)
class Moved:
    """Rings drawn in.

    ``whole`` has for each ring given whether all went well; of one that is not whole there are no corners.
    Of each corner, ``passed`` has where it was after a part of the way, shape (n, 2). Corners that were still
    apart then and are one with it now are in ``merged``, shape (m, 2), and ``into`` has which corner that is,
    ascending.
    """

    x: Floats
    y: Floats
    rings: Offsets
    whole: NDArray[np.bool_]
    passed: Floats
    merged: Floats
    into: Index


class _Edges:
    """Edges as the lines on which they lie, each with the corner at which it begins."""

    def __init__(self, x: Floats, y: Floats, rings: Offsets) -> None:
        self.x, self.y, self.rings = x, y, rings
        right, up = self.after(x) - x, self.after(y) - y
        length = np.sqrt(right * right + up * up)
        self.whole = np.ones(len(rings) - 1, bool)
        self.ring = np.repeat(np.arange(len(rings) - 1), np.diff(rings))
        self.whole[self.ring[length < _LEAST]] = False
        length[length < _LEAST] = 1.0
        self.right, self.up = right / length, up / length
        self._turn()
        cut = np.flatnonzero((self.cross < 0) & (self.dot < _CUT))
        if len(cut):
            self._cut_off(cut)

    def after(self, values: Floats) -> Floats:
        """Return what stands at the point after each."""
        moved = np.empty_like(values)
        moved[:-1] = values[1:]
        moved[self.rings[1:] - 1] = values[self.rings[:-1]]
        return moved

    def _before(self, values: Floats) -> Floats:
        moved = np.empty_like(values)
        moved[1:] = values[:-1]
        moved[self.rings[:-1]] = values[self.rings[1:] - 1]
        return moved

    def _turn(self) -> None:
        """Work out how much each edge turns from the one before: cosine and sine, and where it came from."""
        self.from_right, self.from_up = self._before(self.right), self._before(self.up)
        self.dot = self.right * self.from_right + self.up * self.from_up
        self.cross = self.from_right * self.up - self.from_up * self.right

    def _cut_off(self, at: Index) -> None:
        """Put an edge without length before each of these, half turned."""
        right, up = self.right[at] + self.from_right[at], self.up[at] + self.from_up[at]
        # Turned right round there is no half: any direction will do, since what lies there is not whole.
        length = np.sqrt(right * right + up * up)
        self.whole[self.ring[at[length < _LEAST]]] = False
        length[length < _LEAST] = 1.0
        more = np.bincount(self.ring[at], minlength=len(self.whole))
        self.x, self.y = (np.insert(each, at, each[at]) for each in (self.x, self.y))
        self.right = np.insert(self.right, at, right / length)
        self.up = np.insert(self.up, at, up / length)
        self.ring = np.insert(self.ring, at, self.ring[at])
        self.rings = self.rings + np.concatenate([[0], np.cumsum(more)])
        self._turn()


def moved_in(x: Floats, y: Floats, rings: Offsets, distance: float, part: float = 0.0) -> Moved:
    """Return rings drawn in.

    Args:
        x: of the points, in steps.
        y: likewise.
        rings: where each ring begins, and at last where all end; what is inside lies to their left.
        distance: in steps.
        part: of the distance, after which is told where corners passed.
    """
    edges = _Edges(x, y, rings)
    spread = 1.0 + edges.dot
    edges.whole[edges.ring[spread < _NEEDLE]] = False
    reach = distance / np.maximum(spread, _NEEDLE)
    left = edges.x - (edges.up + edges.from_up) * reach
    above = edges.y + (edges.right + edges.from_right) * reach
    corners = _Corners(edges, left, above, distance, part)
    corners.leave_out()
    whole = edges.whole[edges.ring]
    kept = corners.kept & whole
    sizes = np.bincount(edges.ring[kept], minlength=len(edges.whole))
    ends = np.concatenate([[0], np.cumsum(sizes[edges.whole])])
    merged = np.flatnonzero(corners.late & whole)
    into = (np.cumsum(kept) - 1)[corners.following(merged)]
    order = np.argsort(into, kind="stable")
    return Moved(
        left[kept],
        above[kept],
        ends,
        edges.whole,
        corners.passed[kept],
        corners.passed[merged[order]],
        into[order],
    )


class _Corners:
    """Where edges meet as they move, and which of them come to nothing on the way.

    Of each corner, that at which an edge begins, the place is known where edges have not moved and where they
    have come to the end of their way; in between it goes straight. ``when`` has for each edge after how much
    of the way it has come to nothing, and more than the whole for all others.
    """

    def __init__(self, edges: _Edges, left: Floats, above: Floats, distance: float, part: float) -> None:
        self.edges, self.distance, self.part = edges, distance, part
        self.x, self.y = edges.x, edges.y
        self.left, self.above = left, above
        self.kept, self.late = np.ones(len(left), bool), np.zeros(len(left), bool)
        self.passed = np.empty((len(left), 2))
        self.passed[:, 0] = edges.x + (left - edges.x) * part
        self.passed[:, 1] = edges.y + (above - edges.y) * part
        length = (edges.after(left) - left) * edges.right + (edges.after(above) - above) * edges.up
        self.gone = np.flatnonzero(length <= _LEAST)

    def leave_out(self) -> None:
        """Leave out the edges that come to nothing, one after another where they are neighbours."""
        gone = self.gone
        if not len(gone):
            return
        edges, own = self.edges, np.arange(len(self.left))
        self.x, self.y = edges.x.copy(), edges.y.copy()
        self.before, self.after = own - 1, own + 1
        self.before[edges.rings[:-1]] = edges.rings[1:] - 1
        self.after[edges.rings[1:] - 1] = edges.rings[:-1]
        self.when, seen = np.full(len(own), np.inf), np.empty(len(own), np.intp)
        size = np.diff(edges.rings)
        self._see(gone)
        while len(gone):
            a, b = self.before[gone], self.after[gone]
            mine = self.when[gone]
            first = (mine < self.when[a]) | ((mine == self.when[a]) & (gone < a))
            first &= (mine < self.when[b]) | ((mine == self.when[b]) & (gone < b))
            out = gone[first]
            size -= np.bincount(edges.ring[out], minlength=len(size))
            edges.whole[size < 3] = False
            self.kept[out] = False
            self.late[out] = mine[first] > self.part
            self.when[out] = np.inf
            touched = self._closed(a[first], b[first], mine[first])
            self._see(touched)
            gone = np.concatenate([gone[~first], touched])
            gone = gone[(self.when[gone] < np.inf) & edges.whole[edges.ring[gone]]]
            # Each once.
            seen[gone] = np.arange(len(gone))
            gone = gone[seen[gone] == np.arange(len(gone))]

    def following(self, which: Index) -> Index:
        """Return the edges that are left where others were left out: that after each."""
        if not len(which):
            return which
        found: Index = self.after[which]
        while True:
            out = np.flatnonzero(~self.kept[found])
            if not len(out):
                return found
            found[out] = self.after[found[out]]

    def _see(self, which: Index) -> None:
        """See when edges come to nothing."""
        edges, after = self.edges, self.after[which]
        right, up = edges.right[which], edges.up[which]
        length = (self.left[after] - self.left[which]) * right + (self.above[after] - self.above[which]) * up
        begun = (self.x[after] - self.x[which]) * right + (self.y[after] - self.y[which]) * up
        gone = length <= _LEAST
        self.when[which] = np.where(gone, begun / np.maximum(begun - length, _LEAST), np.inf)

    def _closed(self, a: Index, b: Index, when: Floats) -> Index:
        """Let edges follow one another from then on; return the edges that have another length for it."""
        edges, distance = self.edges, self.distance
        self.after[a], self.before[b] = b, a
        a = self.before[b]
        right_a, up_a, right_b, up_b = edges.right[a], edges.up[a], edges.right[b], edges.up[b]
        cross = right_a * up_b - up_a * right_b
        meet = (cross > _STRAIGHT) & (1.0 + right_a * right_b + up_a * up_b > _NEEDLE)
        edges.whole[edges.ring[b[~meet]]] = False
        cross = np.where(meet, cross, 1.0)
        # How far from the point at which the second begins the line of the first lies, and has come to lie.
        apart = right_a * (edges.y[a] - edges.y[b]) - up_a * (edges.x[a] - edges.x[b])
        for x, y, came in ((self.x, self.y, 0.0), (self.left, self.above, distance)):
            x[b] = edges.x[b] + ((apart + came) * right_b - came * right_a) / cross
            y[b] = edges.y[b] + ((apart + came) * up_b - came * up_a) / cross
        early = b[when <= self.part]
        self.passed[early, 0] = self.x[early] + (self.left[early] - self.x[early]) * self.part
        self.passed[early, 1] = self.y[early] + (self.above[early] - self.y[early]) * self.part
        return np.concatenate([a, b])


def round_one_place(x: Floats, y: Floats, rings: Offsets) -> NDArray[np.bool_]:
    """Return which rings go round the mean of their corners and never back: none of these crosses itself, if
    it turns once in all.
    """
    size = np.diff(rings)
    middle_x, middle_y = (np.repeat(np.add.reduceat(each, rings[:-1]) / size, size) for each in (x, y))
    x, y = x - middle_x, y - middle_y
    last = rings[1:] - 1
    onward = np.empty(len(x), bool)
    onward[:-1] = x[:-1] * y[1:] > y[:-1] * x[1:]
    onward[last] = x[last] * y[rings[:-1]] > y[last] * x[rings[:-1]]
    return np.asarray(np.logical_and.reduceat(onward, rings[:-1]))
