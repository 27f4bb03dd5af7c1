"""Separations: the colour spaces of spot inks (ISO 32000-1, 8.6.6.4), and how inks lie over one another.

A separation has an alternate, the colour that shows where its ink is not at hand: no tint is paper white,
full tint the ink's colour. In L*a*b* a colour on screen is converted exactly, by IEC 61966-2-1 and the
Bradford adaptation to D50 that ICC profiles of sRGB carry. In CMYK none is exact without the press's profile:
the rule of ISO 32000-1, 10.3.5 is taken, black to the full where all three inks meet, which comes out too
saturated on most presses. So inks may say what they are.
"""

from __future__ import annotations

from collections.abc import Mapping

from batik_vector.artwork import Ink, Overlap, Page, Plate
from batik_vector.artwork.overdyeing import linear
from batik_vector.export.options import Alternate, Overprint, PdfInks, PdfOptions
from batik_vector.export.palette import hex_colour, rgb
from batik_vector.export.pdf.spelling import name, numbers
from batik_vector.values import frozen

Parts = tuple[float, ...]
"""The components of a colour as a colour space of PDF takes them."""

TRAP = "trap"
"""How the words of the process begin that has inks lie under others."""
WHITE: Mapping[Alternate, Parts] = {
    Alternate.RGB: (1.0, 1.0, 1.0),
    Alternate.CMYK: (0.0, 0.0, 0.0, 0.0),
    Alternate.LAB: (100.0, 0.0, 0.0),
}
SPACES: Mapping[Alternate, str] = {
    Alternate.RGB: "/DeviceRGB",
    Alternate.CMYK: "/DeviceCMYK",
    Alternate.LAB: "[/Lab << /WhitePoint [0.9642 1 0.8249] /Range [-128 127 -128 127] >>]",
}
D50 = (0.96422, 1.0, 0.82521)
TO_D50 = (
    (0.4360747, 0.3850649, 0.1430804),
    (0.2225045, 0.7168786, 0.0606169),
    (0.0139322, 0.0971045, 0.7141733),
)
"""XYZ under D50 of linear sRGB: Bradford's adaptation from D65."""


@frozen
class Paint:
    """How what is drawn next is painted: the operators, and the colour space where one is needed."""

    fill: str
    stroke: str
    space: bytes = b""
    overprint: bool = False


def paints_of(page: Page, options: PdfOptions, press: str = "") -> list[Paint]:
    """Return the paints of the layers of a page, the cloth's first where it is drawn.

    ``press`` is the colour space of the press that the file is for, if it is for one: ``CMYK``, ``RGB``,
    ``GRAY``.
    """
    inks = [plate.ink for plate in page.plates]
    cloth = Ink("cloth", page.cloth)
    if options.inks is not PdfInks.SPOT:
        return [_screen(ink.colour) for ink in ([cloth] if options.shows_cloth else []) + inks]
    plates = [(plate_name(plate), plate.ink, overprints(plate, page, options)) for plate in page.plates]
    if options.shows_cloth:
        # Separations of one name are one plate.
        ground = "cloth (ground)" if any(ink.name == "cloth" for ink in inks) else "cloth"
        plates.insert(0, (ground, cloth, False))
    chosen = [options.alternate or told(ink, press) for _, ink, _ in plates]
    return [_spot(number, *plate, chosen[number]) for number, plate in enumerate(plates)]


def _screen(colour: str) -> Paint:
    parts = numbers(tuple(part / 255 for part in rgb(colour)))
    return Paint(f"{parts} rg\n", f"{parts} RG\n")


def _spot(number: int, plate: str, ink: Ink, overprint: bool, alternate: Alternate) -> Paint:
    space = separation(plate, ink, alternate)
    return Paint(f"/S{number} cs 1 scn\n", f"/S{number} CS 1 SCN\n", space, overprint)


def separation(plate: str, ink: Ink, alternate: Alternate) -> bytes:
    """Return the colour space of a spot ink."""
    full, white = numbers(parts_of(ink, alternate)), numbers(WHITE[alternate])
    tint = f"<< /FunctionType 2 /Domain [0 1] /C0 [{white}] /C1 [{full}] /N 1 >>"
    return f"[/Separation /{name(plate)} {SPACES[alternate]} {tint}]".encode("ascii")


def told(ink: Ink, press: str = "") -> Alternate:
    """Return the colour space in which an ink says what it is in print, or else that of screens.

    What is for a press is in its own colours, or in those of no device.
    """
    if ink.cmyk and press in ("", "CMYK"):
        return Alternate.CMYK
    return Alternate.LAB if ink.lab or press else Alternate.RGB


def plate_name(plate: Plate) -> str:
    """Return the name of a plate's separation.

    Two names mean every plate and no plate: guides stand on every plate, so that plates can be registered.
    """
    if plate.guide:
        return "All"
    own = plate.ink.name
    return f"{own} ink" if own in ("All", "None") else own


def overprints(plate: Plate, page: Page, options: PdfOptions) -> bool:
    """Return whether a plate leaves those beneath it whole."""
    if options.overprint is not Overprint.MEANT:
        return options.overprint is Overprint.ALL
    # What spreads under another ink would be cut out of its plate again by that.
    trapped = any(words.split()[0] == TRAP for words in page.provenance.processes if words)
    return trapped or plate.guide or plate.ink.overlap is Overlap.OVERLAY


def parts_of(ink: Ink, alternate: Alternate) -> Parts:
    """Return an ink's colour in a colour space."""
    if alternate is Alternate.LAB:
        return ink.lab or lab_of(ink.colour)
    if alternate is Alternate.CMYK:
        return tuple(part / 100 for part in ink.cmyk) if ink.cmyk else cmyk_of(ink.colour)
    return tuple(part / 255 for part in rgb(ink.colour))


def cmyk_of(colour: str) -> Parts:
    """Return cyan, magenta, yellow and black (0 to 1) of a colour on screen, by the plainest rule."""
    red, green, blue = (part / 255 for part in rgb(colour))
    light = max(red, green, blue)
    if not light:
        return 0.0, 0.0, 0.0, 1.0
    return 1 - red / light, 1 - green / light, 1 - blue / light, 1 - light


def lab_of(colour: str) -> Parts:
    """Return L*, a* and b* under D50 of a colour on screen."""
    parts = linear(hex_colour(colour))
    xyz = (sum(a * b for a, b in zip(row, parts, strict=True)) for row in TO_D50)
    x, y, z = (_root(each / white) for each, white in zip(xyz, D50, strict=True))
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def _root(part: float) -> float:
    least = 6 / 29
    return part ** (1 / 3) if part > least**3 else part / (3 * least**2) + 4 / 29


def reckoned(page: Page, options: PdfOptions) -> list[str]:
    """Return the names of the inks whose CMYK is reckoned from their colour on screen."""
    if options.inks is not PdfInks.SPOT or options.alternate is not Alternate.CMYK:
        return []
    return [plate.ink.name for plate in page.plates if not plate.guide and not plate.ink.cmyk]
