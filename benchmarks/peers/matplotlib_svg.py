"""matplotlib: one ``PolyCollection``, saved as SVG."""

from __future__ import annotations

from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from benchmarks.peers.drawn import Drawing, main


def draw(drawing: Drawing, suffix: str) -> None:
    """Draw and save."""
    figure = Figure(figsize=(drawing.width / 25.4, drawing.height / 25.4))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set_xlim(0, drawing.width)
    axes.set_ylim(drawing.height, 0)
    axes.add_collection(PolyCollection(list(drawing.points), facecolors="#1a1a1a", edgecolors="none"))
    figure.savefig(drawing.path(suffix))


def write(drawing: Drawing, _: None) -> None:
    """Draw and save."""
    draw(drawing, ".svg")


if __name__ == "__main__":
    main(".svg", write)
