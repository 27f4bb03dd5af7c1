"""Writers: an artwork becomes a file. A new format is a file beside this one, and a line in ``FORMATS``.

    write_artwork(artwork, "kawung.dxf")
    write_artwork(artwork, "kawung.svg", options=SvgOptions(profile=Profile.COMPACT))

What is drawn is a :class:`~batik_vector.artwork.Page`: an artwork, or metres of cloth that come in pieces. An
artwork that is not in the normal form is refused; ``check=False`` writes it as it is.

A new format is a module with ``write(page, sink, options)`` and ``render(page, options) -> bytes``, an
options class in :mod:`batik_vector.export.options`, and a line in ``FORMATS``.
"""

from __future__ import annotations

import os
import re
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, BinaryIO

from batik_vector.errors import ExportError, UnknownNameError
from batik_vector.export.files import write_all_whole, write_whole
from batik_vector.export.options import (
    Curves,
    DxfOptions,
    DxfVersion,
    GcodeOptions,
    HpglOptions,
    Pages,
    PaletteOptions,
    PdfInks,
    PdfOptions,
    PngOptions,
    Profile,
    SvgOptions,
    SwatchOptions,
    TiffOptions,
    Turn,
)
from batik_vector.fields import Catalogue, Instead, given
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.artwork import Page

__all__ = [
    "FORMATS",
    "Curves",
    "DxfOptions",
    "DxfVersion",
    "Format",
    "GcodeOptions",
    "HpglOptions",
    "Pages",
    "PaletteOptions",
    "PdfInks",
    "PdfOptions",
    "PngOptions",
    "Profile",
    "SvgOptions",
    "SwatchOptions",
    "TiffOptions",
    "Turn",
    "format_of",
    "render",
    "write_all_whole",
    "write_artwork",
    "write_page",
    "write_whole",
]


@frozen
class Format:
    """One kind of file: its suffix, its options, one line of help, and the module that writes it.

    The module is imported when it is first needed, since some pull in much.
    """

    suffix: str
    options: type
    says: str
    module: str

    def check_ready(self) -> None:
        """Raise where this system lacks what the format needs.

        Raises:
            MissingLibraryError: with what is to be installed.
        """
        check = getattr(import_module(self.module), "check_ready", None)
        if check is not None:
            check()

    def render(self, page: Page, options: Any) -> bytes:
        """Return the page as a file of this format."""
        data: bytes = import_module(self.module).render(page, options)
        return data

    def write(self, page: Page, sink: BinaryIO, options: Any) -> None:
        """Write the page as a file of this format, piece by piece."""
        import_module(self.module).write(page, sink, options)

    def divides(self, options: Any) -> bool:
        """Return whether a page may be divided over several files, of which none has been chosen."""
        return getattr(options, "pages", None) is Pages.TILE and getattr(options, "sheet", ()) is None

    def parts(self, page: Page, options: Any) -> list[tuple[str, dict[str, Any]]]:
        """Return the files that a page is divided over, none where it need not be.

        Returns:
            What is added to the name of each, and which options are its own.
        """
        parts: list[tuple[str, dict[str, Any]]] = import_module(self.module).parts(page, options)
        return parts


def _of_plugin(name: str, cls: Any) -> Format:
    """Return the row of a plug-in's format, which the class of its outputs tells.

    Raises:
        ValueError: with what that class lacks.
    """
    suffix, module = getattr(cls, "suffix", ""), getattr(cls, "module", "")
    if not re.fullmatch(r"(-[a-z0-9]+)?(\.[a-z0-9]+)+", suffix):
        raise ValueError(f'suffix = "{suffix}", expected one such as ".csv"')
    if suffix in {FORMATS[each].suffix for each in FORMATS.own}:
        raise ValueError(f'suffix = "{suffix}", which is another format\'s')
    if not module:
        raise ValueError("expected module = where its write and render stand")
    return Format(suffix, cls.writer, (cls.__doc__ or name).partition("\n")[0].rstrip("."), module)


