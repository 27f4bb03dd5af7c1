"""From outlines to polylines: cubics are sampled to a tolerance, all subpaths of a drawing at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.paths.cubics import evaluated, needed
from batik_vector.geometry.paths.outline import CONTROL, CURVE, MOVE, Outline
from batik_vector.geometry.sampling import REFINE_SHARE, Array, Indices, Points, refine, thin
from batik_vector.values import frozen

LEAST_CORNERS = 6
"""Vertices that a bent subpath keeps however coarse the tolerance."""
STRAIGHT = 1e-9
"""Sine of a turn up to which a subpath goes straight on."""
JOINED = 1e-9
"""Ends of a closed subpath this near to one another, as a share of the drawing's size, are one point."""


@frozen(eq=False)
class Polylines:
    """Subpaths as polylines: number i is ``points[offsets[i]:offsets[i + 1]]``.

    A ``closed`` one repeats its first point at its end.
    """

    points: Points
    offsets: Indices
    closed: NDArray[np.bool_]


def sampled(outline: Outline, tolerance: float | Callable[[Points], Array]) -> Polylines:
    """Return an outline as polylines from which it stands off by no more than a tolerance.

    Straight stretches keep no vertices but those that their neighbours need.

    Args:
        outline: subpaths in any unit.
        tolerance: in that unit; or a function of points, shape (n, 2) → (n,), giving it place by place, for
            what a map will bend: the vertices are then left dense, to be thinned in the image.

    Raises:
        TooLargeError: where it would need too many vertices.
    """
    dense = _dense(outline, tolerance)
    if callable(tolerance) or not len(dense.points):
        return dense
    keep = thin(dense.points, dense.offsets, tolerance * (1 - REFINE_SHARE))
    _spare(keep, dense)
    ends = np.cumsum(keep)[dense.offsets[1:] - 1]
    return Polylines(dense.points[keep], np.append(0, ends).astype(np.intp), dense.closed)


def _dense(outline: Outline, tolerance: float | Callable[[Points], Array]) -> Polylines:
    """Return dense polylines, which know where the outline bends."""
    end = np.flatnonzero(outline.kinds == CURVE)
    control = outline.points[end[:, None] + np.array([-3, -2, -1, 0])]
    piece, t = _parameters(control, tolerance)
    plain = np.flatnonzero(outline.kinds != CONTROL)
    begins = np.flatnonzero(outline.kinds == MOVE)
    first = begins[outline.closed]
    last = np.append(begins[1:], len(outline.kinds)) - 1
    # What closes a subpath comes behind its last point, where that lies elsewhere.
    gap = np.abs(outline.points[last] - outline.points[begins]).max(axis=1, initial=0.0)
    size = float(np.abs(outline.points).max(initial=0.0))
    ends_apart = (gap > JOINED * size)[outline.closed]
    points = outline.points.copy()
    points[last[outline.closed][~ends_apart]] = points[first[~ends_apart]]
    node = np.concatenate([plain, end[piece], last[outline.closed][ends_apart]])
    at = np.concatenate([np.ones(len(plain)), t, np.full(int(ends_apart.sum()), 2.0)])
    places = np.concatenate([points[plain], evaluated(control[piece], t), points[first[ends_apart]]])
    order = np.lexsort((at, node))
    starts = np.flatnonzero(outline.kinds[node[order]] == MOVE)
    return Polylines(places[order], np.append(starts, len(order)).astype(np.intp), outline.closed)


def _parameters(control: Points, tolerance: float | Callable[[Points], Array]) -> tuple[Indices, Array]:
    """Return where cubics are divided between their ends: number of the cubic, parameter."""
    bent = np.arange(len(control))
    fine = tolerance if callable(tolerance) else tolerance * REFINE_SHARE
    if not callable(fine):
        bent = np.flatnonzero(needed(control, fine) > 1)
    curved = control[bent]

    def evaluate(piece: Indices, t: Array) -> Points:
        return evaluated(curved[piece], t)

    begin, finish = np.zeros(len(bent)), np.ones(len(bent))
    piece, t = refine(evaluate, np.arange(len(bent)), begin, finish, fine)
    inner = t > 0
    return bent[piece[inner]], t[inner]


def _spare(keep: NDArray[np.bool_], dense: Polylines) -> None:
    """Let small bent subpaths keep a shape, in place, where a coarse tolerance would leave a sliver."""
    low, high = dense.offsets[:-1], dense.offsets[1:] - 1
    left = np.add.reduceat(keep, low, dtype=np.intp)
    few = np.flatnonzero((left <= LEAST_CORNERS) & (left <= high - low))
    share = np.linspace(0, 1, LEAST_CORNERS + 1)[1:-1]
    at = np.rint(low[few, None] + (high - low)[few, None] * share).astype(np.intp).ravel()
    at = at[~keep[at]]
    (x, y), (along, up) = (dense.points[at + k].T - dense.points[at].T for k in (-1, 1))
    keep[at[np.abs(x * up - y * along) > STRAIGHT * (x * x + y * y + along * along + up * up)]] = True
