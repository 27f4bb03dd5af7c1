"""From cubic Béziers to polylines, the same on both sides of a seam.

A curve is divided evenly in its parameter, by its own shape alone, so that a curve and its twin one
period further are divided alike; and where it crosses an edge of the page, it is divided there, so that
a curve cut at the seam by hand and one that runs across it meet the seam in the same place.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import TooLargeError
from batik_vector.geometry.paths.cubics import bernstein, evaluated, needed, turns_of
from batik_vector.geometry.paths.outline import CURVE, LINE, MOVE, Outline
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

Points = NDArray[np.float64]
Indices = NDArray[np.intp]

SNAP_MM = 1e-6
"""What lies this near an edge of the page is meant to lie on it; floats of a page of metres are off by
some 1e-12 mm, files with six decimals by 5e-7."""
GRID_SNAP_STEPS = 1e-4
"""What lies this near the 1 µm grid lies on it, so that our own files come back to the bit."""
HALVINGS = 60
"""Each halves the stretch in which a crossing lies; past 53 a float has no further halves."""
LEAST_RISE_MM = 3e-6
"""By how much a curve has to turn back for the turn to be a vertex; what rises less has one at its end."""
MAX_PIECES = 10_000
MAX_CURVED = 5_000_000
"""Points that all curves of a drawing may come to; up to polygons they take some 130 bytes each."""
FINER = 3
"""By how much curves that meet an edge of the page are divided more finely, since a chord hides a kink at
the seam that is no sharper than the chord's own turn."""


@frozen(eq=False)
class Lines:
    """Polylines: number i is ``points[offsets[i]:offsets[i + 1]]``, one for each subpath."""

    points: Points
    offsets: Indices


@frozen(eq=False)
class Meetings:
    """Where curves meet the page's edges: number of the cubic, parameter on it, place, whether it crosses.

    Where it does not, it turns back at the edge, or short of it by less than the tolerance.
    """

    cubic: Indices
    at: Points
    place: Points
    crosses: NDArray[np.bool_]


def flattened(outline: Outline, width: float, height: float, tolerance: float) -> Lines:
    """Return an outline as polylines that stand off its curves by no more than a tolerance.

    Args:
        outline: in mm, the page's lower left corner at (0, 0).
        width: of the page, in mm.
        height: of the page, in mm.
        tolerance: in mm.

    Raises:
        TooLargeError: where the curves would come to more than ``MAX_CURVED`` points.
    """
    points = snapped(outline.points, width, height)
    _meet(points, outline.kinds)
    end = np.flatnonzero(outline.kinds == CURVE)
    control = points[end[:, None] + np.array([-3, -2, -1, 0])]
    plain = np.flatnonzero((outline.kinds == MOVE) | (outline.kinds == LINE))
    owner, at, bent = _divided(
        control, _meetings(control, width, height, tolerance), width, height, tolerance
    )
    places = np.concatenate([points[plain], bent])
    node = np.concatenate([plain, end[owner]])
    order = np.lexsort((np.concatenate([np.ones(len(plain)), at]), node))
    begins = np.flatnonzero((outline.kinds == MOVE)[node[order]])
    return Lines(places[order], np.append(begins, len(order)).astype(np.intp))


def snapped(points: Points, width: float, height: float) -> Points:
    """Return points, shape (n, 2), moved to the page's edges and to the grid where they lie all but there."""
    points = points.copy()
    steps = np.rint(points * STEPS_PER_MM)
    near = np.abs(points * STEPS_PER_MM - steps) < GRID_SNAP_STEPS
    points[near] = steps[near] / STEPS_PER_MM
    for axis, far in ((0, width), (1, height)):
        for edge in (0.0, far):
            points[np.abs(points[:, axis] - edge) <= SNAP_MM, axis] = edge
    return points


def _meet(points: Points, kinds: NDArray[np.uint8]) -> None:
    """Let subpaths that all but come back to where they began end there, in place.

    Relative steps miss it by the last bits of their sums, which a fill would take for a crossing.
    """
    begin = np.flatnonzero(kinds == MOVE)
    last = np.append(begin[1:], len(kinds)) - 1
    back = (np.abs(points[last] - points[begin]) <= SNAP_MM).all(axis=1)
    points[last[back]] = points[begin[back]]


