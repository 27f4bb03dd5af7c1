"""svgwrite as it comes: a path for each mark, and ``push`` for each vertex."""

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
        path = page.path()
        path.push("M", *ring[0])
        for vertex in ring[1:]:
            path.push("L", *vertex)
        path.push("Z")
        page.add(path)
    page.save()


if __name__ == "__main__":
    main(".svg", write)
