"""svgwrite as it comes: ``polygon(points=…)`` for each mark."""

from __future__ import annotations

import svgwrite

from benchmarks.peers.drawn import Drawing, main


def write(drawing: Drawing, _: None) -> None:
    """Draw and save."""
    page = svgwrite.Drawing(
        str(drawing.path(".svg")),
        size=(f"{drawing.width}mm", f"{drawing.height}mm"),
        viewBox=f"0 0 {drawing.width} {drawing.height}",
    )
    for ring in drawing.points.tolist():
        page.add(page.polygon(points=ring))
    page.save()


if __name__ == "__main__":
    main(".svg", write)
