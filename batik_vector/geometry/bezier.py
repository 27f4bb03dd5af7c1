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

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import GeometryError
from batik_vector.geometry.sampling import Array, Indices, Points, thin

Mask: TypeAlias = NDArray[np.bool_]
Complex: TypeAlias = NDArray[np.complex128]

SAMPLING = 0.02
"""Chord height (mm) that sampled curves are expected to have at most; polygons have far larger ones."""

FLAT = 0.001
"""Vertices this close (mm) to a line through others say nothing: the grid that geometry is kept on."""

CORNER = 0.62
"""A turn sharper than this (radians) is a corner: the circle of 12 vertices turns by 0.52, an octagon by
0.79. Only details whose chords would stand off no more than ``SAMPLING`` may turn faster."""

SUDDEN = 2.2
"""A turn this many times what the turns beside it lead to expect is a corner."""

STRAIGHT = 4.0
"""An edge is straight when an arc of its ends' turns would stand off this many times more than its
neighbours', or than ``SAMPLING`` by a little more."""

ALIKE = 1.25
"""Turns and edges that differ by less than this factor are those of a regular polygon: a circle's."""

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


@dataclass(frozen=True)
class Cubics:
    """Cubic Béziers of several paths, in drawing order.

    ``points`` has shape (m, 4, 2), the control points in mm; path i is
    ``points[offsets[i]:offsets[i + 1]]`` with ``offsets`` of shape (k + 1,). Where ``straight``, shape
    (m,), the control points divide a line into thirds.
    """

    points: Points
    offsets: Indices
    straight: Mask


@dataclass(frozen=True)
class _Lines:
    """Polylines without their useless vertices; a ring's first vertex is not repeated.

    One item per vertex, and per edge from it to ``after``; the last vertex of an open line has an edge
    of length 0 and follows itself.
    """

    at: Complex
    line: Indices
    before: Indices
    after: Indices
    length: Array
    heading: Array
    turn: Array
    end: Mask


@dataclass(frozen=True)
class _Runs:
    """Smooth stretches: items are their vertices, each stretch with both of its ends.

    ``dense`` holds every vertex and after it the middle of the smooth interpretation of the edge that
    leaves it; ``travel`` and ``pace`` the arc length and the affine arc length there. ``rise`` and
    ``fall`` are the slopes of the interpretation over its chord, ``bend`` is their sum. ``first`` vertex
    and number of ``edges`` belong to stretches, all else to vertices and the edges that leave them.
    """

    dense: Complex
    travel: Array
    pace: Array
    tangent: Complex
    chord: Complex
    rise: Array
    fall: Array
    bend: Array
    first: Indices
    edges: Indices


