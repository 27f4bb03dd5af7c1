"""pycairo: a path for each mark on a PDF surface."""

from __future__ import annotations

import cairo

from benchmarks.peers.drawn import Drawing, main
from benchmarks.peers.pycairo_svg import POINT, draw


def write(drawing: Drawing, _: None) -> None:
    """Draw and save."""
    page = drawing.width * POINT, drawing.height * POINT
    draw(cairo.PDFSurface(str(drawing.path(".pdf")), *page), drawing)


if __name__ == "__main__":
    main(".pdf", write)
