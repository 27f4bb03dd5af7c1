"""cairosvg: the SVG that batik_vector wrote, as PDF."""

from __future__ import annotations

import cairosvg

from benchmarks.peers.drawn import WARM, Drawing, main


def write(drawing: Drawing, _: None) -> None:
    """Convert and save."""
    source = "warm.svg" if len(drawing.points) == WARM else "drawing.svg"
    cairosvg.svg2pdf(url=str(drawing.folder / source), write_to=str(drawing.path(".pdf")))


if __name__ == "__main__":
    main(".pdf", write)
