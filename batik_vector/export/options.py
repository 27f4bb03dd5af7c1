"""What can be chosen of each format, with bounds and help. Importing it costs nothing heavy."""

from __future__ import annotations

import enum
import re
from dataclasses import field
from typing import Annotated

from batik_vector.fields import HIDDEN, Between, Length, Says, Text, belongs, check
from batik_vector.machines.hpgl import Hpgl, Origin
from batik_vector.machines.profile import Machine
from batik_vector.values import frozen

DATE = r"^\d{4}-\d{2}-\d{2}$"


def parse_date(text: str) -> str:
    """Return a day of the calendar as ``YYYY-MM-DD``.

    Raises:
        ValueError: with what was expected.
    """
    from datetime import date

    try:
        if not re.fullmatch(DATE, text):
            raise ValueError
        return date.fromisoformat(text).isoformat()
    except ValueError:
        raise ValueError('expected a day in quotes such as "2026-11-30"') from None


class Profile(enum.StrEnum):
    """How marks become paths."""

    EDITABLE = "editable"
    """One path per mark, each with an id from its name: for work in a drawing program."""
    COMPACT = "compact"
    """One compound path per ink: for machines and for very many marks."""


class Curves(enum.StrEnum):
    """How curves are drawn."""

    POLYLINE = "polyline"
    """As the vertices of the artwork."""
    BEZIER = "bezier"
    """As cubic Béziers fitted to them: far fewer nodes."""


class PdfInks(enum.StrEnum):
    """How inks are named in a PDF."""

    RGB = "rgb"
    """Each ink is its screen colour."""
    SPOT = "spot"
    """Each ink is a separation with its own name, shown in its screen colour."""


class Alternate(enum.StrEnum):
    """In which colour space a separation of a PDF is shown where its ink is not at hand."""

    RGB = "rgb"
    """The colour on screen."""
    CMYK = "cmyk"
    """Process inks: as the ink says, or else reckoned from its colour on screen."""
    LAB = "lab"
    """CIE L*a*b* under D50: as the ink says, or else its colour on screen."""


class Overprint(enum.StrEnum):
    """Which inks of a PDF leave those beneath them on their plates."""

    MEANT = "meant"
    """Those that lie over others on purpose: with overlap = "overlay", and all after traps."""
    ALL = "all"
    """All of them."""
    NONE = "none"
    """None: what lies on top is cut out of all plates beneath."""


class DxfVersion(enum.StrEnum):
    """Which DXF is written."""

    R2000 = "R2000"
    """AC1015: LWPOLYLINE and units. Read by everything of this century."""
    R12 = "R12"
    """AC1009: POLYLINE and VERTEX, no units. For old cutters."""


class Zero(enum.StrEnum):
    """What of a tile lies where a machine's coordinates are zero."""

    CORNER = "corner"
    """Its lower left corner."""
    CENTRE = "centre"
    """Its middle."""


class Pages(enum.StrEnum):
    """What becomes of a drawing that is larger than the page."""

    ONE = "one"
    """It is refused; a PDF has one page, as large as it takes."""
    TILE = "tile"
    """It is divided over several pages that overlap, with crosses to lay them by: in HPGL each is a file of
    its own, in PDF they are pages of one."""


class Turn(enum.StrEnum):
    """How a drawing lies on the page."""

    AUTO = "auto"
    """As it is, or a quarter to the left where it fits only so."""
    NONE = "none"
    LEFT = "left"
    """A quarter turn anticlockwise."""
    OVER = "over"
    """Upside down."""
    RIGHT = "right"
    """A quarter turn clockwise."""


@frozen
class SvgOptions:
    """Options of SVG."""

    profile: Annotated[Profile, Says("one path per mark (editable) or per ink (compact)")] = Profile.EDITABLE
    curves: Annotated[Curves, Says("vertices as they are (polyline) or fitted Béziers (bezier)")] = (
        Curves.POLYLINE
    )
    curve_tolerance: Annotated[
        Annotated[Length, Between(0.0005, 10)] | None,
        Says("how far fitted curves may stray; the artwork's tolerance if unset"),
    ] = None
    cloth: Annotated[bool, Says("show the cloth as a layer %99 cloth, which plotters skip")] = True
    order: Annotated[bool, Says("order lines for a pen: short ways between, inside before outside")] = True

    def __post_init__(self) -> None:
        check(self)


