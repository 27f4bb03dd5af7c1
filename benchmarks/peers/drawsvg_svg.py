"""drawsvg: ``Lines`` for each mark."""

from __future__ import annotations

import drawsvg

from benchmarks.peers.drawn import Drawing, main


def write(drawing: Drawing, _: None) -> None:
    """Draw and save."""
    page = drawsvg.Drawing(drawing.width, drawing.height)
    for ring in drawing.points.reshape(len(drawing.points), -1).tolist():
        page.append(drawsvg.Lines(*ring, close=True, fill="#1a1a1a"))
    page.save_svg(str(drawing.path(".svg")))


if __name__ == "__main__":
    main(".svg", write)
