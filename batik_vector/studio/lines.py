"""The line view: of a picture that our own SVG writer wrote the outlines alone, thin, on bare ground."""

from __future__ import annotations

import re

from batik_vector.units import format_mm

_GROUND = re.compile(r"<polygon [^>]*/>")
_FILLED = re.compile(r'fill="(#[0-9a-f]{6})" fill-rule="[a-z]+"')
_STROKED = re.compile(r'fill="none" stroke="(#[0-9a-f]{6})" stroke-width="[0-9.]+"')


def as_lines(svg: str, width: float) -> str:
    """Return a picture as outlines.

    Args:
        svg: as the SVG writer writes it.
        width: of the lines, in mm.
    """
    breadth = format_mm(max(width, 0.01))
    svg = _GROUND.sub("", svg, count=1)
    drawn = rf'fill="none" stroke="\1" stroke-width="{breadth}"'
    return _FILLED.sub(drawn, _STROKED.sub(drawn, svg))
