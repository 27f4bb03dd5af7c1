"""PNG of one bit to a pixel: plates for those who take no TIFF. Black is what the page's inks cover.

It is written in bands, so that the picture is never in memory.
"""

from __future__ import annotations

import zlib
from typing import BinaryIO

from batik_vector.artwork import Page
from batik_vector.export.png_chunks import SIGNATURE, chunk, physical, text
from batik_vector.export.raster import bands, sheet_of


def write(page: Page, sink: BinaryIO, dpi: float) -> None:
    """Write what a page's inks cover as a PNG file, band by band.

    Raises:
        UnsupportedByFormatError: where it would have too many pixels.
    """
    sheet = sheet_of(page, dpi)
    header = sheet.width.to_bytes(4, "big") + sheet.height.to_bytes(4, "big") + bytes([1, 0, 0, 0, 0])
    sink.write(SIGNATURE + chunk(b"IHDR", header) + physical(dpi) + text(page.provenance))
    packer = zlib.compressobj(6)
    for bits in bands(page, sheet):
        # Each row begins with its filter, none; 1 is white.
        rows = b"".join(b"\0" + row.tobytes() for row in ~bits)
        if packed := packer.compress(rows):
            sink.write(chunk(b"IDAT", packed))
    sink.write(chunk(b"IDAT", packer.flush()) + chunk(b"IEND", b""))
