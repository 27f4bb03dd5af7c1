"""The files a recipe asks for: a format, its options, and what of the pattern goes into the file."""

from __future__ import annotations

import enum
import re
from dataclasses import field, fields, replace
from typing import Annotated, Any, ClassVar, TypeAlias

from batik_vector.export.options import (
    DxfOptions,
    GcodeOptions,
    HpglOptions,
    PaletteOptions,
    PdfInks,
    PdfOptions,
    PngOptions,
    SvgOptions,
    SwatchOptions,
    TiffOptions,
)
from batik_vector.fields import HIDDEN, Alone, Between, Catalogue, Length, OneOf, Says, Text, check, named
from batik_vector.machines.profile import Machine
from batik_vector.processes.options import AnyProcess
from batik_vector.processes.printing.options import PlateColour, SeparateProcess
from batik_vector.values import frozen

_FILE_WORD = r"[\w][\w .+-]{0,79}(?<![ .])\Z"
Ways: TypeAlias = Annotated[
    bool, Says("after a process, show the ways with the tool up, thin, in a layer that plotters skip")
]
Marks: TypeAlias = Annotated[
    bool, Says("crop and registration marks, the names of the inks, and a patch of each, round the page")
]
Count: TypeAlias = Annotated[int, Between(1, 200)]


class Piece(enum.StrEnum):
    """What of the pattern goes into a file."""

    TILE = "tile"
    """What repeats."""
    YARDAGE = "yardage"
    """The cloth that the tile fills, as large as the recipe's yardage says."""


def parse_file_word(text: str) -> str:
    """Return a text that may stand in the name of a file on any system.

    Raises:
        ValueError: with what was expected.
    """
    if text and not re.match(_FILE_WORD, text):
        raise ValueError("expected letters, digits, spaces and - _ + . only, no folder")
    return text


@frozen(kw_only=True)
class OutputSpec:
    """A file to write. Each format has a class of its own in ``OUTPUTS``, with the options of its writer.

    That of a plug-in says of its format, too, what ``FORMATS`` says of the program's: its ``suffix``, and the
    ``module`` that writes it.
    """

    format: ClassVar[str] = ""
    writer: ClassVar[type] = object
    suffix: ClassVar[str] = ""
    module: ClassVar[str] = ""

    name: Annotated[
        str,
        Text(parse_file_word, "part of a file name"),
        Says("added to the file's name, to tell several of one format apart"),
    ] = ""
    piece: Annotated[
        Piece | None, Says("the tile or the yardage; the yardage when left out, where the recipe has one")
    ] = None
    process: Annotated[
        tuple[AnyProcess, ...], Alone(), Says("what a machine needs done to it, one after the other")
    ] = ()
    machine: Annotated[
        str,
        Says('the machine it is for: a profile that comes with the program, or a file such as "mine.toml"'),
    ] = ""
    machine_profile: Machine | None = field(default=None, metadata={HIDDEN: True})
    """The machine, once its profile has been read."""

    def __post_init__(self) -> None:
        check(self)

    def completed(self) -> OutputSpec:
        """Return the output with the processes that its format cannot do without."""
        return self

    @property
    def options(self) -> Any:
        """The options of the format's writer, an instance of its own class."""
        return self.writer(**{each.name: getattr(self, each.name) for each in fields(self.writer)})


@frozen(kw_only=True)
class SvgOutput(OutputSpec, SvgOptions):
    """An SVG file: layers for Inkscape, Illustrator and plotters."""

    format = "svg"
    writer = SvgOptions
    travel: Ways = False
    repeat: Annotated[
        tuple[Count, Count], Says("how many tiles across and up", called="tiles across, tiles up")
    ] = (1, 1)
    marks: Marks = False