def fit_cubics(coords: Points, offsets: Indices, closed: Mask, tolerance: float) -> Cubics:
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

    Returns:
        The cubics. Neighbours share end points bit for bit. A ring ends where it begins, which is at
        its first corner if it has one. A line without length has no cubics.

    Raises:
        GeometryError: for coordinates or a tolerance that no fit can serve.
    """
    if not (np.isfinite(coords).all() and 0 < tolerance < np.inf):
        raise GeometryError("cannot fit curves to coordinates that are not finite, or without a tolerance")
    closed = np.asarray(closed, bool)
    lines, breaks = _read(coords, np.asarray(offsets, np.intp), closed, tolerance)
    path, start, stop, smooth_ring = _stretches(lines, closed, breaks)
    # A stretch of one edge has no vertices to bend it.
    bent = stop - start > 1
    runs = _runs(lines, path, start, stop, bent, smooth_ring, max(tolerance, SAMPLING))
    a, b, handles, failed = _fit_runs(runs, tolerance)
    position = _ranges(start[bent], runs.edges + 1)
    begin, end = np.concatenate([start[~bent], position[a]]), np.concatenate([stop[~bent], position[b]])
    straight = np.concatenate([np.ones(len(begin) - len(a), bool), failed])
    head, tail = lines.at[path[begin]], lines.at[path[end]]
    points = np.column_stack([head, (head * 2 + tail) / 3, (head + tail * 2) / 3, tail])
    points[~straight, 1:3] = handles[~failed]
    order = np.argsort(begin)
    count = np.bincount(lines.line[path[begin]], minlength=len(closed))
    into = np.concatenate([[0], np.cumsum(count)]).astype(np.intp)
    return Cubics(points[order].view(float).reshape(-1, 4, 2), into, straight[order])


def _ranges(start: Indices, size: Indices) -> Indices:
    """Return the indices of ranges one after another."""
    skip = np.cumsum(size) - size
    return np.asarray(np.arange(int(size.sum())) + np.repeat(start - skip, size))


def _flat(tolerance: float) -> float:
    return min(FLAT, tolerance / 5)


def _wrap(angle: Array) -> Array:
    return np.asarray((angle + np.pi) % (2 * np.pi) - np.pi)


def _read(coords: Points, offsets: Indices, closed: Mask, tolerance: float) -> tuple[_Lines, Mask]:
    """Return the polylines, without vertices that say nothing, and the breaks between their stretches."""
    at, line = _distinct(coords, offsets, closed)
    flat = _flat(tolerance)
    keep = _bends(at, line, closed, flat)
    lines = _lines(at[keep], line[keep], closed)
    breaks = _breaks(lines, tolerance)
    # Where curves change sides they are flat too, and chords get too long there to tell how they bend.
    turn = np.abs(lines.turn)
    height = lines.length * np.maximum(turn, turn[lines.after]) / 8
    coarse = (height > 4 * flat) & ~(breaks & breaks[lines.after])
    edge = np.cumsum(keep) - 1
    edge = np.where(lines.line[edge] == line, edge, np.searchsorted(lines.line, line, "right") - 1)
    again = coarse[edge] & ~keep
    if again.any():
        keep |= again
        lines = _lines(at[keep], line[keep], closed)
        breaks = _breaks(lines, tolerance)
    return lines, breaks


def _distinct(coords: Points, offsets: Indices, closed: Mask) -> tuple[Complex, Indices]:
    """Return the vertices and their lines, none repeated, of those lines that have a length."""
    line = np.repeat(np.arange(len(closed)), np.diff(offsets))
    at = np.ascontiguousarray(coords, float).view(complex).ravel()
    keep = np.ones(len(at), bool)
    keep[1:] = (at[1:] != at[:-1]) | (line[1:] != line[:-1])
    at, line = at[keep], line[keep]
    bounds = np.flatnonzero(np.r_[True, line[1:] != line[:-1], True]) if len(at) else np.zeros(1, np.intp)
    head, tail = bounds[:-1], bounds[1:] - 1
    keep = np.repeat(tail > head, np.diff(bounds))
    keep[tail[closed[line[head]] & (at[head] == at[tail])]] = False
    return at[keep], line[keep]


def _bends(at: Complex, line: Indices, closed: Mask, flat: float) -> Mask:
    """Return which vertices stand off the lines through others."""
    if not len(at):
        return np.ones(0, bool)
    bounds = np.flatnonzero(np.r_[True, line[1:] != line[:-1], True])
    keep = thin(at.view(float).reshape(-1, 2), bounds, flat)
    # Both ends of a line are kept, though a ring may begin amid a straight edge.
    for end in (bounds[:-1], bounds[1:] - 1):
        kept = np.flatnonzero(keep)
        lines = _lines(at[kept], line[kept], closed)
        i = np.searchsorted(kept, end)
        i = i[closed[line[end]] & (np.bincount(line[kept])[line[end]] > 2)]
        way, off = (
            at[kept[lines.after[i]]] - at[kept[lines.before[i]]],
            at[kept[i]] - at[kept[lines.before[i]]],
        )
        part = (way.conj() * off).real / np.maximum(np.abs(way) ** 2, 1e-300)
        keep[kept[i[(np.abs(off - way * part) <= flat) & (part > 0) & (part < 1)]]] = False
    return keep


def _lines(at: Complex, line: Indices, closed: Mask) -> _Lines:
    here = np.arange(len(at))
    first = np.searchsorted(line, line, "left")
    last = np.searchsorted(line, line, "right") - 1
    ring = closed[line]
    before = np.where(here > first, here - 1, np.where(ring, last, here))
    after = np.where(here < last, here + 1, np.where(ring, first, here))
    edge = at[after] - at
    heading = np.angle(edge)
    end = (before == here) | (after == here)
    turn = np.where(end, 0.0, _wrap(heading - heading[before]))
    return _Lines(at, line, before, after, np.abs(edge), heading, turn, end)


def _breaks(lines: _Lines, tolerance: float) -> Mask:
    """Return the vertices at which smooth stretches end: corners, and the ends of straight edges."""
    before, after, length = lines.before, lines.after, lines.length
    turn = np.abs(lines.turn)
    scale = max(tolerance, SAMPLING)
    fine = (turn * np.maximum(length, length[before]) <= 12 * scale) & (turn < 1.4)
    fine &= np.maximum(turn[before], turn[after]) > turn / 2
    hard = lines.end | ((turn > CORNER) & ~fine)
    regular = _regular(lines)
    straight = _straight(lines, hard, scale) & ~regular
    hard |= straight | straight[before]
    # What the bending of the neighbours leads to expect; hard ones have none to tell.
    bending = turn / np.maximum((length + length[before]) / 2, 1e-300)
    left = np.where(hard[before], bending[after], bending[before])
    right = np.where(hard[after], bending[before], bending[after])
    lonely = hard[before] & hard[after]
    expected = (left * length[before] + right * length) / 2
    noise = 0.02 + FLAT / np.maximum(np.minimum(length, length[before]), 1e-300)
    sudden = (turn > SUDDEN * expected + noise) & ~lonely & ~(regular & regular[before])
    sudden &= turn * np.minimum(length, length[before]) > scale
    return np.asarray(hard | sudden)


def _straight(lines: _Lines, hard: Mask, scale: float) -> Mask:
    """Return the edges too long for the turns at their ends to be those of a sampled curve."""
    before, after = lines.before, lines.after
    turn = np.where(hard, 1e9, np.abs(lines.turn))
    bounded = hard & hard[after]
    height = np.where(bounded, 0.0, lines.length * np.minimum(turn, turn[after]) / 8)
    further, nearer = np.where(before == before[before], 0.0, height[before[before]]), height[before]
    usual = np.maximum(
        np.maximum(np.where(before == np.arange(len(before)), 0.0, nearer), further),
        np.maximum(height[after], height[after[after]]),
    )
    return bounded | (height > np.maximum(STRAIGHT * np.minimum(usual, 1.25 * scale), scale / 2))


def _regular(lines: _Lines) -> Mask:
    """Return the edges that look like those of a regular polygon, with their neighbours."""
    before, after = lines.before, lines.after
    lengths = np.stack([lines.length[before], lines.length, lines.length[after]])
    turns = np.stack([lines.turn[before], lines.turn, lines.turn[after], lines.turn[after[after]]])
    turns *= np.sign(lines.turn)
    alike = lengths.max(axis=0) <= ALIKE * lengths.min(axis=0)
    alike &= turns.max(axis=0) <= ALIKE * turns.min(axis=0)
    return np.asarray(alike & (turns.max(axis=0) <= CORNER) & ~lines.end)


def _stretches(lines: _Lines, closed: Mask, breaks: Mask) -> tuple[Indices, Indices, Indices, Mask]:
    """Return the drawing order, rings begun at their first break, and the stretches between breaks.

    Returns:
        ``path``: vertices in drawing order, a ring's first repeated at its end; the first and last
        position in it of every stretch; and which stretches are whole rings without a break.
    """
    size = np.bincount(lines.line, minlength=len(closed))
    first = np.cumsum(size) - size
    index = np.flatnonzero(breaks)
    at = np.searchsorted(index, first)
    begin = np.append(index, -1)[np.minimum(at, len(index))]
    broken = (begin >= first) & (begin < first + size)
    shift = np.where(broken & closed, begin - first, 0)
    long = size + (closed & (size > 0))
    local = _ranges(np.zeros(len(size), np.intp), long)
    path = np.repeat(first, long) + (local + np.repeat(shift, long)) % np.repeat(np.maximum(size, 1), long)
    node = breaks[path] | (local == 0)
    final = local == np.repeat(long, long) - 1
    stop = np.flatnonzero((node | final) & (local > 0))
    start = np.flatnonzero(node & ~final)
    return path, start, stop, (closed & ~broken)[lines.line[path[start]]]


def _runs(
    lines: _Lines, path: Indices, start: Indices, stop: Indices, bent: Mask, smooth_ring: Mask, scale: float
) -> _Runs:
    """Give the bent stretches their smooth interpretation."""
    edges = stop[bent] - start[bent]
    size = edges + 1
    vertex = path[_ranges(start[bent], size)]
    first = np.cumsum(size) - size
    last = first + edges
    at = lines.at[vertex]
    chord, bend = lines.at[lines.after[vertex]] - at, np.abs(lines.turn)[vertex]
    chord[last] = 0
    local = np.arange(len(at)) - np.repeat(first, size)
    heading = _headings(at, bend, local, np.repeat(edges, size), np.repeat(smooth_ring[bent], size))
    single = np.zeros(len(lines.at), bool)
    single[path[start[~bent]]] = True
    for end, edge, far, beyond in (
        (first, first, first + 1, lines.before[vertex[first]]),
        (last, last - 1, last - 1, vertex[last]),
    ):
        inner = lines.heading[vertex[edge]]
        bow = _wrap(inner - heading[far])
        reach = np.where(smooth_ring[bent], np.pi, np.abs(bow) + 2 * scale / np.abs(chord[edge]))
        heading[end] = _end_heading(heading[end], inner, bow, reach, single[beyond], lines.heading[beyond])
    angle = np.angle(chord)
    rise = 2 * np.tan(np.clip(_wrap(heading - angle), -1.4, 1.4) / 2)
    fall = 2 * np.tan(np.clip(_wrap(angle - np.roll(heading, -1)), -1.4, 1.4) / 2)
    # Chords are not expected to stand off farther: what bends more bends beyond their ends.
    height = np.abs(chord) * (np.abs(rise) + np.abs(fall)) / 8
    tame = np.where(_regular(lines)[vertex], 1.0, scale / np.maximum(height, scale))
    rise, fall = rise * tame, fall * tame
    rise[last] = fall[last] = 0
    arc = np.abs(chord) * (1 + (rise**2 + fall**2) / 12)
    middle = at + chord * (0.5 + 0.125j * (rise + fall))
    dense = np.column_stack([at, middle]).ravel()
    bend = np.abs(np.where(np.abs(chord) > 0, rise + fall, 0))
    travel, pace = _halfway(arc), _halfway(np.cbrt(bend * arc * arc))
    return _Runs(dense, travel, pace, np.exp(1j * heading), chord, rise, fall, bend, first, edges)


def _halfway(step: Array) -> Array:
    """Return what steps add up to before each and in its middle, by turns."""
    total = np.cumsum(step)
    return np.column_stack([total - step, total - step / 2]).ravel()


def _end_heading(
    heading: Array, inner: Array, bow: Array, reach: Array, straight: Mask, beyond: Array
) -> Array:
    """Return the directions at the ends of stretches, given those of their first or last chords.

    Nothing beyond an end tells its direction: it is kept near to that of a parabola. A straight edge
    beyond that the curve meets without a kink gives it its own.
    """
    heading = inner + bow + np.clip(_wrap(heading - inner - bow), -reach, reach)
    kink, step = np.abs(_wrap(heading - beyond)), np.abs(_wrap(inner - beyond))
    return np.where(straight & (kink <= 0.35 * step + 0.01), beyond, heading)


def _headings(at: Complex, bend: Array, local: Indices, edges: Indices, ring: Mask) -> Array:
    """Return the direction of the curve in its vertices.

    A chord's direction is nearly the mean of the curve's along it: the integral of the direction is
    known in the vertices, and its derivative by Lagrange's formula through up to five of them is the
    direction there. Where vertices are dense, every second or fourth is taken, to see past rounding.
    """
    origin = np.arange(len(at)) - local
    total, travel = np.cumsum(bend), np.cumsum(np.abs(np.diff(at, prepend=at[:1])))
    stride = np.ones(len(at), np.intp)
    for step in (2, 4):
        low = origin + np.clip(local - 2 * step, 0, np.maximum(edges - 4 * step, 0))
        high = np.minimum(low + 4 * step, origin + edges)
        turned, length = total[high] - total[low], (travel[high] - travel[low]) / (4 * step)
        dense = (turned < 0.5) & (turned * length < 80 * step * FLAT) & (length < 2000 * FLAT)
        stride[dense & (edges >= 5 * step)] = step
    before, behind = local // stride, (edges - local) // stride
    place = np.where(ring, 2, np.clip(2, 4 - behind, before))
    place = np.where(~ring & (edges < 5), np.minimum(local, 4), place)
    index = local[:, None] + (np.arange(5) - place[:, None]) * stride[:, None]
    valid = ring[:, None] | ((index >= 0) & (index <= edges[:, None]))
    index = np.where(ring[:, None], index % edges[:, None], np.clip(index, 0, edges[:, None]))
    point = at[origin[:, None] + index]
    step_ = np.diff(point, axis=1)
    length, angle = np.abs(step_), np.angle(step_)
    angle[:, 1:] = np.cumsum(_wrap(np.diff(angle, axis=1)), axis=1)
    base = angle[:, 0].copy()
    angle[:, 0] = 0
    return np.asarray(base + _derivative(length, angle, place, valid))


def _derivative(length: Array, angle: Array, place: Indices, valid: Mask) -> Array:
    """Return the derivative, at one of five places, of the integral of ``angle`` over ``length``."""
    zero = np.zeros((len(length), 1))
    way = np.hstack([zero, np.cumsum(length, axis=1)])
    value = np.hstack([zero, np.cumsum(length * angle, axis=1)])
    row = np.arange(len(way))
    way -= way[row, place][:, None]
    value -= value[row, place][:, None]
    use = valid & (np.arange(5) != place[:, None])
    result = np.zeros(len(way))
    for j in range(5):
        other = use & (np.arange(5) != j)
        with np.errstate(divide="ignore", invalid="ignore"):
            factor = np.where(other, way / (way - way[:, j : j + 1]), 1.0).prod(axis=1)
            result += np.where(use[:, j], value[:, j] / way[:, j] * factor, 0.0)
    # No wilder than a straight line through the directions of the two nearest chords allows.
    near = np.clip(place - 1, 0, np.minimum(valid.sum(axis=1) - 3, 2))
    middle = way[:, :4] + length / 2
    m0, m1, a0, a1 = middle[row, near], middle[row, near + 1], angle[row, near], angle[row, near + 1]
    guess = a0 - (a1 - a0) * m0 / (m1 - m0)
    reach = np.abs(a1 - a0) / 2
    return np.asarray(np.clip(result, guess - reach, guess + reach))


def _fit_runs(runs: _Runs, tolerance: float) -> tuple[Indices, Indices, Complex, Mask]:
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


def _weights(runs: _Runs, tolerance: float) -> Array:
    """Return how many spans each edge should need: an arc of angle θ is missed by about 2e-5·r·θ⁶."""
    length = np.abs(runs.chord)
    need = (2e-5 * length / tolerance) ** (1 / 6) * runs.bend ** (5 / 6)
    # Inflections bend too little to count, yet have length.
    return np.maximum(need, runs.bend / SPAN_TURN) + 1e-6 * length / tolerance


def _joints(runs: _Runs, weight: Array, tolerance: float) -> Mask:
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


def _needs(runs: _Runs, weight: Array, a: Indices, b: Indices, error: Array) -> tuple[Array, Array]:
    """Return the edges' weights corrected by the errors made, and how many spans each span should be."""
    size = b - a
    edge, head = _ranges(a, size), np.cumsum(size) - size
    need = np.clip(error - ROUNDING, 0.002, 100) ** (1 / 6)
    need = np.maximum(need, np.add.reduceat(runs.bend[edge], head) / SPAN_TURN)
    weight = weight.copy()
    weight[edge] *= np.repeat(need / np.add.reduceat(weight[edge], head), size)
    return weight, need


