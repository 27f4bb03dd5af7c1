"""PDF: 1:1 pages with trim and bleed boxes, one layer per ink, vectors only.

Coordinates are whole micrometres under a single matrix, so the stream is digits and letters and is
written as fast as text, compressed as it comes. Layers are optional-content groups (ISO 32000-1, 8.11),
which PDF 1.5 has; the page is 1.6 for ``UserUnit``, without which no side may pass 14,400 units = 5.08 m.
Nothing in the file changes from run to run: no dates, and the ID is a hash of the content.

Where inks are separations, nothing is drawn in any other colour: a fill in RGB is printed with all four
process inks. So the cloth is left out, or is a separation like the others where it is asked for.

The media box is the cell grown by the page's margins; the bleed box is the cell grown by the bleed; the trim
box is the cell.
"""

from __future__ import annotations

import hashlib
import math
import zlib
from typing import BinaryIO

import numpy as np

from batik_vector.artwork import Ink, Page, Plate
from batik_vector.export.numbers import WORD, Room, Style, Words, room_for, spelling, text, word
from batik_vector.export.options import Curves, PdfInks, PdfOptions
from batik_vector.export.palette import rgb, xml_label
from batik_vector.export.provenance import NAMESPACE, xml_fields
from batik_vector.export.strokes import CONTROL, LINE, MOVE, Pen, Strokes
from batik_vector.export.walk import Outlines, in_memory, walk
from batik_vector.units import STEPS_PER_MM

POINTS_PER_STEP = 72 / 25.4 / STEPS_PER_MM
LONGEST_SIDE = 14_400
"""Units in a side at most (ISO 32000-1, annex C); ``UserUnit`` makes the unit larger."""
COMPRESSION = 1
"""Level 6 takes six times as long and saves a sixth."""
BLOCK = 1 << 20
"""Bytes compressed at a time."""
HELD_BACK = 1 << 24
"""Compressed bytes up to which a content stream is kept until its length is known; a longer one is written as
it comes, and its length behind it."""
OPERATORS: Words = np.array([word(letters) for letters in ("m\n", "l\n", "", "", "c\n")], WORD)
"""What stands behind a point of each kind, in the order of the kinds."""
CONTENT = 4
"""Number of the content stream's object."""

DEFAULTS = PdfOptions()


def render(page: Page, options: PdfOptions = DEFAULTS) -> bytes:
    """Return a page as a PDF file; see :func:`write`."""
    return in_memory(lambda sink: write(page, sink, options))


def write(page: Page, sink: BinaryIO, options: PdfOptions = DEFAULTS) -> None:
    """Write a page as a PDF file of one page.

    Raises:
        ExportError: where the page holds what cannot be written.
    """
    walk(page, _PdfSurface(sink, options))


def units_per_user_unit(page: Page) -> int:
    """Return by what ``UserUnit`` a page's units are larger than points: 1 up to 5.08 m, and a warning else.

    Some programs pass ``UserUnit`` over, and show the page so many times too small.
    """
    margins = page.margins
    sides = (page.cell.columns + margins.left + margins.right, page.cell.rows + margins.bottom + margins.top)
    return max(1, math.ceil(max(sides) * POINTS_PER_STEP / LONGEST_SIDE))


def path_operators(drawn: Strokes, paint: str, unfinished: bool = False) -> bytes:
    """Return strokes as path operators, coordinates in whole steps, each mark painted by itself.

    Args:
        drawn: the strokes.
        paint: the operator that paints a path: ``f*``, ``S``.
        unfinished: the last mark goes on, and is not painted yet.
    """
    points = drawn.points
    spelled = spelling(points, Style.STEPS)
    width = 2 * spelled.words + 1
    painting = np.frombuffer(f"{paint}\n".encode("ascii"), np.uint8)
    room = np.zeros(len(drawn.closed), np.int64)
    begin = drawn.marks[1:-1]
    room[begin] = room_for(len(painting), width)
    layout = Room(drawn.rings, room)
    points = points.take(layout.source, axis=0)
    rows: Words = np.empty((len(points), width), WORD)
    spelled.put(rows, spelled.put(rows, 0, points[:, 0]), points[:, 1])
    curved = (drawn.kinds >= CONTROL).any()
    rows[:, -1] = OPERATORS.take(drawn.kinds.take(layout.source)) if curved else OPERATORS[LINE]
    rows[layout.first, -1] = OPERATORS[MOVE]
    rows[layout.last[drawn.closed], -1] += word("\0\0h\n")
    layout.put(rows, begin, np.repeat(painting[None], len(begin), axis=0))
    return text(rows) + (b"" if unfinished else painting.tobytes())


