"""The pages of a PDF: one as large as the drawing, or several over which it is divided.

The drawing is written once, as a form (ISO 32000-1, 8.10), and shown by every page through its own window: a
cloth of twenty metres on five pages is as long as on one.
"""

from __future__ import annotations

from collections.abc import Iterator

from batik_vector.errors import UnsupportedByFormatError
from batik_vector.export.dividing import Grid, check_overlap, parse_sheet
from batik_vector.export.options import Pages, PdfOptions
from batik_vector.units import STEPS_PER_MM, format_mm, to_steps
from batik_vector.values import frozen

LONGEST = 5_000.0
"""Longest side (mm) of a page unless another is asked for: a round number below the limit of 5.08 m."""
LIMIT = 5_080.0
MOST = 10_000
ARM = 2_500
"""Length of an arm of the crosses that neighbouring pages share, in grid steps."""
LINE = 200
"""Their breadth."""


@frozen
class Window:
    """What of the drawing a page shows, in grid steps from the drawing's lower left corner."""

    left: int
    bottom: int
    width: int
    height: int


@frozen
class Sheets:
    """The pages: their windows, and where crosses stand, in grid steps of the drawing."""

    windows: tuple[Window, ...]
    crosses: tuple[tuple[int, int], ...] = ()

    @property
    def divided(self) -> bool:
        """Whether there are several."""
        return len(self.windows) > 1

    def marks(self, window: Window) -> Iterator[str]:
        """Yield the crosses that reach into a window, as path operators in steps of the drawing."""
        for x, y in self.crosses:
            right, top = window.left + window.width, window.bottom + window.height
            if window.left - ARM < x < right + ARM and window.bottom - ARM < y < top + ARM:
                yield f"{x - ARM} {y} m\n{x + ARM} {y} l\n{x} {y - ARM} m\n{x} {y + ARM} l\nS\n"


def planned(size: tuple[int, int], options: PdfOptions) -> Sheets:
    """Return the pages of a drawing.

    Args:
        size: of the drawing with its margins, in grid steps.
        options: how large the pages are to be, and how far they overlap.

    Raises:
        UnsupportedByFormatError: where the pages are too large for PDF, too small or too many.
    """
    if options.pages is not Pages.TILE:
        return Sheets((Window(0, 0, *size),))
    asked = _asked(options.page)
    width, height = asked or (min(size[0], to_steps(LONGEST)), min(size[1], to_steps(LONGEST)))
    if size[0] <= width and size[1] <= height:
        return Sheets((Window(0, 0, *size),))
    check_overlap(options.overlap, min(width, height) / STEPS_PER_MM)
    grid = Grid(size, (width, height), to_steps(options.overlap))
    columns, rows = grid.counts
    if columns * rows > MOST:
        raise UnsupportedByFormatError(
            f"page: {columns * rows:,} pages, expected at most {MOST:,}: a larger page"
        )
    windows = (
        Window(*at, width, height)
        if asked
        else Window(*at, min(width, size[0] - at[0]), min(height, size[1] - at[1]))
        for _, at in grid.pages()
    )
    return Sheets(tuple(windows), tuple(grid.crosses()))


def _asked(text: str) -> tuple[int, int] | None:
    """Return breadth and height of the pages that are asked for, in grid steps."""
    if not text:
        return None
    try:
        width, height = parse_sheet(text)
    except ValueError:
        raise UnsupportedByFormatError(f'page = "{text}", expected a size such as "420 x 297 mm"') from None
    if not (10 <= width <= LIMIT and 10 <= height <= LIMIT):
        most = format_mm(LIMIT)
        raise UnsupportedByFormatError(
            f'page = "{text}", expected 10 to {most} mm each way: PDF has none larger'
        )
    return to_steps(width), to_steps(height)
