"""Elliptic arcs as cubic Béziers of at most 22.5°, whose error is 7e-8 of the radius."""

from __future__ import annotations

import math

import numpy as np

from batik_vector.geometry.sampling import Points

MAX_ARC = math.pi / 8


def arc(
    start: Points, end: Points, radii: tuple[float, float], turn: float, large: bool, sweep: bool
) -> Points | None:
    """Return an elliptic arc as cubics, shape (m, 3, 2), or None where it is a straight line.

    SVG 2, B.2.4 (from end points to centre) and B.2.5 (radii that are too small).
    """
    rx, ry = abs(radii[0]), abs(radii[1])
    if (start == end).all():
        return np.empty((0, 3, 2))
    if rx == 0 or ry == 0:
        return None
    cos, sin = math.cos(turn), math.sin(turn)
    half = (start - end) / 2
    x, y = cos * half[0] + sin * half[1], -sin * half[0] + cos * half[1]
    needed = (x / rx) ** 2 + (y / ry) ** 2
    if needed > 1:
        rx, ry = rx * math.sqrt(needed), ry * math.sqrt(needed)
    over = max(0.0, 1 / max(needed, 1e-300) - 1) if needed <= 1 else 0.0
    side = math.sqrt(over) * (-1 if large == sweep else 1)
    cx, cy = side * rx * y / ry, -side * ry * x / rx
    first = math.atan2((y - cy) / ry, (x - cx) / rx)
    swept = math.atan2((-y - cy) / ry, (-x - cx) / rx) - first
    if sweep and swept < 0:
        swept += 2 * math.pi
    elif not sweep and swept > 0:
        swept -= 2 * math.pi
    frame = np.array([[rx * cos, rx * sin], [-ry * sin, ry * cos]])
    middle = (start + end) / 2 + np.array([cos * cx - sin * cy, sin * cx + cos * cy])
    control: Points = _unit_arc(first, swept) @ frame + middle
    control[-1, 2] = end
    return control


def _unit_arc(first: float, swept: float) -> Points:
    """Return an arc of the unit circle as cubics, shape (m, 3, 2)."""
    pieces = max(1, math.ceil(abs(swept) / MAX_ARC - 1e-9))
    angle = first + np.linspace(0, swept, pieces + 1)
    reach = 4 / 3 * math.tan(swept / pieces / 4)
    on = np.column_stack([np.cos(angle), np.sin(angle)])
    along = np.column_stack([-np.sin(angle), np.cos(angle)]) * reach
    return np.stack([on[:-1] + along[:-1], on[1:] - along[1:], on[1:]], axis=1)
