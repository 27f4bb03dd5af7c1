"""Whole micrometres to text, in bulk: a million coordinates at the cost of a few array operations.

A number is looked up in tables of four-byte words, padded with NUL: one word for the whole millimetres,
one for the thousandths. Words of a row (a vertex with all that stands around it in the format) lie side
by side in a matrix, and one pass deletes the NULs. The result is exact: it is the decimal notation of
``k / 1000`` with no digit lost and none too many.

Up to ±9,999.999 mm a number takes two words of digits; beyond, up to ``LIMIT_MM``, three; farther out
:func:`check_range` refuses, since no cloth is a hundred kilometres long.
"""

from __future__ import annotations

import enum
import functools
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import ExportError
from batik_vector.outlines import Steps

Words: TypeAlias = NDArray[np.uint32]
"""Little-endian words of four characters each, NUL where there is none."""

WORD = np.dtype("<u4")
NARROW_STEPS = 10**7
"""Below this many steps the whole millimetres have at most four digits."""
LIMIT_STEPS = 10**11
LIMIT_MM = LIMIT_STEPS // 1000
MINUS = np.uint32(ord("-") << 24)


class Style(enum.Enum):
    """How a number is spelled."""

    SHORT = "short"
    """Millimetres without needless digits: ``12``, ``-0.5``."""
    REAL = "real"
    """Millimetres always with a point: ``12.0``, ``-0.5``."""
    STEPS = "steps"
    """Whole micrometres with a space behind: ``12000``, ``-500``."""


def word(text: str) -> np.uint32:
    """Return one to four characters as a word."""
    return np.uint32(int.from_bytes(text.encode("ascii"), "little"))


def _words(texts: list[str]) -> Words:
    return np.array(texts, dtype="S4").view(WORD)


@functools.cache
def _wholes(zero: str) -> Words:
    """Four digits: 0–9999 trimmed (0 as given), then 0–9999 in full for use behind higher digits."""
    return _words([zero, *(str(i) for i in range(1, 10_000)), *(f"{i:04d}" for i in range(10_000))])


@functools.cache
def _thousandths(style: Style) -> Words:
    """What stands behind the whole millimetres; for STEPS, a second half for use when there are any."""
    if style is Style.STEPS:
        return _words([f"{i} " for i in range(1000)] + [f"{i:03d} " for i in range(1000)])
    zero = ".0" if style is Style.REAL else ""
    return _words([zero, *(f".{i:03d}".rstrip("0") for i in range(1, 1000))])


def check_range(steps: Steps) -> None:
    """Refuse coordinates that no table holds.

    Raises:
        ExportError: where one is beyond ``LIMIT_MM``.
    """
    if steps.size and max(int(steps.max()), -int(steps.min())) >= LIMIT_STEPS:
        raise ExportError(f"a coordinate is beyond {LIMIT_MM:,} mm")


def digit_words(*numbers: Steps) -> int:
    """Return how many words the digits of each of these numbers need: 2 in the narrow range, else 3."""
    for steps in numbers:
        check_range(steps)
    worst = max((max(int(s.max()), -int(s.min())) for s in numbers if s.size), default=0)
    return 2 if worst < NARROW_STEPS else 3


def put(row: Words, at: int, steps: Steps, style: Style, size: int, lead: Words | np.uint32) -> int:
    """Write numbers into columns of a word matrix.

    Args:
        row: shape (n, k), the matrix.
        at: the first column to use.
        steps: shape (n,), the numbers.
        style: the spelling.
        size: what :func:`digit_words` says of all numbers in the file's block.
        lead: up to three characters before each number, shape (n,) or one for all.

    Returns:
        The column after the number: ``at + 1 + size``.
    """
    negative = steps < 0
    row[:, at] = lead + negative * MINUS
    small = np.abs(steps)
    if size == 2:
        small = small.astype(np.int32)
    mm = small // 1000
    rest = small - mm * 1000
    wholes = _wholes("" if style is Style.STEPS else "0")
    if size == 2:
        row[:, at + 1] = wholes[mm]
    else:
        high = mm // 10_000
        row[:, at + 1] = _wholes("")[high]
        row[:, at + 2] = wholes[mm - high * 10_000 + (high > 0) * 10_000]
    if style is Style.STEPS:
        rest += (mm > 0) * rest.dtype.type(1000)
    row[:, at + size] = _thousandths(style)[rest]
    return at + 1 + size


def text(row: Words | NDArray[np.uint8]) -> bytes:
    """Return the characters of a matrix, row by row, without the NULs."""
    return row.tobytes().translate(None, b"\0")


def digits(values: NDArray[np.int64], base: int = 10, width: int = 8) -> NDArray[np.uint8]:
    """Return non-negative integers as characters, shape (n, width), NUL in place of leading zeros."""
    figures = np.frombuffer(b"0123456789ABCDEF", np.uint8)
    out = np.zeros((len(values), width), np.uint8)
    rest = values
    for column in range(width - 1, -1, -1):
        out[:, column] = np.where((rest > 0) | (column == width - 1), figures[rest % base], 0)
        rest = rest // base
    return out


def beside(count: int, *parts: bytes | NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return rows of characters: each part is one text for all rows, or a matrix of shape (count, w).

    The width is padded to whole words.
    """
    widths = [len(part) if isinstance(part, bytes) else part.shape[1] for part in parts]
    out = np.zeros((count, -(-sum(widths) // 4) * 4), np.uint8)
    at = 0
    for part, width in zip(parts, widths, strict=True):
        out[:, at : at + width] = np.frombuffer(part, np.uint8) if isinstance(part, bytes) else part
        at += width
    return out


def headed(heads: NDArray[np.uint8], rows: Words, offsets: NDArray[np.int64]) -> bytes:
    """Return the text of rows with a head before each run of them.

    Args:
        heads: shape (k, h) characters.
        rows: shape (n, w) words.
        offsets: shape (k + 1,); head i stands before ``rows[offsets[i]:offsets[i + 1]]``.
    """
    count, width = len(heads), rows.shape[1] * 4
    per_head = -(-heads.shape[1] // width)
    everything = np.zeros((count * per_head + len(rows), rows.shape[1]), WORD)
    padded = np.zeros((count, per_head * width), np.uint8)
    padded[:, : heads.shape[1]] = heads
    starts = offsets[:-1] + per_head * np.arange(count)
    everything[(starts[:, None] + np.arange(per_head)).ravel()] = padded.view(WORD).reshape(-1, rows.shape[1])
    owner = np.repeat(np.arange(1, count + 1) * per_head, np.diff(offsets))
    everything[np.arange(len(rows)) + owner] = rows
    return text(everything)
