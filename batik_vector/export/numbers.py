"""Whole micrometres to text, in bulk: a million coordinates at the cost of a few array operations.

A number is looked up in tables of four-byte words, padded with NUL: one word for the whole millimetres,
one for the thousandths. Words of a row (a vertex with all that stands around it in the format) lie side
by side in a matrix, and one pass deletes the NULs. The result is exact: it is the decimal notation of
``k / 1000`` with no digit lost and none too many.

How many words a number takes is settled for a block at once, see :class:`Reach`; farther out than
``LIMIT_MM`` :func:`check_range` refuses, since no cloth is a hundred kilometres long. What stands between
rows (the end of one path and the beginning of the next) gets rows of its own, see :class:`Room`.
"""

from __future__ import annotations

import enum
import functools
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import ExportError
from batik_vector.geometry.outlines import Index, Offsets, Steps
from batik_vector.values import frozen

Words: TypeAlias = NDArray[np.uint32]
"""Little-endian words of four characters each, NUL where there is none."""
Characters: TypeAlias = NDArray[np.uint8]

WORD = np.dtype("<u4")
LIMIT_STEPS = 10**11
LIMIT_MM = LIMIT_STEPS // 1000
MINUS = np.uint32(ord("-") << 24)
ALL_BUT_FIRST = np.uint32(0xFFFFFF00)


class Style(enum.Enum):
    """How a number is spelled."""

    SHORT = "short"
    """Millimetres without needless digits: ``12``, ``-0.5``."""
    REAL = "real"
    """Millimetres always with a point: ``12.0``, ``-0.5``."""
    STEPS = "steps"
    """Whole micrometres with a space behind: ``12000``, ``-500``."""


class Reach(enum.Enum):
    """Which numbers a block holds, and so how many words each takes."""

    NEAR = "near"
    """None below zero, and none whose lead and whole millimetres would pass a word: two words, the lead in
    the first."""
    MIDDLE = "middle"
    """Up to ±999.999 mm, and up to 9,999.999 mm above zero: two words, and one before them for a lead."""
    FAR = "far"
    """The others: four words, the lead and the sign in the first."""


@frozen
class Spelling:
    """How all numbers of a block are spelled. ``lead``, one character or none, stands before each."""

    style: Style
    lead: str
    reach: Reach

    @property
    def words(self) -> int:
        """How many words a number takes, its lead among them; a lead is the first character of the first."""
        if self.reach is Reach.FAR:
            return 4
        return 2 + (self.reach is Reach.MIDDLE and bool(self.lead))

    def put(self, rows: Words, at: int, steps: Steps) -> int:
        """Write numbers into columns of a word matrix.

        Args:
            rows: shape (n, k), the matrix.
            at: the first column to use.
            steps: shape (n,), the numbers, all within the reach.

        Returns:
            The column after the number.
        """
        after = at + self.words
        if self.reach is Reach.FAR:
            self._put_far(rows, at, steps)
            return after
        small = steps.astype(np.int32)
        if self.reach is Reach.MIDDLE:
            below = small < 0
            np.abs(small, out=small)
        whole = small // 1000
        small -= whole * 1000
        if self.style is Style.STEPS:
            small += (whole > 0) * np.int32(1000)
        if self.reach is Reach.MIDDLE:
            whole += below * np.int32(10_000)
            if self.lead:
                rows[:, at] = word(self.lead)
        table = _wholes(self.style, self.lead if self.reach is Reach.NEAR else "")
        rows[:, after - 2] = table.take(whole)
        rows[:, after - 1] = _thousandths(self.style).take(small)
        return after

    def _put_far(self, rows: Words, at: int, steps: Steps) -> None:
        rows[:, at] = word(self.lead) + (steps < 0) * MINUS
        small = np.abs(steps)
        whole = small // 1000
        rest = small - whole * 1000
        high = whole // 10_000
        rows[:, at + 1] = _fours(False).take(high)
        low = whole - high * 10_000
        rows[:, at + 2] = np.where(high > 0, _fours(True).take(low), _wholes(self.style, "").take(low))
        if self.style is Style.STEPS:
            rest += (whole > 0) * 1000
        rows[:, at + 3] = _thousandths(self.style).take(rest)


def spelling(numbers: Steps, style: Style, lead: str = "") -> Spelling:
    """Return how numbers are spelled in the fewest words.

    Args:
        numbers: all numbers of the block, of any shape.
        style: the style.
        lead: a character before each number, or none.

    Raises:
        ExportError: where one is beyond ``LIMIT_MM``.
    """
    low, high = (int(numbers.min()), int(numbers.max())) if numbers.size else (0, 0)
    _check(low, high)
    if low >= 0 and high < (10**6 if lead else 10**7):
        return Spelling(style, lead, Reach.NEAR)
    return Spelling(style, lead, Reach.MIDDLE if low > -(10**6) and high < 10**7 else Reach.FAR)


def check_range(steps: Steps) -> None:
    """Refuse coordinates that no table holds.

    Raises:
        ExportError: where one is beyond ``LIMIT_MM``.
    """
    if steps.size:
        _check(int(steps.min()), int(steps.max()))


def _check(low: int, high: int) -> None:
    if max(high, -low) >= LIMIT_STEPS:
        raise ExportError(f"a coordinate is beyond {LIMIT_MM:,} mm")


def word(text: str) -> np.uint32:
    """Return up to four characters as a word."""
    return np.uint32(int.from_bytes(text.encode("ascii"), "little"))


