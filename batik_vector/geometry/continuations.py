"""Where an edge cut curves: the directions that both halves share.

A tile is cut through the chords of its outlines, and each half is fitted by itself. One half alone cannot
know how the curve goes on: the last chord is a piece of a longer one, and says little of the direction at
its end. So both halves are laid against one another, without the vertex that only the cut has made, and the
smooth interpretation of the whole (see :mod:`batik_vector.geometry.stretches`) gives the direction at the
cut, and those of the vertices beside it. A curve that runs through an edge, or touches it, goes on by itself.

What comes back to its edge without having left it by more than the tolerance stays as it is: a curve could
lie on the edge instead, and cover of it what the other half leaves bare.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.known import BREAK, SMOOTH, Known, nothing_known
from batik_vector.geometry.outlines import Index, Outlines, Steps
from batik_vector.geometry.sampling import Array
from batik_vector.geometry.stretches import (
    CORNER,
    SAMPLING,
    Complex,
    Mask,
    ranges,
    read_lines,
    smooth_runs,
    stretches,
)
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

REACH = 12
"""Vertices that are looked at on each side of a cut."""

TOLD = 4
"""Vertices beside a cut whose direction depends on what lies beyond it."""

ON_CHORD = 1.5
"""A vertex this close (steps) to the line through its neighbours was made by the cut, and rounded."""

NEVER = np.iinfo(np.intp).max

Edges = tuple[tuple[int, int], tuple[int, int]]
"""Abscissas of the upright edges and ordinates of the level ones, in steps."""


@frozen(eq=False)
class Ends:
    """Polylines walked away from where they meet an edge, in steps.

    ``at`` (m, 2) is where they begin, ``way`` (m, REACH, 2) the vertices that follow, of which ``count``
    (m,) are any. ``index`` (m, REACH + 1) has their numbers in the outlines, the first one's first.
    ``forward`` tells whether they are walked as they are drawn, ``closed`` whether of a ring. ``depth`` is
    how far they go from the edge to which they come back, or ``NEVER``; ``on`` (m, 2) tells whether the edge
    is upright, and whether it is level: in a corner it is both.
    """

    at: Steps
    way: Steps
    count: Index
    index: Index
    forward: Mask
    closed: Mask
    depth: Index
    on: Mask

    def __len__(self) -> int:
        return len(self.at)


def together(parts: Sequence[Ends]) -> Ends:
    """Return the ends of several outlines as one; ``index`` is still each one's own."""
    columns = ("at", "way", "count", "index", "forward", "closed", "depth", "on")
    return Ends(*(np.concatenate([getattr(part, name) for part in parts]) for name in columns))


def ends_of(outlines: Outlines, edges: Edges) -> Ends:
    """Return the ends of outlines on edges; what runs along an edge is none."""
    points, rings = outlines.points, outlines.rings
    upright, level = np.isin(points[:, 0], edges[0]), np.isin(points[:, 1], edges[1])
    on = upright | level
    here = np.flatnonzero(on)
    ring = np.searchsorted(rings, here, "right") - 1
    first, size, closed = rings[ring], np.diff(rings)[ring], outlines.closed[ring]
    step = np.arange(1, REACH + 1)
    parts = []
    for sign in (1, -1):
        local = (here - first)[:, None] + sign * step
        valid = np.where(closed[:, None], step < size[:, None], (local >= 0) & (local < size[:, None]))
        index = first[:, None] + local % size[:, None]
        # An end stops at the next edge, whose vertex is the last of it.
        met = on[index] & valid
        stop: Index = np.cumsum(met, axis=1) - met
        valid = np.logical_and.accumulate(valid & (stop == 0), axis=1)
        near = points[index[:, 0]] == points[here]
        along = (near[:, 0] & upright[here]) | (near[:, 1] & level[here])
        keep = valid[:, 0] & ~along
        at, way, count = points[here[keep]], points[index[keep]], valid[keep].sum(axis=1)
        axes = np.column_stack([upright[here[keep]], level[here[keep]]])
        parts.append(
            Ends(
                at,
                way,
                count,
                np.column_stack([here, index])[keep],
                np.full(int(keep.sum()), sign > 0),
                closed[keep],
                _depth(at, way, count, axes),
                axes,
            )
        )
    return together(parts)


def _depth(at: Steps, way: Steps, count: Index, on: Mask) -> Index:
    """Return how far ends go from the edges (``on`` says which axes') on which they stop again."""
    off = np.abs(way - at[:, None])
    last = off[np.arange(len(at)), np.maximum(count, 1) - 1]
    gone = np.where((np.arange(REACH) < count[:, None])[..., None], off, 0).max(axis=1)
    return np.asarray(np.where(on & (last == 0), gone, NEVER).min(axis=1, initial=NEVER))


