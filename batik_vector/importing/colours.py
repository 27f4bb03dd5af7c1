"""CSS colours as printers know them: ``#rrggbb`` and an opacity."""

from __future__ import annotations

import colorsys
import functools
import re
from collections.abc import Sequence
from typing import Any

from batik_vector.patterns import NUMBER

_FUNCTION = re.compile(r"\s*+(rgb|hsl)a?+\(([^()]*+)\)\s*+", re.IGNORECASE)
_PART = re.compile(rf"({NUMBER})(%|[a-z]*+)", re.IGNORECASE)
_TURNS = {"": 1 / 360, "deg": 1 / 360, "grad": 1 / 400, "rad": 0.15915494309189535, "turn": 1.0}


@functools.lru_cache(4096)
def colour_of(text: str, current: str = "black") -> tuple[str, float] | None:
    """Return a CSS colour as (``#rrggbb``, opacity), or None where the text is none."""
    import tinycss2.color3  # type: ignore[import-untyped]

    text = text.partition("icc-color(")[0]
    colour: Any = tinycss2.color3.parse_color(text)
    if colour == "currentColor":
        return None if current.lower() == "currentcolor" else colour_of(current)
    parts = _spaced(text) if colour is None else tuple(colour)
    if parts is None:
        return None
    levels = (int(round(255 * max(0.0, min(1.0, part)), 6) + 0.5) for part in parts[:3])
    return "#{:02x}{:02x}{:02x}".format(*levels), float(max(0.0, min(1.0, parts[3])))


def _spaced(text: str) -> Sequence[float] | None:
    """Return red, green, blue and opacity as shares, from rgb() and hsl() of CSS Color 4, 5.1 and 7."""
    match = _FUNCTION.fullmatch(text)
    if match is None:
        return None
    terms = [_PART.fullmatch(each) for each in re.split(r"[\s,/]++", match[2].strip())]
    parts = [(float(term[1]), term[2].lower()) for term in terms if term is not None]
    if len(parts) < len(terms) or len(parts) not in (3, 4):
        return None
    hsl = match[1].lower() == "hsl"
    if any(unit not in ("", "%") for _, unit in parts[1 if hsl else 0 :]) or (
        hsl and parts[0][1] not in _TURNS
    ):
        return None
    opacity = _share(*parts[3]) if len(parts) == 4 else 1.0
    if not hsl:
        return *(_share(value, unit, 255.0) for value, unit in parts[:3]), opacity
    hue = parts[0][0] * _TURNS[parts[0][1]] % 1.0
    saturation, light = (max(0.0, min(1.0, value / 100)) for value, _ in parts[1:3])
    return *colorsys.hls_to_rgb(hue, light, saturation), opacity


def _share(value: float, unit: str, whole: float = 1.0) -> float:
    return value / (100 if unit == "%" else whole)
