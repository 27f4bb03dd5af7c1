"""SVG, PDF and DXF by three programs: svgwrite around ready strings, cairosvg of that file, ezdxf."""

from __future__ import annotations

import cairosvg

from benchmarks.peers import ezdxf_dxf, svgwrite_ready
from benchmarks.peers.drawn import Drawing, main


def write(drawing: Drawing, _: None) -> None:
    """Write the three files."""
    svgwrite_ready.write(drawing, None)
    cairosvg.svg2pdf(url=str(drawing.path(".svg")), write_to=str(drawing.path(".pdf")))
    ezdxf_dxf.write(drawing, None)


if __name__ == "__main__":
    main(".svg", write)