def known_at(own: Ends, others: Ends, shifts: Steps, size: int, tolerance: float) -> Known | None:
    """Return what the other halves tell of outlines at the ends of their curves.

    Args:
        own: the ends of the outlines.
        others: all ends that may go on where they stop, those of ``own`` among them.
        shifts: shape (s, 2), by which others repeat, in steps; (0, 0) for those that stay.
        size: how many points the outlines have.
        tolerance: of the fit, in mm.
    """
    row, column, shift = _pairs(own, others, shifts)
    shallow = own.depth <= tolerance * STEPS_PER_MM
    if not len(row) and not shallow.any():
        return None
    known = nothing_known(size)
    if len(row):
        _Windows(own, others, row, column, shifts[shift], tolerance).tell(known)
    reach = np.arange(REACH + 1) <= own.count[shallow][:, None]
    known.joint[own.index[shallow][reach]] = BREAK
    return known


def _pairs(own: Ends, others: Ends, shifts: Steps) -> tuple[Index, Index, Index]:
    """Return for each end that goes on straightest into another: its number, the other's, and the shift's."""
    places = (others.at[None] + shifts[:, None]).reshape(-1, 2)
    _, number = np.unique(np.concatenate([own.at, places]), axis=0, return_inverse=True)
    number = number.ravel()
    mine, theirs = number[: len(own)], number[len(own) :]
    order = np.argsort(theirs, kind="stable")
    low, high = (np.searchsorted(theirs[order], mine, side) for side in ("left", "right"))
    row = np.repeat(np.arange(len(own)), high - low)
    found = order[ranges(low, high - low)]
    column, shift = found % max(len(others), 1), found // max(len(others), 1)
    away = _complex(own.way[row, 0] - own.at[row])
    onward = _complex(others.way[column, 0] - others.at[column])
    turn = np.abs(np.angle(-onward / away))
    rings = own.closed[row] & others.closed[column]
    # A ring arrives where its other half leaves.
    good = (turn <= CORNER) & ~(rings & (own.forward[row] == others.forward[column]))
    # What only touches the edge has no other half.
    good &= (_opposed(away, onward) & own.on[row]).any(axis=1)
    row, column, shift, turn = row[good], column[good], shift[good], turn[good]
    order = np.lexsort([column, shift, turn, row])
    row, best = np.unique(row[order], return_index=True)
    return row, column[order][best], shift[order][best]


def _opposed(one: Complex, other: Complex) -> Mask:
    """Return whether steps go to opposite sides of an upright line, and of a level one: shape (m, 2)."""
    return np.column_stack([one.real * other.real < 0, one.imag * other.imag < 0])


def _complex(points: NDArray[np.int64] | Array) -> Complex:
    return np.asarray(points[..., 0] + 1j * points[..., 1])


