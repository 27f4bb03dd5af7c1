"""Cubic Béziers through polylines: tens of nodes that a designer can edit, in place of thousands.

Schneider's least squares (Graphics Gems, 1990, "An algorithm for automatically fitting digitized
curves"), for all spans of all polylines at once. What differs from his paper:

* A polyline is first cut into *stretches*: straight edges, and smooth runs between corners.
* Every smooth run has a *smooth interpretation*: the tangents of a high-order difference through its
  vertices, and over every chord the cubic arc between them. It is what is fitted and checked against,
  in the vertices and between them.
* A run is not halved until it fits: its joints are placed so that all of its spans err alike, as few as
  keep the tolerance. A cubic's error grows as the sixth power of its length, so that a span of error e
  counts for (e / tolerance)^⅙ spans.

Inside, points are complex numbers: a dot product is ``(a.conjugate() * b).real``.
"""

from __future__ import annotations

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.geometry.known import Known
from batik_vector.geometry.sampling import Array, Indices, Points
from batik_vector.geometry.stretches import (
    NO_EDGES,
    SAMPLING,
    Complex,
    Edges,
    Mask,
    Runs,
    flatness,
    ranges,
    read_lines,
    smooth_runs,
    stretches,
)
from batik_vector.values import frozen

SPAN_TURN = 2.6
"""No cubic is planned to turn by more (radians), though one that fits may."""

ROUNDS = 7
"""How often joints are moved: later rounds seldom save a cubic."""

FITS = 4
"""Least squares solutions, each followed by two Newton steps towards the nearest parameters."""

ALONG = 1e-4
"""Weight of errors along the curve against errors across it, once the parameters are near: only the
latter are errors, but where the curve is straight nothing else would place the handles."""

STEP = 2.5
"""Handles change by at most this factor from one solution to the next."""

EVEN = 0.3
"""First parameters go by affine arc length ∫ κ^⅓ ds, a parabola's own parameter, with this share of
plain arc length, for the sake of inflections."""

ROUNDING = 0.1
"""Errors below this part of the tolerance come from the sampling; fewer spans would not enlarge them."""

BLOCK = 16384
"""How many data are fitted at a time: what a processor's cache holds."""


@frozen
class Cubics:
    """Cubic Béziers of several paths, in drawing order.

    ``points`` has shape (m, 4, 2), the control points in mm; path i is
    ``points[offsets[i]:offsets[i + 1]]`` with ``offsets`` of shape (k + 1,). Where ``straight``, shape
    (m,), the control points divide a line into thirds.
    """

    points: Points
    offsets: Indices
    straight: Mask


def fit_cubics(
    coords: Points,
    offsets: Indices,
    closed: Mask,
    tolerance: float,
    edges: Edges = NO_EDGES,
    known: Known | None = None,
) -> Cubics:
    """Fit cubic Béziers to polylines and rings.

    Corners stay nodes and long straight edges stay straight; all other joints share their tangent, save
    where a bend finer than the sampling is left as its chord. The fit keeps within the tolerance of every
    vertex, and between vertices of the smooth curve that they suggest: it stands off the polyline by no
    more than the tolerance beyond the chord's own height, and by no more than 1.5 times the tolerance
    where that height is below the tolerance. This is checked at four places of every edge.

    Args:
        coords: shape (n, 2), mm: vertices on smooth curves and corners between, line after line.
        offsets: shape (k + 1,): line i is ``coords[offsets[i]:offsets[i + 1]]``.
        closed: shape (k,): which lines are rings; these repeat their first point at the end.
        tolerance: mm. Fewer cubics the larger it is, as its sixth root.
        edges: lines (mm) on which every vertex stays a node: those along which a tile was cut, where the
            curve must meet its other half.
        known: what is known of vertices beyond what the lines themselves show.

    Returns:
        The cubics. Neighbours share end points bit for bit. A ring ends where it begins, which is at
        its first corner if it has one. A line without length has no cubics.

    Raises:
        GeometryError: for coordinates or a tolerance that no fit can serve.
    """
    if not (np.isfinite(coords).all() and 0 < tolerance < np.inf):
        raise GeometryError("cannot fit curves to coordinates that are not finite, or without a tolerance")
    closed = np.asarray(closed, bool)
    lines, breaks = read_lines(coords, np.asarray(offsets, np.intp), closed, tolerance, edges, known)
    path, start, stop, smooth_ring = stretches(lines, closed, breaks)
    # A stretch of one edge has no vertices to bend it.
    bent = stop - start > 1
    runs = smooth_runs(lines, path, start, stop, bent, smooth_ring, max(tolerance, SAMPLING), known)
    a, b, handles, failed = _fit_runs(runs, tolerance)
    position = ranges(start[bent], runs.edges + 1)
    begin, end = np.concatenate([start[~bent], position[a]]), np.concatenate([stop[~bent], position[b]])
    straight = np.concatenate([np.ones(len(begin) - len(a), bool), failed])
    head, tail = lines.at[path[begin]], lines.at[path[end]]
    points = np.column_stack([head, (head * 2 + tail) / 3, (head + tail * 2) / 3, tail])
    points[~straight, 1:3] = handles[~failed]
    order = np.argsort(begin)
    count = np.bincount(lines.line[path[begin]], minlength=len(closed))
    into = np.concatenate([[0], np.cumsum(count)]).astype(np.intp)
    return Cubics(points[order].view(float).reshape(-1, 4, 2), into, straight[order])


