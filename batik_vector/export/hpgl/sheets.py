"""Sheets: how a drawing is turned and put on the sheets of a machine, and onto how many of them.

Where a drawing lies hangs on the size of its page alone, never on what is drawn, so that files of one recipe
register. All is reckoned in whole nanometres and whole plotter units.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Page
from batik_vector.errors import UnsupportedByFormatError
from batik_vector.export.dividing import Grid, check_overlap, parse_sheet
from batik_vector.export.hpgl.clipping import Window, clipped
from batik_vector.export.options import HpglOptions, Pages, Turn
from batik_vector.geometry.outlines import Offsets, Outlines, Steps
from batik_vector.machines.hpgl import FARTHEST, Hpgl, HpglPage, Origin, sheet_of
from batik_vector.units import STEPS_PER_MM, format_mm, to_steps
from batik_vector.values import frozen

NM_PER_STEP = 1_000_000 // STEPS_PER_MM
QUARTERS = {Turn.NONE: 0, Turn.LEFT: 1, Turn.OVER: 2, Turn.RIGHT: 3}
MARK_NM = 2_500_000
"""Length of an arm of the crosses that neighbouring sheets share."""


@frozen
class Frame:
    """A drawing in the units of a machine: its page turned, with its lower left corner at (0, 0).

    ``corner`` is the page's lower left corner and ``size`` its breadth and height, both in grid steps and as
    the page has them; ``quarters`` says how often it is turned a quarter to the left, ``downwards`` that y
    counts from above.
    """

    corner: tuple[int, int]
    size: tuple[int, int]
    quarters: int
    unit: int
    downwards: bool = False

    @property
    def turned(self) -> tuple[int, int]:
        """Breadth and height when turned, in grid steps."""
        return self.size if self.quarters % 2 == 0 else (self.size[1], self.size[0])

    @property
    def extent(self) -> tuple[int, int]:
        """Breadth and height when turned, in units."""
        width, height = (self.nearest(side * NM_PER_STEP) for side in self.turned)
        return width, height

    def nearest(self, nm: int) -> int:
        """Return a length in units."""
        return (2 * nm + self.unit) // (2 * self.unit)

    def placed(self, points: Steps) -> Steps:
        """Return places of the page in units, each coordinate rounded once."""
        x, y = points[:, 0] - self.corner[0], points[:, 1] - self.corner[1]
        width, height = self.size
        turned = ((x, y), (height - y, x), (width - x, height - y), (y, width - x))[self.quarters]
        if self.downwards:
            turned = turned[0], self.turned[1] - turned[1]
        out = np.empty_like(points)
        for axis in (0, 1):
            out[:, axis] = (2 * NM_PER_STEP * turned[axis] + self.unit) // (2 * self.unit)
        return out


@frozen
class Sheet:
    """One sheet of paper: which part of the drawing lies on it, and where.

    ``window`` is the part, in units of the drawing, or None for all of it. ``shift`` brings it to the
    machine's coordinates. ``limits`` are what the machine can draw on, if it has any.
    """

    number: tuple[int, int]
    shift: tuple[int, int]
    window: Window | None
    limits: Window | None
    marks: tuple[tuple[int, int], ...]

    @property
    def name(self) -> str:
        """What is added to the name of its file: its column and its row, counted from the lower left."""
        return f"p{self.number[0]}x{self.number[1]}"


@frozen
class Plan:
    """How a drawing comes onto sheets."""

    frame: Frame
    paper: HpglPage | None
    sheets: tuple[Sheet, ...]


def planned(page: Page, options: HpglOptions) -> Plan:
    """Return how a page comes onto the sheets of a machine.

    Raises:
        UnsupportedByFormatError: where it is too large for them, or the machine has no such sheet.
    """
    device = options.device
    corner, size = _extent(page, options.margin)
    turns = (0, 1) if options.turn is Turn.AUTO else (QUARTERS[options.turn],)
    frames = [Frame(corner, size, turn, device.unit_nm, device.downwards) for turn in turns]
    papers = _papers(device, options)
    if not papers:
        return _unlimited(frames[0], options)
    for paper in papers:
        for frame in frames:
            limits = _limits(paper)
            if all(side <= room for side, room in zip(frame.extent, _room(limits), strict=True)):
                shift = _centred(frame, limits) if _is_centred(options) else (limits[0], limits[1])
                return Plan(frame, paper, (Sheet((1, 1), shift, None, limits, ()),))
    if options.pages is not Pages.TILE:
        raise UnsupportedByFormatError(_too_large(frames[0], papers, device))
    plans = [Plan(frame, papers[0], tuple(_tiled(frame, papers[0], options))) for frame in frames]
    return min(plans, key=lambda plan: len(plan.sheets))


def _unlimited(frame: Frame, options: HpglOptions) -> Plan:
    """Return how a drawing comes onto a machine of which no sheet is known."""
    if options.pages is Pages.TILE:
        raise UnsupportedByFormatError(
            'pages = "tile" needs to know the page: expected page, as "420 x 297 mm", or a machine with some'
        )
    if _is_centred(options):
        return Plan(frame, None, (Sheet((1, 1), _centred(frame, (0, 0, 0, 0)), None, None, ()),))
    # Whatever its sheet is, a machine that counts from its corner comes to nothing below 0.
    limits = (0, 0, FARTHEST, FARTHEST)
    return Plan(frame, None, (Sheet((1, 1), (0, 0), None, limits, ()),))


def _extent(page: Page, margin: float) -> tuple[tuple[int, int], tuple[int, int]]:
    """Return the lower left corner of a drawing with its margin, and its size.

    What guides need is not counted, since they are not drawn, nor what a process leaves outside the drawing:
    files of one recipe, drawn and cut, are to lie at the same place.
    """
    room = round(page.bleed * STEPS_PER_MM) + to_steps(margin)
    return (-room, -room), (page.cell.columns + 2 * room, page.cell.rows + 2 * room)


def _is_centred(options: HpglOptions) -> bool:
    return (options.place or options.device.origin) is Origin.CENTRE


def _papers(device: Hpgl, options: HpglOptions) -> tuple[HpglPage, ...]:
    """Return the sheets that may be taken: the one that was asked for, or all, the usual first."""
    asked = options.page
    if not asked:
        return device.page
    found = tuple(paper for paper in device.page if paper.name.casefold() == asked.casefold())
    if found:
        return found
    if "x" not in asked or not asked[0].isdigit():
        names = ", ".join(paper.name for paper in device.page) or "no sheets of its own"
        raise UnsupportedByFormatError(
            f'page = "{asked}": the machine has {names}; expected one of them, or a size as "420 x 297 mm"'
        )
    return (sheet_of(asked, parse_sheet(asked), device),)


def _limits(paper: HpglPage) -> Window:
    return (*paper.low, *paper.high)


def _room(limits: Window) -> tuple[int, int]:
    return limits[2] - limits[0], limits[3] - limits[1]


def _centred(frame: Frame, limits: Window) -> tuple[int, int]:
    """Return the shift that brings the middle of a drawing to the middle of the limits."""
    width, height = frame.extent
    return (limits[0] + limits[2] - width) // 2, (limits[1] + limits[3] - height) // 2


def _shown(sides: tuple[int, int], unit: int) -> str:
    width, height = (format_mm(side * unit / 1_000_000) for side in sides)
    return f"{width} x {height} mm"


def _too_large(frame: Frame, papers: tuple[HpglPage, ...], device: Hpgl) -> str:
    drawing = " x ".join(format_mm(side / STEPS_PER_MM) for side in frame.size)
    rooms = [(paper, _room(_limits(paper))) for paper in device.page]
    fitting = [paper.name for paper, room in rooms if _fits(frame.extent, room)]
    given = ", ".join(f"{paper.name} ({_shown(_room(_limits(paper)), frame.unit)})" for paper in papers)
    would = f'page = "{fitting[0]}", or ' if fitting else "a larger sheet, a smaller drawing, or "
    return (
        f"the drawing is {drawing} mm, and the machine can draw on {given}: expected {would}"
        'pages = "tile", which divides it over several sheets'
    )


def _fits(extent: tuple[int, int], room: tuple[int, int]) -> bool:
    return sorted(extent)[0] <= sorted(room)[0] and sorted(extent)[1] <= sorted(room)[1]


def _tiled(frame: Frame, paper: HpglPage, options: HpglOptions) -> Iterator[Sheet]:
    """Yield the sheets over which a drawing is divided, row by row from the lower left.

    Raises:
        UnsupportedByFormatError: where sheets overlap so far that they do not get on.
    """
    limits = _limits(paper)
    room, overlap = _room(limits), frame.nearest(round(options.overlap * 1_000_000))
    check_overlap(options.overlap, min(room) * frame.unit / 1_000_000)
    grid = Grid(frame.extent, room, overlap)
    columns, rows = grid.counts
    marks = tuple(grid.crosses())
    for (column, row), (left, bottom) in grid.pages():
        window = (
            # What stands over the edge of the page is not cut off, but found to be beyond the limits.
            left if column else -FARTHEST,
            bottom if row else -FARTHEST,
            left + room[0] if column < columns - 1 else FARTHEST,
            bottom + room[1] if row < rows - 1 else FARTHEST,
        )
        shift = (limits[0] - left, limits[1] - bottom)
        yield Sheet((column + 1, row + 1), shift, window, limits, marks)


def crosses(plan: Plan, sheet: Sheet) -> tuple[Steps, Offsets]:
    """Return the crosses that a sheet shares with its neighbours, in units of the drawing."""
    arm = plan.frame.nearest(MARK_NM)
    lines: list[NDArray[np.int64]] = [
        np.array([(x - arm * dx, y - arm * dy), (x + arm * dx, y + arm * dy)], np.int64)
        for x, y in sheet.marks
        for dx, dy in ((1, 0), (0, 1))
    ]
    points = np.concatenate(lines) if lines else np.empty((0, 2), np.int64)
    offsets = np.arange(0, len(points) + 1, 2)
    return clipped(points, offsets, np.zeros(len(offsets) - 1, bool), (0, 0, *plan.frame.extent))


def polylines(plan: Plan, outlines: Outlines) -> tuple[Steps, Offsets]:
    """Return outlines in units of the drawing; those that are closed end where they began."""
    points, offsets = outlines.repeating()
    return plan.frame.placed(points), offsets
