"""How a curve is traced: from a formula to the polylines that draw it and the rings that bound its region."""

from __future__ import annotations

from collections.abc import Callable
from itertools import compress
from typing import Annotated

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, given
from batik_vector.geometry.curves.base import Curve, knots_of, points_at
from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.paths.sampling import sampled
from batik_vector.geometry.sampling import (
    REFINE_SHARE,
    Array,
    Geometries,
    Indices,
    Points,
    deviation,
    refine,
    thin,
)
from batik_vector.values import frozen

LEAST_CORNERS = 6
"""Vertices that a bent ring keeps however coarse the tolerance."""

STRAIGHT = 1e-12
"""A vertex this near to the line between its neighbours, as a share of the curve's size, lies on it. The last
bits of coordinates are 1e-16 of that size, and a vertex that a bend needs stands off by the tolerance."""

JOINED = 1e-9
"""Ends of a closed curve this near to one another, as a share of its size, are one point."""

LEAST_LEAP = 1e-6
"""Steps of less than this share of a curve's size are not looked into: they show on no cloth."""

TOLERANCES = 1e-12, 1e12

HALVINGS = 40
KEPT = 0.9
"""A step that keeps this much of its length through so many halvings of its parameters is a jump. Where a
curve is only steep, as t^p is at 0, a step shrinks to 2^-40p of its length: below that from p = 1/260 on."""


@frozen
class Trace:
    """A curve as polylines: ``strands`` draw it, ``rings`` bound its region; both use the same vertices.

    Every strand and ring has shape (n, 2); closed ones repeat their first point at the end.
    """

    strands: list[Points]
    rings: list[Points]
    areas: Geometries | None = None
    """The region, where the curve knows it: the rings are its outlines."""


def trace(curve: Curve, tolerance: float | Callable[[Points], Array]) -> Trace:
    """Sample a curve so that no chord stands farther from it than the tolerance.

    Straight edges keep no vertices but their ends; so does the one that closes a curve which ends elsewhere
    than it begins.

    Args:
        curve: the curve, in its own units.
        tolerance: in the curve's units; or a function of points giving it place by place, for curves
            that a map will stretch unevenly (the vertices are then left dense, to be thinned in the
            image).

    Returns:
        The strands and rings, one set for every one of the curve's turns. A ring that stays on one line
        bounds nothing and is left out.

    Raises:
        GeometryError: where the curve jumps, or does not give finite points in the shape asked for.
        TooLargeError: where it would need too many vertices.
    """
    given(curve, Curve, "curve")
    if not callable(tolerance):
        tolerance = given(tolerance, Annotated[float, Between(*TOLERANCES)], "tolerance")
    known = _region(curve, tolerance)
    if known is not None:
        return known
    outline = curve.outline()
    if outline is not None:
        return _outlined(curve, outline, tolerance)
    t, points = _sample(curve, tolerance)
    loops = curve.loops()
    strand = _closed(points) if curve.closed else points
    single = loops == [(0.0, 1.0)]
    strands, rings = [], []
    for angle in curve.turns():
        turned = strand if angle == 0 else strand @ _rotation(float(angle)).T
        strands.append(turned)
        rings += [turned] if single else [_closed(turned[_within(t, loop)]) for loop in loops]
    return Trace(strands, [ring for ring in rings if len(ring) > 3])


def _region(curve: Curve, tolerance: float | Callable[[Points], Array]) -> Trace | None:
    """Trace a curve that knows its region; where a map will stretch it, to the least tolerance anywhere."""
    if callable(tolerance):
        rough = curve.outline()
        if rough is None or curve.region(float(np.inf)) is None:
            return None
        tolerance = float(np.min(tolerance(rough.points)))
    areas = curve.region(tolerance)
    if areas is None:
        return None
    if shapely.is_empty(areas).all():
        raise GeometryError(f"{type(curve).__name__}: its region is empty, expected an area")
    points, ring = shapely.get_coordinates(shapely.get_rings(areas), return_index=True)
    rings = np.split(points, np.flatnonzero(np.diff(ring)) + 1)
    return Trace(rings, rings, areas)


def _outlined(curve: Curve, outline: Outline, tolerance: float | Callable[[Points], Array]) -> Trace:
    """Trace a curve that is made of lines and cubic Béziers, all at once."""
    lines = sampled(outline, tolerance)
    strands, drawn = lines.parts(), lines.lines()
    if not drawn.any():
        raise GeometryError(f"{type(curve).__name__}: draws a mere point, expected a line")
    return Trace(list(compress(strands, drawn)), list(compress(strands, lines.bounding())))