def _place(runs: _Runs, owner: Indices, weight: Array, count: Indices) -> Mask:
    """Divide every run into its count of spans of equal weight, at the vertices nearest to that."""
    total = np.cumsum(weight)
    base = (total - weight)[runs.first]
    whole = total[runs.first + runs.edges] - base
    share = (total - weight / 2 - base[owner]) / whole[owner]
    bucket = np.floor(share * count[owner] + 1e-6)
    joint = np.append(False, bucket[1:] > bucket[:-1])
    joint[runs.first] = joint[runs.first + runs.edges] = True
    return joint


def _spans(runs: _Runs, joint: Mask, active: Mask) -> tuple[Indices, Indices]:
    """Return the first and last vertices of the spans between joints, of the active runs."""
    begin = np.repeat(active, runs.edges + 1) & joint
    end = begin.copy()
    begin[runs.first + runs.edges] = end[runs.first] = False
    return np.flatnonzero(begin), np.flatnonzero(end)


def _fit(runs: _Runs, a: Indices, b: Indices, tolerance: float) -> tuple[Complex, Array]:
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


def _fit_block(runs: _Runs, a: Indices, b: Indices, tolerance: float) -> tuple[Complex, Array]:
    if not len(a):
        return np.empty((0, 2), complex), np.empty(0)
    size = 2 * (b - a) + 1
    at, own, head = _ranges(2 * a, size), np.repeat(np.arange(len(a)), size), np.cumsum(size) - size
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


