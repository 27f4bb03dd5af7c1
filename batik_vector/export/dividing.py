"""A drawing that is larger than a page, divided over several that overlap, with crosses to lay them by."""

from __future__ import annotations

from collections.abc import Iterator

from batik_vector.errors import UnsupportedByFormatError
from batik_vector.units import format_mm, parse_length
from batik_vector.values import frozen

Pair = tuple[int, int]


@frozen
class Grid:
    """Pages of one size over a drawing, in whole units of any kind, each overlapping its neighbours."""

    extent: Pair
    room: Pair
    overlap: int

    @property
    def steps(self) -> Pair:
        """From a page to the next one right of it, and above it."""
        return self.room[0] - self.overlap, self.room[1] - self.overlap

    @property
    def counts(self) -> Pair:
        """How many columns and rows of pages there are."""
        columns, rows = (
            max(1, -(-(side - self.overlap) // step))
            for side, step in zip(self.extent, self.steps, strict=True)
        )
        return columns, rows

    def pages(self) -> Iterator[tuple[Pair, Pair]]:
        """Yield the column and row of each page, from 0, and its lower left corner; row by row from below."""
        columns, rows = self.counts
        for row in range(rows):
            for column in range(columns):
                yield (column, row), (column * self.steps[0], row * self.steps[1])

    def crosses(self) -> Iterator[Pair]:
        """Yield where crosses stand: two in each strip that neighbouring pages share, in the middle of it."""
        for axis in (0, 1):
            other = 1 - axis
            for seam in range(1, self.counts[axis]):
                middle = seam * self.steps[axis] + self.overlap // 2
                for number in range(self.counts[other]):
                    low = number * self.steps[other]
                    high = min(low + self.steps[other] + self.overlap, self.extent[other])
                    for along in (low + (high - low) // 4, high - (high - low) // 4):
                        yield (middle, along) if axis == 0 else (along, middle)


def check_overlap(overlap: float, narrower: float) -> None:
    """Raise where pages overlap so far that they do not get on.

    Args:
        overlap: in mm.
        narrower: the narrower side of a page, in mm.

    Raises:
        UnsupportedByFormatError: with the most that will do.
    """
    if 2 * overlap > narrower:
        said, most = format_mm(overlap), format_mm(narrower / 2)
        raise UnsupportedByFormatError(f"overlap = {said} mm, expected at most {most} mm, half of the page")


def parse_sheet(text: str) -> tuple[float, float]:
    """Return breadth and height in mm of a sheet such as ``"420 x 297 mm"``."""
    first, second = text.split("x")
    unit = second.strip().lstrip("0123456789.")
    width = parse_length(first if first.strip()[-1:].isalpha() else first + unit)
    return width, parse_length(second)
