"""vsketch: a sketch of polygons, saved."""

from __future__ import annotations

import vsketch

from benchmarks.peers.drawn import Drawing, main


def prepare(drawing: Drawing) -> vsketch.Vsketch:
    """Return the sketch."""
    sketch = vsketch.Vsketch()
    sketch.size(f"{drawing.width}mm", f"{drawing.height}mm", center=False)
    sketch.scale("mm")
    for ring in drawing.points:
        sketch.polygon(ring, close=True)
    return sketch


def write(drawing: Drawing, sketch: vsketch.Vsketch) -> None:
    """Save the sketch."""
    sketch.save(str(drawing.path(".svg")))


if __name__ == "__main__":
    main(".svg", write, prepare)
