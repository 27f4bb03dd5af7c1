"""Writers: an artwork becomes a file.

    write_artwork(artwork, "kawung.dxf")
    write_artwork(artwork, "kawung.svg", options=SvgOptions(profile=Profile.COMPACT))

A new format is a module with ``render(artwork, options) -> bytes``, an options class in
:mod:`batik_vector.export.options`, and a line in ``FORMATS``.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from batik_vector.errors import ExportError, UnknownNameError
from batik_vector.export.files import write_all_whole, write_whole
from batik_vector.export.options import (
    Curves,
    DxfOptions,
    DxfVersion,
    PdfInks,
    PdfOptions,
    PngOptions,
    Profile,
    SvgOptions,
)

if TYPE_CHECKING:
    from batik_vector.artwork import Artwork

__all__ = [
    "FORMATS",
    "Curves",
    "DxfOptions",
    "DxfVersion",
    "Format",
    "PdfInks",
    "PdfOptions",
    "PngOptions",
    "Profile",
    "SvgOptions",
    "format_of",
    "render",
    "write_all_whole",
    "write_artwork",
    "write_whole",
]


@dataclass(frozen=True)
class Format:
    """One kind of file: its suffix, its options, one line of help, and the module that writes it.

    The module is imported when it is first needed, since some pull in much.
    """

    suffix: str
    options: type
    says: str
    module: str

    def render(self, artwork: Artwork, options: Any) -> bytes:
        """Return the artwork as a file of this format."""
        data: bytes = import_module(self.module).render(artwork, options)
        return data


FORMATS: Mapping[str, Format] = MappingProxyType(
    {
        "svg": Format(
            ".svg", SvgOptions, "layers for Inkscape, Illustrator, plotters", "batik_vector.export.svg"
        ),
        "pdf": Format(".pdf", PdfOptions, "1:1 pages with trim, bleed and layers", "batik_vector.export.pdf"),
        "dxf": Format(".dxf", DxfOptions, "closed polylines for cutters and CAD", "batik_vector.export.dxf"),
        "png": Format(".png", PngOptions, "a preview for the screen", "batik_vector.export.png"),
    }
)


def format_of(path: str | os.PathLike[str]) -> str:
    """Return the name of the format that a path's suffix asks for.

    Raises:
        UnknownNameError: where no format has that suffix.
    """
    suffix = Path(path).suffix.lower()
    for name, known in FORMATS.items():
        if known.suffix == suffix:
            return name
    raise UnknownNameError(suffix.removeprefix(".") or Path(path).name, list(FORMATS), "format")


def render(artwork: Artwork, format: str, options: Any = None) -> bytes:
    """Return an artwork as the bytes of a file.

    Args:
        artwork: what to write, in the normal form.
        format: a name in ``FORMATS``.
        options: an instance of the format's options class; its defaults when left out.

    Raises:
        UnknownNameError: where the format is unknown.
        ExportError: where the artwork cannot be written in it, or the options are another format's.
    """
    if format not in FORMATS:
        raise UnknownNameError(format, list(FORMATS), "format")
    chosen = FORMATS[format]
    if options is None:
        options = chosen.options()
    if not isinstance(options, chosen.options):
        raise ExportError(
            f"{type(options).__name__} are no options of {format}: expected {chosen.options.__name__}"
        )
    return chosen.render(artwork, options)


def write_artwork(
    artwork: Artwork, path: str | os.PathLike[str], format: str | None = None, options: Any = None
) -> Path:
    """Write an artwork to a file, whole or not at all.

    Args:
        artwork: what to write, in the normal form.
        path: where to.
        format: a name in ``FORMATS``; by the path's suffix when left out.
        options: see :func:`render`.

    Returns:
        The path.

    Raises:
        UnknownNameError: where the format is unknown.
        ExportError: where the artwork or the file cannot be written.
    """
    write_whole(path, render(artwork, format or format_of(path), options))
    return Path(path)
