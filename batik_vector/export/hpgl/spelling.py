"""Strokes in plotter units as the words of HP-GL: PU and PD, or PE.

Coordinates are absolute, each rounded once, so that nothing adds up. PE (polyline encoded) names differences,
which are whole numbers too, and every stroke of it begins at an absolute place again. It is written in base
32, whose characters are plain ASCII: those of base 64 have eight bits, of which serial lines may lose one.

    PU0,0;PD4000,0,4000,2000;          pen up to (0, 0), then drawn to two places
    PE7<=__…;                          the same, see The HP-GL/2 and HP RTL Reference Guide, 1996, "PE"
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.export.numbers import Characters, Room, Style, Words, lead, spelling
from batik_vector.geometry.outlines import Offsets, Steps
from batik_vector.values import frozen

BASE = 5
"""Bits that a character of PE holds in base 32."""
MORE, LAST = 63, 95
"""Added to a digit to make a character of it: one that another follows, and the last (lowest first)."""


@frozen
class Trail:
    """Strokes as a pen draws them, in units: open polylines of two points or more, each moving everywhere.

    ``offsets`` says where each begins, and at last where they end. With ``goes_on`` the first begins where
    the pen is, and down.
    """

    points: Steps
    offsets: Offsets
    goes_on: bool

    def __len__(self) -> int:
        return len(self.offsets) - 1


def trail(points: Steps, offsets: Offsets, at: tuple[int, int] | None) -> Trail:
    """Return strokes without moves of no length; those that begin where one ends are its continuation.

    Args:
        points: shape (n, 2), in units.
        offsets: shape (k + 1,), where each stroke begins.
        at: where the pen is, if it is down.
    """
    moves = np.ones(len(points), bool)
    moves[1:] = (points[1:] != points[:-1]).any(axis=1)
    moves[offsets[:-1][np.diff(offsets) > 0]] = True
    # What has shrunk to one place draws nothing.
    before = np.concatenate([[0], np.cumsum(moves)])[offsets]
    keeps = np.diff(before) > 1
    moves &= np.repeat(keeps, np.diff(offsets))
    points = points[moves]
    offsets = np.concatenate([[0], np.cumsum(np.diff(before)[keeps])])
    first, last = offsets[:-1], offsets[1:] - 1
    joins = np.zeros(len(first), bool)
    joins[1:] = (points[first[1:]] == points[last[:-1]]).all(axis=1)
    kept = np.ones(len(points), bool)
    kept[first[joins]] = False
    sizes = np.add.reduceat(kept, first, dtype=np.int64) if len(first) else np.diff(offsets)
    ends = np.concatenate([[0], np.cumsum(sizes)])
    offsets = ends[np.append(~joins, True)]
    points = points[kept]
    goes_on = bool(len(points)) and at == (int(points[0, 0]), int(points[0, 1]))
    return Trail(points, offsets, goes_on)


def plain(strokes: Trail, most: int) -> bytes:
    """Return strokes as PU and PD, a line of text to each, with at most so many points behind one PD."""
    if not len(strokes):
        return b""
    first, sizes = strokes.offsets[:-1], np.diff(strokes.offsets)
    chunks = -(-(sizes - 1) // most)
    rank = np.arange(chunks.sum()) - np.repeat(np.cumsum(chunks) - chunks, chunks)
    downs = np.repeat(first + 1, chunks) + rank * most
    ups = first[strokes.goes_on :]
    starts = np.sort(np.concatenate([ups, downs]))
    is_up = np.zeros(len(strokes.points), bool)
    is_up[ups] = True
    skipped = int(strokes.goes_on)
    points = strokes.points[skipped:]
    heads = np.where(is_up[starts][:, None], _head(b";\nPU"), _head(b";PD"))
    runs = np.append(starts - skipped, len(points))
    spelled = spelling(points, Style.STEPS, ",")
    layout = Room(runs, np.ones(len(starts), np.int64))
    source = points.take(layout.source, axis=0)
    rows: Words = np.empty((len(source), 2 * spelled.words), np.uint32)
    spelled.put(rows, spelled.put(rows, 0, source[:, 0]), source[:, 1])
    lead(rows, layout.first, "")
    layout.put(rows, slice(None), heads)
    # Numbers are spelled with a blank behind them.
    return rows.tobytes().translate(None, b"\0 ").lstrip(b";\n") + b";\n"


def _head(text: bytes) -> Characters:
    return np.frombuffer(text.rjust(4, b"\0"), np.uint8)


def encoded(strokes: Trail) -> bytes:
    """Return strokes as one PE."""
    if not len(strokes):
        return b""
    points = strokes.points
    steps = np.diff(points, axis=0, prepend=points[:1])
    first = strokes.offsets[strokes.goes_on : -1]
    steps[first] = points[first]
    numbers = 2 * np.abs(steps) + (steps < 0)
    places = max(1, -(-int(numbers.max()).bit_length() // BASE))
    rows = np.zeros((len(points), 2 + 2 * places), np.uint8)
    rows[first, :2] = np.frombuffer(b"<=", np.uint8)
    for axis in (0, 1):
        _put_digits(rows[:, 2 + axis * places :], numbers[:, axis], places)
    if strokes.goes_on:
        rows = rows[1:]
    return b"PE7" + rows.tobytes().translate(None, b"\0") + b";\n"


def _put_digits(rows: NDArray[np.uint8], numbers: NDArray[np.int64], places: int) -> None:
    for place in range(places):
        rest = numbers >> (BASE * place)
        digit = rest & (2**BASE - 1)
        follows = rest >= 2**BASE
        shown = (rest > 0) | (place == 0)
        rows[:, place] = np.where(shown, digit + np.where(follows, MORE, LAST), 0)
