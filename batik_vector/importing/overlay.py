"""Lines laid over a drawing, which is left as it is: the file with one more group at its end.

Read as an artwork and written again, a stranger's drawing would lose what lies on top of what, tints and all
that is no ink. Where one points at such things, they have to show.
"""

from __future__ import annotations

import re

import shapely

from batik_vector.artwork import Geometries
from batik_vector.geometry.paths.matrix import Matrix
from batik_vector.importing.document import INKSCAPE

_END = re.compile(rb"</(?:[A-Za-z_][\w.-]*:)?svg\s*>\s*$")


def laid_over(
    data: bytes, onto: Matrix, lines: Geometries, breadth: float, colour: str, name: str
) -> bytes | None:
    """Return an SVG file with lines on top, in a layer of their own.

    Args:
        data: the file.
        onto: from the lines' mm to the user units of its root.
        lines: polylines in mm.
        breadth: of them all, in mm.
        colour: theirs, ``#rrggbb``.
        name: of the layer.

    Returns:
        The file; None where it does not end as files in UTF-8 do.
    """
    end = _END.search(data)
    if end is None:
        return None
    paths = []
    for line in lines:
        points = " ".join(f"{x:.3f} {y:.3f}" for x, y in shapely.get_coordinates(line).tolist())
        paths.append(f'<path d="M{points}"/>')
    matrix = " ".join(f"{part + 0.0:.12g}" for part in onto)
    group = (
        f'<g xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="{INKSCAPE}" id="{name}" '
        f'inkscape:groupmode="layer" inkscape:label="{name}" transform="matrix({matrix})" fill="none" '
        f'stroke="{colour}" stroke-width="{breadth:g}" stroke-linecap="round" stroke-opacity="1">'
        f"{''.join(paths)}</g>\n"
    )
    return data[: end.start()] + group.encode() + data[end.start() :]
