"""ezdxf: ``add_lwpolyline`` for each mark in an R2000 drawing, and ``saveas``."""

from __future__ import annotations

from ezdxf import units
from ezdxf.filemanagement import new

from benchmarks.peers.drawn import Drawing, main


def write(drawing: Drawing, _: None) -> None:
    """Draw and save."""
    page = new("R2000", units=units.MM)
    page.layers.add("WAX")
    space = page.modelspace()
    for ring in drawing.points:
        space.add_lwpolyline(ring, close=True, dxfattribs={"layer": "WAX"})
    page.saveas(drawing.path(".dxf"))


if __name__ == "__main__":
    main(".dxf", write)
