"""SVG: named layers, true millimetres, plain paths.

What Inkscape, Illustrator, plotters and cutters each insist on, all at once: width and height in mm with
a viewBox in mm; layers as direct children of the root, with Inkscape's group mode and label and an id of
letters and digits for Illustrator; the label begins with the pen's number, as AxiDraw and vpype read it;
absolute coordinates on whole micrometres; no transforms, styles, references or clips.

What no pen draws stays apart. AxiDraw leaves out layers whose label begins with ``%``; vpype does not, and
goes by the first number in a label or else by the layer's order: as ``%99 cloth`` the cloth is a layer of its
own there. It is a polygon, which Inkscape's writers of DXF leave out.

The page is the cell, grown by the page's margins. svgwrite makes the furniture: root, metadata and
layers; the paths are put between as they come.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from typing import Any, BinaryIO

import numpy as np

from batik_vector.artwork import Ink, Overlap, Page, Plate
from batik_vector.export import light_svgwrite
from batik_vector.export.ids import Ids
from batik_vector.export.numbers import (
    WORD,
    Characters,
    Room,
    Style,
    Words,
    beside,
    digits,
    lead,
    room_for,
    spelling,
    text,
)
from batik_vector.export.options import Curves, Profile, SvgOptions
from batik_vector.export.palette import hex_colour, xml_label
from batik_vector.export.provenance import NAMESPACE, xml_fields
from batik_vector.export.strokes import (
    CONTROL,
    CURVE,
    LINE,
    MOVE,
    Pen,
    Strokes,
    begins_block,
    blocks,
    blocks_of,
    some,
)
from batik_vector.export.walk import Order, Outlines, in_memory, walk
from batik_vector.geometry.outlines import Index
from batik_vector.units import STEPS_PER_MM, format_mm

INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"
SODIPODI = "http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"

AT_ONCE = 50_000
"""Points spelled at once, about. What stands around them then stays in the processor's cache, and the system
need not find fresh memory for every array, which took a quarter of the time of writing."""

PLACE = "\0"
"""Stands on both sides of the name of a place; XML cannot hold it, so nothing else of a page does."""
HOLE = "place"
PATH = b'<path d="'
END = b'" />\n'
CLOTH_NUMBER = 99
"""Layer of the cloth in programs that sort by numbers; guides come before it, pens count from 1."""
NAMED_VIEW = {"id": "namedview", "inkscape:document-units": "mm", "units": "mm"}
"""Tells Inkscape to show millimetres on its rulers."""

DEFAULTS = SvgOptions()


def render(page: Page, options: SvgOptions = DEFAULTS) -> bytes:
    """Return a page as an SVG file; see :func:`write`."""
    return in_memory(lambda sink: write(page, sink, options))


def write(page: Page, sink: BinaryIO, options: SvgOptions = DEFAULTS) -> None:
    """Write a page as an SVG file.

    Raises:
        ExportError: where the page holds what cannot be written.
    """
    walk(page, _SvgSurface(sink, options), Order.LINES if options.order else Order.GIVEN)


def svg_text(page: Page, options: SvgOptions = DEFAULTS) -> str:
    """Return a page as SVG text; see :func:`render`."""
    return render(page, options).decode("utf-8")


def path_data(drawn: Strokes, between: Characters | None = None) -> bytes:
    """Return strokes in the path language, coordinates in mm, y as it is.

    Args:
        drawn: the strokes, in steps.
        between: what stands between each mark and the next, shape (marks - 1, h), if anything does.
    """
    points = drawn.points
    if not len(points):
        return b""
    spelled = spelling(points, Style.SHORT, " ")
    width = 2 * spelled.words
    shut = drawn.closed[:-1] * np.uint8(ord("Z"))
    room = np.concatenate([[0], drawn.closed[:-1]]).astype(np.int64)
    begin = drawn.marks[1:-1] if between is not None else drawn.marks[:0]
    if between is not None:
        between = beside(len(begin), shut[begin - 1, None], between)
        room[begin] = room_for(between.shape[1], width)
    layout = Room(drawn.rings, room)
    points = points.take(layout.source, axis=0)
    rows: Words = np.empty((len(points), width), WORD)
    spelled.put(rows, spelled.put(rows, 0, points[:, 0]), points[:, 1])
    for which, command in _commands(drawn):
        lead(rows, layout.row_of(which), command)
    if between is not None:
        layout.put(rows, begin, between)
        room[begin] = 0
    inner = np.flatnonzero(room)
    layout.put(rows, inner, shut[inner - 1, None])
    return text(rows) + (b"Z" if drawn.closed[-1] else b"")


def _commands(drawn: Strokes) -> Iterator[tuple[Index, str]]:
    """Yield the commands that are not understood, each with the points that it stands before."""
    yield drawn.first, "M"
    kinds = drawn.kinds
    if (kinds >= CONTROL).any():
        before = np.concatenate([[MOVE], kinds[:-1]])
        yield np.flatnonzero((kinds == LINE) & (before == CURVE)), "L"
        yield np.flatnonzero((kinds == CONTROL) & (before != CURVE)), "C"


class _SvgSurface:
    """Puts paths into the furniture as they come."""

    def __init__(self, sink: BinaryIO, options: SvgOptions) -> None:
        self._sink = sink
        self._options = options
        self._compact = options.profile is Profile.COMPACT
        self._ids = Ids()

    def begin(self, page: Page) -> None:
        chosen = self._options.curve_tolerance or page.tolerance
        self._pen = Pen(page, chosen if self._options.curves is Curves.BEZIER else None, downwards=True)
        # Words, then the name of a place, then words and so on.
        self._furniture = iter(furniture(page, self._options).split(PLACE))
        self._number = -1
        self._kind = ""
        self._path_end = b""
        if self._options.cloth:
            self._id("cloth", "cloth")

    def ink(self, ink: Ink, pen: int) -> None:
        self._number += 1
        self._id(ink.name, "ink")

    def areas(self, outlines: Outlines) -> None:
        self._draw("areas", outlines)

    def lines(self, outlines: Outlines) -> None:
        self._draw("lines", outlines)

    def end(self) -> None:
        self._go_to("")

    def _go_to(self, place: str) -> None:
        """Write furniture up to a place, or to its end; what is passed stays empty."""
        self._close()
        for words in self._furniture:
            self._sink.write(words.encode("utf-8"))
            if next(self._furniture, None) == place:
                return

    def _close(self) -> None:
        """Write the end of the path that is open, if one is."""
        self._sink.write(self._path_end)
        self._path_end = b""

    def _id(self, name: str, fallback: str) -> None:
        self._go_to(f"id {self._number}")
        self._sink.write(self._ids.one(name, fallback).encode("ascii"))
        self._kind = ""

    def _draw(self, kind: str, outlines: Outlines) -> None:
        if kind != self._kind:
            self._go_to(f"{kind} {self._number}")
            self._kind, self._points, self._unfinished = kind, 0, False
        drawn = self._pen.strokes(outlines, self._number, kind)
        if self._compact:
            self._write_blocks(drawn, outlines.unfinished)
        else:
            self._write_paths(drawn, outlines.names, outlines.unfinished)
        self._unfinished = outlines.unfinished

    def _write_paths(self, drawn: Strokes, names: Sequence[str], unfinished: bool) -> None:
        """Write a path for each mark; the last is left open where it is unfinished."""
        if self._unfinished:
            self._sink.write(path_data(some(drawn, 0, 1)))
            drawn, names = some(drawn, 1, len(drawn.marks) - 1), names[1:]
        if len(names):
            self._write_whole(drawn, self._ends(names))
        if not unfinished:
            self._close()

    def _write_whole(self, drawn: Strokes, ends: Characters) -> None:
        """Write a path for each mark with the end that is meant for it, and leave the last one open."""
        for first, last in blocks(begins_block(drawn, 0, AT_ONCE)):
            self._close()
            between = beside(last - first - 1, ends[first : last - 1], PATH)
            self._sink.write(PATH)
            self._sink.write(path_data(some(drawn, first, last), between))
            self._path_end = text(ends[last - 1 : last])

    def _ends(self, names: Sequence[str]) -> Characters:
        """Return the ends of paths, with their ids."""
        stems, which, numbers = self._ids.many(names, "mark")
        written = np.array([stem.encode("ascii") for stem in stems])
        of_each = written.view(np.uint8).reshape(len(stems), -1).take(which, axis=0)
        return beside(len(names), b'" id="', of_each, digits(numbers), END)

    def _write_blocks(self, drawn: Strokes, unfinished: bool) -> None:
        """Write paths of many marks each; the last is left open, for more marks may come."""
        for block, fresh in blocks_of(drawn, self._points, self._unfinished, unfinished):
            if fresh:
                self._close()
                self._sink.write(PATH)
                self._path_end = END
            self._sink.write(path_data(block))
        self._points += len(drawn.points)


def furniture(page: Page, options: SvgOptions) -> str:
    """Return the whole file but its paths and ids: words and, between ``PLACE`` marks, names of places.

    The places are ``id N`` (the id of layer N, -1 for the cloth), ``areas N`` and ``lines N`` (its paths).
    """
    margins = page.margins
    width = format_mm((page.cell.columns + margins.left + margins.right) / STEPS_PER_MM)
    height = format_mm((page.cell.rows + margins.bottom + margins.top) / STEPS_PER_MM)
    drawing = light_svgwrite.svgwrite().Drawing(
        size=(f"{width}mm", f"{height}mm"), viewBox=f"0 0 {width} {height}", debug=False
    )
    drawing["xmlns:inkscape"] = INKSCAPE
    drawing["xmlns:sodipodi"] = SODIPODI
    drawing.set_desc(title=xml_label(page.title))
    drawing.set_metadata(_metadata(page))
    drawing.add(_Element("sodipodi:namedview", NAMED_VIEW))
    cloth, labels = layer_labels(page)
    if options.cloth:
        ground = _layer(-1, cloth, {"fill": hex_colour(page.cloth)})
        ground.add(_Element("polygon", {"points": f"0 0 {width} 0 {width} {height} 0 {height}"}))
        drawing.add(ground)
    for number, plate in enumerate(page.plates):
        drawing.add(_inked(plate, number, labels[number], options.profile))
    tree = drawing.get_xml()
    ET.indent(tree, space="")
    body = ET.tostring(tree, encoding="unicode")
    # Readers turn a bare carriage return into a line feed.
    body = body.replace("\r", "&#13;")
    body = re.sub(f'<{HOLE} at="({PLACE}[^{PLACE}]*{PLACE})" />\n', r"\1", body)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{body}\n'


def layer_labels(page: Page) -> tuple[str, list[str]]:
    """Return the labels of the cloth and of all other layers, each with a number of its own.

    Inks have the numbers of their pens; what no pen draws begins with ``%``, and its numbers lie far behind.
    """
    guides = sum(plate.guide for plate in page.plates)
    most = max([len(page.plates) - guides, *(plate.pen for plate in page.plates)])
    last = CLOTH_NUMBER
    while last - guides <= most:
        last = last * 10 + 9
    pen, guide, labels = 0, last - guides, []
    for plate in page.plates:
        label = xml_label(plate.ink.name)
        if plate.guide:
            labels.append(f"%{guide} {label}")
            guide += 1
        else:
            pen = plate.pen or pen + 1
            labels.append(f"{pen} {label}")
    return f"%{last} cloth", labels


def _inked(plate: Plate, number: int, label: str, profile: Profile) -> Any:
    """Return the group of an ink: its styles, and the places of its paths; lines beside areas in groups."""
    from svgwrite.container import Group

    colour = hex_colour(plate.ink.colour)
    # Marks laid over one another in one path would cut each other out under the even-odd rule.
    loose = profile is Profile.COMPACT and plate.ink.overlap is Overlap.OVERLAY
    filled = {"fill": colour, "fill-rule": "nonzero" if loose else "evenodd"}
    drawn = {
        "fill": "none",
        "stroke": colour,
        "stroke-width": format_mm(plate.ink.width),
        "stroke-linecap": "round",
        "stroke-linejoin": "round",
    }
    kinds = [("areas", filled)] * plate.areas + [("lines", drawn)] * plate.lines
    layer = _layer(number, label, kinds[0][1] if len(kinds) == 1 else {})
    for kind, style in kinds:
        group = layer
        if len(kinds) > 1:
            group = layer.add(Group(debug=False))
            # Inkscape's R12 writer goes by the label of a path's own group.
            group.attribs.update({"inkscape:label": label, **style})
        group.add(_Element(HOLE, {"at": f"{PLACE}{kind} {number}{PLACE}"}))
    return layer


def _layer(number: int, label: str, style: dict[str, str]) -> Any:
    from svgwrite.container import Group

    layer = Group(debug=False)
    layer.attribs.update(
        {"inkscape:groupmode": "layer", "inkscape:label": label, "id": f"{PLACE}id {number}{PLACE}", **style}
    )
    return layer


def _metadata(page: Page) -> ET.Element:
    """Return recipe, seed and version as XML of our own namespace."""
    root = ET.Element("batik:provenance", {"xmlns:batik": NAMESPACE})
    for name, value in xml_fields(page.provenance):
        ET.SubElement(root, f"batik:{name}", {"xml:space": "preserve"}).text = value
    return root


class _Element:
    """An element that svgwrite puts in as it is."""

    def __init__(self, name: str, attributes: dict[str, str]) -> None:
        self.elementname = name
        self._attributes = attributes

    def get_xml(self) -> ET.Element:
        """Return the element, as svgwrite asks for it."""
        return ET.Element(self.elementname, self._attributes)
