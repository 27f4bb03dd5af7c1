"""The one walk over a page, in the order in which its marks are written: every format is a surface it drives.

The walker checks what every writer relies on and hands each ink's marks over in bulk, piece by piece as the
page gives them. A surface spells them out and knows nothing of shapely.
"""

from __future__ import annotations

import enum
import io
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import chain
from typing import BinaryIO, Protocol

from batik_vector.artwork import Ink, Page
from batik_vector.export.numbers import check_range
from batik_vector.geometry.outlines import Offsets, Outlines

__all__ = ["GUIDE_PEN", "Offsets", "Order", "Outlines", "RecordingSurface", "Surface", "in_memory", "walk"]

GUIDE_PEN = 0
"""The number of a layer that no pen draws."""


class Order(enum.Enum):
    """In which order the marks of an ink are handed over."""

    GIVEN = enum.auto()
    """As the page gives them."""
    LINES = enum.auto()
    """Lines in a good order for a pen; areas as the page gives them."""
    CONTOURS = enum.auto()
    """The outlines of areas, each ring by itself, and lines, those that meet end to end as one: all together
    in a good order for a tool, and handed over as areas."""


class Surface(Protocol):
    """What a format does with a drawing. Calls come in this order, inks from the bottom up."""

    def begin(self, page: Page) -> None:
        """Open the page. Everything of it may be read here but its marks."""

    def ink(self, ink: Ink, pen: int) -> None:
        """Open the layer of an ink; pens count from 1, and ``GUIDE_PEN`` is marks that no pen draws."""

    def areas(self, outlines: Outlines) -> None:
        """Fill outlines with the ink opened last: never none, and perhaps in several calls."""

    def lines(self, outlines: Outlines) -> None:
        """Draw lines with the ink opened last, as broad as the ink says; see :meth:`areas`."""

    def end(self) -> None:
        """Close the page."""


def in_memory(write: Callable[[BinaryIO], object]) -> bytes:
    """Return what a writer writes."""
    sink = io.BytesIO()
    write(sink)
    return sink.getvalue()


def walk(page: Page, surface: Surface, order: Order = Order.GIVEN) -> None:
    """Drive a surface over a page.

    Args:
        page: what is drawn.
        surface: what draws it.
        order: of the marks of each ink; the order of inks is always that of painting, and what a process
            has put in order stays as it is.

    Raises:
        ExportError: where a coordinate is not finite or out of range, or a mark is of the wrong kind.
    """
    if page.provenance.processes:
        order = Order.GIVEN
    surface.begin(page)
    pen = GUIDE_PEN
    for number, plate in enumerate(page.plates):
        pen = pen if plate.guide else plate.pen or pen + 1
        surface.ink(plate.ink, GUIDE_PEN if plate.guide else pen)
        areas, lines = (_checked(pieces) for pieces in (page.areas(number), page.lines(number)))
        if order is not Order.GIVEN:
            areas, lines = _in_order(areas, lines, order)
        for pieces, draw in ((areas, surface.areas), (lines, surface.lines)):
            for outlines in pieces:
                draw(outlines)
    surface.end()


def _checked(pieces: Iterator[Outlines]) -> Iterator[Outlines]:
    for outlines in pieces:
        if len(outlines):
            check_range(outlines.points)
            yield outlines


def _in_order(
    areas: Iterator[Outlines], lines: Iterator[Outlines], order: Order
) -> tuple[Iterator[Outlines], Iterator[Outlines]]:
    # To import what orders marks takes a while, and most files have nothing to order.
    from batik_vector.processes.order import contours, ordered

    if order is Order.CONTOURS:
        return ordered(contours(chain(areas, lines)), join=True), iter(())
    return areas, ordered(lines)


@dataclass
class RecordingSurface:
    """Keeps what it is told, in order: (method, arguments)."""

    calls: list[tuple[str, tuple[object, ...]]] = field(default_factory=list)

    def begin(self, page: Page) -> None:
        """Record the page."""
        self.calls.append(("begin", (page,)))

    def ink(self, ink: Ink, pen: int) -> None:
        """Record the layer."""
        self.calls.append(("ink", (ink, pen)))

    def areas(self, outlines: Outlines) -> None:
        """Record the areas."""
        self.calls.append(("areas", (outlines,)))

    def lines(self, outlines: Outlines) -> None:
        """Record the lines."""
        self.calls.append(("lines", (outlines,)))

    def end(self) -> None:
        """Record the end."""
        self.calls.append(("end", ()))