@frozen(kw_only=True)
class PdfOutput(OutputSpec, PdfOptions):
    """A PDF file: pages 1:1."""

    format = "pdf"
    writer = PdfOptions
    travel: Ways = False
    bleed: Annotated[
        Annotated[Length, Between(0, 100)], Says("how far the pattern goes on beyond the trim")
    ] = 0.0
    marks: Marks = False
    wrap: Annotated[
        bool | None,
        Says(
            "lines along the tile's edge show their other half on the opposite one, too: unless told, with "
            "spot inks"
        ),
    ] = None

    @property
    def wraps(self) -> bool:
        """Whether lines along the tile's edge are drawn on the opposite edge too."""
        return self.inks is PdfInks.SPOT if self.wrap is None else self.wrap


@frozen(kw_only=True)
class DxfOutput(OutputSpec, DxfOptions):
    """A DXF file: closed polylines for cutters and CAD."""

    format = "dxf"
    writer = DxfOptions


@frozen(kw_only=True)
class HpglOutput(OutputSpec, HpglOptions):
    """An HPGL file: strokes for pen plotters and vinyl cutters."""

    format = "hpgl"
    writer = HpglOptions

    @property
    def options(self) -> HpglOptions:
        """The options of the format's writer, for the machine that the file is for."""
        options: HpglOptions = OutputSpec.options.__get__(self)
        if self.machine_profile is None:
            return options
        return replace(options, device=self.machine_profile.hpgl_device)


@frozen(kw_only=True)
class GcodeOutput(OutputSpec, GcodeOptions):
    """G-code: strokes for plotters, lasers, drag knives and wax pens that speak it."""

    format = "gcode"
    writer = GcodeOptions


@frozen(kw_only=True)
class PngOutput(OutputSpec, PngOptions):
    """A PNG file: a preview for the screen, or plates of one bit to a pixel."""

    format = "png"
    writer = PngOptions
    travel: Ways = False
    repeat: Annotated[
        tuple[Count, Count], Says("how many tiles across and up", called="tiles across, tiles up")
    ] = (1, 1)
    marks: Marks = False

    @property
    def options(self) -> PngOptions:
        """The options of the format's writer; what is separated in black has one bit unless told."""
        options: PngOptions = OutputSpec.options.__get__(self)
        plates = [each for each in self.process if isinstance(each, SeparateProcess)]
        if self.bilevel is None and plates:
            return replace(options, bilevel=plates[-1].colour == PlateColour.BLACK)
        return options


@frozen(kw_only=True)
class TiffOutput(OutputSpec, TiffOptions):
    """TIFF files: plates of one bit to a pixel (CCITT Group 4), one for each ink."""

    format = "tiff"
    writer = TiffOptions
    marks: Marks = False

    def completed(self) -> TiffOutput:
        """Return the output with what it goes through in the end: one bit tells of one ink."""
        if any(isinstance(each, SeparateProcess) for each in self.process):
            return self
        return replace(self, process=(*self.process, SeparateProcess()))


@frozen(kw_only=True)
class SwatchOutput(OutputSpec, SwatchOptions):
    """A swatch: an SVG whose tile is a pattern, for Inkscape and Illustrator to fill shapes with."""

    format = "swatch"
    writer = SwatchOptions
    piece: Annotated[Piece | None, Says("the tile: a cloth is no pattern")] = Piece.TILE


@frozen(kw_only=True)
class GplOutput(OutputSpec, PaletteOptions):
    """The inks as a palette of GIMP and Inkscape."""

    format = "gpl"
    writer = PaletteOptions


@frozen(kw_only=True)
class AseOutput(OutputSpec, PaletteOptions):
    """The inks as Adobe Swatch Exchange, for Illustrator and Photoshop."""

    format = "ase"
    writer = PaletteOptions


OUTPUTS: Catalogue[type[OutputSpec]] = Catalogue(
    "formats",
    {
        output.format: output
        for output in (
            SvgOutput,
            PdfOutput,
            DxfOutput,
            HpglOutput,
            GcodeOutput,
            PngOutput,
            TiffOutput,
            SwatchOutput,
            GplOutput,
            AseOutput,
        )
    },
    lambda: OutputSpec,
    named("format", OutputSpec),
)
"""The catalogue of formats that a recipe may ask for."""

AnyOutput: TypeAlias = Annotated[OutputSpec, OneOf(lambda: OUTPUTS, "output", tag="format")]
