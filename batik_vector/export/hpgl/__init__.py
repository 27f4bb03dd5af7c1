"""HP-GL: pen and knife strokes in the units of one machine, absolute, and every pen in turn.

Only words of the first HP-GL are written: IN, SP, PU, PD, and VS, FS and PE where the machine takes them.
Areas and lines are both drawn as outlines and centre lines, in the order in which a tool should follow them
(see :mod:`batik_vector.processes.order`); guides, which no pen draws, are left out. Nothing is written that
lies beyond what the machine can draw on: a drawing too large is refused, or divided over sheets.

HP 7475A Interfacing and Programming Manual (07475-90001); The HP-GL/2 and HP RTL Reference Guide, 1996.
"""

from __future__ import annotations

from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Ink, Page
from batik_vector.errors import UnsupportedByFormatError
from batik_vector.export.hpgl.clipping import Window, clipped
from batik_vector.export.hpgl.sheets import Plan, Sheet, crosses, planned, polylines
from batik_vector.export.hpgl.spelling import encoded, plain, trail
from batik_vector.export.options import HpglOptions
from batik_vector.export.provenance import hpgl_comments
from batik_vector.export.walk import Order, in_memory, walk
from batik_vector.geometry.outlines import Offsets, Outlines, Steps
from batik_vector.machines.hpgl import FARTHEST
from batik_vector.units import format_mm

MM_PER_CM = 10

DEFAULTS = HpglOptions()


def render(page: Page, options: HpglOptions = DEFAULTS) -> bytes:
    """Return a page as an HP-GL file; see :func:`write`."""
    return in_memory(lambda sink: write(page, sink, options))


def write(page: Page, sink: BinaryIO, options: HpglOptions = DEFAULTS) -> None:
    """Write a page as HP-GL.

    Args:
        page: what to write.
        sink: open for writing.
        options: for which machine and sheet; ``sheet`` says which one of a drawing that is divided.

    Raises:
        ExportError: where the machine cannot draw the page, or the options ask for what it has not.
    """
    plan = planned(page, options)
    surface = _HpglSurface(sink, plan, _sheet(plan, options), options)
    walk(page, surface, Order.CONTOURS if options.order else Order.GIVEN)


def parts(page: Page, options: HpglOptions) -> list[tuple[str, dict[str, Any]]]:
    """Return the files over which a drawing is divided, none where it is one.

    A file for each sheet, since many plotters have no word that waits for paper, and those that have differ
    (NR, PG): whoever changes the sheet sends the next file.

    Returns:
        What is added to the name of each, and which options are its own.
    """
    sheets = planned(page, options).sheets
    return [(sheet.name, {"sheet": sheet.number}) for sheet in sheets] if len(sheets) > 1 else []


def _sheet(plan: Plan, options: HpglOptions) -> Sheet:
    columns, rows = plan.sheets[-1].number
    if options.sheet is None and len(plan.sheets) > 1:
        raise UnsupportedByFormatError(
            f"the drawing is divided over {columns} x {rows} pages, each a file of its own: "
            "expected sheet = [column, row], from [1, 1] at the lower left"
        )
    for sheet in plan.sheets:
        if sheet.number == (options.sheet or sheet.number):
            return sheet
    raise UnsupportedByFormatError(
        f"sheet = {list(options.sheet or ())}, expected at most [{columns}, {rows}], the last there is"
    )


