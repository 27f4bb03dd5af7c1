"""Rows of G-code: strokes as text, a row for each move, in bulk."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.export.numbers import (
    WORD,
    Characters,
    Room,
    Style,
    Words,
    beside,
    digits,
    room_for,
    spelling,
    text,
    word,
)
from batik_vector.geometry.arc_fitting import PARTS, fit_arcs
from batik_vector.geometry.outlines import Index, Offsets, Outlines, Steps
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

LINE, CLOCKWISE, COUNTER = 1, 2, 3
"""Motions by the numbers of their words."""
_MOTION = np.array([LINE, COUNTER, CLOCKWISE], np.uint8)
"""By the turn of an arc: 0, 1, and -1, which counts from the end."""
_PER_MM = STEPS_PER_MM * PARTS
_CENTRE_WORDS = 6
"""What I and J fill: twelve characters each."""


@frozen
class Moves:
    """Strokes as moves.

    ``points`` has shape (n, 2), steps: stroke i begins at ``points[strokes[i]]``, and its moves lead to the
    points from there to ``strokes[i + 1]``, each by the motion of ``motions[j]``. Where that is an arc,
    ``centres[j]`` is its centre, in tenths of a step from where it begins.
    """

    points: Steps
    strokes: Offsets
    motions: NDArray[np.uint8]
    centres: NDArray[np.int64]


def straight_moves(strokes: Outlines) -> Moves:
    """Return strokes (one ring or polyline to a mark, no move without length) as straight moves."""
    points, ends = strokes.repeating()
    return Moves(points, ends, np.full(len(points), LINE, np.uint8), np.zeros_like(points))


def with_arcs(moves: Moves, tolerance: float, sampling: float) -> Moves:
    """Return moves with arcs where they fit, see :func:`fit_arcs`; both distances in steps."""
    found = fit_arcs(moves.points, moves.strokes, tolerance, sampling)
    starts = np.searchsorted(found.nodes, moves.strokes[:-1])
    return Moves(
        moves.points[found.nodes],
        np.append(starts, len(found.nodes)),
        _MOTION[found.turns],
        found.centres,
    )


def joined(moves: Moves) -> Moves:
    """Return moves with one stroke for those of which each begins where the one before it ended."""
    begin = moves.strokes[1:-1]
    on = (moves.points[begin] == moves.points[begin - 1]).all(axis=1)
    if not on.any():
        return moves
    stays = np.ones(len(moves.points), bool)
    stays[begin[on]] = False
    left = np.cumsum(np.append(0, stays))
    starts = moves.strokes[np.append(True, np.append(~on, True))]
    return Moves(moves.points[stays], left[starts], moves.motions[stays], moves.centres[stays])


@frozen
class Between:
    """What stands between the moves: line feed first, the last of each without one behind.

    ``travel`` leads to the start of a stroke and ends with the word of the rapid move; ``lower`` stands
    behind it; ``feed`` is what follows the word of the first cut. Where ``motion`` is not 0, a stroke goes on
    from where the tool is, down, and in that motion: it needs none of these.
    """

    travel: bytes
    lower: bytes
    feed: bytes
    motion: int = 0


def spelled(moves: Moves, first: Between, others: Between) -> bytes:
    """Return moves as text, each line begun by its line feed.

    Args:
        moves: of at least one stroke.
        first: what stands around the first stroke's start.
        others: what stands around the starts of the others.
    """
    on = first.motion > 0
    starts = moves.strokes[:-1]
    runs = np.append(np.stack([starts, starts + 1], axis=1).ravel(), moves.strokes[-1])
    points, motions, centres = moves.points, moves.motions, moves.centres
    if on:
        points, motions, centres, runs = points[1:], motions[1:], centres[1:], runs[1:] - 1
    heads = _heads(motions[runs[:-1]], first, others)
    arcs = np.flatnonzero(motions != LINE)
    across, up = (spelling(points[:, axis], Style.SHORT, "XY"[axis]) for axis in (0, 1))
    plain = across.words + up.words + 2
    width = plain + (_CENTRE_WORDS if len(arcs) else 0)
    room = np.zeros(len(runs) - 1, np.int64)
    for which, head in heads:
        room[which] = room_for(len(head), width)
    layout = Room(runs, room)
    rows: Words = np.zeros((len(layout.source), width), WORD)
    rows[:, 0] = _motion_words(motions, runs).take(layout.source)
    placed = points.take(layout.source, axis=0)
    at = across.put(rows, 1, placed[:, 0])
    rows[:, at] = word(" ")
    up.put(rows, at + 1, placed[:, 1])
    if len(arcs):
        rows[layout.row_of(arcs), plain:] = _centres(centres[arcs])
    for which, head in heads:
        layout.put(rows, which, beside(len(which), head))
    return text(rows)


def _heads(motions: NDArray[np.uint8], first: Between, others: Between) -> list[tuple[Index, bytes]]:
    """Return which runs have which heads: starts of strokes, and what follows them, by its first motion."""
    run = np.arange(len(motions))
    cut = run % 2 == (0 if first.motion else 1)
    early = run < (1 if first.motion else 2)
    out = []
    for these, between in ((early, first), (~early, others)):
        out.append((run[these & ~cut], between.travel + b" "))
        for motion in (LINE, CLOCKWISE, COUNTER):
            words = between.lower + (b"\n" if between.motion == motion else b"\nG%d " % motion) + between.feed
            out.append((run[these & cut & (motions == motion)], words))
    return [(which, head) for which, head in out if len(which)]


def _motion_words(motions: NDArray[np.uint8], runs: Offsets) -> Words:
    """Return how each line begins: with a line feed, and the motion where it is another than before."""
    words = np.full(len(motions), word("\n"))
    for motion in (LINE, CLOCKWISE, COUNTER):
        changed = np.flatnonzero((motions[1:] == motion) & (motions[:-1] != motion)) + 1
        words[changed] = word(f"\nG{motion} ")
    # The first of a run stands in the line of its head.
    words[runs[:-1]] = 0
    return words


def _centres(centres: NDArray[np.int64]) -> Words:
    """Return centres as `` I1.0000 J-0.5000``, six words each."""
    parts = [_fixed(b" " + letter, centres[:, axis]) for axis, letter in enumerate((b"I", b"J"))]
    return np.ascontiguousarray(np.hstack(parts)).view(WORD)


def _fixed(lead: bytes, values: NDArray[np.int64]) -> Characters:
    """Return tenths of steps, of less than 10 m, as millimetres with four decimals: twelve characters."""
    sign = np.where(values < 0, np.uint8(ord("-")), np.uint8(0))[:, None]
    whole, rest = np.divmod(np.abs(values), _PER_MM)
    # A one before the decimals keeps their zeros.
    decimals = digits(rest + _PER_MM)[:, -4:]
    return beside(len(values), lead, sign, digits(whole)[:, -4:], b".", decimals)


def bounds(moves: Moves) -> tuple[Steps, Steps]:
    """Return the lower left and the upper right corner of what moves reach, in steps, arcs to the nearest."""
    low, high = moves.points.min(axis=0), moves.points.max(axis=0)
    arcs = np.flatnonzero(moves.motions != LINE)
    begin, end = moves.points[arcs - 1], moves.points[arcs]
    centre = begin + moves.centres[arcs] / PARTS
    off = moves.centres[arcs] / PARTS
    radius = np.sqrt(off[:, 0] * off[:, 0] + off[:, 1] * off[:, 1])
    chord = end - begin
    left = np.where(moves.motions[arcs] == CLOCKWISE, 1.0, -1.0)
    for axis, sign in ((0, -1), (0, 1), (1, -1), (1, 1)):
        far = centre.copy()
        far[:, axis] += sign * radius
        # Of no more than half a turn: what lies on the outer side of its chord.
        side = chord[:, 0] * (far[:, 1] - begin[:, 1]) - chord[:, 1] * (far[:, 0] - begin[:, 0])
        reached = np.rint(far[side * left > 0, axis]).astype(np.int64)
        low[axis] = reached.min(initial=low[axis])
        high[axis] = reached.max(initial=high[axis])
    return low, high