class _File:
    """The file as it grows: numbered objects, and at last their table."""

    def __init__(self, sink: BinaryIO) -> None:
        self._sink = sink
        self._starts: dict[int, int] = {}
        self._at = 0
        self._hash = hashlib.sha256()
        self.put(b"%PDF-1.6\n%\xe2\xe3\xcf\xd3\n")

    def put(self, data: bytes) -> None:
        self._sink.write(data)
        self._hash.update(data)
        self._at += len(data)

    def open(self, number: int) -> None:
        self._starts[number] = self._at
        self.put(b"%d 0 obj\n" % number)

    def close(self) -> None:
        self.put(b"\nendobj\n")

    def whole(self, number: int, body: bytes) -> None:
        self.open(number)
        self.put(body)
        self.close()

    def end(self) -> None:
        table, count = self._at, len(self._starts) + 1
        self.put(f"xref\n0 {count}\n0000000000 65535 f \n".encode("ascii"))
        starts = (self._starts[number] for number in range(1, count))
        self.put("".join(f"{start:010d} 00000 n \n" for start in starts).encode("ascii"))
        mark = self._hash.hexdigest()[:32]
        self.put(
            f"trailer\n<< /Size {count} /Root 1 0 R /Info 6 0 R /ID [<{mark}> <{mark}>] >>\n".encode("ascii")
        )
        self.put(f"startxref\n{table}\n%%EOF\n".encode("ascii"))


class _Stream:
    """The content stream: compressed in blocks, held back while it is short."""

    def __init__(self, file: _File, length_number: int) -> None:
        self._file, self._length_number = file, length_number
        self._machine = zlib.compressobj(COMPRESSION)
        self._raw: list[bytes] = []
        self._waiting = 0
        self._held: list[bytes] = []
        self._length = 0
        self._written = False

    def put(self, data: bytes) -> None:
        self._raw.append(data)
        self._waiting += len(data)
        if self._waiting >= BLOCK:
            raw = b"".join(self._raw)
            whole = len(raw) // BLOCK * BLOCK
            for at in range(0, whole, BLOCK):
                self._keep(self._machine.compress(memoryview(raw)[at : at + BLOCK]))
            self._raw, self._waiting = [raw[whole:]], len(raw) - whole

    def _keep(self, packed: bytes) -> None:
        self._length += len(packed)
        self._held.append(packed)
        if self._length > HELD_BACK:
            if not self._written:
                self._head(b"%d 0 R" % self._length_number)
            self._release()

    def _head(self, length: bytes) -> None:
        self._file.open(CONTENT)
        self._file.put(b"<< /Length %b /Filter /FlateDecode >>\nstream\n" % length)
        self._written = True

    def _release(self) -> None:
        for packed in self._held:
            self._file.put(packed)
        self._held.clear()

    def end(self) -> bool:
        """Close the stream; return whether its length is still to be written, as an object of its own."""
        self._keep(self._machine.compress(b"".join(self._raw)) + self._machine.flush())
        behind = self._written
        if not behind:
            self._head(b"%d" % self._length)
        self._release()
        self._file.put(b"\nendstream")
        self._file.close()
        if behind:
            self._file.whole(self._length_number, b"%d" % self._length)
        return behind


