"""TIFF: plates for film setters and engravers, one bit to a pixel, compressed as facsimile (CCITT Group 4).

TIFF Revision 6.0 (Adobe 1992), sections 8 and 11; ITU-T T.6. All inks of a page are black, the rest is
white; an output separates them before. Resolutions are fractions, and exact. libtiff compresses strips of
some rows one after the other, so that the picture is never in memory. The file carries recipe, seed and
version (ImageDescription), and holds no time.
"""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator
from fractions import Fraction
from typing import Any, BinaryIO

from batik_vector.artwork import Page
from batik_vector.errors import MissingLibraryError
from batik_vector.export.options import TiffOptions
from batik_vector.export.provenance import TIFF_DESCRIPTION, ascii_line
from batik_vector.export.raster import HALF_INCH, Bits, Sheet, bands, sheet_of
from batik_vector.export.walk import in_memory

SHORT, LONG, ASCII, RATIONAL = 3, 4, 2, 5
SIZES = {SHORT: 2, LONG: 4, ASCII: 1, RATIONAL: 8}
STRIP_OFFSETS, STRIP_BYTES, ROWS_PER_STRIP = 273, 279, 278
MOST = 2**32 - 1
"""Of a number in a TIFF."""
STRIP = 256
"""Rows of a strip."""

DEFAULTS = TiffOptions()


def check_ready() -> None:
    """Raise where no TIFF can be written on this system.

    Raises:
        MissingLibraryError: with what is to be installed.
    """
    _compressor()


def _compressor() -> Any:
    words = "TIFF needs Pillow with libtiff, which this system lacks: pip install --upgrade pillow"
    try:
        from PIL import Image, features
    except ImportError as error:
        raise MissingLibraryError(words) from error
    if not features.check("libtiff"):
        raise MissingLibraryError(words)
    return Image


def render(page: Page, options: TiffOptions = DEFAULTS) -> bytes:
    """Return a page as a TIFF file; see :func:`write`."""
    return in_memory(lambda sink: write(page, sink, options))


def write(page: Page, sink: BinaryIO, options: TiffOptions = DEFAULTS) -> None:
    """Write a page as a TIFF file, strip by strip.

    Raises:
        UnsupportedByFormatError: where it would have too many pixels.
        MissingLibraryError: where Pillow or its libtiff are missing.
    """
    sheet = sheet_of(page, options.dpi)
    # Little-endian; where the tags stand is known at the end.
    sink.write(b"II*\0" + bytes(4))
    offsets, sizes, at = [], [], 8
    for strip in _strips(page, sheet):
        sink.write(strip)
        offsets.append(at)
        sizes.append(len(strip))
        at += len(strip)
    sink.write(bytes(at % 2))
    at += at % 2
    sink.write(_directory(at, _fields(page, sheet, offsets, sizes)))
    end = sink.tell()
    sink.seek(4)
    sink.write(struct.pack("<I", at))
    sink.seek(end)


def _strips(page: Page, sheet: Sheet) -> Iterator[bytes]:
    image = _compressor()
    for bits in bands(page, sheet, STRIP):
        yield _compressed(image, bits, sheet.width)


def _compressed(image: Any, bits: Bits, width: int) -> bytes:
    """Return rows as libtiff compresses them; it is we who say that 1 is black."""
    made = io.BytesIO()
    strip = image.frombytes("1", (width, len(bits)), bits.tobytes())
    strip.save(made, "TIFF", compression="group4", strip_size=len(bits) * (width // 8 + 1))
    with image.open(io.BytesIO(made.getvalue())) as read:
        (start,), (size,) = read.tag_v2[STRIP_OFFSETS], read.tag_v2[STRIP_BYTES]
    return made.getvalue()[start : start + size]


def _fields(
    page: Page, sheet: Sheet, offsets: list[int], sizes: list[int]
) -> list[tuple[int, int, list[int] | bytes | Fraction]]:
    """Return the tags of a plate, each with its type and its values, in ascending order."""
    inks = ", ".join(plate.ink.name for plate in page.plates if not plate.guide)
    across, down = (_writable(HALF_INCH / half) for half in (sheet.across, sheet.down))
    return [
        (254, LONG, [0]),
        (256, LONG, [sheet.width]),
        (257, LONG, [sheet.height]),
        (258, SHORT, [1]),
        (259, SHORT, [4]),  # T.6
        (262, SHORT, [0]),  # 0 is white
        (269, ASCII, _ascii(page.title)),
        (TIFF_DESCRIPTION, ASCII, _ascii(ascii_line(page.provenance))),
        (STRIP_OFFSETS, LONG, offsets),
        (274, SHORT, [1]),
        (277, SHORT, [1]),
        (ROWS_PER_STRIP, LONG, [STRIP]),
        (STRIP_BYTES, LONG, sizes),
        (282, RATIONAL, across),
        (283, RATIONAL, down),
        (285, ASCII, _ascii(inks)),
        (293, LONG, [0]),
        (296, SHORT, [2]),
        (305, ASCII, _ascii(f"batik_vector {page.provenance.version}".rstrip())),
    ]


def _writable(found: Fraction) -> Fraction:
    """Return a resolution as a fraction of numbers that a TIFF can hold."""
    while max(found.numerator, found.denominator) > MOST:
        found = found.limit_denominator(found.denominator // 2)
    return found


def _ascii(text: str) -> bytes:
    return text.encode("ascii", "replace") + b"\0"


def _directory(at: int, fields: list[tuple[int, int, list[int] | bytes | Fraction]]) -> bytes:
    """Return the tags as they stand in a file from ``at``, and behind them what has no room in them."""
    entries, rest = [], b""
    behind = at + 2 + 12 * len(fields) + 4
    for tag, kind, values in fields:
        body = _spelled(kind, values)
        count = len(body) // SIZES[kind]
        if len(body) <= 4:
            value = body.ljust(4, b"\0")
        else:
            value = struct.pack("<I", behind + len(rest))
            rest += body + bytes(len(body) % 2)
        entries.append(struct.pack("<HHI", tag, kind, count) + value)
    return struct.pack("<H", len(entries)) + b"".join(entries) + bytes(4) + rest


def _spelled(kind: int, values: list[int] | bytes | Fraction) -> bytes:
    if isinstance(values, bytes):
        return values
    if isinstance(values, Fraction):
        return struct.pack("<II", values.numerator, values.denominator)
    return struct.pack(f"<{len(values)}{'H' if kind == SHORT else 'I'}", *values)