def _fit_runs(runs: Runs, tolerance: float) -> tuple[Indices, Indices, Complex, Mask]:
    """Fit all runs.

    Returns:
        For every span in drawing order: its first and last vertex, its two handles, shape (s, 2), and
        whether it was given up: only spans of one edge are, which then are straight.
    """
    weight = _weights(runs, tolerance)
    total = np.cumsum(weight)
    a, b = _spans(runs, _joints(runs, weight, tolerance), np.ones(len(runs.first), bool))
    done: list[tuple[Indices, Indices, Complex, Mask]] = []
    while len(a) or not done:
        handles, error = _fit(runs, a, b, tolerance)
        bad = error > 1
        stay = ~bad | (b - a == 1)
        done.append((a[stay], b[stay], handles[stay], bad[stay]))
        a, b = a[~stay], b[~stay]
        half = np.searchsorted(total, (total[a] - weight[a] + total[b - 1]) / 2)
        half = np.clip(half, a + 1, b - 1)
        a, b = np.concatenate([a, half]), np.concatenate([half, b])
    a, b, handles, bad = (np.concatenate(parts) for parts in zip(*done, strict=True))
    order = np.argsort(a)
    return a[order], b[order], handles[order], bad[order]


def _weights(runs: Runs, tolerance: float) -> Array:
    """Return how many spans each edge should need: an arc of angle θ is missed by about 2e-5·r·θ⁶."""
    length = np.abs(runs.chord)
    need = (2e-5 * length / tolerance) ** (1 / 6) * runs.bend ** (5 / 6)
    # Inflections bend too little to count, yet have length.
    return np.maximum(need, runs.bend / SPAN_TURN) + 1e-6 * length / tolerance


def _joints(runs: Runs, weight: Array, tolerance: float) -> Mask:
    """Choose the vertices where spans meet, so that the spans of a run err alike and are few."""
    runs_n, never = len(runs.first), np.iinfo(np.intp).max
    owner = np.repeat(np.arange(runs_n), runs.edges + 1)
    joint = np.zeros(len(owner), bool)
    best, active = np.full(runs_n, never), np.ones(runs_n, bool)
    # What ends where it begins takes two cubics: handles alone are no shape to edit.
    least = 1 + (runs.dense[2 * runs.first] == runs.dense[2 * (runs.first + runs.edges)])
    count = np.maximum(np.ceil(np.bincount(owner, weight, runs_n) - 1e-6).astype(np.intp), least)
    for late in range(ROUNDS):
        if not active.any():
            break
        trial = _place(runs, owner, weight, count)
        a, b = _spans(runs, trial, active)
        _, error = _fit(runs, a, b, tolerance)
        worst = np.zeros(runs_n)
        np.maximum.at(worst, owner[a], error)
        spans = np.bincount(owner[a], minlength=runs_n)
        better = active & (worst <= 1) & (spans < best)
        joint = np.where((active & (better | (best == never)))[owner], trial, joint)
        best = np.where(better, spans, best)
        weight, need = _needs(runs, weight, a, b, error)
        wanted = np.ceil(1.02 * np.bincount(owner[a], need, runs_n)).astype(np.intp)
        count = np.where(worst <= 1, np.minimum(wanted, spans - 1), np.maximum(wanted, spans + (late > 0)))
        active &= (count >= least) & (count < best)
    return joint