FORMATS: Catalogue[Format] = Catalogue(
    "formats",
    {
        "svg": Format(
            ".svg", SvgOptions, "layers for Inkscape, Illustrator, plotters", "batik_vector.export.svg"
        ),
        "pdf": Format(".pdf", PdfOptions, "1:1 pages with trim, bleed and layers", "batik_vector.export.pdf"),
        "dxf": Format(".dxf", DxfOptions, "closed polylines for cutters and CAD", "batik_vector.export.dxf"),
        "hpgl": Format(
            ".hpgl", HpglOptions, "strokes for pen plotters and vinyl cutters", "batik_vector.export.hpgl"
        ),
        "gcode": Format(
            ".gcode", GcodeOptions, "strokes in the words of a machine", "batik_vector.export.gcode"
        ),
        "png": Format(".png", PngOptions, "a preview for the screen", "batik_vector.export.png"),
        "tiff": Format(
            ".tiff", TiffOptions, "plates of one bit, one for each ink", "batik_vector.export.tiff"
        ),
        "swatch": Format(
            "-swatch.svg", SwatchOptions, "a pattern to fill shapes with", "batik_vector.export.swatch"
        ),
        "gpl": Format(
            ".gpl", PaletteOptions, "the inks as a palette for Inkscape, GIMP", "batik_vector.export.gpl"
        ),
        "ase": Format(
            ".ase", PaletteOptions, "the inks as swatches for Illustrator", "batik_vector.export.ase"
        ),
    },
    lambda: object,
    _of_plugin,
)


def format_of(path: str | os.PathLike[str]) -> str:
    """Return the name of the format that a path's suffix asks for.

    Raises:
        UnknownNameError: where no format has that suffix.
    """
    given(path, str | os.PathLike, "path")
    suffix = Path(path).suffix.lower()
    for name, known in FORMATS.items():
        if known.suffix == suffix:
            return name
    raise UnknownNameError(suffix.removeprefix(".") or Path(path).name, list(FORMATS), "format")


def render(artwork: Page, format: str, options: Any = None, *, check: bool = True) -> bytes:
    """Return an artwork, or any other page, as the bytes of a file.

    Args:
        artwork: what to write, in the normal form.
        format: a name in ``FORMATS``.
        options: an instance of the format's options class; its defaults when left out.
        check: whether an artwork that breaks the normal form is refused. A page that comes in pieces is not
            looked at.

    Raises:
        UnknownNameError: where the format is unknown.
        ExportError: where the artwork breaks the normal form or cannot be written in the format, or the
            options are another format's.
    """
    chosen, options = _chosen(format, options)
    _refuse_unsound(artwork, check)
    return chosen.render(artwork, options)


def write_page(page: Page, sink: BinaryIO, format: str, options: Any = None, *, check: bool = True) -> None:
    """Write a page into a sink, piece by piece: memory does not grow with the page, but to check an artwork.

    Args:
        page: what to write, in the normal form.
        sink: open for writing and seeking.
        format: a name in ``FORMATS``.
        options, check: see :func:`render`.

    Raises:
        UnknownNameError: where the format is unknown.
        ExportError: where the page cannot be written; see :func:`render`.
    """
    chosen, options = _chosen(format, options)
    _refuse_unsound(page, check)
    chosen.write(page, sink, options)


def _chosen(format: str, options: Any) -> tuple[Format, Any]:
    given(format, str, "format")
    if format not in FORMATS:
        raise UnknownNameError(format, list(FORMATS), "format")
    chosen = FORMATS[format]
    if options is None:
        options = chosen.options()
    if not isinstance(options, chosen.options):
        raise ExportError(
            f"{type(options).__name__} are no options of {format}: expected {chosen.options.__name__}"
        )
    return chosen, options


def _refuse_unsound(page: Page, check: bool) -> None:
    """Raise where a page is none or, if that is to be checked, an artwork breaks the normal form."""
    # Formats are named in help, too, which does without all that geometry needs.
    from batik_vector.artwork import Artwork, violations

    if not hasattr(type(page), "plates"):
        given(page, Annotated[Artwork, Instead("an Artwork: compile_recipe(recipe) makes one")], "artwork")
    broken = violations(page) if check and isinstance(page, Artwork) else []
    if broken:
        raise ExportError(
            f'"{page.title}" breaks the normal form: {"; ".join(broken)}. '
            "Mend it, or write it as it is with check=False"
        )


def write_artwork(
    artwork: Page,
    path: str | os.PathLike[str],
    format: str | None = None,
    options: Any = None,
    *,
    check: bool = True,
) -> Path:
    """Write an artwork, or any other page, to a file, whole or not at all.

    Args:
        artwork: what to write, in the normal form.
        path: where to.
        format: a name in ``FORMATS``; by the path's suffix when left out.
        options, check: see :func:`render`.

    Returns:
        The path.

    Raises:
        UnknownNameError: where the format is unknown.
        ExportError: where the artwork or the file cannot be written; see :func:`render`.
    """
    given(path, str | os.PathLike, "path")
    chosen, options = _chosen(format or format_of(path), options)
    _refuse_unsound(artwork, check)
    write_whole(path, lambda sink: chosen.write(artwork, sink, options))
    return Path(path)