def _sample(curve: Curve, tolerance: float | Callable[[Points], Array]) -> tuple[Array, Points]:
    """Return the parameters and points of the vertices of a curve, from t = 0 to 1."""
    knots = knots_of(curve)
    # A tolerance told place by place is another one on each arc.
    arcs = 1 if callable(tolerance) else curve.arcs()
    t = _refined(curve, knots, arcs, tolerance if callable(tolerance) else tolerance * REFINE_SHARE)
    arc = slice(0, (len(t) - 1) // arcs + 1)
    points = points_at(curve, t)
    if not _size(points):
        raise GeometryError(f"{type(curve).__name__}: at(t) is the same point for every t, expected a line")
    _refuse_jumps(curve, t[arc], points[arc])
    if callable(tolerance):
        return t, points
    given = np.zeros(len(t), bool)
    given[np.searchsorted(t, knots)] = True
    ends = np.array([0, arc.stop], np.intp)
    kept_of_arc = thin(points[arc], ends, tolerance * (1 - REFINE_SHARE), given[arc])
    keep = np.append(np.tile(kept_of_arc[:-1], arcs), True)
    fixed = np.zeros(len(t), bool)
    loops = curve.loops()
    for loop in loops:
        within = _within(t, loop)
        first, last = within.start, within.stop - 1
        fixed[[first, last]] = True
        if keep[within].sum() <= LEAST_CORNERS:
            # So small, or the tolerance so coarse, that the ring would be a sliver: it keeps a shape.
            keep[np.linspace(first, last, LEAST_CORNERS + 1).round().astype(np.intp)] = True
    fixed[[0, -1]] = not (curve.closed and loops == [(0.0, 1.0)])
    kept = _bending(points, np.flatnonzero(keep), fixed)
    return t[kept], points[kept]


def _refined(curve: Curve, knots: Array, arcs: int, tolerance: float | Callable[[Points], Array]) -> Array:
    """Return the parameters of a dense polyline, from t = 0 to 1: those of the first arc, arc by arc."""
    # A few pieces to begin with between breaks, so that no bump hides between the probes.
    starts = _subdivide(knots, 8 if len(knots) > 8 else 32)
    first = starts[: (len(starts) - 1) // arcs + 1]

    def evaluate(_: Indices, t: Array) -> Points:
        return points_at(curve, t)

    _, t = refine(evaluate, np.zeros(len(first) - 1, np.intp), first[:-1], first[1:], tolerance)
    return np.append((t + np.arange(arcs)[:, None] / arcs).ravel(), 1.0)


def _subdivide(knots: Array, parts: int) -> Array:
    inner = knots[:-1, None] + np.diff(knots)[:, None] * np.arange(parts) / parts
    return np.append(inner.ravel(), knots[-1])


def _refuse_jumps(curve: Curve, t: Array, points: Points) -> None:
    """Raise where a curve goes from one place to another without passing between.

    Only steps that a single half makes up are followed, down to where a steep curve would show its middle.
    """
    size = _size(points)
    begin, end = t[:-1], t[1:]
    whole = _length(points[1:] - points[:-1])
    middle = points_at(curve, (begin + end) / 2)
    longer = np.maximum(_length(middle - points[:-1]), _length(points[1:] - middle))
    left = np.flatnonzero((longer > KEPT * whole) & (whole > LEAST_LEAP * size))
    begin, end, a, b, whole = begin[left], end[left], points[:-1][left], points[1:][left], whole[left]
    for _ in range(HALVINGS):
        if not len(begin):
            return
        half = (begin + end) / 2
        middle = points_at(curve, half)
        first = _length(middle - a) >= _length(b - middle)
        begin, end = np.where(first, begin, half), np.where(first, half, end)
        a, b = np.where(first[:, None], a, middle), np.where(first[:, None], middle, b)
        kept = _length(b - a) > KEPT * whole
        begin, end, a, b, whole = begin[kept], end[kept], a[kept], b[kept], whole[kept]
    if len(begin):
        x, y = a[0].tolist(), b[0].tolist()
        raise GeometryError(
            f"{type(curve).__name__}: at(t) jumps from ({x[0]:g}, {x[1]:g}) to ({y[0]:g}, {y[1]:g}) "
            f"at t = {begin[0]:g}, expected one line without gaps"
        )


def _bending(points: Points, kept: Indices, fixed: NDArray[np.bool_]) -> Indices:
    """Return which of the kept vertices do not lie within straight stretches.

    Args:
        points: the dense polyline. Unless its ends are fixed it is a ring, whether or not they meet.
        kept: the vertices to choose from, ascending.
        fixed: which vertices stay whatever they lie on.
    """
    joined = not fixed[-1] and _meet(points)
    around, kept = (points[:-1], kept[:-1]) if joined else (points, kept)
    there = fixed[: len(around)]
    moved = (around != np.roll(around, 1, axis=0)).any(axis=1) | there
    steps = around[moved]
    off = deviation(steps, np.roll(steps, 1, axis=0), np.roll(steps, -1, axis=0))
    bent = there.copy()
    bent[moved] |= off > STRAIGHT * _size(points)
    total = np.cumsum(bent)
    before, after = np.roll(kept, 1), np.roll(kept, -1)
    # How many bends lie between the neighbours of each, round the end for the first and the last.
    within: Indices = np.asarray(total[after] - bent[after] - total[before], np.intp)
    within[[0, -1]] += total[-1]
    needed = ((within > 0) & moved[kept]) | there[kept]
    return np.asarray(kept[needed])


def _within(t: Array, loop: tuple[float, float]) -> slice:
    """Return where the samples of a loop stand among all."""
    first, last = np.searchsorted(t, [loop[0] - 1e-12, loop[1] - 1e-12])
    return slice(int(first), int(last) + 1)


def _closed(points: Points) -> Points:
    """Return a polyline that ends where it begins: moved there over rounding's breadth, or led there."""
    return np.vstack([points[:-1] if _meet(points) else points, points[:1]])


def _meet(points: Points) -> bool:
    """Whether a polyline ends where it begins, but for rounding."""
    return bool(np.hypot(*(points[-1] - points[0])) <= JOINED * _size(points))


def _size(points: Points) -> float:
    # A column after the other: NumPy takes five times as long for both together.
    return max(float(np.ptp(points[:, 0])), float(np.ptp(points[:, 1])))


def _length(steps: Points) -> Array:
    return np.asarray(np.hypot(steps[:, 0], steps[:, 1]))


def _rotation(angle: float) -> Points:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])