class _HpglSurface:
    """Writes strokes as they come, pen by pen."""

    def __init__(self, sink: BinaryIO, plan: Plan, sheet: Sheet, options: HpglOptions) -> None:
        self._sink, self._plan, self._sheet, self._options = sink, plan, sheet, options
        self._device = options.device
        self._pen = self._chosen = 0
        self._at: tuple[int, int] | None = None
        self._marked = not sheet.marks
        self._over = 0

    def begin(self, page: Page) -> None:
        words = self._device.start
        if self._plan.paper is not None:
            words += self._plan.paper.words
        words += _tuned(self._options)
        self._pens = _pens(page, self._options)
        self._inks = iter(self._pens)
        self._sink.write(words.encode("ascii") + b"\n")
        if self._options.comment:
            self._sink.write(hpgl_comments(page.provenance))

    def ink(self, ink: Ink, pen: int) -> None:
        self._pen = next(self._inks) if pen else 0

    def areas(self, outlines: Outlines) -> None:
        if not self._pen:
            return
        points, offsets = polylines(self._plan, outlines)
        self._refuse(_beyond(points, (-FARTHEST, -FARTHEST, FARTHEST, FARTHEST)))
        self._draw(points, offsets, outlines.closed)

    def lines(self, outlines: Outlines) -> None:
        self.areas(outlines)

    def end(self) -> None:
        if not self._marked and any(self._pens):
            self._take(next(filter(None, self._pens)))
        self._lift()
        self._refuse(self._over)
        self._sink.write(self._device.end.encode("ascii") + b"\n")

    def _draw(self, points: Steps, offsets: Offsets, closed: NDArray[np.bool_]) -> None:
        if self._sheet.window is not None:
            points, offsets = clipped(points, offsets, closed, self._sheet.window)
        points = points + np.array(self._sheet.shift)
        if self._sheet.limits is not None:
            # Told at the end: what a later pen draws may go farther.
            self._over = max(self._over, _beyond(points, self._sheet.limits))
        strokes = trail(points, offsets, self._at if self._pen == self._chosen else None)
        if not len(strokes):
            return
        if self._pen != self._chosen:
            self._take(self._pen)
        if self._options.encoded:
            self._sink.write(encoded(strokes))
        else:
            self._sink.write(plain(strokes, self._device.points))
        self._at = int(strokes.points[-1, 0]), int(strokes.points[-1, 1])

    def _take(self, pen: int) -> None:
        """Take a pen; the first draws the crosses that the sheet shares with its neighbours."""
        self._lift()
        self._pen = self._chosen = pen
        self._sink.write(b"SP%d;\n" % pen)
        if not self._marked:
            self._marked = True
            points, offsets = crosses(self._plan, self._sheet)
            self._draw(points, offsets, np.zeros(len(offsets) - 1, bool))
            self._lift()

    def _lift(self) -> None:
        if self._at is not None:
            self._sink.write(b"PU;\n")
            self._at = None

    def _refuse(self, over: int) -> None:
        if over > 0:
            unit = self._plan.frame.unit
            # A tenth of a mm more than is needed, so that the number is a short one.
            needed = self._options.margin + -(-over * unit // 100_000) / 10
            known = self._plan.paper is not None
            beyond = "what the machine can draw on" if known else "the origin, to the left or below"
            raise UnsupportedByFormatError(
                f"strokes go {format_mm(over * unit / 1_000_000)} mm beyond {beyond}, "
                f'as they stand outside the drawing: expected margin = "{format_mm(needed)} mm", or more'
            )


def _beyond(points: Steps, limits: Window) -> int:
    """Return by how much points lie beyond limits, 0 or less where none does."""
    if not len(points):
        return 0
    return max(
        *(limits[axis] - int(points[:, axis].min()) for axis in (0, 1)),
        *(int(points[:, axis].max()) - limits[axis + 2] for axis in (0, 1)),
    )


def _pens(page: Page, options: HpglOptions) -> tuple[int, ...]:
    """Return the pen of each ink that is no guide, the lowest first."""
    inks = [plate.ink.name for plate in page.plates if not plate.guide]
    most = options.device.pens
    if not options.pens:
        numbers = list[int]()
        for plate in page.plates:
            if not plate.guide:
                numbers.append(plate.pen or (numbers[-1] + 1 if numbers else 1))
        if max(numbers, default=0) > most:
            raise UnsupportedByFormatError(
                f"the drawing has {len(inks)} inks, and the machine changes {most} pen{'s' * (most > 1)} "
                "by itself: expected pens, the pen of each ink from the lowest, as "
                f"{[min(number, most) for number in range(1, len(inks) + 1)]}; 0 leaves an ink out"
            )
        return tuple(numbers)
    if len(options.pens) != len(inks):
        raise UnsupportedByFormatError(
            f"pens names {len(options.pens)}, expected {len(inks)}: one for each of {', '.join(inks)}"
        )
    if max(options.pens) > most:
        raise UnsupportedByFormatError(
            f"pens = {list(options.pens)}, expected at most {most}: so many it changes"
        )
    return options.pens


def _tuned(options: HpglOptions) -> str:
    """Return the words for speed and force, and refuse those that the machine does not know."""
    device, words = options.device, ""
    if options.encoded and not device.encoded:
        raise UnsupportedByFormatError("encoded = true, expected false: the machine does not understand PE")
    if options.speed is not None:
        if options.speed > device.speed:
            most = "none: it takes no VS" if not device.speed else f"at most {format_mm(device.speed)} mm/s"
            raise UnsupportedByFormatError(f"speed = {format_mm(options.speed)} mm/s, expected {most}")
        words += f"VS{format_mm(round(options.speed) / MM_PER_CM)};"
    if options.force is not None:
        if options.force > device.force:
            most = "none: it takes no FS" if not device.force else f"at most {device.force}"
            raise UnsupportedByFormatError(f"force = {options.force}, expected {most}")
        words += f"FS{options.force};"
    return words