def _needs(runs: Runs, weight: Array, a: Indices, b: Indices, error: Array) -> tuple[Array, Array]:
    """Return the edges' weights corrected by the errors made, and how many spans each span should be."""
    size = b - a
    edge, head = ranges(a, size), np.cumsum(size) - size
    need = np.clip(error - ROUNDING, 0.002, 100) ** (1 / 6)
    need = np.maximum(need, np.add.reduceat(runs.bend[edge], head) / SPAN_TURN)
    weight = weight.copy()
    weight[edge] *= np.repeat(need / np.add.reduceat(weight[edge], head), size)
    return weight, need


def _place(runs: Runs, owner: Indices, weight: Array, count: Indices) -> Mask:
    """Divide every run into its count of spans of equal weight, at the vertices nearest to that."""
    total = np.cumsum(weight)
    base = (total - weight)[runs.first]
    whole = total[runs.first + runs.edges] - base
    share = (total - weight / 2 - base[owner]) / whole[owner]
    bucket = np.floor(share * count[owner] + 1e-6)
    joint = np.append(False, bucket[1:] > bucket[:-1])
    joint[runs.first] = joint[runs.first + runs.edges] = True
    return joint


def _spans(runs: Runs, joint: Mask, active: Mask) -> tuple[Indices, Indices]:
    """Return the first and last vertices of the spans between joints, of the active runs."""
    begin = np.repeat(active, runs.edges + 1) & joint
    end = begin.copy()
    begin[runs.first + runs.edges] = end[runs.first] = False
    return np.flatnonzero(begin), np.flatnonzero(end)


def _fit(runs: Runs, a: Indices, b: Indices, tolerance: float) -> tuple[Complex, Array]:
    """Fit one cubic to each span from vertex ``a`` to vertex ``b``.

    Returns:
        The two handles, shape (s, 2), and the error in tolerances, shape (s,).
    """
    block = np.cumsum(2 * (b - a) + 1) // BLOCK
    cuts = np.flatnonzero(block[1:] > block[:-1]) + 1
    parts = [
        _fit_block(runs, i, j, tolerance) for i, j in zip(np.split(a, cuts), np.split(b, cuts), strict=True)
    ]
    return np.concatenate([handles for handles, _ in parts]), np.concatenate([error for _, error in parts])


def _fit_block(runs: Runs, a: Indices, b: Indices, tolerance: float) -> tuple[Complex, Array]:
    if not len(a):
        return np.empty((0, 2), complex), np.empty(0)
    size = 2 * (b - a) + 1
    at, own, head = ranges(2 * a, size), np.repeat(np.arange(len(a)), size), np.cumsum(size) - size
    data, travel = runs.dense[at], runs.travel[2 * b] - runs.travel[2 * a]
    pace = np.maximum(runs.pace[2 * b] - runs.pace[2 * a], 1e-300)
    u = (runs.pace[at] - runs.pace[2 * a][own]) / pace[own]
    u = (u + EVEN * (runs.travel[at] - runs.travel[2 * a][own]) / travel[own]) / (1 + EVEN)
    u[head + size - 1] = 1.0
    ends, tangents = (runs.dense[2 * a], runs.dense[2 * b]), (runs.tangent[a], -runs.tangent[b])
    frame: Complex = np.ones(len(at), complex)
    length = np.stack([travel, travel]) / 3
    for late in range(FITS):
        solved = _lengths(data, u, own, head, ends, tangents, frame, ALONG if late else 1.0)
        solved = np.where(np.isfinite(solved), solved, length)
        low, high = np.maximum(length / STEP, 0.02 * travel), np.minimum(length * STEP, 1.2 * travel)
        length = np.clip(solved, low, high)
        handles = np.stack(ends) + length * np.stack(tangents)
        power = _powers(ends[0], handles[0], handles[1], ends[1])[:, own]
        u, frame = _newton(power, data, u)
    error = _error(runs, power, at, own, u, tolerance)
    return handles.T, np.maximum.reduceat(error, head)


