"""vpype: a document of line collections, and ``write_svg``."""

from __future__ import annotations

import vpype

from benchmarks.peers.drawn import Drawing, main

PX = 96 / 25.4
"""vpype counts in CSS pixels."""


def prepare(drawing: Drawing) -> vpype.Document:
    """Return the document."""
    lines = vpype.LineCollection()
    for ring in drawing.points * PX:
        line = ring[:, 0] + 1j * ring[:, 1]
        lines.append([*line, line[0]])
    document = vpype.Document(page_size=(drawing.width * PX, drawing.height * PX))
    document.add(lines, 1)
    return document


def write(drawing: Drawing, document: vpype.Document) -> None:
    """Write the document."""
    with open(drawing.path(".svg"), "w", encoding="utf-8") as sink:
        vpype.write_svg(sink, document)


if __name__ == "__main__":
    main(".svg", write, prepare)
