"""Contact sheets: the pictures of many variants on pages to print, look at and hang up.

Pages are SVGs of nested drawings. PDF and PNG are drawn from them by cairo, with the fonts of the system.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path
from xml.sax.saxutils import escape

from batik_vector.errors import RecipeError, unknown_name
from batik_vector.export.files import write_all_whole
from batik_vector.export.png import cairo_drawer
from batik_vector.making.thumbnails import Thumbnail
from batik_vector.values import frozen

PAPERS = {
    "A5": (148, 210),
    "A4": (210, 297),
    "A3": (297, 420),
    "A2": (420, 594),
    "A1": (594, 841),
    "A0": (841, 1189),
}
"""Breadth and height in mm, upright. ISO 216."""
FORMATS = ("svg", "pdf", "png")
DPI = 200
"""Of PNGs."""
INK, FAINT, PAPER = "#2b2622", "#8d857c", "#fbf9f5"
FONT = "font-family=\"'Source Sans 3', 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif\""
LEAST, WIDEST = 24.0, 90.0
"""Breadth of a picture in mm, where pictures are many and where they are few."""
MARGINS = 17.5
"""How many margins the shorter side of a page is broad."""
MOST_SHARE = 1.5
"""By how much a picture may be taller than broad, or the other way round."""


@frozen
class Entry:
    """A place on a sheet: its picture, or None where nothing came of it, and the lines below it."""

    picture: Thumbnail | None
    caption: tuple[str, ...]


@frozen
class Plan:
    """How a sheet is laid out, in mm."""

    width: float
    height: float
    margin: float
    head: float
    columns: int
    rows: int
    breadth: float
    picture: float
    gap: float
    letters: float
    lines: int

    @property
    def each(self) -> int:
        """Pictures on a page."""
        return self.columns * self.rows

    @property
    def pitch(self) -> float:
        """From one row to the next."""
        return self.picture + self.letters * (1.35 * self.lines + 0.9) + self.gap


def plan(count: int, shape: float, lines: int, paper: str = "A4", columns: int = 0) -> Plan:
    """Return the layout on which the pictures are largest and one page holds them all, if one can.

    The page lies on its side where that makes them larger: many columns and few rows.

    Args:
        count: how many pictures.
        shape: their height over their breadth.
        lines: below each.
        paper: a name of ``PAPERS``.
        columns: how many, where that is known; else what fits best.

    Raises:
        RecipeError: where there is no such paper.
    """
    if paper not in PAPERS:
        raise RecipeError(unknown_name(paper, list(PAPERS), "paper"))
    upright, lying = PAPERS[paper], PAPERS[paper][::-1]
    shape = min(max(shape, 1 / MOST_SHARE), MOST_SHARE)
    found = [_best(count, shape, lines, size, columns) for size in (upright, lying)]
    # The first of equals, and of those that need several pages.
    return max(found, key=lambda each: each.breadth if each.each >= count else 0.0)


def _best(count: int, shape: float, lines: int, size: tuple[int, int], columns: int) -> Plan:
    """Do the work of :func:`plan` for one way to lay the page."""
    width, height = (float(side) for side in size)
    short = min(size)
    most = int((width - 2 * short / MARGINS + 3) / (LEAST + 3))
    layouts = [_laid_out(width, height, each, shape, lines) for each in range(1, most + 1)]
    if columns and columns <= most:
        return layouts[columns - 1]
    # Few pictures do not fill a page for its own sake.
    fits = [each for each in layouts if each.each >= count and each.breadth <= WIDEST * short / 210]
    return fits[0] if fits else layouts[-1]


def _laid_out(width: float, height: float, columns: int, shape: float, lines: int) -> Plan:
    short = min(width, height)
    margin = short / MARGINS
    gap = max(3.0, (width - 2 * margin) / columns * 0.08)
    breadth = (width - 2 * margin - gap * (columns - 1)) / columns
    letters = min(max(breadth / 15, 1.6), short / 70)
    head = short / 11
    page = Plan(width, height, margin, head, columns, 1, breadth, breadth * shape, gap, letters, lines)
    rows = max(1, int((height - 2 * margin - head + gap) / page.pitch))
    return replace(page, rows=rows)


def pages(
    entries: Iterator[Entry], count: int, page: Plan, title: str, about: Sequence[str]
) -> Iterator[str]:
    """Yield the pages of a sheet as SVG.

    Args:
        entries: ``count`` of them, in order.
        count: how many.
        page: the layout.
        title: of the sheet.
        about: what is told beside it, a line each.
    """
    total = max(1, math.ceil(count / page.each))
    for number in range(total):
        yield _page(list(islice(entries, page.each)), page, title, about, (number + 1, total))


def _page(
    entries: Sequence[Entry], page: Plan, title: str, about: Sequence[str], number: tuple[int, int]
) -> str:
    width, height = page.width, page.height
    told = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}mm" height="{height:g}mm" '
        f'viewBox="0 0 {width:g} {height:g}">\n<title>{escape(title)}</title>\n'
        f'<rect width="{width:g}" height="{height:g}" fill="{PAPER}"/>\n'
    ]
    short = min(width, height)
    large, small = short / 32, short / 80
    told.append(_text(page.margin, page.margin + large, large, title, INK, weight=600))
    for row, line in enumerate(about):
        told.append(
            _text(page.margin, page.margin + large + small * (0.6 + 1.45 * (row + 1)), small, line, FAINT)
        )
    if number[1] > 1:
        told.append(
            _text(
                width - page.margin, page.margin + large, small, f"{number[0]} of {number[1]}", FAINT, "end"
            )
        )
    for place, entry in enumerate(entries):
        x = page.margin + place % page.columns * (page.breadth + page.gap)
        y = page.margin + page.head + place // page.columns * page.pitch
        told.append(_entry(entry, x, y, page))
    told.append("</svg>\n")
    return "".join(told)


def _entry(entry: Entry, x: float, y: float, page: Plan) -> str:
    told = []
    if entry.picture is None:
        frame = f'fill="none" stroke="{FAINT}" stroke-width="0.2" stroke-dasharray="1 1"'
        told.append(
            f'<rect x="{x:.2f}" y="{y:.2f}" width="{page.breadth:.2f}" '
            f'height="{page.picture:.2f}" {frame}/>\n'
        )
        told.append(
            _text(x + page.breadth / 2, y + page.picture / 2, page.letters, "not made", FAINT, "middle")
        )
    else:
        told.append(_swatch(entry.picture, x, y, page))
    for row, line in enumerate(entry.caption):
        told.append(_text(x, y + page.picture + page.letters * 1.35 * (row + 1), page.letters, line, INK))
    return "".join(told)


def _swatch(picture: Thumbnail, x: float, y: float, page: Plan) -> str:
    """Return a picture in its frame: of the shape of the frame by repeating it, or by cutting what is over.

    Tiles repeat, so that a frame filled with them shows them as they are on cloth.
    """
    view = picture.width, picture.width * page.picture / page.breadth
    ups = range(max(1, math.ceil(view[1] / picture.height)))
    marks = "".join(
        picture.marks if up == 0 else f'<g transform="translate(0 {up * picture.height})">{picture.marks}</g>'
        for up in ups
    )
    return (
        f'<svg x="{x:.2f}" y="{y:.2f}" width="{page.breadth:.2f}" height="{page.picture:.2f}" '
        f'viewBox="0 0 {view[0]:g} {view[1]:.2f}">'
        f'<rect width="{view[0]:g}" height="{view[1]:.2f}" fill="{picture.cloth}"/>{marks}</svg>\n'
    )


def _text(
    x: float, y: float, size: float, words: str, colour: str, anchor: str = "start", weight: int = 400
) -> str:
    return (
        f'<text x="{x:.2f}" y="{y:.2f}" font-size="{size:.2f}" {FONT} font-weight="{weight}" '
        f'text-anchor="{anchor}" fill="{colour}">{escape(words)}</text>\n'
    )


def write_sheet(
    folder: Path, stem: str, sheet: Iterator[str], formats: Sequence[str], page: Plan
) -> list[Path]:
    """Write a sheet: SVGs and PNGs a page each, numbered where there are several, PDFs in one.

    Raises:
        ExportError: where a file cannot be written, or the system lacks what draws PDF and PNG.
    """
    drawn = list(sheet)
    endings = [f"-{number + 1}" if len(drawn) > 1 else "" for number in range(len(drawn))]
    files: list[tuple[Path, bytes]] = []
    if "svg" in formats:
        files += [
            (folder / f"{stem}{end}.svg", each.encode()) for end, each in zip(endings, drawn, strict=True)
        ]
    if "pdf" in formats:
        files.append((folder / f"{stem}.pdf", _pdf(drawn)))
    if "png" in formats:
        files += [
            (folder / f"{stem}{end}.png", _png(each, page.width))
            for end, each in zip(endings, drawn, strict=True)
        ]
    write_all_whole(files)
    return [path for path, _ in files]


def _pdf(drawn: Sequence[str]) -> bytes:
    import pikepdf

    made = pikepdf.new()
    for page in drawn:
        # Cairo writes the time into its files; pages alone are taken over.
        with pikepdf.open(io.BytesIO(cairo_drawer().svg2pdf(page.encode()))) as one:
            made.pages.extend(one.pages)
    sink = io.BytesIO()
    made.save(sink, deterministic_id=True)
    return sink.getvalue()


def _png(page: str, breadth: float) -> bytes:
    made: bytes = cairo_drawer().svg2png(page.encode(), output_width=round(breadth / 25.4 * DPI))
    return made
