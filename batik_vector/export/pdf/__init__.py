"""PDF: 1:1 pages with trim and bleed boxes, one layer per ink, vectors only.

Coordinates are whole micrometres under a single matrix, so the stream is digits and letters and is
written as fast as text, compressed as it comes. Layers are optional-content groups (ISO 32000-1, 8.11),
which PDF 1.5 has; the page is 1.6 for ``UserUnit``, without which no side may pass 14,400 units = 5.08 m.
Nothing in the file changes from run to run: no clock is read, and the ID is a hash of the content.

Where inks are separations, nothing is drawn in any other colour: a fill in RGB is printed with all four
process inks. So the cloth is left out, or is a separation like the others where it is asked for.

The media box is the cell grown by the page's margins; the bleed box is the cell grown by the bleed; the trim
box is the cell.
"""

from __future__ import annotations

from typing import BinaryIO

from batik_vector.artwork import Ink, Page
from batik_vector.export.options import Curves, PdfOptions
from batik_vector.export.pdf.container import File, Stream
from batik_vector.export.pdf.document import DRAWING, POINTS_PER_STEP, Document
from batik_vector.export.pdf.operators import path_operators
from batik_vector.export.pdf.spelling import number
from batik_vector.export.strokes import Pen
from batik_vector.export.walk import Outlines, in_memory, walk
from batik_vector.units import STEPS_PER_MM

DEFAULTS = PdfOptions()


def render(page: Page, options: PdfOptions = DEFAULTS) -> bytes:
    """Return a page as a PDF file; see :func:`write`."""
    return in_memory(lambda sink: write(page, sink, options))


def write(page: Page, sink: BinaryIO, options: PdfOptions = DEFAULTS) -> None:
    """Write a page as a PDF file of one page, or of several over which it is divided.

    Raises:
        ExportError: where the page holds what cannot be written.
    """
    walk(page, _PdfSurface(sink, options))


class _PdfSurface:
    """Writes the objects around the content stream, and the stream as it comes."""

    def __init__(self, sink: BinaryIO, options: PdfOptions) -> None:
        self._sink = sink
        self._options = options
        self._layer_count = 0
        self._over = False

    def begin(self, page: Page) -> None:
        self._document = Document(page, self._options)
        chosen = self._options.curve_tolerance or page.tolerance
        self._pen = Pen(page, chosen if self._options.curves is Curves.BEZIER else None)
        self._number = -1
        self._file = File(self._sink)
        for at, body in enumerate(self._document.before(), start=1):
            self._file.whole(at, body)
        self._content = Stream(
            self._file, DRAWING, self._document.length_number, self._document.drawing_entries()
        )
        scale = number(POINTS_PER_STEP / self._document.unit, 16)
        self._put(f"{scale} 0 0 {scale} 0 0 cm\n1 J 1 j\n")
        if self._options.shows_cloth:
            width, height = self._document.size
            self._layer()
            self._put(f"{self._paint.fill}0 0 {width} {height} re\nf\n")

    def ink(self, ink: Ink, pen: int) -> None:
        self._number += 1
        self._ink = ink
        self._layer()
        self._coloured = [False, False]

    def areas(self, outlines: Outlines) -> None:
        if not self._coloured[0]:
            self._coloured[0] = True
            self._put(self._paint.fill)
        self._content.put(
            path_operators(self._pen.strokes(outlines, self._number, "areas"), "f*", outlines.unfinished)
        )

    def lines(self, outlines: Outlines) -> None:
        if not self._coloured[1]:
            self._coloured[1] = True
            width = round(self._ink.width * STEPS_PER_MM)
            self._put(f"{self._paint.stroke}{width} w\n")
        self._content.put(
            path_operators(self._pen.strokes(outlines, self._number, "lines"), "S", outlines.unfinished)
        )

    def end(self) -> None:
        if self._layer_count:
            self._put("EMC\n")
        self._content.end()
        for at, body in enumerate(self._document.behind(), start=DRAWING + 1):
            self._file.whole(at, body)
        self._file.end()

    def _put(self, words: str) -> None:
        self._content.put(words.encode("ascii"))

    def _layer(self) -> None:
        """Open the next layer, and lay it over what is beneath as its paint says."""
        at = self._layer_count
        self._put(f"EMC\n/OC /L{at} BDC\n" if at else f"/OC /L{at} BDC\n")
        self._layer_count += 1
        self._paint = self._document.paints[at]
        if self._paint.overprint != self._over:
            self._over = self._paint.overprint
            self._put("/Over gs\n" if self._over else "/Cut gs\n")
