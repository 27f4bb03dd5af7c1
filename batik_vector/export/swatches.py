"""Palettes: the inks of a page by their names and colours, as programs import them.

GPL is GIMP's and Inkscape's, a text (https://developer.gimp.org/core/standards/gpl/). ASE, Adobe Swatch
Exchange, is read by Illustrator and Photoshop: big-endian blocks of UTF-16 names and floats, as
http://www.selapa.net/swatches/colors/fileformats.php#adobe_ase describes them.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import TYPE_CHECKING

from batik_vector.export.options import PaletteOptions
from batik_vector.export.palette import rgb, xml_label

if TYPE_CHECKING:
    from batik_vector.artwork import Page

GROUP_START, GROUP_END, COLOUR = 0xC001, 0xC002, 0x0001
GLOBAL = 0
"""The kind of an ASE colour that is known by its name in all of a document."""
LONGEST_NAME = 200


def colours(page: Page, options: PaletteOptions) -> Iterator[tuple[str, str]]:
    """Yield names and colours of the inks, the lowest first, and of the cloth before them."""
    if options.cloth:
        yield "cloth", page.cloth
    for plate in page.plates:
        if not plate.guide:
            yield xml_label(plate.ink.name)[:LONGEST_NAME], plate.ink.colour


def gpl(page: Page, options: PaletteOptions) -> bytes:
    """Return the inks of a page as a palette of GIMP and Inkscape."""
    lines = ["GIMP Palette", f"Name: {xml_label(page.title)}", "Columns: 0", "#"]
    lines += ["{:3} {:3} {:3}\t{}".format(*rgb(colour), name) for name, colour in colours(page, options)]
    return ("\n".join(lines) + "\n").encode("utf-8")


def ase(page: Page, options: PaletteOptions) -> bytes:
    """Return the inks of a page as an Adobe Swatch Exchange file."""
    blocks = [_block(GROUP_START, _name(xml_label(page.title)[:LONGEST_NAME]))]
    for name, colour in colours(page, options):
        parts = (part / 255 for part in rgb(colour))
        blocks.append(_block(COLOUR, _name(name) + struct.pack(">4s3fH", b"RGB ", *parts, GLOBAL)))
    blocks.append(_block(GROUP_END, b""))
    return struct.pack(">4sHHI", b"ASEF", 1, 0, len(blocks)) + b"".join(blocks)


def _block(kind: int, data: bytes) -> bytes:
    return struct.pack(">HI", kind, len(data)) + data


def _name(text: str) -> bytes:
    """Return a name: how many units of UTF-16 it has, with the nought at its end, and these."""
    written = text.encode("utf-16-be") + b"\0\0"
    return struct.pack(">H", len(written) // 2) + written