@frozen
class SwatchOptions:
    """Options of swatches."""

    profile: Annotated[Profile, Says("one path per mark (editable) or per ink (compact)")] = Profile.EDITABLE
    curves: Annotated[Curves, Says("vertices as they are (polyline) or fitted Béziers (bezier)")] = (
        Curves.POLYLINE
    )
    curve_tolerance: Annotated[
        Annotated[Length, Between(0.0005, 10)] | None,
        Says("how far fitted curves may stray; the artwork's tolerance if unset"),
    ] = None
    cloth: Annotated[bool, Says("fill the ground with the cloth's colour")] = True

    def __post_init__(self) -> None:
        check(self)


@frozen
class PaletteOptions:
    """Options of palettes."""

    cloth: Annotated[bool, Says("begin with the cloth's colour")] = True

    def __post_init__(self) -> None:
        check(self)


@frozen
class PdfOptions:
    """Options of PDF."""

    curves: Annotated[Curves, Says("vertices as they are (polyline) or fitted Béziers (bezier)")] = (
        Curves.POLYLINE
    )
    curve_tolerance: Annotated[
        Annotated[Length, Between(0.0005, 10)] | None,
        Says("how far fitted curves may stray; the artwork's tolerance if unset"),
    ] = None
    cloth: Annotated[
        bool | None,
        Says("show the cloth as a layer of its own: unless told, with rgb inks only; with spot inks a plate"),
    ] = None
    inks: Annotated[PdfInks, Says("inks as screen colours (rgb) or as named separations (spot)")] = (
        PdfInks.RGB
    )
    alternate: Annotated[
        Alternate | None,
        Says("how separations are shown without their inks: rgb, cmyk or lab; as each ink tells if unset"),
    ] = None
    overprint: Annotated[
        Overprint,
        Says("which separations leave those beneath whole: overlays and traps (meant), all, or none"),
    ] = Overprint.MEANT
    icc: Annotated[
        str, Says('the profile of the press, a file such as "press.icc": the file is written as PDF/X-4')
    ] = ""
    condition: Annotated[
        str, Says('the printing condition by its registered name, such as "FOGRA51"; Custom if unset')
    ] = ""
    date: Annotated[
        str,
        Text(parse_date, 'a day in quotes such as "2026-11-30"', DATE),
        Says("the day that PDF/X-4 says it was made on; no clock is read"),
    ] = "1970-01-01"
    pages: Annotated[
        Pages,
        Says("a drawing larger than the page makes the page larger (one), or is divided over several (tile)"),
    ] = Pages.ONE
    page: Annotated[
        str, Says('the size of the pages, as "420 x 297 mm"; 5 m at most each way if unset, and no larger')
    ] = ""
    overlap: Annotated[
        Annotated[Length, Between(0, 1000)], Says("how far the pages of a divided drawing overlap")
    ] = 10.0
    icc_profile: bytes | None = field(default=None, repr=False, metadata={HIDDEN: True})
    """The profile, once it has been read."""

    def __post_init__(self) -> None:
        check(self)
        if not self.icc:
            belongs(self, ("condition", "date"), "icc")
        if self.pages is not Pages.TILE:
            belongs(self, ("page", "overlap"), 'pages = "tile"')
        if self.inks is not PdfInks.SPOT:
            belongs(self, ("alternate", "overprint"), 'inks = "spot"')

    @property
    def shows_cloth(self) -> bool:
        """Whether the cloth is drawn. Separations are for printing, and nobody prints the cloth."""
        return self.inks is PdfInks.RGB if self.cloth is None else self.cloth


@frozen
class DxfOptions:
    """Options of DXF."""

    version: Annotated[DxfVersion, Says("R2000, or R12 for old cutters")] = DxfVersion.R2000
    order: Annotated[bool, Says("order contours for a tool: inside before outside, short ways between")] = (
        True
    )

    def __post_init__(self) -> None:
        check(self)


