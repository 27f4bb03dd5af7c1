"""A page drawn by cairo: paths are handed over whole, as cairo keeps them, and not point by point.

What comes out is to the pixel what cairosvg makes of our own SVG in its compact profile, which it takes
apart word by word.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Ink, Overlap, Page
from batik_vector.export.palette import rgb
from batik_vector.export.strokes import Pen, Strokes, blocks_of
from batik_vector.export.walk import Order, Outlines, walk
from batik_vector.units import STEPS_PER_MM, format_mm

MOVE_TO, LINE_TO, CLOSE_PATH = 0, 1, 3
"""As in cairo.h: cairo_path_data_type_t."""


def drawn(page: Page, size: tuple[int, int], cloth: bool, cairo: Any, *, fine: bool = True) -> Any:
    """Return a page as a surface of cairo's, filled by the page with its margins.

    Args:
        page: what is drawn.
        size: width and height in pixels.
        cloth: whether the ground has the cloth's colour, and is not clear.
        cairo: cairocffi.
        fine: whether borders have 255 shades. With a few they are drawn in half the time.

    Raises:
        ExportError: where the page holds what cannot be drawn.
    """
    surface = cairo.ImageSurface(cairo.FORMAT_ARGB32, *size)
    context = cairo.Context(surface)
    if not fine:
        context.set_antialias(cairo.ANTIALIAS_FAST)
    walk(page, _CairoSurface(context, cloth, cairo), Order.GIVEN)
    return surface


class _CairoSurface:
    """Gathers the paths of a layer in cairo's context, and paints them."""

    def __init__(self, context: Any, cloth: bool, cairo: Any) -> None:
        self._context, self._cloth, self._cairo = context, cloth, cairo

    def begin(self, page: Page) -> None:
        margins = page.margins
        width = (page.cell.columns + margins.left + margins.right) / STEPS_PER_MM
        height = (page.cell.rows + margins.bottom + margins.top) / STEPS_PER_MM
        self._pen = Pen(page, None, downwards=True)
        surface = self._context.get_target()
        self._context.scale(surface.get_width() / width, surface.get_height() / height)
        self._number, self._kind = -1, ""
        if self._cloth:
            self._context.set_source_rgb(*_share(page.cloth))
            self._context.rectangle(0, 0, width, height)
            self._context.fill()

    def ink(self, ink: Ink, pen: int) -> None:
        self._paint()
        self._ink, self._kind = ink, ""
        self._number += 1

    def areas(self, outlines: Outlines) -> None:
        self._draw("areas", outlines)

    def lines(self, outlines: Outlines) -> None:
        self._draw("lines", outlines)

    def end(self) -> None:
        self._paint()

    def _draw(self, kind: str, outlines: Outlines) -> None:
        if kind != self._kind:
            self._paint()
            self._kind, self._points, self._unfinished = kind, 0, False
        strokes = self._pen.strokes(outlines, self._number, kind)
        # Of what is one path, pixels at which two marks meet are covered by both together.
        for block, fresh in blocks_of(strokes, self._points, self._unfinished, outlines.unfinished):
            if fresh:
                self._paint()
            self._append(block)
        self._points += len(strokes.points)
        self._unfinished = outlines.unfinished

    def _append(self, strokes: Strokes) -> None:
        ffi, library = self._cairo.ffi, self._cairo.cairo
        data = _path_data(strokes)
        path = ffi.new(
            "cairo_path_t *",
            {"status": 0, "data": ffi.from_buffer("cairo_path_data_t[]", data), "num_data": len(data)},
        )
        library.cairo_append_path(self._context._pointer, path)

    def _paint(self) -> None:
        """Paint what is gathered, if anything is."""
        context, cairo = self._context, self._cairo
        if not self._kind:
            return
        context.set_source_rgb(*_share(self._ink.colour))
        if self._kind == "areas":
            # Marks laid over one another would cut each other out under the even-odd rule.
            loose = self._ink.overlap is Overlap.OVERLAY
            context.set_fill_rule(cairo.FILL_RULE_WINDING if loose else cairo.FILL_RULE_EVEN_ODD)
            context.fill()
        else:
            context.set_line_width(float(format_mm(self._ink.width)))
            context.set_line_cap(cairo.LINE_CAP_ROUND)
            context.set_line_join(cairo.LINE_JOIN_ROUND)
            context.stroke()


def _share(colour: str) -> tuple[float, float, float]:
    red, green, blue = rgb(colour)
    return red / 255, green / 255, blue / 255


def _path_data(strokes: Strokes) -> NDArray[np.float64]:
    """Return strokes of lines alone as cairo keeps a path: heads and points of 16 bytes each, in mm."""
    count = len(strokes.points)
    shut = np.zeros(count, np.intp)
    shut[strokes.last[strokes.closed]] = 1
    at = 2 * np.arange(count) + np.cumsum(shut) - shut
    data = np.empty((2 * count + int(shut.sum()), 2))
    heads = data.view(np.int32).reshape(len(data), 4)
    heads[at, 0], heads[at, 1] = LINE_TO, 2
    heads[at[strokes.first], 0] = MOVE_TO
    data[at + 1] = strokes.points / STEPS_PER_MM
    ends = at[shut > 0] + 2
    heads[ends, 0], heads[ends, 1] = CLOSE_PATH, 1
    return data
