"""Names of inks: what people call a colour, as far as CSS has a word for it."""

from __future__ import annotations

import colorsys
from collections.abc import Sequence

GREYS = ((0.08, "black"), (0.35, "charcoal"), (0.65, "grey"), (0.92, "silver"), (1.1, "white"))
"""Words for what has no hue, up to which lightness."""
HUES = (
    (15, "red"),
    (40, "orange"),
    (65, "yellow"),
    (80, "lime"),
    (160, "green"),
    (195, "turquoise"),
    (255, "blue"),
    (290, "violet"),
    (335, "pink"),
    (361, "red"),
)
"""Words for hues, up to which degree of the colour circle."""
DARK, PALE, PLAIN = 0.3, 0.75, 0.12
"""Lightness below which a colour is dark, above which it is pale, and saturation below which it is a grey."""


def ink_names(colours: Sequence[str]) -> list[str]:
    """Return a name for each colour ``#rrggbb``, no two alike: "dark-blue", "red", "red-2"."""
    names: list[str] = []
    for colour in colours:
        name, count = _word(colour), 1
        while (name if count == 1 else f"{name}-{count}") in names:
            count += 1
        names.append(name if count == 1 else f"{name}-{count}")
    return names


def _word(colour: str) -> str:
    red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    hue, light, saturation = colorsys.rgb_to_hls(red, green, blue)
    spread = max(red, green, blue) - min(red, green, blue)
    if min(saturation, spread) < PLAIN:
        return next(word for limit, word in GREYS if light < limit)
    word = next(word for limit, word in HUES if hue * 360 < limit)
    return f"dark-{word}" if light < DARK else f"pale-{word}" if light > PALE else word