@frozen
class GcodeOptions:
    """Options of G-code."""

    arcs: Annotated[bool, Says("fit arcs (G2, G3) where they keep to the drawing")] = False
    arc_tolerance: Annotated[
        Annotated[Length, Between(0.0005, 10)] | None,
        Says("how far arcs may stand from the drawing's vertices; the artwork's tolerance if unset"),
    ] = None
    feed: Annotated[
        Annotated[float, Between(1, 100_000)] | None,
        Says("mm/min with the tool down; the machine's if unset"),
    ] = None
    origin: Annotated[Zero, Says("what is at X0 Y0: the tile's lower left corner, or its middle")] = (
        Zero.CORNER
    )
    offset: Annotated[
        tuple[Length, Length], Says("how far right and up of the origin the drawing goes, as for a margin")
    ] = (0.0, 0.0)
    order: Annotated[bool, Says("order contours for a tool: inside before outside, short ways between")] = (
        True
    )
    machine_profile: Machine | None = field(default=None, metadata={HIDDEN: True})
    """The machine whose words are written; without one, a pen on a Z axis."""

    def __post_init__(self) -> None:
        check(self)


@frozen
class PngOptions:
    """Options of PNG."""

    dpi: Annotated[float, Between(1, 2400), Says("pixels per inch of cloth")] = 100.0
    cloth: Annotated[bool, Says("paint the cloth; without it the ground is transparent")] = True
    bilevel: Annotated[
        bool | None, Says("black and white, one bit to a pixel: unless told, what was separated in black is")
    ] = None

    def __post_init__(self) -> None:
        check(self)


@frozen
class TiffOptions:
    """Options of TIFF."""

    dpi: Annotated[float, Between(1, 5080), Says("pixels per inch of cloth")] = 254.0

    def __post_init__(self) -> None:
        check(self)


@frozen
class HpglOptions:
    """Options of HPGL."""

    page: Annotated[
        str, Says('a sheet of the machine, or its size as "420 x 297 mm"; if unset the first that fits')
    ] = ""
    pages: Annotated[Pages, Says("a drawing larger than the page is refused (one) or divided (tile)")] = (
        Pages.ONE
    )
    overlap: Annotated[
        Annotated[Length, Between(0, 1000)], Says("how far the pages of a divided drawing overlap")
    ] = 10.0
    sheet: Annotated[
        tuple[Annotated[int, Between(1, 9999)], Annotated[int, Between(1, 9999)]] | None,
        Says(
            "column and row of the one page of a divided drawing that is written; all of them if unset",
            called="column, row",
        ),
    ] = None
    turn: Annotated[
        Turn, Says("quarter turns of the drawing: none, left, over, right, or as it fits (auto)")
    ] = Turn.AUTO
    place: Annotated[
        Origin | None,
        Says("where the drawing lies: corner or centre; where the machine counts from if unset"),
    ] = None
    margin: Annotated[
        Annotated[Length, Between(0, 1000)],
        Says("room that is left around the drawing, as for what is cut outside it"),
    ] = 0.0
    pens: Annotated[
        tuple[Annotated[int, Between(0, 64)], ...],
        Says("the pen of each ink, lowest ink first; 0 leaves an ink out; 1, 2, 3 … if unset"),
    ] = ()
    encoded: Annotated[bool, Says("write PE, half as long, where the machine understands it")] = False
    speed: Annotated[
        Annotated[float, Between(0.1, 10_000)] | None, Says("speed with the pen down in mm/s (VS)")
    ] = None
    force: Annotated[
        Annotated[int, Between(1, 1000)] | None, Says("force of the pen, as the machine counts it (FS)")
    ] = None
    comment: Annotated[bool, Says("carry the recipe, as comments (CO) that old machines do not know")] = False
    order: Annotated[bool, Says("order contours for a tool: inside before outside, short ways between")] = (
        True
    )
    device: Hpgl = field(default=Hpgl(), metadata={HIDDEN: True})

    def __post_init__(self) -> None:
        check(self)
        if self.pages is not Pages.TILE:
            belongs(self, ("overlap",), 'pages = "tile"')
