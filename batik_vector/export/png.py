"""PNG: a preview for the screen, drawn from our own SVG by cairosvg.

It shows the cell without its bleed, so previews tile as the cloth does. The file says its resolution
(pHYs) and carries recipe, seed and version (tEXt); it holds no time.
"""

from __future__ import annotations

import zlib
from dataclasses import replace

from batik_vector.artwork import Artwork
from batik_vector.errors import UnsupportedByFormatError
from batik_vector.export import svg
from batik_vector.export.options import PngOptions, Profile, SvgOptions
from batik_vector.export.provenance import PNG_KEYWORD, ascii_line

MAX_PIXELS = 120_000_000
"""Four bytes each in memory: half a gigabyte."""
MAX_SIDE = 32_767
"""The longest side that cairo draws."""
AFTER_HEADER = 8 + 25
"""Bytes of the signature and the IHDR chunk, behind which other chunks may stand."""

DEFAULTS = PngOptions()


def pixel_size(artwork: Artwork, dpi: float) -> tuple[int, int]:
    """Return how many pixels wide and high the cell is.

    Raises:
        UnsupportedByFormatError: where that is more than can be drawn, with the estimate.
    """
    width, height = (max(1, round(side / 25.4 * dpi)) for side in (artwork.cell.width, artwork.cell.height))
    if width * height > MAX_PIXELS or max(width, height) > MAX_SIDE:
        most = min(dpi * (MAX_PIXELS / (width * height)) ** 0.5, dpi * MAX_SIDE / max(width, height))
        raise UnsupportedByFormatError(
            f"a preview at {dpi:g} dpi would have {width:,} × {height:,} pixels "
            f"({width * height * 4 / 1e9:.1f} GB): {int(most)} dpi is the most for this cell"
        )
    return width, height


def render(artwork: Artwork, options: PngOptions = DEFAULTS) -> bytes:
    """Return a picture of the artwork's cell as a PNG file.

    Raises:
        ExportError: where the artwork holds what cannot be written, or would have too many pixels.
    """
    width, height = pixel_size(artwork, options.dpi)
    drawing = svg.render(
        replace(artwork, bleed=0.0), SvgOptions(profile=Profile.COMPACT, cloth=options.cloth)
    )
    # Sides are rounded to whole pixels each by itself, and the picture fills them.
    drawing = drawing.replace(b" viewBox=", b' preserveAspectRatio="none" viewBox=', 1)
    import cairosvg

    data: bytes = cairosvg.svg2png(bytestring=drawing, output_width=width, output_height=height)
    per_metre = round(options.dpi / 0.0254).to_bytes(4, "big")
    chunks = _chunk(b"pHYs", per_metre + per_metre + b"\1")
    chunks += _chunk(b"tEXt", PNG_KEYWORD + b"\0" + ascii_line(artwork.provenance).encode("ascii"))
    return data[:AFTER_HEADER] + chunks + data[AFTER_HEADER:]


def _chunk(kind: bytes, body: bytes) -> bytes:
    return len(body).to_bytes(4, "big") + kind + body + zlib.crc32(kind + body).to_bytes(4, "big")
