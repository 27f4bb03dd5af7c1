"""PDF: 1:1 pages with trim and bleed boxes, one layer per ink, vectors only.

Coordinates are whole micrometres under a single matrix, so the stream is digits and letters and is
written as fast as text. Layers are optional-content groups (ISO 32000-1, 8.11), which PDF 1.5 has; the
page is 1.6 for ``UserUnit``, without which no side may pass 14,400 units = 5.08 m. Nothing in the file
changes from run to run: no dates, and the ID is a hash of the content.

The media box is the cell grown by the bleed; the trim box is the cell.
"""

from __future__ import annotations

import hashlib
import math
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from xml.sax.saxutils import escape

import numpy as np

from batik_vector.artwork import Artwork, Ink
from batik_vector.export.numbers import WORD, Style, Words, digit_words, put, text, word
from batik_vector.export.options import Curves, PdfInks, PdfOptions
from batik_vector.export.palette import rgb, xml_label
from batik_vector.export.provenance import NAMESPACE, xml_fields
from batik_vector.export.strokes import CONTROL, CURVE, LINE, MOVE, PULL, Strokes, strokes
from batik_vector.export.walk import Outlines, walk
from batik_vector.units import STEPS_PER_MM

POINTS_PER_STEP = 72 / 25.4 / STEPS_PER_MM
LONGEST_SIDE = 14_400
"""Units in a side at most (ISO 32000-1, annex C); ``UserUnit`` makes the unit larger."""
COMPRESSION = 1
"""Level 6 takes six times as long and saves a sixth."""

DEFAULTS = PdfOptions()


def render(artwork: Artwork, options: PdfOptions = DEFAULTS) -> bytes:
    """Return an artwork as a PDF file of one page.

    Raises:
        ExportError: where the artwork holds what cannot be written.
    """
    surface = _PdfSurface(options)
    walk(artwork, surface)
    return surface.data


def path_operators(drawn: Strokes, paint: str) -> bytes:
    """Return strokes as path operators, coordinates in whole steps, each mark painted by itself.

    Args:
        drawn: the strokes.
        paint: the operator that paints a path: ``f*``, ``S``.
    """
    points = drawn.points
    size = digit_words(points)
    rows: Words = np.zeros((len(points), 2 * (1 + size) + 2), WORD)
    at = put(rows, 0, points[:, 0], Style.STEPS, size, word("\0"))
    at = put(rows, at, points[:, 1], Style.STEPS, size, word("\0"))
    letters = np.zeros(5, WORD)
    letters[[MOVE, LINE, CONTROL, PULL, CURVE]] = [word(c) for c in ("m\n", "l\n", "\0", "\0", "c\n")]
    rows[:, at] = letters[drawn.kinds]
    rows[drawn.last[drawn.closed], at] += word("\0\0h\n")
    rows[drawn.last[drawn.marks[1:] - 1], at + 1] = word(f"{paint}\n")
    return text(rows)