def _lengths(
    data: Complex,
    u: Array,
    own: Indices,
    head: Indices,
    ends: tuple[Complex, Complex],
    tangents: tuple[Complex, Complex],
    frame: Complex,
    along: float,
) -> Array:
    """Solve for the lengths of both handles, shape (2, s): Schneider's normal equations, 2×2 per span.

    Errors are measured in the frame of the curve's unit tangents: all across it, ``along`` of the rest.
    """
    v = 1 - u
    late = u * u * (3 - 2 * u)
    rest = data - (ends[0][own] * (1 - late) + ends[1][own] * late)
    frame = frame.conj()
    one, two, rest = frame * tangents[0][own], frame * tangents[1][own], frame * rest
    one *= 3 * u * v * v
    two *= 3 * u * u * v

    def dot(p: Complex, q: Complex) -> Array:
        return np.asarray(p.imag * q.imag + along * (p.real * q.real))

    rows = np.stack([dot(one, one), dot(one, two), dot(two, two), dot(one, rest), dot(two, rest)])
    s11, s12, s22, r1, r2 = np.add.reduceat(rows, head, axis=1)
    det = s11 * s22 - s12 * s12
    det[det <= 1e-12 * s11 * s22] = np.nan
    return np.asarray(np.stack([r1 * s22 - r2 * s12, r2 * s11 - r1 * s12]) / det)


def _powers(p0: Complex, p1: Complex, p2: Complex, p3: Complex) -> Complex:
    """Return the coefficients of 1, u, u², u³."""
    return np.stack([p0, 3 * (p1 - p0), 3 * (p0 - 2 * p1 + p2), p3 - p0 + 3 * (p1 - p2)])


def _newton(power: Complex, data: Complex, u: Array) -> tuple[Array, Complex]:
    """Move parameters towards the points nearest to the data; return them and the unit tangents there."""
    c0, c1, c2, c3 = power
    inner = (u > 0) & (u < 1)
    speed = c1 + u * (2 * c2 + u * (3 * c3))
    for _ in range(2):
        off = c0 + u * (c1 + u * (c2 + u * c3)) - data
        square = speed.real**2 + speed.imag**2
        slope = square + ((2 * c2 + u * (6 * c3)).conj() * off).real
        step = (speed.conj() * off).real / np.where(slope > square / 4, slope, np.maximum(square, 1e-300))
        u = np.where(inner, np.clip(u - step, 1e-9, 1 - 1e-9), u)
        speed = c1 + u * (2 * c2 + u * (3 * c3))
    return u, speed / np.maximum(np.abs(speed), 1e-300)


def _error(runs: Runs, power: Complex, at: Indices, own: Indices, u: Array, tolerance: float) -> Array:
    """Return the error in tolerances at every datum and between it and the next.

    The data (vertices and the middles between) must be near the curve, and the curve between data near
    the smooth interpretation of its edge, and near the edge itself.
    """
    c0, c1, c2, c3 = power
    point = c0 + u * (c1 + u * (c2 + u * c3))
    # Vertices left out may be farther off by as much as they stood off their neighbours' line.
    error = np.abs(point - runs.dense[at]) / (tolerance - flatness(tolerance))
    i, middle = np.flatnonzero(own[1:] == own[:-1]), np.flatnonzero(at % 2)
    half = (u[i] + u[i + 1]) / 2
    between = c0[i] + half * (c1[i] + half * (c2[i] + half * c3[i]))
    # A curve that runs backwards between its data has a loop.
    off = np.where(u[i + 1] > u[i], _stray(runs, between, at[i] // 2, tolerance), 1e3)
    error[i] = np.maximum(error[i], off)
    error[middle] = np.maximum(error[middle], _stray(runs, point[middle], at[middle] // 2, tolerance))
    return np.asarray(error)


def _stray(runs: Runs, point: Complex, edge: Indices, tolerance: float) -> Array:
    """Return how far points are from their edges and the arcs over them, in parts of what is allowed.

    From an edge that is the tolerance and the height of its arc, but no more than 1.5 times the tolerance
    unless the arc alone stands off that far: then it is half the tolerance and the height.
    """
    chord, rise, fall = runs.chord[edge], runs.rise[edge], runs.fall[edge]
    length = np.abs(chord)
    point = (point - runs.dense[2 * edge]) * chord.conj() / length
    part = np.clip(point.real / length, 0, 1)
    beyond = point.real - part * length
    arc = length * part * (1 - part) * (rise * (1 - part) + fall * part)
    height = length * (np.abs(rise) + np.abs(fall)) / 8
    allowed = tolerance / 2 + np.maximum(tolerance / 2 + np.minimum(height, tolerance / 2), height)
    off = np.hypot(beyond, point.imag - arc) / tolerance
    return np.asarray(np.maximum(off, np.hypot(beyond, point.imag) / allowed))
