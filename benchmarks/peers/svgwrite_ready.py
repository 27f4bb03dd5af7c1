"""svgwrite around ready ``d`` strings, its checks switched off: as fast as it can be made."""

from __future__ import annotations

import svgwrite

from benchmarks.peers.drawn import Drawing, main


def write(drawing: Drawing, _: None) -> None:
    """Draw and save."""
    page = svgwrite.Drawing(
        str(drawing.path(".svg")),
        size=(f"{drawing.width}mm", f"{drawing.height}mm"),
        viewBox=f"0 0 {drawing.width} {drawing.height}",
        debug=False,
    )
    pattern = "M" + "L".join(["%.3f %.3f"] * drawing.points.shape[1]) + "Z"
    for ring in drawing.points.reshape(len(drawing.points), -1).tolist():
        page.add(page.path(d=pattern % tuple(ring)))
    page.save()


if __name__ == "__main__":
    main(".svg", write)
