"""ASE: the inks as Adobe Swatch Exchange; see :mod:`batik_vector.export.swatches`."""

from __future__ import annotations

from typing import TYPE_CHECKING, BinaryIO

from batik_vector.export.options import PaletteOptions
from batik_vector.export.swatches import ase

if TYPE_CHECKING:
    from batik_vector.artwork import Page

DEFAULTS = PaletteOptions()


def render(page: Page, options: PaletteOptions = DEFAULTS) -> bytes:
    """Return the inks of a page as a file."""
    return ase(page, options)


def write(page: Page, sink: BinaryIO, options: PaletteOptions = DEFAULTS) -> None:
    """Write the inks of a page as a file."""
    sink.write(render(page, options))