class _PdfSurface:
    """Collects the content stream, then builds the file around it."""

    def __init__(self, options: PdfOptions) -> None:
        self._options = options
        self._content: list[bytes] = []
        self._layers: list[str] = []
        self._spots: list[tuple[str, str]] = []
        self.data = b""

    def begin(self, artwork: Artwork) -> None:
        self._artwork = artwork
        self._bleed = round(artwork.bleed * STEPS_PER_MM)
        self._size = (artwork.cell.columns + 2 * self._bleed, artwork.cell.rows + 2 * self._bleed)
        chosen = self._options.curve_tolerance or artwork.tolerance
        self._tolerance = chosen if self._options.curves is Curves.BEZIER else None
        self._unit = max(1, math.ceil(max(self._size) * POINTS_PER_STEP / LONGEST_SIDE))
        scale = _number(POINTS_PER_STEP / self._unit, 16)
        self._content.append(f"{scale} 0 0 {scale} 0 0 cm\n1 J 1 j\n".encode("ascii"))
        if self._options.cloth:
            self._layer("cloth")
            # The cloth is no ink: it has no plate, even where inks are separations.
            fill, _ = _device_colour(artwork.cloth)
            self._content.append(f"{fill}0 0 {self._size[0]} {self._size[1]} re\nf\n".encode("ascii"))

    def ink(self, ink: Ink, pen: int) -> None:
        self._ink = ink
        self._layer(ink.name)
        if self._options.inks is PdfInks.SPOT:
            name = f"S{len(self._spots)}"
            self._spots.append((ink.name, ink.colour))
            self._colours = (f"/{name} cs 1 scn\n", f"/{name} CS 1 SCN\n")
        else:
            self._colours = _device_colour(ink.colour)

    def areas(self, outlines: Outlines) -> None:
        self._content.append(self._colours[0].encode("ascii"))
        self._content.append(path_operators(self._drawn(outlines), "f*"))

    def lines(self, outlines: Outlines) -> None:
        width = round(self._ink.width * STEPS_PER_MM)
        self._content.append(f"{self._colours[1]}{width} w\n".encode("ascii"))
        self._content.append(path_operators(self._drawn(outlines), "S"))

    def end(self) -> None:
        if self._layers:
            self._content.append(b"EMC\n")
        self.data = _file(
            _Page(self._artwork, self._size, self._bleed, self._unit, self._layers, self._spots),
            b"".join(self._content),
        )

    def _drawn(self, outlines: Outlines) -> Strokes:
        return strokes(outlines.moved(self._bleed, self._bleed), self._tolerance)

    def _layer(self, name: str) -> None:
        if self._layers:
            self._content.append(b"EMC\n")
        self._content.append(f"/OC /L{len(self._layers)} BDC\n".encode("ascii"))
        self._layers.append(name)


@dataclass(frozen=True)
class _Page:
    """All of the file but its drawing."""

    artwork: Artwork
    size: tuple[int, int]
    bleed: int
    unit: int
    layers: Sequence[str]
    spots: Sequence[tuple[str, str]]


def _file(page: _Page, content: bytes) -> bytes:
    """Return the whole file: numbered objects, cross-reference table, trailer."""
    stream = zlib.compress(content, COMPRESSION)
    packet = _xmp(page.artwork)
    groups = range(7, 7 + len(page.layers))
    spots = range(groups.stop, groups.stop + len(page.spots))
    listed = " ".join(f"{number} 0 R" for number in groups)
    order = f"/OCProperties << /OCGs [{listed}] /D << /Order [{listed}] /ON [{listed}] >> >>"
    bodies: list[bytes] = [
        f"<< /Type /Catalog /Pages 2 0 R /Metadata 5 0 R {order if page.layers else ''} >>".encode("ascii"),
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        _page_object(page, groups, spots),
        b"<< /Length %d /Filter /FlateDecode >>\nstream\n%b\nendstream" % (len(stream), stream),
        b"<< /Type /Metadata /Subtype /XML /Length %d >>\nstream\n%b\nendstream" % (len(packet), packet),
        f"<< /Title {_text(page.artwork.title)} /Producer {_text(_producer(page.artwork))} >>".encode(
            "ascii"
        ),
        *(f"<< /Type /OCG /Name {_text(name)} >>".encode("ascii") for name in page.layers),
        *(_separation(name, colour) for name, colour in page.spots),
    ]
    out = bytearray(b"%PDF-1.6\n%\xe2\xe3\xcf\xd3\n")
    starts = []
    for number, body in enumerate(bodies, start=1):
        starts.append(len(out))
        out += b"%d 0 obj\n%b\nendobj\n" % (number, body)
    table = len(out)
    out += f"xref\n0 {len(bodies) + 1}\n0000000000 65535 f \n".encode("ascii")
    out += "".join(f"{start:010d} 00000 n \n" for start in starts).encode("ascii")
    mark = hashlib.sha256(out).hexdigest()[:32]
    out += f"trailer\n<< /Size {len(bodies) + 1} /Root 1 0 R /Info 6 0 R /ID [<{mark}> <{mark}>] >>\n".encode(
        "ascii"
    )
    out += f"startxref\n{table}\n%%EOF\n".encode("ascii")
    return bytes(out)


