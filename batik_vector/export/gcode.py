"""G-code: strokes as straight moves and arcs, in the words of a machine.

Coordinates are absolute millimetres with all their digits, y up; the corner of the cell is (0, 0), or its
middle, or where the options put it. Areas and lines are both followed as outlines and centre lines, in the
order in which a tool should follow them (:mod:`batik_vector.processes.order`); what a process has prepared is
written as it stands. Guides are left out: no tool draws them.

A stroke is a rapid move to its start, the words that lower the tool, its moves, and the words that lift it.
The feed stands with the first cut of each tool, and again where other words have changed it; neither a
motion nor a feed is repeated. A stroke that begins where the one before it ended goes on without lifting: a
move without length is an error to some interpreters. Arcs give their centre by I and J, from where they begin
(G91.1), since with R interpreters bear much less: LinuxCNC 2.9 takes ends that are 2.5 µm off with R, with I
and J those off by 0.1 % of the radius, and 28 µm at least. Four decimals keep both ends on one circle to
0.2 µm.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import BinaryIO

import numpy as np

from batik_vector.artwork import Ink, Page
from batik_vector.errors import UnsupportedByFormatError
from batik_vector.export.gcode_rows import Between, bounds, joined, spelled, straight_moves, with_arcs
from batik_vector.export.options import GcodeOptions, Zero
from batik_vector.export.provenance import GCODE_CHUNK, ascii_chunks
from batik_vector.export.walk import GUIDE_PEN, Order, Outlines, in_memory, walk
from batik_vector.machines import Machine
from batik_vector.machines.gcode import Comment, Stop, codes, number, plain
from batik_vector.processes.order import contours
from batik_vector.units import STEPS_PER_MM

DEFAULTS = GcodeOptions()
GENERIC = Machine()
"""What speaks G-code as :class:`~batik_vector.machines.gcode.Gcode` has it when nothing else is said."""


def render(page: Page, options: GcodeOptions = DEFAULTS) -> bytes:
    """Return a page as G-code; see :func:`write`."""
    return in_memory(lambda sink: write(page, sink, options))


def write(page: Page, sink: BinaryIO, options: GcodeOptions = DEFAULTS) -> None:
    """Write a page as G-code.

    Args:
        page: what to write.
        sink: open for writing.
        options: of the format, the machine among them.

    Raises:
        ExportError: where the page holds what cannot be written.
        UnsupportedByFormatError: where the drawing reaches beyond the machine, or arcs are asked of one that
            takes none.
    """
    walk(page, _Program(sink, options), Order.CONTOURS if options.order else Order.GIVEN)


class _Program:
    """Writes a program line by line; each begins with its line feed, but for the first of the file."""

    def __init__(self, sink: BinaryIO, options: GcodeOptions) -> None:
        self._sink, self._options = sink, options
        self._machine = options.machine_profile or GENERIC
        self._gcode = self._machine.gcode
        if options.arcs and not self._gcode.arcs:
            raise UnsupportedByFormatError(
                f"arcs = true: {self._named()} takes none, expected arcs = false or another machine"
            )
        self._feed = options.feed or self._gcode.feed or self._machine.motion.draw_speed * 60
        # Words of the tool that say a feed leave it behind for the cuts.
        words = (self._gcode.tool_down, self._gcode.tool_up, self._gcode.rapid)
        self._restated = any(word.startswith("F") for each in words for word in codes(each))

    def begin(self, page: Page) -> None:
        self._page = page
        self._shift = _shift(page, self._options)
        self._sampling = page.tolerance * STEPS_PER_MM
        within = self._options.arc_tolerance
        self._tolerance = self._sampling if within is None else within * STEPS_PER_MM
        self._tool: dict[str, float | str] = {"feed": self._feed, "tool": 1, "ink": "", "width": 0.0}
        self._waiting: Ink | None = None
        self._begun = self._down = self._feed_due = False
        self._at, self._motion = np.zeros(2, np.int64), 0
        far = np.iinfo(np.int64).max
        self._low, self._high = np.full(2, far), np.full(2, -far)
        self._sink.write(b"\n".join(line.encode("ascii") for line in self._opening(page)))
        self._say(self._filled(self._gcode.start))
        # Where the tool is when a program begins, nobody knows.
        self._say(self._filled(self._gcode.tool_up))

    def _opening(self, page: Page) -> Iterator[str]:
        if self._gcode.stop is Stop.PERCENT:
            yield "%"
        width, height = (number(steps / STEPS_PER_MM) for steps in (page.cell.columns, page.cell.rows))
        yield from self._comments(f"{plain(page.title)}, {width} x {height} mm")
        yield from self._comments(plain(self._machine.says)) if self._machine.says else ()
        for chunk in ascii_chunks(page.provenance, GCODE_CHUNK):
            yield from self._comments(chunk)
        yield "G21 G90 G17" + (" G91.1" if self._options.arcs else "")

    def _named(self) -> str:
        return f'the machine ("{self._machine.says}")' if self._machine.says else "the machine"

    def _comments(self, words: str) -> list[str]:
        """Return a comment as the machine takes it, if it takes any."""
        style = self._gcode.comment
        if style is Comment.NONE:
            return []
        return [f"({words})" if style is Comment.PARENTHESES else f"; {words}"]

    def ink(self, ink: Ink, pen: int) -> None:
        self._waiting, self._pen, self._guide = ink, pen, pen == GUIDE_PEN

    def areas(self, outlines: Outlines) -> None:
        if self._guide:
            return
        for strokes in contours([outlines]):
            self._strokes(strokes.moved(*self._shift))

    def lines(self, outlines: Outlines) -> None:
        self.areas(outlines)

    def _strokes(self, strokes: Outlines) -> None:
        moves = straight_moves(strokes)
        if self._options.arcs:
            moves = with_arcs(moves, self._tolerance, self._sampling)
        moves = joined(moves)
        self._change()
        on = self._down and bool((moves.points[0] == self._at).all())
        self._sink.write(spelled(moves, self._first(on), self._others()))
        self._down, self._feed_due = True, False
        # A view would keep all the points.
        self._at, self._motion = moves.points[-1].copy(), int(moves.motions[-1])
        low, high = bounds(moves)
        self._low, self._high = np.minimum(self._low, low), np.maximum(self._high, high)

    def _first(self, on: bool) -> Between:
        """Return what leads to the first stroke of some: it may go on, or be the first of its tool."""
        others = self._others()
        if on:
            return Between(b"", b"", b"", self._motion)
        travel = others.travel if self._down else _line(self._filled(self._gcode.rapid))
        return Between(travel, others.lower, self._feed_word if self._feed_due else others.feed)

    def _others(self) -> Between:
        """Return what leads from a stroke to the next."""
        lift, lower, rapid = (
            _line(self._filled(words))
            for words in (self._gcode.tool_up, self._gcode.tool_down, self._gcode.rapid)
        )
        return Between(lift + rapid, lower, self._feed_word if self._restated else b"")

    @property
    def _feed_word(self) -> bytes:
        return f"F{number(self._feed)} ".encode("ascii")

    def _change(self) -> None:
        """Change the tool, where strokes of another ink begin than the last."""
        ink = self._waiting
        if ink is None:
            return
        self._lift()
        self._waiting, self._feed_due = None, True
        self._tool |= {"tool": self._pen, "ink": ink.name, "width": ink.width}
        self._say(*self._comments(f"pen {self._pen}: {plain(ink.name)}, {number(ink.width)} mm"))
        if self._begun or self._gcode.first_tool:
            self._say(self._filled(self._gcode.tool_change))
        self._begun = True

    def _lift(self) -> None:
        if self._down:
            self._say(self._filled(self._gcode.tool_up))
        self._down = False

    def end(self) -> None:
        if self._begun:
            self._refuse_beyond()
        self._lift()
        self._say(self._filled(self._gcode.end), self._gcode.stop)
        self._sink.write(b"\n")

    def _refuse_beyond(self) -> None:
        """Raise where the drawing reaches beyond the machine."""
        size = self._machine.size
        if size is None:
            return
        sizes = [round(side * STEPS_PER_MM) for side in size]
        lowest = [-(side // 2) if self._options.origin is Zero.CENTRE else 0 for side in sizes]
        for axis, name in enumerate("xy"):
            low, high = int(self._low[axis]), int(self._high[axis])
            least, most = lowest[axis], lowest[axis] + sizes[axis]
            if low < least or high > most:
                raise UnsupportedByFormatError(
                    f"{name} runs from {_mm(low)} to {_mm(high)} mm, and {self._named()} "
                    f"reaches from {_mm(least)} to {_mm(most)} mm: {_remedy(low, high, least, most, name)}"
                )

    def _filled(self, words: str) -> str:
        return self._gcode.filled(words, self._tool)

    def _say(self, *texts: str) -> None:
        self._sink.write(b"".join(map(_line, texts)))


def _line(words: str) -> bytes:
    """Return words, on one line or several, begun by a line feed."""
    return f"\n{words}".encode("ascii") if words else b""


def _shift(page: Page, options: GcodeOptions) -> tuple[int, int]:
    """Return how far right and up of the cell's corner the drawing goes, in steps."""
    right, up = (round(each * STEPS_PER_MM) for each in options.offset)
    if options.origin is Zero.CENTRE:
        right, up = right - page.cell.columns // 2, up - page.cell.rows // 2
    return right, up


def _remedy(low: int, high: int, least: int, most: int, axis: str) -> str:
    """Return what would bring a drawing onto the machine along an axis."""
    if high - low > most - least:
        return f"it is {_mm(high - low)} mm long, expected {_mm(most - least)} mm at most"
    by = least - low if low < least else most - high
    return f"expected an offset {_mm(abs(by))} mm {'larger' if by > 0 else 'smaller'} in {axis}"


def _mm(steps: int) -> str:
    return number(steps / STEPS_PER_MM)
