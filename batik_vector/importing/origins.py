"""Transforms as styles write them: with units, and about an origin (CSS Transforms 1, 6 and 8)."""

from __future__ import annotations

from batik_vector.geometry.paths.matrix import IDENTITY, Matrix, times
from batik_vector.importing.page import parse_px
from batik_vector.importing.styles import Style
from batik_vector.importing.transforms import parse_transform

_SHARES = ({"left": 0.0, "center": 0.5, "right": 1.0}, {"top": 0.0, "center": 0.5, "bottom": 1.0})
_BOXES = ("", "view-box")


def transform_of(style: Style, size: tuple[float, float]) -> Matrix:
    """Return the map that an element's style or attributes set, about its origin.

    Args:
        style: the element's own.
        size: the sides of its viewport, of which percentages of the origin are shares.

    Raises:
        ValueError: where it cannot be read.
    """
    matrix = parse_transform(style.get("transform", ""))
    origin = style.get("transform-origin", "")
    if matrix == IDENTITY or not origin:
        return matrix
    x, y = _origin(origin, size)
    if (x or y or "%" in origin or "center" in origin) and style.get("transform-box", "") not in _BOXES:
        raise ValueError(
            f"transform-box: {style['transform-box'][:40]} is not read; apply the transform first"
        )
    return times(times((1.0, 0.0, 0.0, 1.0, x, y), matrix), (1.0, 0.0, 0.0, 1.0, -x, -y))


def _origin(text: str, size: tuple[float, float]) -> tuple[float, float]:
    words = text.lower().replace(",", " ").split()
    if len(words) == 3 and parse_px(words[2]) == 0:
        words.pop()
    if len(words) == 1:
        words = ["center", words[0]] if words[0] in ("top", "bottom") else [words[0], "center"]
    elif words[0] in _SHARES[1] and words[1] in _SHARES[0]:
        words.reverse()
    found = []
    for word, shares, whole in zip(words, _SHARES, size, strict=False):
        value = shares[word] * whole if word in shares else parse_px(word, whole)
        if value is not None:
            found.append(value)
    if len(words) != 2 or len(found) != 2:
        raise ValueError(f'transform-origin "{text[:60]}" cannot be read')
    return found[0], found[1]
