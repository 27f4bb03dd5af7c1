"""Letters of single strokes, for marks that are read by people: a small plotter's alphabet, drawn for this.

Letters stand on a grid of 4 by 6, capitals only. Accents are dropped; what is not in the alphabet is ``?``.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

TALL = 6
"""Height of a letter on its grid."""
ADVANCE = 6
"""From one letter to the next."""
WIDE = 4
_STROKES = {
    "A": "0004264440 0242",
    "B": "00063645443303 3342413000",
    "C": "4536160501103041",
    "D": "00062644422000",
    "E": "46060040 0333",
    "F": "460600 0333",
    "G": "45361605011030414323",
    "H": "0006 4046 0343",
    "I": "1030 2026 1636",
    "J": "0110304146",
    "K": "0006 460340",
    "L": "060040",
    "M": "0006234640",
    "N": "00064046",
    "O": "100105163645413010",
    "P": "00063645443303",
    "Q": "100105163645413010 2240",
    "R": "00063645443303 2340",
    "S": "453616050413334241301001",
    "T": "0646 2026",
    "U": "060110304146",
    "V": "0602204246",
    "W": "0600234046",
    "X": "0046 0640",
    "Y": "062346 2320",
    "Z": "06460040",
    "0": "100105163645413010 1135",
    "1": "152620 1030",
    "2": "05163645440040",
    "3": "051636454433 13334241301001",
    "4": "30360242",
    "5": "460603334241301001",
    "6": "4536160501103041423303",
    "7": "064620",
    "8": "13040516364544331302011030414233",
    "9": "0110304145361605041343",
    "-": "1333",
    "+": "1333 2224",
    ".": "2021",
    ",": "2110",
    ":": "2122 2425",
    "/": "0046",
    "#": "1016 3036 0242 0444",
    "(": "36242230",
    ")": "16242210",
    "_": "0040",
    "=": "0242 0444",
    "%": "0046 0506 4041",
    "'": "2624",
    "?": "05163645442322 2021",
    " ": "",
}


def lettered(words: str, height: float) -> list[NDArray[np.float64]]:
    """Return the strokes of a line of text, each of shape (n, 2), its lower left corner at (0, 0).

    Args:
        words: the text.
        height: of its letters, in whatever unit the strokes are to have.
    """
    scale = height / TALL
    return [
        np.array([(int(x) + at * ADVANCE, int(y)) for x, y in zip(stroke[::2], stroke[1::2], strict=True)])
        * scale
        for at, letter in enumerate(_plain(words))
        for stroke in _STROKES.get(letter, _STROKES["?"]).split()
    ]


def length_of(words: str, height: float) -> float:
    """Return how long a line of text is."""
    return max(len(_plain(words)) * ADVANCE - (ADVANCE - WIDE), 0) * height / TALL


def _plain(words: str) -> str:
    if not words.isascii():
        # Its tables take longer to load than all letters to draw.
        import unicodedata

        split = unicodedata.normalize("NFKD", words)
        words = "".join(each for each in split if not unicodedata.combining(each))
    return words.upper()
