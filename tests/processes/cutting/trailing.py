"""A knife that trails: where its tip goes when its holder goes along a way. Shares nothing with the product.

A rod of fixed length is pulled at one end; the other moves towards it alone, never sideways. Pulled straight
on, the angle between rod and way falls as tan(angle / 2) does by exp(-distance / length): the tractrix.
"""

from __future__ import annotations

import cmath
import math
from itertools import pairwise


def trailed(way: list[complex], rod: float, heading: float, fine: float) -> list[complex]:
    """Return where the tip goes.

    Args:
        way: where the holder goes, straight from place to place.
        rod: how far the tip is from the holder's axis.
        heading: into which direction the blade points at first, in radians.
        fine: how far apart the places that are returned are along the way, about, where the tip swings.
    """
    pointing = cmath.rect(1, heading)
    tip = [way[0] - rod * pointing]
    for begin, end in pairwise(way):
        length = abs(end - begin)
        if not length:
            continue
        ahead = (end - begin) / length
        angle = cmath.phase(pointing / ahead)
        parts = max(1, math.ceil(length / fine)) if abs(angle) > 1e-6 else 1
        for part in range(1, parts + 1):
            gone = length * part / parts
            left = angle
            if abs(angle) < math.pi - 1e-7:
                left = 2 * math.atan(math.tan(angle / 2) * math.exp(-gone / rod))
            pointing = ahead * cmath.rect(1, left)
            tip.append(begin + ahead * gone - rod * pointing)
    return tip


def heading_after(way: list[complex], tip: complex) -> float:
    """Return into which direction the blade points at the end of a way."""
    return cmath.phase(way[-1] - tip)
