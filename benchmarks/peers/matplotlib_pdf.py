"""matplotlib: one ``PolyCollection``, saved as PDF."""

from __future__ import annotations

from benchmarks.peers.drawn import Drawing, main
from benchmarks.peers.matplotlib_svg import draw


def write(drawing: Drawing, _: None) -> None:
    """Draw and save."""
    draw(drawing, ".pdf")


if __name__ == "__main__":
    main(".pdf", write)
