"""Swatch: an SVG whose tile is a ``<pattern>``, for Inkscape and Illustrator to fill shapes with.

Beside the artwork lies a rectangle filled with the pattern. Two things keep seams out of sight. What is drawn
goes on beyond the edges of the pattern's cell, welded, so that no renderer mixes the paper in where it cuts
the cell out (resvg does, by up to half, without). And the cell is whole units of its own broad and high,
under a ``patternTransform``: cairosvg draws a cell as a picture of whole pixels, and leaves gaps otherwise.

The artwork goes on beyond its cell too, over a rectangle without fill or stroke: drawn into Illustrator's
panel of swatches, that is what bounds the repeat.
"""

from __future__ import annotations

import re
from typing import BinaryIO

from batik_vector.artwork import Cell, Page
from batik_vector.export.ids import Ids
from batik_vector.export.options import SvgOptions, SwatchOptions
from batik_vector.export.palette import hex_colour, xml_label
from batik_vector.export.svg import svg_text
from batik_vector.units import format_mm

PER_MM, MOST_UNITS = 10.0, 4000
"""Units of the pattern's cell to a mm, and along its longer side at most: cairosvg's pixels."""
OVER = 1 / 20
"""How far what is drawn goes on beyond the cell, as a part of its shorter side."""
GAP = 1 / 10
"""Between the artwork and the filled rectangle, as a part of the cell's breadth."""
SHOWN = 2
"""Cells across and up that the filled rectangle shows."""
_LABELS = re.compile(r' (?:id|inkscape:\w+)="[^"]*"')
_SIZE = re.compile(r' (?:height|width|viewBox)="[^"]*"')


def overscan(cell: Cell) -> float:
    """Return how far (mm) what is drawn ought to go on beyond a pattern's cell."""
    return round(min(max(min(cell.width, cell.height) * OVER, 0.5), 10.0), 3)


def repeats(cell: Cell) -> tuple[int, int]:
    """Return how many tiles across and up make the rectangle by which a tile repeats without a drop."""
    whole = cell.rectangle
    return whole.columns // cell.columns, whole.rows // cell.rows


DEFAULTS = SwatchOptions()
LABEL = "%97 swatch"
"""The layer of the rectangle that the pattern fills."""


def render(page: Page, options: SwatchOptions = DEFAULTS) -> bytes:
    """Return a page as a swatch; see :func:`write`."""
    drawn = SvgOptions(options.profile, options.curves, options.curve_tolerance, cloth=False)
    text = svg_text(page, drawn)
    start = text.find("<g ")
    start = len(text) - len("</svg>\n") if start < 0 else start
    head, layers = text[:start], text[start : text.rindex("</svg>")]
    margins, cell = page.margins, page.cell
    left, top = margins.left / 1000, margins.top / 1000
    width, height = sheet(page)
    size = (
        f' width="{format_mm(width)}mm" height="{format_mm(height)}mm"'
        f' viewBox="0 0 {format_mm(width)} {format_mm(height)}"'
    )
    root, _, rest = head.partition("<svg")
    tag, _, inner = rest.partition(">")
    bounds, swatch = (_free(each, text) for each in ("bounds", "swatch"))
    name = _free(Ids().one(page.title, "tile"), f'{text} id="{bounds}" id="{swatch}"')
    box = _box(left, top, cell.width, cell.height)
    over = _box(0, 0, cell.width + left + margins.right / 1000, cell.height + top + margins.bottom / 1000)
    cloth = f'<rect {over} fill="{hex_colour(page.cloth)}" />\n' if options.cloth else ""
    right = left * 2 + cell.width * (1 + GAP)
    filled = _box(right, top, cell.width * SHOWN, cell.height * SHOWN)
    parts = [
        f"{root}<svg{_SIZE.sub('', tag)}{size}>{inner}",
        _pattern(name, page, right, cloth + _LABELS.sub("", layers)),
        _layer(bounds, "%98 bounds", f'<rect {box} fill="none" stroke="none" />\n{cloth}'),
        layers,
        _layer(swatch, LABEL, f'<rect {filled} fill="url(#{name})" />\n'),
        "</svg>\n",
    ]
    return "".join(parts).encode("utf-8")


def write(page: Page, sink: BinaryIO, options: SwatchOptions = DEFAULTS) -> None:
    """Write a page as a swatch: its cell is what repeats, and its bleed what is drawn beyond.

    Raises:
        ExportError: where the page holds what cannot be written.
    """
    sink.write(render(page, options))


def sheet(page: Page) -> tuple[float, float]:
    """Return breadth and height (mm) of the file's page, artwork and filled rectangle side by side."""
    over = page.margins.left / 1000
    width, height = page.cell.width, page.cell.height
    return round(width * (1 + GAP + SHOWN) + 3 * over, 3), round(height * SHOWN + 2 * over, 3)


def _pattern(name: str, page: Page, right: float, content: str) -> str:
    """Return the definition of the pattern, its cell in whole units, the first where ``right`` (mm) is."""
    left, top = page.margins.left / 1000, page.margins.top / 1000
    width, height = page.cell.width, page.cell.height
    units = min(PER_MM, MOST_UNITS / max(width, height))
    columns, rows = max(1, round(width * units)), max(1, round(height * units))
    x, y = width / columns, height / rows
    return (
        f'<defs>\n<pattern id="{name}" inkscape:label="{_attribute(page.title)}"'
        f' patternUnits="userSpaceOnUse" width="{columns}" height="{rows}"'
        f' patternTransform="matrix({x:.9g} 0 0 {y:.9g} {right:.9g} {top:.9g})">\n'
        f'<g transform="matrix({1 / x:.9g} 0 0 {1 / y:.9g} {-left / x:.9g} {-top / y:.9g})">\n'
        f"{content}</g>\n</pattern>\n</defs>\n"
    )


def _free(name: str, text: str) -> str:
    """Return an id that no element has, as like a name as can be."""
    number, new = 1, name
    while f' id="{new}"' in text:
        number += 1
        new = f"{name}{number}"
    return new


def _layer(name: str, label: str, content: str) -> str:
    return f'<g inkscape:groupmode="layer" inkscape:label="{label}" id="{name}">\n{content}</g>\n'


def _box(x: float, y: float, width: float, height: float) -> str:
    return f'x="{format_mm(x)}" y="{format_mm(y)}" width="{format_mm(width)}" height="{format_mm(height)}"'


def _attribute(text: str) -> str:
    for sign, written in (("&", "&amp;"), ("<", "&lt;"), ('"', "&quot;")):
        text = text.replace(sign, written)
    return xml_label(text)
