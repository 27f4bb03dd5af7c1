"""All of a PDF but its drawing: catalogue, page with its boxes, layers, colour spaces, metadata."""

from __future__ import annotations

import math
from collections.abc import Iterator

from batik_vector.artwork import Page
from batik_vector.errors import ExportError, UnsupportedByFormatError
from batik_vector.export.options import PdfInks, PdfOptions
from batik_vector.export.pdf import metadata, print_standard
from batik_vector.export.pdf.container import INFO
from batik_vector.export.pdf.icc import IccProfile, icc_profile
from batik_vector.export.pdf.separations import paints_of
from batik_vector.export.pdf.spelling import number, text
from batik_vector.units import STEPS_PER_MM

POINTS_PER_STEP = 72 / 25.4 / STEPS_PER_MM
LONGEST_SIDE = 14_400
"""Units in a side at most (ISO 32000-1, annex C); ``UserUnit`` makes the unit larger."""
PAGES, PAGE, DRAWING, METADATA = 2, 3, 4, 5
"""Numbers of objects; the catalogue is the first."""
LAID_OVER = (
    "/ExtGState << /Over << /Type /ExtGState /OP true /op true /OPM 1 >> "
    "/Cut << /Type /ExtGState /OP false /op false /OPM 0 >> >> "
)
"""Whether what is drawn leaves other plates as they are (ISO 32000-1, 8.6.7)."""


def units_per_user_unit(page: Page) -> int:
    """Return by what ``UserUnit`` a page's units are larger than points: 1 up to 5.08 m, and a warning else.

    Some programs pass ``UserUnit`` over, and show the page so many times too small.
    """
    return max(1, math.ceil(max(size_of(page)) * POINTS_PER_STEP / LONGEST_SIDE))


def size_of(page: Page) -> tuple[int, int]:
    """Return breadth and height of a page with its margins, in grid steps."""
    cell, margins = page.cell, page.margins
    return (cell.columns + margins.left + margins.right, cell.rows + margins.bottom + margins.top)


def press_of(options: PdfOptions) -> IccProfile | None:
    """Return the profile of the press that a file is for, if it is for one.

    Raises:
        UnsupportedByFormatError: where it has not been read, or is none.
    """
    if not options.icc:
        return None
    if options.icc_profile is None:
        raise UnsupportedByFormatError(
            f'icc = "{options.icc}": not read, expected the file beside the recipe'
        )
    try:
        return icc_profile(options.icc_profile)
    except ExportError as error:
        raise UnsupportedByFormatError(f'icc = "{options.icc}": {error}') from error


class Document:
    """The numbered objects around the drawing."""

    def __init__(self, page: Page, options: PdfOptions) -> None:
        self.page, self.options = page, options
        self.size = size_of(page)
        self.unit = units_per_user_unit(page)
        self.press = press_of(options)
        if self.press is not None:
            print_standard.check(page, options, self.press, self.unit)
        self.paints = paints_of(page, options, self.press.space if self.press else "")
        self.layers = ["cloth"] * options.shows_cloth + [plate.ink.name for plate in page.plates]
        first = INFO + 1
        self.groups = range(first, first + len(self.layers))
        spaces = sum(bool(paint.space) for paint in self.paints)
        self.spaces = range(self.groups.stop, self.groups.stop + spaces)
        self.profile_number = self.spaces.stop
        self.length_number = self.profile_number + (self.press is not None)
        """Of the object that holds the drawing's length, should that come behind it: the last."""

    @property
    def overprints(self) -> bool:
        """Whether any paint leaves other plates as they are."""
        return any(paint.overprint for paint in self.paints)

    def before(self) -> Iterator[bytes]:
        """Yield the objects that come before the drawing."""
        listed = " ".join(f"{each} 0 R" for each in self.groups)
        told = press = ""
        if self.press is not None:
            told = f"/Name {text('Layers')} "
            press = print_standard.catalogue(self.profile_number, self.options, self.press)
        order = f"/OCProperties << /OCGs [{listed}] /D << {told}/Order [{listed}] /ON [{listed}] >> >>"
        layers = order if self.layers else ""
        head = f"<< /Type /Catalog /Pages {PAGES} 0 R /Metadata {METADATA} 0 R"
        yield f"{head} {press}{layers} >>".encode("ascii")
        yield f"<< /Type /Pages /Kids [{PAGE} 0 R] /Count 1 >>".encode("ascii")
        yield self._page_object()

    def behind(self) -> Iterator[bytes]:
        """Yield the objects that come behind it."""
        namespaces = more = info = ""
        if self.press is not None:
            namespaces, more = print_standard.NAMESPACES, print_standard.metadata(self.page, self.options)
            info = print_standard.info(self.page, self.options)
        packet = metadata.packet(self.page, namespaces, more)
        yield b"<< /Type /Metadata /Subtype /XML /Length %d >>\nstream\n%b\nendstream" % (len(packet), packet)
        yield metadata.info(self.page, info)
        for name in self.layers:
            yield f"<< /Type /OCG /Name {text(name)} >>".encode("ascii")
        if self.options.inks is PdfInks.SPOT:
            yield from (paint.space for paint in self.paints)
        if self.press is not None:
            yield print_standard.profile_object(self.press)

    def resources(self) -> str:
        """Return what the drawing names: layers, colour spaces, and how inks lie over one another."""
        properties = " ".join(f"/L{i} {each} 0 R" for i, each in enumerate(self.groups))
        spaces = " ".join(f"/S{i} {each} 0 R" for i, each in enumerate(self.spaces))
        over = LAID_OVER if self.overprints else ""
        return f"<< /Properties << {properties} >> {over}/ColorSpace << {spaces} >> >>"

    def _page_object(self) -> bytes:
        cell, margins = self.page.cell, self.page.margins
        bleed = round(self.page.bleed * STEPS_PER_MM)
        x, y = margins.left, margins.bottom
        width, height = self.size
        whole = self._box(0, 0, width, height)
        inked = self._box(
            max(x - bleed, 0),
            max(y - bleed, 0),
            min(x + cell.columns + bleed, width),
            min(y + cell.rows + bleed, height),
        )
        trim = self._box(x, y, x + cell.columns, y + cell.rows)
        unit = f"/UserUnit {self.unit} " if self.unit > 1 else ""
        return (
            f"<< /Type /Page /Parent {PAGES} 0 R /MediaBox {whole} /CropBox {whole} /BleedBox {inked} "
            f"/TrimBox {trim} {unit}/Contents {DRAWING} 0 R /Resources {self.resources()} >>"
        ).encode("ascii")

    def _box(self, *edges: int) -> str:
        return "[" + " ".join(points(steps, self.unit) for steps in edges) + "]"


def points(steps: float, unit: float) -> str:
    """Return a length in page units, rounded down: a hair too wide, and renderers add a row of pixels."""
    return number(math.floor(steps * POINTS_PER_STEP / unit * 1e8) / 1e8, 8)
