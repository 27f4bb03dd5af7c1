"""Plain decimals of long path data, read all at once.

A decimal is its figures as a whole number, divided by a power of ten. Where a float holds both exactly, the
quotient is the float nearest to the decimal, the one that :class:`float` reads (W. D. Clinger, How to read
floating point numbers accurately, 1990, section 4).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.sampling import Array

EXACT = 2**53
"""Whole numbers below it are floats."""
_TENS = np.array([float(10**power) for power in range(23)])
"""The powers of ten that are floats."""
_MINUS, _POINT = b"-."
_SPACED = bytes.maketrans(b",-\t\r\n", b" " * 5)


def decimals_in(text: str) -> list[float] | None:
    """Return the numbers of a list in which spaces, commas or a minus stand between them.

    Args:
        text: figures, points, minuses, commas and spaces, and nothing else.

    Returns:
        The numbers; None where one is broken, too long to be read like this, or runs into the next one.
    """
    found = placed_decimals(text.encode("ascii"))
    return found[0].tolist() if found is not None and len(found[0]) else None


def placed_decimals(text: bytes) -> tuple[Array, NDArray[np.intp]] | None:
    """Return the numbers of such a list, and the place of the last character of each; shape (n,) both.

    None as for :func:`decimals_in`; a list that holds no number has none.
    """
    # Behind the last number is a place that is none of its own.
    raw = text + b" "
    spaced = raw.translate(_SPACED, b".").strip()
    characters = np.frombuffer(raw, np.uint8)
    inside = characters >= _POINT
    ends = (inside[:-1] > inside[1:]).nonzero()[0]
    if not spaced:
        return (np.empty(0), ends) if not len(ends) and _MINUS not in raw else None
    figures = np.fromstring(spaced, np.int64, sep=" ")
    points, minus = ((characters == each).nonzero()[0] for each in (_POINT, _MINUS))
    of = ends.searchsorted(points)
    behind = np.zeros(len(ends), np.intp)
    behind[of] = ends[of] - points
    broken = len(figures) != len(ends) or (of[1:] == of[:-1]).any() or not inside[minus + 1].all()
    if broken or figures.max() >= EXACT or behind.max() >= len(_TENS):
        return None
    numbers = figures / _TENS[behind]
    of = ends.searchsorted(minus)
    numbers[of] = -numbers[of]
    return numbers, ends
