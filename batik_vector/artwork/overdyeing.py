"""Overdyeing: the colour of cloth that has seen several dye baths, predicted from the colour of each.

The theory of P. Kubelka and F. Munk (Ein Beitrag zur Optik der Farbanstriche, Zeitschrift für technische
Physik 12, 1931) as textile colourists use it: K/S = (1 − R)² / 2R is what a cloth absorbs over what it
scatters, and what dyes add to the K/S of the undyed cloth is added up, at each wavelength. R is taken in
three bands, the linear red, green and blue of sRGB, for no more is known of a colour on a screen.
docs/wax.md tells how far that is off.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

LEAST = 0.002
"""Reflectance below which nothing is told apart: the darkest that dyed cotton comes to, about."""


def overdyed(undyed: str, baths: Sequence[str]) -> str:
    """Return the colour of cloth after some baths, in any order, as ``#rrggbb``.

    Args:
        undyed: the colour of the cloth before.
        baths: the colour that each bath gives the undyed cloth.
    """
    if len(baths) < 2:
        return baths[0] if baths else undyed
    cloth = [_absorption(part) for part in linear(undyed)]
    dyed = [[_absorption(part) for part in linear(each)] for each in baths]
    total = [bare + math.fsum(each[k] - bare for each in dyed) for k, bare in enumerate(cloth)]
    return _hex([_reflectance(max(each, 0.0)) for each in total])


def _absorption(reflectance: float) -> float:
    part = max(reflectance, LEAST)
    return (1 - part) ** 2 / (2 * part)


def _reflectance(absorption: float) -> float:
    return 1 + absorption - math.sqrt(absorption * absorption + 2 * absorption)


def linear(colour: str) -> tuple[float, float, float]:
    """Return the linear red, green and blue of a colour of sRGB, 0 to 1. IEC 61966-2-1."""
    red, green, blue = (
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4
        for part in (int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5))
    )
    return red, green, blue


def _hex(parts: Sequence[float]) -> str:
    shown = (12.92 * part if part <= 0.0031308 else 1.055 * part ** (1 / 2.4) - 0.055 for part in parts)
    return "#" + "".join(f"{round(255 * min(max(part, 0.0), 1.0)):02x}" for part in shown)


def difference(one: str, other: str) -> float:
    """Return how far two colours are apart for the eye: the CIE's ΔE*ab of 1976, in D65."""
    return math.dist(_lab(one), _lab(other))


def _lab(colour: str) -> tuple[float, float, float]:
    red, green, blue = linear(colour)
    x = (0.4124564 * red + 0.3575761 * green + 0.1804375 * blue) / 0.95047
    y = 0.2126729 * red + 0.7151522 * green + 0.0721750 * blue
    z = (0.0193339 * red + 0.1191920 * green + 0.9503041 * blue) / 1.08883
    fx, fy, fz = (t ** (1 / 3) if t > (6 / 29) ** 3 else t / (3 * (6 / 29) ** 2) + 4 / 29 for t in (x, y, z))
    return 116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)
