"""From outlines to polylines: curves are divided as a tolerance needs, all at once, and corners stay."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import TooLargeError
from batik_vector.geometry.paths.cubics import evaluated, needed
from batik_vector.geometry.paths.outline import CURVE, LINE, MOVE, Outline
from batik_vector.geometry.sampling import MAX_POINTS, Array, Indices, Points, refine, thin
from batik_vector.values import frozen

Mask = NDArray[np.bool_]

SMOOTH = 0.01
"""Cubics that meet under less than this angle (radians) run on; a sharper joint is a corner and stays."""
DENSER = 1 / 52
"""Share of the tolerance spent on dividing curves, before vertices are chosen among them. A chord may then
pass six and reach the seventh: where it just could not, every other chord would be divided in two."""
JOINED_SHARE = 1e-3
"""Ends of a closed subpath this near, as a share of the tolerance, are one point: files cut off numbers."""
LEAST_CORNERS = 6
"""Vertices that a bent ring keeps however coarse the tolerance."""
FIRST = 12
"""Pieces into which the curves of a subpath are divided at least, before vertices are chosen among them."""
STRAIGHT = 1e-12
"""Edges whose directions differ by less (radians) lie on one line."""


@frozen(eq=False)
class Polylines:
    """Polylines: number i is ``points[offsets[i]:offsets[i + 1]]``; closed ones end where they begin."""

    points: Points
    offsets: Indices
    closed: Mask

    def parts(self) -> list[Points]:
        """Return them one by one, each of shape (n, 2)."""
        return np.split(self.points, self.offsets[1:-1]) if len(self.closed) else []

    def lines(self) -> Mask:
        """Return which of them are no mere points."""
        low, high = (each.reduceat(self.points, self.offsets[:-1]) for each in (np.minimum, np.maximum))
        return np.asarray((high > low).any(axis=1))

    def bounding(self) -> Mask:
        """Return which of them bound a region: closed ones that do not stay on one line."""
        step = np.diff(self.points, axis=0)
        turn = np.abs(step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0])
        length = np.hypot(step[:, 0], step[:, 1])
        bent = np.zeros(len(self.points), bool)
        bent[1:-1] = turn > STRAIGHT * length[:-1] * length[1:]
        # What is between two polylines is no corner of either.
        bent[self.offsets[:-1]] = bent[self.offsets[1:] - 1] = False
        return self.closed & (_counted(bent, self.offsets) > 0)


def sampled(outline: Outline, tolerance: float | Callable[[Points], Array]) -> Polylines:
    """Return an outline as polylines from which it stands off by no more than a tolerance.

    The ends of its lines stay, and the places where its curves turn sharply.

    Args:
        outline: subpaths in any unit.
        tolerance: in that unit; or a function of points, shape (n, 2) → (n,), giving it place by place, for
            what a map will bend: the vertices are then left dense, to be thinned in the image.

    Raises:
        TooLargeError: where it would need too many vertices.
    """
    dense, fixed = _dense(outline.shut(0.0 if callable(tolerance) else JOINED_SHARE * tolerance), tolerance)
    if not callable(tolerance) and len(dense.points):
        keep = thin(dense.points, dense.offsets, tolerance * (1 - DENSER), fixed)
        _keep_shapes(dense, fixed, keep)
        dense = _taken(dense, keep)
    return dense


def _dense(outline: Outline, tolerance: float | Callable[[Points], Array]) -> tuple[Polylines, Mask]:
    """Return an outline as dense polylines, and which of their vertices have to stay."""
    kinds = outline.kinds
    end = np.flatnonzero(kinds == CURVE)
    control = outline.points.take(end[:, None] + np.array([-3, -2, -1, 0]), axis=0)
    owner, at = _divided(control, _least(kinds, end), tolerance)
    # Where each node's points begin: one for a move or a line, for a curve all behind its start.
    count = np.zeros(len(kinds), np.intp)
    count[(kinds == MOVE) | (kinds == LINE)] = 1
    count[end] = np.bincount(owner, minlength=len(end))
    node = np.repeat(np.arange(len(kinds)), count)
    points = outline.points.take(node, axis=0)
    curved = np.flatnonzero(kinds[node] == CURVE)
    whole = at == 1.0
    points[curved[~whole]] = evaluated(control[owner[~whole]], at[~whole])
    fixed = np.zeros(len(node), bool)
    fixed[np.cumsum(count)[_corners(outline, control, end)] - 1] = True
    offsets = np.append(np.flatnonzero(kinds[node] == MOVE), len(node)).astype(np.intp)
    return _clean(Polylines(points, offsets, outline.closed), fixed)


def _least(kinds: NDArray[np.uint8], end: Indices) -> Indices:
    """Return into how many pieces each cubic is divided at least."""
    subpath = np.cumsum(kinds == MOVE) - 1
    segments = np.bincount(subpath[(kinds == LINE) | (kinds == CURVE)], minlength=int((kinds == MOVE).sum()))
    return np.asarray(-(-FIRST // np.maximum(segments[subpath[end]], 1)), np.intp)


def _divided(
    control: Points, least: Indices, tolerance: float | Callable[[Points], Array]
) -> tuple[Indices, Array]:
    """Return the parameters at which cubics are divided, without the starts and with the ends."""
    if callable(tolerance):

        def evaluate(piece: Indices, t: Array) -> Points:
            return evaluated(control[piece], t)

        each = np.arange(len(control))
        begun, rank = _ranked(each, least)
        owner, at = refine(evaluate, begun, (rank - 1) / least[begun], rank / least[begun], tolerance)
        # From the starts of pieces to their ends.
        last = np.append(owner[1:] != owner[:-1], True)[: len(owner)]
        return owner, np.where(last, 1.0, np.append(at[1:], 1.0)[: len(owner)])
    pieces = np.maximum(np.ceil(needed(control, tolerance * DENSER) - 1e-6), least)
    if (total := float(pieces.sum())) > MAX_POINTS:
        raise TooLargeError(f"its curves would need {total:.3g} vertices at this tolerance")
    owner, rank = _ranked(np.arange(len(control)), pieces.astype(np.intp))
    return owner, rank / pieces[owner]


def _ranked(each: Indices, count: Indices) -> tuple[Indices, Indices]:
    """Return things repeated, each as often as said, and for each repeat its number from one on."""
    owner = np.repeat(each, count)
    return owner, np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count) + 1


def _corners(outline: Outline, control: Points, end: Indices) -> Mask:
    """Return at which nodes an outline has vertices that stay: ends of lines, and joints that turn."""
    kinds = outline.kinds
    corner = kinds == LINE
    # Where a line begins.
    corner[np.flatnonzero(kinds == LINE) - 1] = True
    corner[kinds == MOVE] = True
    before = np.flatnonzero(end[1:] == end[:-1] + 3)
    if len(before):
        arriving, leaving = _tangents(control)
        (ax, ay), (bx, by) = arriving[before].T, leaving[before + 1].T
        cross, dot = ax * by - ay * bx, ax * bx + ay * by
        corner[end[before]] = np.abs(np.arctan2(cross, dot)) > SMOOTH
    return np.asarray(corner)


def _tangents(control: Points) -> tuple[Points, Points]:
    """Return the directions in which cubics end and begin; where a handle has no length, of the next one."""
    return -_first_way(control[:, 3], control[:, 2::-1]), _first_way(control[:, 0], control[:, 1:])


def _first_way(start: Points, on: Points) -> Points:
    """Return the ways from starts to the first of three places each that lies elsewhere."""
    way = on[:, 0] - start
    for further in (1, 2):
        still = np.flatnonzero((way[:, 0] == 0) & (way[:, 1] == 0))
        way[still] = on[still, further] - start[still]
    return way


def _clean(lines: Polylines, fixed: Mask) -> tuple[Polylines, Mask]:
    """Leave out points that repeat the one before, but for those of polylines that are a mere point."""
    points = lines.points
    again = np.zeros(len(points), bool)
    again[1:] = (points[1:] == points[:-1]).all(axis=1)
    again[lines.offsets[:-1]] = False
    if not again.any():
        return lines, fixed
    # A corner that is left out hands on that it stays.
    head = np.maximum.accumulate(np.where(again, 0, np.arange(len(points))))
    fixed = fixed.copy()
    np.logical_or.at(fixed, head, fixed)
    count = _counted(~again, lines.offsets)
    again &= np.repeat(count > 1, np.diff(lines.offsets))
    return _taken(lines, ~again), fixed[~again]


def _keep_shapes(lines: Polylines, fixed: Mask, keep: Mask) -> None:
    """Let bent rings keep a shape, in place, where a coarse tolerance would leave them a sliver."""
    first, last = lines.offsets[:-1], lines.offsets[1:] - 1
    straight = _counted(fixed, lines.offsets) > last - first
    low = lines.closed & (_counted(keep, lines.offsets) <= LEAST_CORNERS) & ~straight
    part = np.linspace(0, 1, LEAST_CORNERS + 1)
    keep[np.rint(first[low, None] + (last - first)[low, None] * part).astype(np.intp)] = True


def _taken(lines: Polylines, keep: Mask) -> Polylines:
    """Return polylines with some of their vertices."""
    offsets = np.append(0, np.cumsum(_counted(keep, lines.offsets))).astype(np.intp)
    return Polylines(lines.points[keep], offsets, lines.closed)


def _counted(which: Mask, offsets: Indices) -> Indices:
    """Return how many vertices of each polyline are meant."""
    return np.asarray(np.diff(np.append(0, np.cumsum(which))[offsets]), np.intp)
