"""All of a PDF but its drawing: catalogue, page with its boxes, layers, colour spaces, metadata."""

from __future__ import annotations

import math
from collections.abc import Iterator

from batik_vector.artwork import Ink, Page
from batik_vector.errors import ExportError, UnsupportedByFormatError
from batik_vector.export.options import Pages, PdfInks, PdfOptions
from batik_vector.export.pdf import metadata, print_standard
from batik_vector.export.pdf.container import INFO
from batik_vector.export.pdf.icc import IccProfile, icc_profile
from batik_vector.export.pdf.separations import paints_of, separation, told
from batik_vector.export.pdf.sheets import LINE, Window, planned
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


def units_per_user_unit(page: Page, options: PdfOptions | None = None) -> int:
    """Return by what ``UserUnit`` a page's units are larger than points: 1 up to 5.08 m, and a warning else.

    Some programs pass ``UserUnit`` over, and show the page so many times too small. Divided over pages, none
    is so large.
    """
    if options is not None and options.pages is Pages.TILE:
        return 1
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
        self.sheets = planned(self.size, options)
        self.unit = units_per_user_unit(page, options)
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
        first = self.profile_number + (self.press is not None)
        count = len(self.sheets.windows) if self.sheets.divided else 0
        self.shows = range(first, first + count)
        """The contents of several pages, each of which shows the drawing."""
        self.others = range(self.shows.stop, self.shows.stop + max(count - 1, 0))
        """The pages after the first."""
        self.length_number = self.others.stop
        """Of the object that holds the drawing's length, should that come behind it: the last."""

    @property
    def overprints(self) -> bool:
        """Whether any paint leaves other plates as they are."""
        return any(paint.overprint for paint in self.paints)

    def before(self) -> Iterator[bytes]:
        """Yield the objects that come before the drawing."""
        listed = " ".join(f"{each} 0 R" for each in self.groups)
        named = press = ""
        if self.press is not None:
            named = f"/Name {text('Layers')} "
            press = print_standard.catalogue(self.profile_number, self.options, self.press)
        order = f"/OCProperties << /OCGs [{listed}] /D << {named}/Order [{listed}] /ON [{listed}] >> >>"
        layers = order if self.layers else ""
        head = f"<< /Type /Catalog /Pages {PAGES} 0 R /Metadata {METADATA} 0 R"
        yield f"{head} {press}{layers} >>".encode("ascii")
        kids = [f"{each} 0 R" for each in (PAGE, *self.others)]
        yield f"<< /Type /Pages /Kids [{' '.join(kids)}] /Count {len(kids)} >>".encode("ascii")
        yield self._page_object(0)

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
        if self.sheets.divided:
            yield from (self._show(window) for window in self.sheets.windows)
            yield from (self._page_object(each) for each in range(1, len(self.sheets.windows)))

    def resources(self) -> str:
        """Return what the drawing names: layers, colour spaces, and how inks lie over one another."""
        properties = " ".join(f"/L{i} {each} 0 R" for i, each in enumerate(self.groups))
        spaces = " ".join(f"/S{i} {each} 0 R" for i, each in enumerate(self.spaces))
        over = LAID_OVER if self.overprints else ""
        return f"<< /Properties << {properties} >> {over}/ColorSpace << {spaces} >> >>"

    def drawing_entries(self) -> bytes:
        """Return what the dictionary of the drawing's stream says where several pages show it."""
        if not self.sheets.divided:
            return b""
        whole = self._box(0, 0, *self.size)
        return f"/Type /XObject /Subtype /Form /BBox {whole} /Resources {self.resources()} ".encode("ascii")

    def _show(self, window: Window) -> bytes:
        """Return the contents of a page that shows a part of the drawing, and the crosses on it."""
        x, y = (number(-steps * POINTS_PER_STEP, 8) for steps in (window.left, window.bottom))
        scale = number(POINTS_PER_STEP, 16)
        fill = "/All CS 1 SCN" if self.options.inks is PdfInks.SPOT else "0 0 0 RG"
        marks = "".join(self.sheets.marks(window))
        body = f"1 0 0 1 {x} {y} cm\n/Drawing Do\n{scale} 0 0 {scale} 0 0 cm\n{fill}\n{LINE} w\n{marks}"
        return f"<< /Length {len(body)} >>\nstream\n{body}\nendstream".encode("ascii")

    def _page_object(self, which: int) -> bytes:
        cell, margins, window = self.page.cell, self.page.margins, self.sheets.windows[which]
        bleed = round(self.page.bleed * STEPS_PER_MM)
        x, y = margins.left, margins.bottom
        whole = self._box(0, 0, window.width, window.height)
        inked = self._part(window, x - bleed, y - bleed, x + cell.columns + bleed, y + cell.rows + bleed)
        trim = self._part(window, x, y, x + cell.columns, y + cell.rows)
        unit = f"/UserUnit {self.unit} " if self.unit > 1 else ""
        contents, resources = DRAWING, self.resources()
        if self.sheets.divided:
            contents, resources = self.shows[which], self._of_show()
        return (
            f"<< /Type /Page /Parent {PAGES} 0 R /MediaBox {whole} /CropBox {whole} /BleedBox {inked} "
            f"/TrimBox {trim} {unit}/Contents {contents} 0 R /Resources {resources} >>"
        ).encode("ascii")

    def _of_show(self) -> str:
        """Return what the contents of one of several pages name."""
        if self.options.inks is not PdfInks.SPOT:
            return f"<< /XObject << /Drawing {DRAWING} 0 R >> >>"
        ink = Ink("marks", "#000000")
        alternate = self.options.alternate or told(ink, self.press.space if self.press else "")
        every = separation("All", ink, alternate).decode("ascii")
        return f"<< /XObject << /Drawing {DRAWING} 0 R >> /ColorSpace << /All {every} >> >>"

    def _part(self, window: Window, left: int, bottom: int, right: int, top: int) -> str:
        """Return the box that a page shows of a rectangle of the drawing; all of it where that is nothing."""
        x0, y0 = max(left - window.left, 0), max(bottom - window.bottom, 0)
        x1, y1 = min(right - window.left, window.width), min(top - window.bottom, window.height)
        if x0 >= x1 or y0 >= y1:
            return self._box(0, 0, window.width, window.height)
        return self._box(x0, y0, x1, y1)

    def _box(self, *edges: int) -> str:
        return "[" + " ".join(points(steps, self.unit) for steps in edges) + "]"


def points(steps: float, unit: float) -> str:
    """Return a length in page units, rounded down: a hair too wide, and renderers add a row of pixels."""
    return number(math.floor(steps * POINTS_PER_STEP / unit * 1e8) / 1e8, 8)