class _Windows:
    """Both halves of each curve as one polyline, about the place of the cut, which is the origin.

    They are laid so that either half sees the very same numbers.
    """

    def __init__(
        self, own: Ends, others: Ends, row: Index, column: Index, shift: Steps, tolerance: float
    ) -> None:
        self.own, self.row = own, row
        self.mine = _complex(own.way[row] - own.at[row][:, None]) / STEPS_PER_MM
        theirs = _complex(others.way[column] + shift[:, None] - own.at[row][:, None]) / STEPS_PER_MM
        counts = own.count[row], others.count[column]
        near, far = self.mine[:, 0], theirs[:, 0]
        off = np.abs((near.conjugate() * far).imag) / np.maximum(np.abs(near - far), 1e-300)
        made = off <= ON_CHORD / STEPS_PER_MM
        # From the left to the right, or upwards: the same for both halves.
        self.onward = (near.real > far.real) | ((near.real == far.real) & (near.imag > far.imag))
        before = np.where(self.onward, counts[1], counts[0])
        behind = np.where(self.onward, counts[0], counts[1])
        size = before + behind + ~made
        self.offsets = np.concatenate([[0], np.cumsum(size)]).astype(np.intp)
        window = np.repeat(np.arange(len(row)), size)
        place = np.arange(len(window)) - self.offsets[window]
        rank = place - before[window] + (made[window] & (place >= before[window]))
        # Rank 0 is the cut itself, -1 and 1 its neighbours.
        step = np.maximum(np.abs(rank) - 1, 0)
        own_side = (rank > 0) == self.onward[window]
        at = np.where(own_side, self.mine[window, step], theirs[window, step])
        at[rank == 0] = 0
        self.across = _opposed(near, far) & own.on[row]
        self.through = (near - far) * np.where(self.onward, 1, -1)
        self.window, self.rank, self.own_side = window, rank, own_side & (rank != 0)
        self.tolerance = tolerance
        self._read(np.column_stack([at.real, at.imag]))

    def _read(self, coords: Array) -> None:
        closed = np.zeros(len(self.row), bool)
        lines, breaks = read_lines(coords, self.offsets, closed, self.tolerance)
        path, start, stop, smooth_ring = stretches(lines, closed, breaks)
        bent = stop - start > 1
        scale = max(self.tolerance, SAMPLING)
        runs = smooth_runs(lines, path, start, stop, bent, smooth_ring, scale)
        of_run = path[ranges(start[bent], runs.edges + 1)]
        self.lines, self.breaks = lines, breaks
        inner = np.ones(len(of_run), bool)
        inner[runs.first] = inner[runs.first + runs.edges] = False
        self.heading = np.full(len(lines.at), np.nan)
        self.heading[of_run[inner]] = np.angle(runs.tangent[inner])
        # Slopes are those of the edge that leaves a vertex.
        leaves = np.ones(len(of_run), bool)
        leaves[runs.first + runs.edges] = False
        self.rise, self.fall = np.zeros(len(lines.at)), np.zeros(len(lines.at))
        self.rise[of_run[leaves]], self.fall[of_run[leaves]] = runs.rise[leaves], runs.fall[leaves]

    def tell(self, known: Known) -> None:
        """Write down what is known of the points of the outlines."""
        own, row, lines = self.own, self.row, self.lines
        source = lines.source
        told = np.flatnonzero(self.own_side[source] & (np.abs(self.rank[source]) <= TOLD))
        window = self.window[source[told]]
        index = own.index[row[window], np.abs(self.rank[source[told]])]
        turned = np.where(self.onward == own.forward[row], 0.0, np.pi)
        # The far end of a polyline that stops there is none of the curve's.
        true = ~lines.end[told]
        index, told, window = index[true], told[true], window[true]
        known.joint[index] = np.where(self.breaks[told], BREAK, SMOOTH)
        known.arriving[index] = known.leaving[index] = _wrapped(self.heading[told] + turned[window])
        cut, forward = own.index[row, 0], own.forward[row]
        direction = _wrapped(self._inward(self._at_cut()) + turned)
        known.leaving[cut[forward]] = direction[forward]
        known.arriving[cut[~forward]] = direction[~forward]

    def _inward(self, direction: Array) -> Array:
        """Return directions at cuts that lead through the edge, as the line through both neighbours does."""
        back = _opposed(np.exp(1j * direction), self.through) & self.across
        return np.where(back.any(axis=1), np.angle(self.through), direction)

    def _at_cut(self) -> Array:
        """Return the direction of every window at its cut, in which it is laid."""
        lines = self.lines
        begin = np.searchsorted(lines.line, np.arange(len(self.row)))
        here = np.flatnonzero(self.rank[lines.source] == 0)
        vertex = np.full(len(self.row), -1)
        vertex[lines.line[here]] = here
        # Where the cut is no vertex, the last one before it begins the edge that it lies on.
        before = np.add.reduceat((self.rank[lines.source] < 0).astype(np.intp), begin) - 1
        edge = begin + np.maximum(before, 0)
        edge = np.where(vertex >= 0, np.maximum(vertex - 1, begin), edge)
        chord = lines.at[lines.after[edge]] - lines.at[edge]
        part = np.clip(
            (chord.conjugate() * -lines.at[edge]).real / np.maximum(np.abs(chord) ** 2, 1e-300), 0, 1
        )
        rise, fall = self.rise[edge], self.fall[edge]
        slope = (1 - 2 * part) * (rise * (1 - part) + fall * part) + part * (1 - part) * (fall - rise)
        straight = self.breaks[edge] | self.breaks[lines.after[edge]]
        passing = np.angle(chord) + np.where(straight, 0.0, np.arctan(slope))
        at = np.maximum(vertex, 0)
        into, out = lines.heading[lines.before[at]], lines.heading[at]
        bare = self.breaks[lines.before[at]], self.breaks[lines.after[at]]
        standing = np.where(bare[0], into, np.where(bare[1], out, self.heading[at]))
        standing = np.where(self.breaks[at], np.nan, standing)
        return np.asarray(np.where(vertex >= 0, standing, passing))


def _wrapped(angle: Array) -> Array:
    return np.asarray((angle + np.pi) % (2 * np.pi) - np.pi)
