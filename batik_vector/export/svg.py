"""SVG: named layers, true millimetres, plain paths.

What Inkscape, Illustrator, plotters and cutters each insist on, all at once: width and height in mm with
a viewBox in mm; layers as direct children of the root, with Inkscape's group mode and label and an id of
letters and digits for Illustrator; the label begins with the pen's number, as AxiDraw and vpype read it;
absolute coordinates on whole micrometres; no transforms, styles, references or clips.

The page is the cell, grown by the bleed on every side.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from batik_vector.artwork import Artwork, Ink, Overlap
from batik_vector.export.numbers import WORD, Style, Words, digit_words, put, text, word
from batik_vector.export.options import Curves, Profile, SvgOptions
from batik_vector.export.palette import Ids, hex_colour, xml_label
from batik_vector.export.provenance import NAMESPACE, xml_fields
from batik_vector.export.strokes import CONTROL, CURVE, LINE, MOVE, Strokes, strokes
from batik_vector.export.walk import Outlines, walk
from batik_vector.units import STEPS_PER_MM, format_mm

if TYPE_CHECKING:
    from svgwrite.container import Group

INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"
SODIPODI = "http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"

PATH_POINTS = 400_000
"""Points in one path at most. A point takes up to 24 characters, and libxml2, which many readers use,
refuses an attribute longer than 10 million."""

DEFAULTS = SvgOptions()


def render(artwork: Artwork, options: SvgOptions = DEFAULTS) -> bytes:
    """Return an artwork as an SVG file.

    Raises:
        ExportError: where the artwork holds what cannot be written.
    """
    surface = _SvgSurface(options)
    walk(artwork, surface)
    return surface.data


def svg_text(artwork: Artwork, options: SvgOptions = DEFAULTS) -> str:
    """Return an artwork as SVG text; see :func:`render`."""
    return render(artwork, options).decode("utf-8")


def path_data(drawn: Strokes, split: bool) -> list[str]:
    """Return strokes in the path language, coordinates in mm, y as it is.

    Args:
        drawn: the strokes, in steps.
        split: one text for each mark, or else one for all of them.
    """
    points = drawn.points
    if not len(points):
        return []
    size = digit_words(points)
    rows: Words = np.zeros((len(points), 2 * (1 + size)), WORD)
    at = put(rows, 0, points[:, 0], Style.SHORT, size, _leads(drawn, split))
    put(rows, at, points[:, 1], Style.SHORT, size, word(" "))
    end = b"Z" if drawn.closed[-1] else b""
    data = (text(rows) + end).decode("ascii")
    return data.split("\n") if split else [data]


def _leads(drawn: Strokes, split: bool) -> Words:
    """Return what stands before each point: its command where that is not understood, else a space."""
    kinds = drawn.kinds
    before = np.r_[np.uint8(MOVE), kinds[:-1]]
    leads = np.full(len(kinds), word(" "), WORD)
    leads[(kinds == LINE) & (before == CURVE)] = word("L")
    leads[(kinds == CONTROL) & (before != CURVE)] = word("C")
    shut = np.r_[False, drawn.closed[:-1]] * word("Z")
    parted = np.zeros(len(shut), WORD)
    if split:
        parted[drawn.marks[1:-1]] = word("\0\n")
    leads[drawn.first] = shut + parted + word("\0\0M")
    return leads


class _SvgSurface:
    """Builds the tree of the file."""

    def __init__(self, options: SvgOptions) -> None:
        self._options = options
        self._ids = Ids()
        self.data = b""

    def begin(self, artwork: Artwork) -> None:
        import svgwrite

        self._bleed = round(artwork.bleed * STEPS_PER_MM)
        self._columns = artwork.cell.columns + 2 * self._bleed
        self._rows = artwork.cell.rows + 2 * self._bleed
        width, height = format_mm(self._columns / STEPS_PER_MM), format_mm(self._rows / STEPS_PER_MM)
        chosen = self._options.curve_tolerance or artwork.tolerance
        self._tolerance = chosen if self._options.curves is Curves.BEZIER else None
        self._page = svgwrite.Drawing(
            size=(f"{width}mm", f"{height}mm"), viewBox=f"0 0 {width} {height}", debug=False
        )
        self._page["xmlns:inkscape"] = INKSCAPE
        self._page["xmlns:sodipodi"] = SODIPODI
        self._page.set_desc(title=xml_label(artwork.title))
        self._page.set_metadata(_metadata(artwork))
        self._page.add(_NamedView())
        if self._options.cloth:
            self._layer("%cloth", "cloth", "cloth")
            self._group["fill"] = hex_colour(artwork.cloth)
            self._path(f"M0 0 {width} 0 {width} {height} 0 {height}Z")

    def ink(self, ink: Ink, pen: int) -> None:
        self._ink = ink
        self._layer(f"{pen} {xml_label(ink.name)}", ink.name, "ink")

    def areas(self, outlines: Outlines) -> None:
        # Marks laid over one another in one path would cut each other out under the even-odd rule.
        compact = self._options.profile is Profile.COMPACT
        rule = "nonzero" if compact and self._ink.overlap is Overlap.OVERLAY else "evenodd"
        self._style = {"fill": hex_colour(self._ink.colour), "fill-rule": rule}
        self._group.attribs.update(self._style)
        self._draw(outlines)

    def lines(self, outlines: Outlines) -> None:
        style = {
            "fill": "none",
            "stroke": hex_colour(self._ink.colour),
            "stroke-width": format_mm(self._ink.width),
            "stroke-linecap": "round",
            "stroke-linejoin": "round",
        }
        if self._group.elements:
            self._part()
        self._group.attribs.update(style)
        self._draw(outlines)

    def end(self) -> None:
        tree = self._page.get_xml()
        ET.indent(tree, space="")
        body = ET.tostring(tree, encoding="unicode")
        # Readers turn a bare carriage return into a line feed.
        body = body.replace("\r", "&#13;")
        self.data = f'<?xml version="1.0" encoding="UTF-8"?>\n{body}\n'.encode()

    def _layer(self, label: str, name: str, fallback: str) -> None:
        from svgwrite.container import Group

        self._group: Group = self._page.add(Group(factory=self._page))
        self._group.attribs.update(
            {"inkscape:groupmode": "layer", "inkscape:label": label, "id": self._ids.one(name, fallback)}
        )

    def _part(self) -> None:
        """Move what the layer holds into a group of its own, and open another beside it for the lines."""
        from svgwrite.container import Group

        layer, filled, drawn = self._group, Group(factory=self._page), Group(factory=self._page)
        filled.elements, layer.elements = layer.elements, [filled, drawn]
        for name, value in self._style.items():
            filled[name] = value
            del layer.attribs[name]
        self._group = drawn

    def _draw(self, outlines: Outlines) -> None:
        flipped = outlines.moved(self._bleed, self._bleed).flipped(self._rows)
        drawn = strokes(flipped, self._tolerance)
        if self._options.profile is Profile.COMPACT:
            for part in _blocks(drawn):
                self._path(path_data(part, split=False)[0])
            return
        for name, data in zip(outlines.names, path_data(drawn, split=True), strict=True):
            self._path(data, self._ids.next(name, "mark"))

    def _path(self, data: str, name: str | None = None) -> None:
        from svgwrite.path import Path

        path = Path(data, factory=self._page)
        if name:
            path["id"] = name
        self._group.add(path)


def _blocks(drawn: Strokes) -> list[Strokes]:
    """Cut strokes between marks so that no block has many more than ``PATH_POINTS`` points."""
    ends = drawn.rings[drawn.marks]
    cuts = np.unique(np.searchsorted(ends, np.arange(0, ends[-1], PATH_POINTS), side="right") - 1)
    blocks = []
    for first, last in pairwise([*cuts.tolist(), len(ends) - 1]):
        r0, r1 = drawn.marks[first], drawn.marks[last]
        p0, p1 = drawn.rings[r0], drawn.rings[r1]
        rings, marks = drawn.rings[r0 : r1 + 1] - p0, drawn.marks[first : last + 1] - r0
        blocks.append(
            replace(
                drawn,
                points=drawn.points[p0:p1],
                kinds=drawn.kinds[p0:p1],
                rings=rings,
                marks=marks,
                closed=drawn.closed[r0:r1],
            )
        )
    return blocks


def _metadata(artwork: Artwork) -> ET.Element:
    """Return recipe, seed and version as XML of our own namespace."""
    root = ET.Element("batik:provenance", {"xmlns:batik": NAMESPACE})
    for name, value in xml_fields(artwork.provenance):
        ET.SubElement(root, f"batik:{name}", {"xml:space": "preserve"}).text = value
    return root


class _NamedView:
    """Tells Inkscape to show millimetres on its rulers."""

    elementname = "sodipodi:namedview"

    def get_xml(self) -> ET.Element:
        """Return the element, as svgwrite asks for it."""
        return ET.Element(
            self.elementname, {"id": "namedview", "inkscape:document-units": "mm", "units": "mm"}
        )