def _page_object(page: _Page, groups: range, spots: range) -> bytes:
    width, height, edge = (_points(steps, page.unit) for steps in (*page.size, page.bleed))
    right, top = (_points(steps - page.bleed, page.unit) for steps in page.size)
    whole = f"[0 0 {width} {height}]"
    properties = " ".join(f"/L{i} {number} 0 R" for i, number in enumerate(groups))
    spaces = " ".join(f"/S{i} {number} 0 R" for i, number in enumerate(spots))
    unit = f"/UserUnit {page.unit} " if page.unit > 1 else ""
    return (
        f"<< /Type /Page /Parent 2 0 R /MediaBox {whole} /CropBox {whole} /BleedBox {whole} "
        f"/TrimBox [{edge} {edge} {right} {top}] {unit}/Contents 4 0 R "
        f"/Resources << /Properties << {properties} >> /ColorSpace << {spaces} >> >> >>"
    ).encode("ascii")


def _points(steps: float, unit: float) -> str:
    """Return a length in page units, rounded down: a hair too wide, and renderers add a row of pixels."""
    return _number(math.floor(steps * POINTS_PER_STEP / unit * 1e8) / 1e8, 8)


def _device_colour(colour: str) -> tuple[str, str]:
    """Return the operators that set a colour for filling and for stroking."""
    parts = " ".join(_number(part / 255, 5) for part in rgb(colour))
    return f"{parts} rg\n", f"{parts} RG\n"


def _separation(name: str, colour: str) -> bytes:
    """Return the colour space of a spot ink: no tint is paper white, full tint its screen colour."""
    full = " ".join(_number(part / 255, 5) for part in rgb(colour))
    tint = f"<< /FunctionType 2 /Domain [0 1] /C0 [1 1 1] /C1 [{full}] /N 1 >>"
    if name in ("All", "None"):
        # These two names mean every plate and no plate.
        name = f"{name} ink"
    return f"[/Separation /{_name(name)} /DeviceRGB {tint}]".encode("ascii")


def _number(value: float, decimals: int) -> str:
    """Return a number as PDF has it: no exponent, no needless zeros."""
    words = f"{value:.{decimals}f}"
    return words.rstrip("0").rstrip(".") if "." in words else words


def _text(words: str) -> str:
    """Return a text string in UTF-16, hexadecimal, which needs no escapes."""
    return f"<{(chr(0xFEFF) + words).encode('utf-16-be', 'replace').hex()}>"


def _name(words: str) -> str:
    """Return a name object's characters, all but letters and digits escaped, 127 bytes at most."""
    raw = words.encode("utf-8", "replace")[:127]
    return "".join(chr(byte) if chr(byte).isalnum() and byte < 128 else f"#{byte:02x}" for byte in raw)


def _producer(artwork: Artwork) -> str:
    return f"batik_vector {artwork.provenance.version}".rstrip()


def _xmp(artwork: Artwork) -> bytes:
    """Return the metadata packet (ISO 16684-1) with recipe, seed and version in our namespace."""
    fields = [
        f"<batik:{name}>{_escaped(value)}</batik:{name}>" for name, value in xml_fields(artwork.provenance)
    ]
    packet = (
        '<?xpacket begin="\ufeff" id="W5M0MpCehiHzreSzNTczkc9d"?>\n'
        '<x:xmpmeta xmlns:x="adobe:ns:meta/">\n'
        '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">\n'
        '<rdf:Description rdf:about="" xmlns:dc="http://purl.org/dc/elements/1.1/" '
        f'xmlns:pdf="http://ns.adobe.com/pdf/1.3/" xmlns:batik="{NAMESPACE}">\n'
        "<dc:format>application/pdf</dc:format>\n"
        '<dc:title><rdf:Alt><rdf:li xml:lang="x-default">'
        f"{_escaped(xml_label(artwork.title))}</rdf:li></rdf:Alt></dc:title>\n"
        f"<pdf:Producer>{_escaped(xml_label(_producer(artwork)))}</pdf:Producer>\n"
        + "\n".join(fields)
        + '\n</rdf:Description>\n</rdf:RDF>\n</x:xmpmeta>\n<?xpacket end="r"?>'
    )
    return packet.encode("utf-8")


def _escaped(words: str) -> str:
    """Return text for an XML element; a carriage return would be read as a line feed."""
    return escape(words, {"\r": "&#13;"})
