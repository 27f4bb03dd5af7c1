"""Curves through points: straight from one to the next, or smooth, as a cubic spline.

The spline is C² (its bend runs on without a step, as that of a wooden batten) with centripetal parameters:
the step from point to point is the square root of their distance (Lee, "Choosing nodes in parametric curve
interpolation", 1989). Among the common parametrisations it stays nearest to the straight lines between the
points, however unevenly these stand (Floater, "On the deviation of a parametric cubic spline interpolant from
its data polygon", 2008). Catmull-Rom splines would be local, yet a circle through eight points is an octagon
with round corners in them. At its ends and corners the first and last piece are parabolas.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.fields.fitting import shown
from batik_vector.geometry.paths.outline import CONTROL, CURVE, LINE, MOVE, Outline, polyline
from batik_vector.geometry.sampling import Array, Indices, Points


def through(points: Any, smooth: bool, closed: bool, corners: Sequence[int] = ()) -> Outline:
    """Return the curve through points as an outline of one subpath.

    Args:
        points: shape (n, 2). What repeats the point before counts once.
        smooth: a cubic spline, or straight lines.
        closed: leads back to the first point.
        corners: numbers of points at which a smooth curve may turn sharply.

    Raises:
        GeometryError: for points that are not finite, too few of them, and corners that are none.
    """
    points = _finite(points)
    for place, number in enumerate(corners):
        if not -len(points) <= number < len(points):
            raise GeometryError(f"corners = {number} in place {place}, expected 0 to {len(points) - 1}")
    given = len(points)
    points, home = _once(points, closed)
    least = 3 if closed else 2
    if len(points) < least:
        kind = "a closed" if closed else "an open"
        raise GeometryError(
            f"points = a list of {given}, of which {len(points)} differ from the one before, "
            f"expected at least {least} for {kind} curve"
        )
    if not smooth:
        return polyline(points, closed)
    turns = sorted({int(home[number]) for number in corners})
    if closed and not turns:
        return _joined(points, [_periodic(points)], True)
    if closed:
        points = np.roll(points, -turns[0], axis=0)
        points = np.vstack([points, points[:1]])
        turns = [number - turns[0] for number in turns]
    stops = sorted({0, *turns, len(points) - 1})
    parts = [points[a : b + 1] for a, b in itertools.pairwise(stops)]
    return _joined(points, [_open(part) if len(part) > 2 else part[1:, None] for part in parts], closed)


def _finite(given: Any) -> Points:
    """Return points that are right as an array."""
    try:
        points = np.asarray(given, float)
    except (TypeError, ValueError, OverflowError):
        raise GeometryError(f"points = {shown(given)}, expected a list of pairs of numbers") from None
    if not points.size:
        points = points.reshape(0, 2)
    if points.ndim != 2 or points.shape[1:] != (2,):
        raise GeometryError(f"points = an array of shape {points.shape}, expected pairs of numbers: (n, 2)")
    finite = np.isfinite(points).all(axis=1)
    if not finite.all():
        number = int(np.flatnonzero(~finite)[0])
        x, y = points[number].tolist()
        raise GeometryError(f"points = ({x:g}, {y:g}) in place {number}, expected finite numbers")
    return points


def _once(points: Points, closed: bool) -> tuple[Points, Indices]:
    """Return points without repeats of the one before, and which of these each of the given ones is."""
    new = np.append(True, (points[1:] != points[:-1]).any(axis=1))[: len(points)]
    home = np.cumsum(new) - 1
    kept = points[new]
    while closed and len(kept) > 1 and (kept[-1] == kept[0]).all():
        kept = kept[:-1]
    return kept, np.asarray(home % max(len(kept), 1), np.intp)


def _steps(points: Points) -> tuple[Array, Array]:
    """Return centripetal steps, and the slopes over them as complex numbers."""
    leap = points[:, 0] + 1j * points[:, 1]
    leap = np.diff(leap)
    step = np.sqrt(np.abs(leap))
    return step, leap / step


def _open(points: Points) -> Points:
    """Return the cubics through points, shape (n - 1, 3, 2); at either end they are parabolas."""
    step, slope = _steps(points)
    diagonal = 2 * (step[:-1] + step[1:])
    # The bend of the first and of the last piece does not change.
    diagonal[0] += step[0]
    diagonal[-1] += step[-1]
    bend = _solved(step[1:-1], diagonal, 6 * np.diff(slope))
    return _cubics(points, step, slope, np.concatenate([bend[:1], bend, bend[-1:]]))


def _periodic(points: Points) -> Points:
    """Return the closed spline through points as cubics, shape (n, 3, 2)."""
    points = np.vstack([points, points[:1]])
    step, slope = _steps(points)
    before = np.roll(step, 1)
    diagonal = 2 * (before + step)
    right = 6 * (slope - np.roll(slope, 1))
    # Sherman and Morrison: the corners of the cyclic matrix as a product, taken out and brought in again.
    corner = float(step[-1])
    diagonal[[0, -1]] -= corner
    lean = np.zeros(len(step), complex)
    lean[[0, -1]] = corner
    plain, leaned = _solved(step[:-1], diagonal, right), _solved(step[:-1], diagonal, lean)
    bend = plain - leaned * ((plain[0] + plain[-1]) / (1 + leaned[0] + leaned[-1]))
    return _cubics(points, step, slope, np.append(bend, bend[0]))


def _solved(beside: Array, diagonal: Array, right: Array) -> Array:
    """Solve a symmetric tridiagonal system by elimination (Thomas)."""
    side, middle, found = beside.tolist(), diagonal.tolist(), right.tolist()
    for i in range(1, len(middle)):
        share = side[i - 1] / middle[i - 1]
        middle[i] -= share * side[i - 1]
        found[i] -= share * found[i - 1]
    found[-1] /= middle[-1]
    for i in range(len(middle) - 2, -1, -1):
        found[i] = (found[i] - side[i] * found[i + 1]) / middle[i]
    return np.array(found)


def _cubics(points: Points, step: Array, slope: Array, bend: Array) -> Points:
    """Return the pieces of a spline with these second derivatives as Béziers: handles and ends."""
    place = points[:, 0] + 1j * points[:, 1]
    leaving = slope - step * (2 * bend[:-1] + bend[1:]) / 6
    arriving = slope + step * (bend[:-1] + 2 * bend[1:]) / 6
    handles = np.stack([place[:-1] + step * leaving / 3, place[1:] - step * arriving / 3, place[1:]], axis=1)
    return np.stack([handles.real, handles.imag], axis=2)


def _joined(points: Points, parts: Sequence[Points], closed: bool) -> Outline:
    """Return an outline that begins in the first point: of cubics, shape (n, 3, 2), and lines, (1, 1, 2)."""
    kinds = [[LINE] if part.shape[1] == 1 else [CONTROL, CONTROL, CURVE] * len(part) for part in parts]
    return Outline(
        np.concatenate([points[:1], *(part.reshape(-1, 2) for part in parts)]),
        np.array([MOVE, *itertools.chain(*kinds)], np.uint8),
        np.array([closed]),
    )