class _PdfSurface:
    """Writes the objects around the content stream, and the stream as it comes."""

    def __init__(self, sink: BinaryIO, options: PdfOptions) -> None:
        self._sink = sink
        self._options = options
        self._layer_count = 0

    def begin(self, page: Page) -> None:
        self._page = _Page(page, self._options)
        chosen = self._options.curve_tolerance or page.tolerance
        self._pen = Pen(page, chosen if self._options.curves is Curves.BEZIER else None)
        self._number = -1
        self._file = _File(self._sink)
        for number, body in enumerate(self._page.before(), start=1):
            self._file.whole(number, body)
        self._content = _Stream(self._file, self._page.length_number)
        scale = _number(POINTS_PER_STEP / self._page.unit, 16)
        self._content.put(f"{scale} 0 0 {scale} 0 0 cm\n1 J 1 j\n".encode("ascii"))
        if self._options.shows_cloth:
            fill, _ = self._layer(page.cloth)
            self._content.put(b"%b0 0 %d %d re\nf\n" % (fill.encode("ascii"), *self._page.size))

    def ink(self, ink: Ink, pen: int) -> None:
        self._number += 1
        self._ink = ink
        self._colours = self._layer(ink.colour)
        self._coloured = [False, False]

    def areas(self, outlines: Outlines) -> None:
        if not self._coloured[0]:
            self._coloured[0] = True
            self._content.put(self._colours[0].encode("ascii"))
        self._content.put(
            path_operators(self._pen.strokes(outlines, self._number, "areas"), "f*", outlines.unfinished)
        )

    def lines(self, outlines: Outlines) -> None:
        if not self._coloured[1]:
            self._coloured[1] = True
            width = round(self._ink.width * STEPS_PER_MM)
            self._content.put(f"{self._colours[1]}{width} w\n".encode("ascii"))
        self._content.put(
            path_operators(self._pen.strokes(outlines, self._number, "lines"), "S", outlines.unfinished)
        )

    def end(self) -> None:
        if self._layer_count:
            self._content.put(b"EMC\n")
        self._content.end()
        for number, body in enumerate(self._page.behind(), start=CONTENT + 1):
            self._file.whole(number, body)
        self._file.end()

    def _layer(self, colour: str) -> tuple[str, str]:
        """Open the next layer; return the operators that set its colour for filling and for stroking."""
        number = self._layer_count
        if number:
            self._content.put(b"EMC\n")
        self._content.put(f"/OC /L{number} BDC\n".encode("ascii"))
        self._layer_count += 1
        if self._page.spots:
            return f"/S{number} cs 1 scn\n", f"/S{number} CS 1 SCN\n"
        return _device_colour(colour)


class _Page:
    """All of the file but its drawing."""

    def __init__(self, page: Page, options: PdfOptions) -> None:
        self.page = page
        margins = page.margins
        self.size = (
            page.cell.columns + margins.left + margins.right,
            page.cell.rows + margins.bottom + margins.top,
        )
        self.unit = units_per_user_unit(page)
        names = [plate.ink.name for plate in page.plates]
        self.layers = ["cloth"] * options.shows_cloth + names
        self.spots: list[bytes] = []
        if options.inks is PdfInks.SPOT:
            self.spots = [_separation(_plate_name(plate), plate.ink.colour) for plate in page.plates]
            if options.shows_cloth:
                # Separations of one name are one plate.
                ground = "cloth (ground)" if "cloth" in names else "cloth"
                self.spots.insert(0, _separation(ground, page.cloth))
        first = CONTENT + 3
        self.groups = range(first, first + len(self.layers))
        self.spaces = range(self.groups.stop, self.groups.stop + len(self.spots))
        self.length_number = self.spaces.stop

    def before(self) -> list[bytes]:
        """Return the objects that come before the drawing."""
        listed = " ".join(f"{number} 0 R" for number in self.groups)
        order = f"/OCProperties << /OCGs [{listed}] /D << /Order [{listed}] /ON [{listed}] >> >>"
        catalog = f"<< /Type /Catalog /Pages 2 0 R /Metadata 5 0 R {order if self.layers else ''} >>"
        return [
            catalog.encode("ascii"),
            b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
            _page_object(self),
        ]

    def behind(self) -> list[bytes]:
        """Return the objects that come behind it."""
        packet = _xmp(self.page)
        return [
            b"<< /Type /Metadata /Subtype /XML /Length %d >>\nstream\n%b\nendstream" % (len(packet), packet),
            f"<< /Title {_text(self.page.title)} /Producer {_text(_producer(self.page))} >>".encode("ascii"),
            *(f"<< /Type /OCG /Name {_text(name)} >>".encode("ascii") for name in self.layers),
            *self.spots,
        ]


