"""Contours: the outlines and centre lines of an ink on the torus, with the cuts at the page's edges undone.

A tile ends at its edges, the cloth does not: what the page cuts goes on at the opposite edge. So the cuts are
left out, and the outline goes on where its twin enters; a mark that lies across a seam is one mark again.
Coordinates run on without a jump; they may leave the page.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from batik_vector.certificate.drawing import Frame
from batik_vector.geometry.outlines import Index, Offsets, Outlines, Steps
from batik_vector.values import frozen

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


@frozen(eq=False)
class Contours:
    """Outlines of areas, their ink on the left, and centre lines.

    Contour i is ``points[starts[i]:starts[i + 1]]``, shape (n, 2), in steps. A closed one does not repeat its
    first point; from its last the way leads to the first moved by ``shift[i]``, which is not nought where it
    closes round the torus alone. ``outline`` tells the outlines of areas from centre lines, and ``half`` is
    how far the ink of a centre line reaches on either side.
    """

    points: Floats
    starts: Offsets
    closed: Mask
    outline: Mask
    shift: Floats
    half: Floats

    def __len__(self) -> int:
        return len(self.closed)

    @property
    def of_point(self) -> Index:
        """The contour of each point."""
        return np.repeat(np.arange(len(self)), np.diff(self.starts))

    @property
    def after(self) -> Index:
        """The point that follows each point: -1 where a line ends."""
        following = np.arange(1, len(self.points) + 1)
        last = self.starts[1:] - 1
        following[last] = np.where(self.closed, self.starts[:-1], -1)
        return following

    def ends(self) -> Floats:
        """Return for each point where the edge that leaves it ends; at the end of a line the point itself."""
        ends = self.points[np.maximum(self.after, 0)]
        last = self.starts[1:] - 1
        ends[last] = np.where(self.closed[:, None], ends[last] + self.shift, self.points[last])
        return ends


def contours(areas: Outlines, lines: Outlines, width: float, frame: Frame, own: Borders) -> Contours:
    """Return an ink's contours.

    Args:
        areas: in steps of the frame, outer rings counter-clockwise, within the page.
        lines: likewise.
        width: the breadth in mm of the ink of a line.
        frame: the page.
        own: borders of marks that run along the seam, as (axis, from, to) in steps: these are no cuts.
    """
    loops = list(_loops(areas, frame, own))
    whole = _uncut(areas, frame, own)
    rings = np.flatnonzero(whole)
    sizes = np.diff(areas.rings)
    kept = areas.points[np.repeat(whole, sizes)]
    points = [kept, *(points for points, _, _ in loops), lines.points]
    counts = np.concatenate([sizes[rings], [len(points) for points, _, _ in loops], np.diff(lines.rings)])
    n, k, m = len(rings), len(loops), len(lines.closed)
    shift = np.zeros((n + k + m, 2))
    if loops:
        shift[n : n + k] = [moved for _, moved, _ in loops]
    closed = np.concatenate([np.ones(n, bool), np.array([shut for *_, shut in loops], bool), lines.closed])
    return Contours(
        np.concatenate(points).astype(np.float64),
        np.concatenate([[0], np.cumsum(counts)]).astype(np.int64),
        closed,
        np.arange(n + k + m) < n + k,
        shift,
        np.where(np.arange(n + k + m) < n + k, 0.0, width * frame.per_mm / 2),
    )


Borders = NDArray[np.int64]
"""Stretches of the seam, (axis, from, to), shape (n, 3)."""


def _cuts(areas: Outlines, frame: Frame, own: Borders) -> Mask:
    """Return which edges, each that leaves a point, are cuts of the page."""
    here = areas.points
    there = np.roll(here, -1, axis=0)
    if len(here):
        there[areas.rings[1:] - 1] = here[areas.rings[:-1]]
    found = np.zeros(len(here), bool)
    for axis, far in ((0, frame.cell.columns), (1, frame.cell.rows)):
        at = here[:, axis]
        rim = np.flatnonzero((at == there[:, axis]) & ((at == 0) | (at == far)))
        middle = (here[rim, 1 - axis] + there[rim, 1 - axis]) / 2
        slip = frame.cell.lattice[axis][1 - axis]
        along = np.where(at[rim] == far, middle - slip, middle) % frame.cell.lattice[1 - axis][1 - axis]
        mine = own[own[:, 0] == axis]
        mine = mine[np.argsort(mine[:, 1], kind="stable")]
        row = np.searchsorted(mine[:, 1], along, side="right") - 1
        border = (row >= 0) & (along < np.append(mine[:, 2], -1)[row])
        found[rim] = ~border
    return found


def _uncut(areas: Outlines, frame: Frame, own: Borders) -> Mask:
    """Return which rings no edge of the page has cut."""
    cuts = _cuts(areas, frame, own)
    return np.asarray(np.bincount(_ring_of(areas)[cuts], minlength=len(areas.closed)) == 0)


def _ring_of(areas: Outlines) -> Index:
    return np.repeat(np.arange(len(areas.closed)), np.diff(areas.rings))


def _chains(areas: Outlines, frame: Frame, own: Borders) -> Iterator[Steps]:
    """Yield what is left of the rings that were cut: polylines from edge to edge of the page."""
    cuts = _cuts(areas, frame, own)
    for ring in np.unique(_ring_of(areas)[cuts]).tolist():
        first, stop = areas.rings[ring : ring + 2]
        points, cut = areas.points[first:stop], np.flatnonzero(cuts[first:stop])
        # From behind the first cut once round, and on to its beginning.
        points = np.roll(points, -(cut[0] + 1), axis=0)
        breaks = [-1, *(cut[1:] - cut[0] - 1).tolist(), len(points) - 1]
        for low, high in pairwise(breaks):
            if high - low > 1:
                yield points[low + 1 : high + 1]


def _loops(areas: Outlines, frame: Frame, own: Borders) -> Iterator[tuple[Steps, Steps, bool]]:
    """Yield the chains joined over the seams: points, the shift with which they close, whether they do."""
    chains = list(_chains(areas, frame, own))
    if not chains:
        return
    begins = frame.canonical(np.array([chain[0] for chain in chains])).tolist()
    ends = frame.canonical(np.array([chain[-1] for chain in chains])).tolist()
    waiting: dict[tuple[int, ...], list[int]] = {}
    for number in reversed(range(len(chains))):
        waiting.setdefault(tuple(begins[number]), []).append(number)
    used = [False] * len(chains)
    for first in range(len(chains)):
        if used[first]:
            continue
        waiting[tuple(begins[first])].remove(first)
        used[first], now, moved, parts = True, first, np.zeros(2, np.int64), [chains[first]]
        while ends[now] != begins[first]:
            following = waiting.get(tuple(ends[now]))
            if not following:
                yield np.concatenate(parts), np.zeros(2, np.int64), False
                break
            after = following.pop()
            moved = moved + chains[now][-1] - chains[after][0]
            used[after], now = True, after
            parts.append(chains[after][1:] + moved)
        else:
            moved = moved + chains[now][-1] - chains[first][0]
            yield np.concatenate(parts)[:-1], moved, True
