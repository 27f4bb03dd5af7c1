"""Figures as outlines: what SVG calls its basic shapes."""

from __future__ import annotations

from batik_vector.geometry.paths.outline import Outline, box
from batik_vector.geometry.paths.pen import drawn


def ellipse(cx: float, cy: float, rx: float, ry: float) -> Outline:
    """Return an ellipse, its four outermost points exact."""
    return drawn(
        [("M", [cx + rx, cy])]
        + [
            ("A", [rx, ry, 0, 0, 1, x, y])
            for x, y in ((cx, cy + ry), (cx - rx, cy), (cx, cy - ry), (cx + rx, cy))
        ]
    )


def rectangle(x: float, y: float, width: float, height: float, rx: float, ry: float) -> Outline:
    """Return a rectangle, its corners rounded by radii above zero."""
    if rx <= 0 or ry <= 0:
        return box(x, y, width, height)
    right, low = x + width, y + height
    rx, ry = min(rx, width / 2), min(ry, height / 2)
    corner = [rx, ry, 0.0, 0.0, 1.0]
    return drawn(
        [
            ("M", [x + rx, y]),
            ("L", [right - rx, y]),
            ("A", [*corner, right, y + ry]),
            ("L", [right, low - ry]),
            ("A", [*corner, right - rx, low]),
            ("L", [x + rx, low]),
            ("A", [*corner, x, low - ry]),
            ("L", [x, y + ry]),
            ("A", [*corner, x + rx, y]),
        ]
    )