def _page_object(page: _Page) -> bytes:
    cell, margins = page.page.cell, page.page.margins
    bleed = round(page.page.bleed * STEPS_PER_MM)

    def box(left: int, bottom: int, right: int, top: int) -> str:
        return "[" + " ".join(_points(steps, page.unit) for steps in (left, bottom, right, top)) + "]"

    x, y = margins.left, margins.bottom
    whole = box(0, 0, *page.size)
    inked = box(
        max(x - bleed, 0),
        max(y - bleed, 0),
        min(x + cell.columns + bleed, page.size[0]),
        min(y + cell.rows + bleed, page.size[1]),
    )
    trim = box(x, y, x + cell.columns, y + cell.rows)
    properties = " ".join(f"/L{i} {number} 0 R" for i, number in enumerate(page.groups))
    spaces = " ".join(f"/S{i} {number} 0 R" for i, number in enumerate(page.spaces))
    unit = f"/UserUnit {page.unit} " if page.unit > 1 else ""
    return (
        f"<< /Type /Page /Parent 2 0 R /MediaBox {whole} /CropBox {whole} /BleedBox {inked} "
        f"/TrimBox {trim} {unit}/Contents {CONTENT} 0 R "
        f"/Resources << /Properties << {properties} >> /ColorSpace << {spaces} >> >> >>"
    ).encode("ascii")


def _points(steps: float, unit: float) -> str:
    """Return a length in page units, rounded down: a hair too wide, and renderers add a row of pixels."""
    return _number(math.floor(steps * POINTS_PER_STEP / unit * 1e8) / 1e8, 8)


def _device_colour(colour: str) -> tuple[str, str]:
    """Return the operators that set a colour for filling and for stroking."""
    parts = " ".join(_number(part / 255, 5) for part in rgb(colour))
    return f"{parts} rg\n", f"{parts} RG\n"


def _plate_name(plate: Plate) -> str:
    """Return the name of a plate's separation.

    Two names mean every plate and no plate: guides stand on every plate, so that plates can be registered.
    """
    if plate.guide:
        return "All"
    name = plate.ink.name
    return f"{name} ink" if name in ("All", "None") else name


def _separation(name: str, colour: str) -> bytes:
    """Return the colour space of a spot ink: no tint is paper white, full tint its screen colour."""
    full = " ".join(_number(part / 255, 5) for part in rgb(colour))
    tint = f"<< /FunctionType 2 /Domain [0 1] /C0 [1 1 1] /C1 [{full}] /N 1 >>"
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


def _producer(page: Page) -> str:
    return f"batik_vector {page.provenance.version}".rstrip()


def _xmp(page: Page) -> bytes:
    """Return the metadata packet (ISO 16684-1) with recipe, seed and version in our namespace."""
    fields = [
        f"<batik:{name}>{_escaped(value)}</batik:{name}>" for name, value in xml_fields(page.provenance)
    ]
    packet = (
        '<?xpacket begin="\ufeff" id="W5M0MpCehiHzreSzNTczkc9d"?>\n'
        '<x:xmpmeta xmlns:x="adobe:ns:meta/">\n'
        '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">\n'
        '<rdf:Description rdf:about="" xmlns:dc="http://purl.org/dc/elements/1.1/" '
        f'xmlns:pdf="http://ns.adobe.com/pdf/1.3/" xmlns:batik="{NAMESPACE}">\n'
        "<dc:format>application/pdf</dc:format>\n"
        '<dc:title><rdf:Alt><rdf:li xml:lang="x-default">'
        f"{_escaped(xml_label(page.title))}</rdf:li></rdf:Alt></dc:title>\n"
        f"<pdf:Producer>{_escaped(xml_label(_producer(page)))}</pdf:Producer>\n"
        + "\n".join(fields)
        + '\n</rdf:Description>\n</rdf:RDF>\n</x:xmpmeta>\n<?xpacket end="r"?>'
    )
    return packet.encode("utf-8")


def _escaped(words: str) -> str:
    """Return text for an XML element; a carriage return would be read as a line feed."""
    return words.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace("\r", "&#13;")
