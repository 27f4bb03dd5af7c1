"""The drawing beside a recipe: outlines that are too long to be read in it, each where the tile has it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from xml.sax.saxutils import escape

from batik_vector.drafting.path_data import number

Mark = tuple[str, str, tuple[float, float], str]
"""A name, path data in mm, y up, where their origin lies on the page (mm), and a colour."""


def drawing_beside(title: str, size: tuple[float, float], cloth: str, marks: Sequence[Mark]) -> str:
    """Return an SVG of marks, each a path of its name.

    Args:
        title: of the recipe.
        size: width and height of the page in mm.
        cloth: its colour.
        marks: bottom first.
    """
    return "\n".join([*_lines(title, size, cloth, marks), ""])


def _lines(title: str, size: tuple[float, float], cloth: str, marks: Sequence[Mark]) -> Iterator[str]:
    width, height = (number(side) for side in size)
    yield f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}mm" height="{height}mm"'
    yield f'  viewBox="0 0 {width} {height}">'
    yield f"<title>{escape(title)}</title>"
    yield f'<rect id="cloth" width="{width}" height="{height}" fill="{cloth}"/>'
    for name, data, (x, y), colour in marks:
        place = f"translate({number(x)} {number(size[1] - y)}) scale(1 -1)"
        yield f'<path id="{name}" transform="{place}" fill="{colour}"'
        yield f'  d="{data}"/>'
    yield "</svg>"