def _error(runs: _Runs, power: Complex, at: Indices, own: Indices, u: Array, tolerance: float) -> Array:
    """Return the error in tolerances at every datum and between it and the next.

    The data (vertices and the middles between) must be near the curve, and the curve between data near
    the smooth interpretation of its edge, and near the edge itself.
    """
    c0, c1, c2, c3 = power
    point = c0 + u * (c1 + u * (c2 + u * c3))
    # Vertices left out may be farther off by as much as they stood off their neighbours' line.
    error = np.abs(point - runs.dense[at]) / (tolerance - _flat(tolerance))
    i, middle = np.flatnonzero(own[1:] == own[:-1]), np.flatnonzero(at % 2)
    half = (u[i] + u[i + 1]) / 2
    between = c0[i] + half * (c1[i] + half * (c2[i] + half * c3[i]))
    # A curve that runs backwards between its data has a loop.
    off = np.where(u[i + 1] > u[i], _stray(runs, between, at[i] // 2, tolerance), 1e3)
    error[i] = np.maximum(error[i], off)
    error[middle] = np.maximum(error[middle], _stray(runs, point[middle], at[middle] // 2, tolerance))
    return np.asarray(error)


def _stray(runs: _Runs, point: Complex, edge: Indices, tolerance: float) -> Array:
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