def _divided(
    control: Points, meetings: Meetings, width: float, height: float, tolerance: float
) -> tuple[Indices, Points, Points]:
    """Divide cubics evenly between their ends and meetings: (cubic, parameter, place), without the starts."""
    cubics = np.arange(len(control))
    need = needed(control, tolerance)
    ends = control[:, [0, 3]]
    on_edge = ((ends == 0.0) | (ends == np.array([width, height]))).any(axis=(1, 2))
    on_edge[meetings.cubic[meetings.crosses]] = True
    need = np.where(on_edge, FINER * need, need)
    # Spans from one end or meeting to the next.
    owner = np.concatenate([meetings.cubic, cubics])
    stop = np.concatenate([meetings.at, np.ones(len(control))])
    place = np.concatenate([meetings.place, control[:, 3]])
    order = np.lexsort((stop, owner))
    owner, stop, place = owner[order], stop[order], place[order]
    start = np.where(
        np.append(True, owner[1:] != owner[:-1])[: len(owner)], 0.0, np.append(0.0, stop[:-1])[: len(owner)]
    )
    # A hair less than the bound, so that twins whose floats differ in the last bit get the same count.
    pieces = np.clip(np.ceil(need[owner] * (stop - start) - 1e-6), 1, MAX_PIECES).astype(np.intp)
    if (total := int(pieces.sum())) > MAX_CURVED:
        raise TooLargeError(
            f"its curves come to {total:,} points, expected at most {MAX_CURVED:,}: "
            "draw them smaller, or read them with a greater tolerance"
        )
    span = np.repeat(np.arange(len(owner)), pieces)
    rank = np.arange(len(span)) - np.repeat(np.cumsum(pieces) - pieces, pieces) + 1
    at = start[span] + (stop - start)[span] * (rank / pieces[span])
    found = evaluated(control[owner[span]], at)
    last = np.cumsum(pieces) - 1
    at[last], found[last] = stop, place
    return owner[span], at, found


def _meetings(control: Points, width: float, height: float, tolerance: float) -> Meetings:
    """Return where cubics cross the page's edges between their ends, or turn back at them."""
    owners, params, places, kinds = [], [], [], []
    for axis, far in ((0, width), (1, height)):
        for edge in (0.0, far):
            at = control[:, :, axis] - edge
            which = np.flatnonzero((at.min(axis=1) <= tolerance) & (at.max(axis=1) >= -tolerance))
            own, t, crosses = _roots(at[which], tolerance)
            place = evaluated(control[which[own]], t)
            place[crosses | (np.abs(place[:, axis] - edge) <= SNAP_MM), axis] = edge
            owners.append(which[own])
            params.append(t)
            places.append(place)
            kinds.append(crosses)
    owner, at = np.concatenate(owners), np.concatenate(params)
    return Meetings(owner, at, np.concatenate(places), np.concatenate(kinds))


def _roots(coefficients: Points, tolerance: float) -> tuple[Indices, Points, NDArray[np.bool_]]:
    """Return where polynomials in Bernstein form, shape (m, 4), meet zero inside (0, 1): row, place, kind.

    They change their sign there, or else have an extreme no further than a tolerance from it.
    """
    t = turns_of(coefficients)
    value = bernstein(coefficients[:, None, :], t)
    # What begins or ends on the edge does not cross it there, and what turns back at it not at all.
    sign = np.where(np.abs(value) <= SNAP_MM, 0, np.sign(value))
    last = np.maximum.accumulate(np.where(sign != 0, np.arange(t.shape[1]), 0), axis=1)
    own, at = np.nonzero(np.take_along_axis(sign, last, axis=1)[:, :-1] * sign[:, 1:] < 0)
    since = last[own, at]
    low, high = t[own, since], t[own, at + 1]
    rising = value[own, since] < 0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        below = (bernstein(coefficients[own], middle) < 0) == rising
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    rises = np.minimum(np.abs(value - value[:, :1]), np.abs(value - value[:, -1:])) > LEAST_RISE_MM
    turns, which = np.nonzero((np.abs(value) <= tolerance) & rises)
    return (
        np.concatenate([own, turns]),
        np.concatenate([(low + high) / 2, t[turns, which]]),
        np.repeat([True, False], [len(own), len(turns)]),
    )
