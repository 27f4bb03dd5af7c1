"""pycairo: a path for each mark on a vector surface."""

from __future__ import annotations

import cairo

from benchmarks.peers.drawn import Drawing, main

POINT = 72 / 25.4
"""cairo's surfaces count in points."""


def draw(surface: cairo.Surface, drawing: Drawing) -> None:
    """Fill every mark, and close the file."""
    pen = cairo.Context(surface)
    pen.scale(POINT, POINT)
    pen.set_source_rgb(0.1, 0.1, 0.1)
    for ring in drawing.points.tolist():
        pen.move_to(*ring[0])
        for vertex in ring[1:]:
            pen.line_to(*vertex)
        pen.close_path()
        pen.fill()
    surface.finish()


def write(drawing: Drawing, _: None) -> None:
    """Draw and save."""
    page = drawing.width * POINT, drawing.height * POINT
    draw(cairo.SVGSurface(str(drawing.path(".svg")), *page), drawing)


if __name__ == "__main__":
    main(".svg", write)
