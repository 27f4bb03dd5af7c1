"""PNG: a preview for the screen, drawn by cairo; or a plate of one bit to a pixel.

It shows a tile without its bleed, so previews tile as the cloth does; a page that comes in pieces is shown
with its margins. The file says its resolution (pHYs) and carries recipe, seed and version (tEXt); it holds
no time.
"""

from __future__ import annotations

import sys
import zlib
from dataclasses import replace
from importlib import import_module
from typing import Any, BinaryIO

import numpy as np

from batik_vector.artwork import Artwork, Page
from batik_vector.errors import MissingLibraryError, UnsupportedByFormatError
from batik_vector.export import png_bilevel
from batik_vector.export.options import PngOptions
from batik_vector.export.png_cairo import drawn
from batik_vector.export.png_chunks import SIGNATURE, chunk, physical, text
from batik_vector.export.walk import in_memory
from batik_vector.units import STEPS_PER_MM

MAX_PIXELS = 120_000_000
"""Four bytes each in memory: half a gigabyte."""
MAX_SIDE = 32_767
"""The longest side that cairo draws."""
MAX_VERTICES = 5_000_000
"""Vertices that are drawn at most: cairo holds those of an ink in memory, and as many edges."""
LARGE_PIXELS = 16_000_000
"""Pixels from which a picture is drawn with fewer shades at borders, and packed by us: twice as fast."""
BAND = 256
"""Rows that are packed at once."""
AFTER_HEADER = 8 + 25
"""Bytes of the signature and the IHDR chunk, behind which other chunks may stand."""

DEFAULTS = PngOptions()


def cairo_drawer() -> Any:
    """Return cairosvg.

    Raises:
        MissingLibraryError: where the system lacks cairo, with what is to be installed.
    """
    return _with_cairo("cairosvg")


def cairo() -> Any:
    """Return cairocffi, which cairosvg draws with and brings along; it is imported far sooner.

    Raises:
        MissingLibraryError: as of :func:`cairo_drawer`.
    """
    return _with_cairo("cairocffi")


def _with_cairo(name: str) -> Any:
    try:
        return import_module(name)
    except (ImportError, OSError) as error:
        # No wheel brings cairo along, and cairocffi looks for it when it is imported.
        raise MissingLibraryError(
            "PNG needs the cairo library, which this system lacks: install libcairo2 (Debian, Ubuntu: apt), "
            "cairo (macOS: brew) or the GTK runtime (Windows: winget install tschoonj.GTKForWindows)"
        ) from error


def check_ready() -> None:
    """Raise where no PNG can be written on this system.

    Raises:
        MissingLibraryError: with what is to be installed.
    """
    cairo()


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
    """Write a picture of a page as a PNG file.

    Raises:
        ExportError: where the page holds what cannot be written, or would have too many pixels or vertices.
    """
    if options.bilevel:
        png_bilevel.write(_shown(page), sink, options.dpi)
        return
    # Sides are rounded to whole pixels each by itself, and the picture fills them.
    size = pixel_size(page, options.dpi)
    if page.vertex_count > MAX_VERTICES:
        raise UnsupportedByFormatError(
            f"a preview of about {page.vertex_count:,} vertices, past the limit of {MAX_VERTICES:,}: "
            "show less cloth, or the tile"
        )
    large = size[0] * size[1] >= LARGE_PIXELS
    surface = drawn(_shown(page), size, options.cloth, cairo(), fine=not large)
    chunks = physical(options.dpi) + text(page.provenance)
    if options.cloth and large:
        _write_opaque(surface, sink, chunks)
    else:
        data: bytes = surface.write_to_png()
        sink.write(data[:AFTER_HEADER] + chunks + data[AFTER_HEADER:])


def render(page: Page, options: PngOptions = DEFAULTS) -> bytes:
    """Return a picture of a page as a PNG file; see :func:`write`."""
    return in_memory(lambda sink: write(page, sink, options))


def _write_opaque(surface: Any, sink: BinaryIO, chunks: bytes) -> None:
    """Write a surface of cairo's without its alpha, packed in a third of the time that libpng takes."""
    width, height = surface.get_width(), surface.get_height()
    header = width.to_bytes(4, "big") + height.to_bytes(4, "big") + bytes([8, 2, 0, 0, 0])
    sink.write(SIGNATURE + chunk(b"IHDR", header) + chunks)
    pixels = np.frombuffer(surface.get_data(), np.uint8).reshape(height, -1, 4)[:, :width]
    # Cairo keeps a pixel as one number: alpha, red, green, blue from its highest byte on.
    shade = pixels[..., :3][..., ::-1] if sys.byteorder == "little" else pixels[..., 1:]
    packer = zlib.compressobj(1)
    for first in range(0, height, BAND):
        band = shade[first : first + BAND]
        # Each row begins with its filter, none.
        rows = np.zeros((len(band), 1 + 3 * width), np.uint8)
        for each in range(3):
            rows[:, 1 + each :: 3] = band[..., each]
        if packed := packer.compress(rows.data):
            sink.write(chunk(b"IDAT", packed))
    sink.write(chunk(b"IDAT", packer.flush()) + chunk(b"IEND", b""))
