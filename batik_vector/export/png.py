"""PNG: a preview for the screen, drawn from our own SVG by cairosvg; or a plate of one bit to a pixel.

It shows a tile without its bleed, so previews tile as the cloth does; a page that comes in pieces is shown
with its margins. The file says its resolution (pHYs) and carries recipe, seed and version (tEXt); it holds
no time.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, BinaryIO

from batik_vector.artwork import Artwork, Page
from batik_vector.errors import MissingLibraryError, UnsupportedByFormatError
from batik_vector.export import png_bilevel, svg
from batik_vector.export.options import PngOptions, Profile, SvgOptions
from batik_vector.export.png_chunks import physical, text
from batik_vector.export.walk import in_memory
from batik_vector.units import STEPS_PER_MM

MAX_PIXELS = 120_000_000
"""Four bytes each in memory: half a gigabyte."""
MAX_SIDE = 32_767
"""The longest side that cairo draws."""
MAX_VERTICES = 5_000_000
"""Vertices that are drawn at most: the drawing is held in memory as text and as a tree."""
AFTER_HEADER = 8 + 25
"""Bytes of the signature and the IHDR chunk, behind which other chunks may stand."""

DEFAULTS = PngOptions()


def cairo_drawer() -> Any:
    """Return cairosvg.

    Raises:
        MissingLibraryError: where the system lacks cairo, with what is to be installed.
    """
    try:
        import cairosvg
    except (ImportError, OSError) as error:
        # No wheel brings cairo along, and cairocffi looks for it when it is imported.
        raise MissingLibraryError(
            "PNG needs the cairo library, which this system lacks: install libcairo2 (Debian, Ubuntu: apt), "
            "cairo (macOS: brew) or the GTK runtime (Windows: winget install tschoonj.GTKForWindows)"
        ) from error
    return cairosvg


def check_ready() -> None:
    """Raise where no PNG can be written on this system.

    Raises:
        MissingLibraryError: with what is to be installed.
    """
    cairo_drawer()


def pixel_size(page: Page, dpi: float) -> tuple[int, int]:
    """Return how many pixels wide and high the picture is.

    Raises:
        UnsupportedByFormatError: where that is more than can be drawn, with the estimate.
    """
    margins = _shown(page).margins
    columns = page.cell.columns + margins.left + margins.right
    rows = page.cell.rows + margins.bottom + margins.top
    width, height = (max(1, round(side / STEPS_PER_MM / 25.4 * dpi)) for side in (columns, rows))
    if width * height > MAX_PIXELS or max(width, height) > MAX_SIDE:
        most = min(dpi * (MAX_PIXELS / (width * height)) ** 0.5, dpi * MAX_SIDE / max(width, height))
        raise UnsupportedByFormatError(
            f"a preview at {dpi:g} dpi would have {width:,} × {height:,} pixels "
            f"({width * height * 4 / 1e9:.1f} GB): "
            + (f"{int(most)} dpi is the most for this cell" if most >= 1 else "show less cloth, or the tile")
        )
    return width, height


def _shown(page: Page) -> Page:
    return replace(page, bleed=0.0) if isinstance(page, Artwork) else page


def write(page: Page, sink: BinaryIO, options: PngOptions = DEFAULTS) -> None:
    """Write a picture of a page as a PNG file; see :func:`render`."""
    if options.bilevel:
        png_bilevel.write(_shown(page), sink, options.dpi)
    else:
        sink.write(render(page, options))


def render(page: Page, options: PngOptions = DEFAULTS) -> bytes:
    """Return a picture of a page as a PNG file.

    Raises:
        ExportError: where the page holds what cannot be written, or would have too many pixels or vertices.
    """
    if options.bilevel:
        return in_memory(lambda sink: write(page, sink, options))
    width, height = pixel_size(page, options.dpi)
    if page.vertex_count > MAX_VERTICES:
        raise UnsupportedByFormatError(
            f"a preview of about {page.vertex_count:,} vertices, past the limit of {MAX_VERTICES:,}: "
            "show less cloth, or the tile"
        )
    drawing = svg.render(_shown(page), SvgOptions(profile=Profile.COMPACT, cloth=options.cloth, order=False))
    # Sides are rounded to whole pixels each by itself, and the picture fills them.
    drawing = drawing.replace(b" viewBox=", b' preserveAspectRatio="none" viewBox=', 1)
    data: bytes = cairo_drawer().svg2png(bytestring=drawing, output_width=width, output_height=height)
    chunks = physical(options.dpi) + text(page.provenance)
    return data[:AFTER_HEADER] + chunks + data[AFTER_HEADER:]
