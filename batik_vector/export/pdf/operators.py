"""Strokes as path operators (ISO 32000-1, 8.5)."""

from __future__ import annotations

import numpy as np

from batik_vector.export.numbers import WORD, Room, Style, Words, room_for, spelling, text, word
from batik_vector.export.strokes import CONTROL, LINE, MOVE, Strokes

OPERATORS: Words = np.array([word(letters) for letters in ("m\n", "l\n", "", "", "c\n")], WORD)
"""What stands behind a point of each kind, in the order of the kinds."""


def path_operators(drawn: Strokes, paint: str, unfinished: bool = False) -> bytes:
    """Return strokes as path operators, coordinates in whole steps, each mark painted by itself.

    Args:
        drawn: the strokes.
        paint: the operator that paints a path: ``f*``, ``S``.
        unfinished: the last mark goes on, and is not painted yet.
    """
    points = drawn.points
    spelled = spelling(points, Style.STEPS)
    width = 2 * spelled.words + 1
    painting = np.frombuffer(f"{paint}\n".encode("ascii"), np.uint8)
    room = np.zeros(len(drawn.closed), np.int64)
    begin = drawn.marks[1:-1]
    room[begin] = room_for(len(painting), width)
    layout = Room(drawn.rings, room)
    points = points.take(layout.source, axis=0)
    rows: Words = np.empty((len(points), width), WORD)
    spelled.put(rows, spelled.put(rows, 0, points[:, 0]), points[:, 1])
    curved = (drawn.kinds >= CONTROL).any()
    rows[:, -1] = OPERATORS.take(drawn.kinds.take(layout.source)) if curved else OPERATORS[LINE]
    rows[layout.first, -1] = OPERATORS[MOVE]
    rows[layout.last[drawn.closed], -1] += word("\0\0h\n")
    layout.put(rows, begin, np.repeat(painting[None], len(begin), axis=0))
    return text(rows) + (b"" if unfinished else painting.tobytes())
