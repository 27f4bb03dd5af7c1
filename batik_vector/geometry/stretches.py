"""Polylines read as stretches: straight edges, and smooth runs between corners.

Every smooth run has a *smooth interpretation*: the tangents of a high-order difference through its
vertices, and over every chord the cubic arc between them. Inside, points are complex numbers.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.known import BREAK, UNKNOWN, Known
from batik_vector.geometry.sampling import Array, Indices, Points, thin
from batik_vector.values import frozen

Mask: TypeAlias = NDArray[np.bool_]
Complex: TypeAlias = NDArray[np.complex128]

SAMPLING = 0.02
"""Chord height (mm) that sampled curves are expected to have at most; polygons have far larger ones."""

FLAT = 0.001
"""Vertices this close (mm) to a line through others say nothing: the grid that geometry is kept on."""

Edges = tuple[tuple[float, ...], tuple[float, ...]]
"""Abscissas of upright lines and ordinates of level ones."""
NO_EDGES: Edges = ((), ())

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


@frozen
class Lines:
    """Polylines without their useless vertices; a ring's first vertex is not repeated.

    One item per vertex, and per edge from it to ``after``; the last vertex of an open line has an edge
    of length 0 and follows itself. ``source`` is the number of each vertex among those given.
    """

    at: Complex
    line: Indices
    before: Indices
    after: Indices
    length: Array
    heading: Array
    turn: Array
    end: Mask
    source: Indices


@frozen
class Runs:
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


def ranges(start: Indices, size: Indices) -> Indices:
    """Return the indices of ranges one after another."""
    skip = np.cumsum(size) - size
    return np.asarray(np.arange(int(size.sum())) + np.repeat(start - skip, size))


def flatness(tolerance: float) -> float:
    """Return how far (mm) a vertex may stand off a line and still say nothing."""
    return min(FLAT, tolerance / 5)


def _wrap(angle: Array) -> Array:
    return np.asarray((angle + np.pi) % (2 * np.pi) - np.pi)


def read_lines(
    coords: Points,
    offsets: Indices,
    closed: Mask,
    tolerance: float,
    edges: Edges = NO_EDGES,
    known: Known | None = None,
) -> tuple[Lines, Mask]:
    """Return the polylines, without vertices that say nothing, and the breaks between their stretches.

    Vertices on ``edges`` are breaks, and so are those that are known to be.
    """
    at, line, source = _distinct(coords, offsets, closed)
    flat = flatness(tolerance)
    keep = _bends(at, line, closed, flat) | _on(edges, at)

    def read() -> tuple[Lines, Mask]:
        lines = _lines(at[keep], line[keep], closed, source[keep])
        breaks = _breaks(lines, tolerance)
        if known is not None:
            joint = known.joint[lines.source]
            breaks = np.where(joint == UNKNOWN, breaks, joint == BREAK)
        return lines, breaks | _on(edges, lines.at)

    lines, breaks = read()
    # Where curves change sides they are flat too, and chords get too long there to tell how they bend.
    turn = np.abs(lines.turn)
    height = lines.length * np.maximum(turn, turn[lines.after]) / 8
    coarse = (height > 4 * flat) & ~(breaks & breaks[lines.after])
    edge = np.cumsum(keep) - 1
    edge = np.where(lines.line[edge] == line, edge, np.searchsorted(lines.line, line, "right") - 1)
    again = coarse[edge] & ~keep
    if again.any():
        keep |= again
        lines, breaks = read()
    return lines, breaks


def _on(edges: Edges, at: Complex) -> Mask:
    return np.isin(at.real, edges[0]) | np.isin(at.imag, edges[1])


def _distinct(coords: Points, offsets: Indices, closed: Mask) -> tuple[Complex, Indices, Indices]:
    """Return the vertices, their lines and numbers, none repeated, of those lines that have a length."""
    line = np.repeat(np.arange(len(closed)), np.diff(offsets))
    at = np.ascontiguousarray(coords, float).view(complex).ravel()
    keep = np.ones(len(at), bool)
    keep[1:] = (at[1:] != at[:-1]) | (line[1:] != line[:-1])
    source = np.flatnonzero(keep)
    at, line = at[keep], line[keep]
    bounds = np.flatnonzero(np.r_[True, line[1:] != line[:-1], True]) if len(at) else np.zeros(1, np.intp)
    head, tail = bounds[:-1], bounds[1:] - 1
    keep = np.repeat(tail > head, np.diff(bounds))
    keep[tail[closed[line[head]] & (at[head] == at[tail])]] = False
    return at[keep], line[keep], source[keep]


def _bends(at: Complex, line: Indices, closed: Mask, flat: float) -> Mask:
    """Return which vertices stand off the lines through others."""
    if not len(at):
        return np.ones(0, bool)
    bounds = np.flatnonzero(np.r_[True, line[1:] != line[:-1], True])
    keep = thin(at.view(float).reshape(-1, 2), bounds, flat)
    # Both ends of a line are kept, though a ring may begin amid a straight edge.
    for end in (bounds[:-1], bounds[1:] - 1):
        kept = np.flatnonzero(keep)
        lines = _lines(at[kept], line[kept], closed, kept)
        i = np.searchsorted(kept, end)
        i = i[closed[line[end]] & (np.bincount(line[kept])[line[end]] > 2)]
        way, off = (
            at[kept[lines.after[i]]] - at[kept[lines.before[i]]],
            at[kept[i]] - at[kept[lines.before[i]]],
        )
        part = (way.conj() * off).real / np.maximum(np.abs(way) ** 2, 1e-300)
        keep[kept[i[(np.abs(off - way * part) <= flat) & (part > 0) & (part < 1)]]] = False
    return keep


def _lines(at: Complex, line: Indices, closed: Mask, source: Indices) -> Lines:
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
    return Lines(at, line, before, after, np.abs(edge), heading, turn, end, source)


def _breaks(lines: Lines, tolerance: float) -> Mask:
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


def _straight(lines: Lines, hard: Mask, scale: float) -> Mask:
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


def _regular(lines: Lines) -> Mask:
    """Return the edges that look like those of a regular polygon, with their neighbours."""
    before, after = lines.before, lines.after
    lengths = np.stack([lines.length[before], lines.length, lines.length[after]])
    turns = np.stack([lines.turn[before], lines.turn, lines.turn[after], lines.turn[after[after]]])
    turns *= np.sign(lines.turn)
    alike = lengths.max(axis=0) <= ALIKE * lengths.min(axis=0)
    alike &= turns.max(axis=0) <= ALIKE * turns.min(axis=0)
    return np.asarray(alike & (turns.max(axis=0) <= CORNER) & ~lines.end)


def stretches(lines: Lines, closed: Mask, breaks: Mask) -> tuple[Indices, Indices, Indices, Mask]:
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
    local = ranges(np.zeros(len(size), np.intp), long)
    path = np.repeat(first, long) + (local + np.repeat(shift, long)) % np.repeat(np.maximum(size, 1), long)
    node = breaks[path] | (local == 0)
    final = local == np.repeat(long, long) - 1
    stop = np.flatnonzero((node | final) & (local > 0))
    start = np.flatnonzero(node & ~final)
    return path, start, stop, (closed & ~broken)[lines.line[path[start]]]


def smooth_runs(
    lines: Lines,
    path: Indices,
    start: Indices,
    stop: Indices,
    bent: Mask,
    smooth_ring: Mask,
    scale: float,
    known: Known | None = None,
) -> Runs:
    """Give the bent stretches their smooth interpretation, with the directions that are known."""
    edges = stop[bent] - start[bent]
    size = edges + 1
    vertex = path[ranges(start[bent], size)]
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
    if known is not None:
        told = known.leaving[lines.source[vertex]]
        told[last] = known.arriving[lines.source[vertex[last]]]
        heading = np.where(np.isnan(told), heading, told)
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
    return Runs(dense, travel, pace, np.exp(1j * heading), chord, rise, fall, bend, first, edges)


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
