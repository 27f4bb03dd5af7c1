"""Long path data, read in bulk: tracers write a drawing as one path of a hundred thousand numbers."""

from __future__ import annotations

import re

import numpy as np

from batik_vector.geometry.paths.pen import Command

LONG_TEXT = 5_000
"""Characters from which this is quicker than to read one token after another."""

_TAKES = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "Z": 0}
"""Commands and the numbers they take. Arcs are left to others: no blank need follow their flags."""
_CODES = {ord(each): takes for name, takes in _TAKES.items() for each in (name, name.lower())}
_FIGURES = b"0123456789.+-eE"
_KNOWN = bytes([*_CODES, *_FIGURES, *b" \t\n\r\f,"])
_COUNT = np.array([_CODES.get(code, -1) for code in range(256)])
_ALONE = np.isin(np.arange(256), list(b"MmZz"))
_IN_NUMBER = np.isin(np.arange(256), list(_FIGURES))
_BLANKED = bytes(32 if code in _CODES or code == ord(",") else code for code in range(256))
_GLUED = re.compile(rb"(?:\.\d*+(?:[eE][-+]?+\d++)?|[eE][-+]?+\d++)(?=\.)")
"""The end of a number behind which the next begins with its point: ``.5.5``."""


def commands_of(text: str) -> list[Command] | None:
    """Return the commands of sound path data without arcs; None of any other, and of short ones."""
    if len(text) < LONG_TEXT or not text.isascii():
        return None
    data = text.encode("ascii")
    if data.translate(None, _KNOWN):
        return None
    for sign in (b"-", b"+"):
        # A sign begins a number, but for that of an exponent.
        data = data.replace(sign, b" " + sign)
        data = data.replace(b"e " + sign, b"e" + sign).replace(b"E " + sign, b"E" + sign)
    try:
        numbers = _floats(data)
    except ValueError:
        # So does a second point.
        data = _GLUED.sub(rb"\g<0> ", data)
        try:
            numbers = _floats(data)
        except ValueError:
            return None
    return _parted(data, numbers)


def _floats(data: bytes) -> list[float]:
    return list(map(float, data.translate(_BLANKED).split()))


def _parted(data: bytes, numbers: list[float]) -> list[Command] | None:
    """Return the numbers by the commands that take them, or None where their counts do not fit."""
    codes = np.frombuffer(data, np.uint8)
    figure = _IN_NUMBER[codes]
    begun = np.cumsum(figure & ~np.append(False, figure[:-1]))
    places = np.flatnonzero(_COUNT[codes] >= 0)
    if not len(places) or begun[places[0]] or begun[-1] != len(numbers):
        return None
    code, ends = codes[places], np.append(begun[places], len(numbers))
    takes, counts = _COUNT[code], np.diff(ends)
    if not np.where(takes > 0, (counts > 0) & (counts % np.maximum(takes, 1) == 0), counts == 0).all():
        return None
    # One letter again and again, as some programs write it, is one command with many numbers.
    first = np.flatnonzero(np.append(True, (code[1:] != code[:-1]) | _ALONE[code[1:]]))
    cuts = [*ends[first].tolist(), len(numbers)]
    letters = bytes(code[first]).decode("ascii")
    return [(each, numbers[low:high]) for each, low, high in zip(letters, cuts, cuts[1:], strict=False)]
