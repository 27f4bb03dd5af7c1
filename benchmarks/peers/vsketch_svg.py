"""vsketch: a sketch of polygons, saved."""

from __future__ import annotations

import vsketch

from benchmarks.peers.drawn import Drawing, main


def page(width: float, height: float) -> vsketch.Vsketch:
    """Return an empty page of so many mm, drawn on in mm."""
    sketch = vsketch.Vsketch()
    sketch.size(f"{width}mm", f"{height}mm", center=False)
    sketch.scale("mm")
    return sketch


def prepare(drawing: Drawing) -> vsketch.Vsketch:
    """Return the sketch."""
    sketch = page(drawing.width, drawing.height)
    for ring in drawing.points:
        sketch.polygon(ring, close=True)
    return sketch


def write(drawing: Drawing, sketch: vsketch.Vsketch) -> None:
    """Save the sketch."""
    sketch.save(str(drawing.path(".svg")))


if __name__ == "__main__":
    main(".svg", write, prepare)
