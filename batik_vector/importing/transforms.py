"""Affine maps as SVG writes them: what a transform attribute says, with its units."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from batik_vector.geometry.paths.matrix import IDENTITY, Matrix, times
from batik_vector.patterns import NUMBER

PX_PER_INCH = 96.0
PX_PER_UNIT = {
    "": 1.0,
    "px": 1.0,
    "pt": PX_PER_INCH / 72,
    "pc": PX_PER_INCH / 6,
    "in": PX_PER_INCH,
    "cm": PX_PER_INCH / 2.54,
    "mm": PX_PER_INCH / 25.4,
    "q": PX_PER_INCH / 101.6,
}
_DEGREES = {"": 1.0, "deg": 1.0, "grad": 0.9, "rad": math.degrees(1.0), "turn": 360.0}
_BARE = {"": 1.0}
_CALL = re.compile(r"\s*+,?+\s*+(matrix|translate|scale|rotate|skewX|skewY)\s*+\(([^()]*+)\)\s*+")
_TERM = re.compile(rf"[\s,]*+({NUMBER})([a-zA-Z%]*+)")
_COUNTS = {
    "matrix": (6,),
    "translate": (1, 2),
    "scale": (1, 2),
    "rotate": (1, 3),
    "skewX": (1,),
    "skewY": (1,),
}


def parse_transform(text: str) -> Matrix:
    """Return the map that a transform attribute writes.

    Raises:
        ValueError: where it is none.
    """
    matrix, at = IDENTITY, 0
    text = text.strip()
    if text == "none":
        return IDENTITY
    while at < len(text):
        match = _CALL.match(text, at)
        if match is None:
            raise ValueError(f'transform "{text[:80]}" cannot be read')
        matrix = times(matrix, _called(match[1], _terms(match[1], match[2])))
        at = match.end()
    if not all(map(math.isfinite, matrix)):
        raise ValueError(f'transform "{text[:80]}" is not finite')
    return matrix


def _terms(name: str, text: str) -> list[float]:
    """Return what a function is given: plain numbers, degrees and px, from the units of CSS Transforms 1."""
    found: list[float] = []
    at = 0
    while match := _TERM.match(text, at):
        angle = name in ("skewX", "skewY") or (name == "rotate" and not found)
        units = _DEGREES if angle else PX_PER_UNIT if name in ("translate", "rotate") else _BARE
        if match[2].lower() not in units:
            break
        found.append(float(match[1]) * units[match[2].lower()])
        at = match.end()
    if text[at:].strip(" \t\r\n,"):
        raise ValueError(f'transform "{name}({text[:60]})" cannot be read')
    return found


def _called(name: str, numbers: Sequence[float]) -> Matrix:
    if len(numbers) not in _COUNTS[name]:
        raise ValueError(f"transform {name}() with {len(numbers)} numbers")
    if name == "matrix":
        a, b, c, d, e, f = numbers
        return a, b, c, d, e, f
    first, second = numbers[0], numbers[1] if len(numbers) > 1 else None
    if name == "translate":
        return 1.0, 0.0, 0.0, 1.0, first, second or 0.0
    if name == "scale":
        return first, 0.0, 0.0, first if second is None else second, 0.0, 0.0
    if name == "rotate":
        return _rotation(first, *numbers[1:])
    lean = math.tan(math.radians(first))
    return (1.0, 0.0, lean, 1.0, 0.0, 0.0) if name == "skewX" else (1.0, lean, 0.0, 1.0, 0.0, 0.0)


def _rotation(degrees: float, x: float = 0.0, y: float = 0.0) -> Matrix:
    # Quarter turns are exact, so that what lies on an edge of the page stays on it.
    quarter = {0.0: (1.0, 0.0), 90.0: (0.0, 1.0), 180.0: (-1.0, 0.0), 270.0: (0.0, -1.0)}
    turn = math.radians(degrees)
    cos, sin = quarter.get(degrees % 360, (math.cos(turn), math.sin(turn)))
    return cos, sin, -sin, cos, x - cos * x + sin * y, y - sin * x - cos * y