def _figures(count: int, places: int, full: bool) -> Characters:
    """0 to count - 1 as figures, shape (count, places): with leading zeros in full, or else NUL for them."""
    tens = 10 ** np.arange(places - 1, -1, -1)
    numbers = np.arange(count)[:, None]
    figures = numbers // tens % 10 + ord("0")
    return np.where(full | (numbers >= tens), figures, 0).astype(np.uint8)


def _words(characters: Characters) -> Words:
    return np.ascontiguousarray(characters).view(WORD).ravel()


@functools.cache
def _fours(full: bool) -> Words:
    """0–9999 as four figures: all of them, or without leading zeros and nothing for 0."""
    return _words(_figures(10_000, 4, full))


@functools.cache
def _wholes(style: Style, lead: str) -> Words:
    """Whole millimetres with their lead, or their sign: 0–999 behind a lead; or else 0–9999, then -0 to -999.

    No millimetres are written as nothing before steps, and as 0 before a point.
    """
    zero = word("" if style is Style.STEPS else "\0\0\0" + "0")
    behind = _words(beside(1000, (lead or "-").encode("ascii"), _figures(1000, 3, False)))
    behind[0] += zero
    if lead:
        return behind
    whole = _fours(False).copy()
    whole[0] = zero
    return np.concatenate([whole, behind])


@functools.cache
def _thousandths(style: Style) -> Words:
    """What stands behind the whole millimetres; for STEPS, a second half for use when there are any."""
    if style is Style.STEPS:
        halves = [beside(1000, _figures(1000, 3, full), b" ") for full in (False, True)]
        halves[0][0, 2] = ord("0")
        return _words(np.concatenate(halves))
    figures = _figures(1000, 3, True)
    followed = np.logical_or.accumulate(figures[:, ::-1] != ord("0"), axis=1)[:, ::-1]
    table = _words(beside(1000, b".", np.where(followed, figures, np.uint8(0))))
    table[0] = word(".0" if style is Style.REAL else "")
    return table


def lead(rows: Words, which: Index, character: str) -> None:
    """Put another character, or none, before the numbers that begin some rows, in place of their lead."""
    rows[which, 0] = (rows[which, 0] & ALL_BUT_FIRST) | word(character)


def text(rows: Words | Characters) -> bytes:
    """Return the characters of a matrix, row by row, without the NULs."""
    return rows.tobytes().translate(None, b"\0")


def digits(values: NDArray[np.int64]) -> Characters:
    """Return integers from 0 to 10¹² - 1 as decimal figures, shape (n, 12), NUL in place of leading zeros."""
    out: Words = np.empty((len(values), 3), WORD)
    high, low = values // 10_000, values % 10_000
    top, middle = high // 10_000, high % 10_000
    out[:, 0] = _fours(False).take(top)
    out[:, 1] = np.where(top > 0, _fours(True).take(middle), _fours(False).take(middle))
    out[:, 2] = np.where(high > 0, _fours(True).take(low), _wholes(Style.SHORT, "").take(low))
    return out.view(np.uint8)


def hexadecimals(values: NDArray[np.int64]) -> Characters:
    """Return integers from 0 to 16⁶ - 1 as six hexadecimal figures, shape (n, 6)."""
    figures = np.frombuffer(b"0123456789ABCDEF", np.uint8)
    return figures.take((values[:, None] >> np.arange(20, -4, -4)) & 15)


def beside(count: int, *parts: bytes | Characters) -> Characters:
    """Return rows of characters: each part is one text for all rows, or a matrix of shape (count, w)."""
    widths = [len(part) if isinstance(part, bytes) else part.shape[1] for part in parts]
    out = np.zeros((count, sum(widths)), np.uint8)
    at = 0
    for part, width in zip(parts, widths, strict=True):
        out[:, at : at + width] = np.frombuffer(part, np.uint8) if isinstance(part, bytes) else part
        at += width
    return out


class Room:
    """A word matrix with a row for each point and room before each run of them.

    Args:
        offsets: shape (k + 1,); run i is the points ``offsets[i]`` to ``offsets[i + 1]``.
        room: shape (k,), how many rows are left free before each run.
    """

    def __init__(self, offsets: Offsets, room: NDArray[np.int64]) -> None:
        before = np.cumsum(room)
        self._offsets, self._before = offsets, before
        self.first: Index = offsets[:-1] + before
        """The row of each run's first point."""
        self.last: Index = offsets[1:] + before - 1
        """The row of each run's last point."""
        self.source: Index = np.arange(offsets[-1] + before[-1])
        """The point that each row spells; free rows spell any."""
        self.source -= np.repeat(before, np.diff(offsets) + room)
        np.maximum(self.source, 0, out=self.source)

    def row_of(self, points: Index) -> Index:
        """Return the rows of some points."""
        return points + self._before[np.searchsorted(self._offsets, points, side="right") - 1]

    def put(self, rows: Words, runs: Index | slice, heads: Characters) -> None:
        """Write heads into the room before some runs, as close before them as they reach.

        Args:
            rows: the matrix, each of its free rows to be written just once.
            runs: the runs.
            heads: their heads, shape (len(runs), h).
        """
        count, width = heads.shape
        needed = room_for(width, rows.shape[1])
        padded = np.zeros((count, needed * rows.shape[1] * 4), np.uint8)
        padded[:, :width] = heads
        where = self.first[runs][:, None] + np.arange(-needed, 0)
        rows[where.ravel()] = padded.view(WORD).reshape(-1, rows.shape[1])


def room_for(characters: int, words: int) -> int:
    """Return how many rows of so many words a head of so many characters fills."""
    return -(-characters // (4 * words))
