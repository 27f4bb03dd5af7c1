"""From the repeat a recipe asks for to a cell on the grid."""

from __future__ import annotations

import enum
import re
from dataclasses import dataclass
from fractions import Fraction
from typing import Annotated

from batik_vector.artwork import Cell, DropAxis
from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Length, Says, Text, check, choice
from batik_vector.units import to_steps

_DROP = re.compile(r"^(drop|brick)\s+(\d{1,3})\s*/\s*(\d{1,3})$")
_NAMED = {
    "grid": (Fraction(0), DropAxis.COLUMN),
    "half-drop": (Fraction(1, 2), DropAxis.COLUMN),
    "brick": (Fraction(1, 2), DropAxis.ROW),
}
MAX_DENOMINATOR = 60
REPEATS = '"grid", "half-drop", "brick", "drop p/q" or "brick p/q"'
REPEAT_PATTERN = r"^\s*(grid|half-drop|brick|(drop|brick)\s+\d{1,3}\s*/\s*\d{1,3})\s*$"
"""For editors; :func:`parse_repeat` is what decides."""


def _checked_repeat(text: str) -> str:
    parse_repeat(text)
    return text


class Cut(enum.StrEnum):
    """Which piece of the field becomes the tile."""

    RECTANGLE = "rectangle"
    """The smallest rectangle that repeats straight: q units for a drop of p/q."""
    UNIT = "unit"
    """One unit, to be repeated with its drop."""


@dataclass(frozen=True, kw_only=True)
class TileSpec:
    """The repeat: the size of its unit, how units stand to one another, and what is cut out as the tile."""

    size: Annotated[
        tuple[Annotated[Length, Between(0.1, 20_000)], Annotated[Length, Between(0.1, 20_000)]],
        Says("width and height of the unit; a drop p/q rounds the side it divides to q µm"),
    ]
    repeat: Annotated[
        str, Text(_checked_repeat, REPEATS, REPEAT_PATTERN), Says(f"how units stand: {REPEATS}")
    ] = "grid"
    cut: Annotated[Cut, Says("the rectangle that repeats straight, or one unit")] = Cut.RECTANGLE

    def __post_init__(self) -> None:
        check(self)
        parse_repeat(self.repeat)
        object.__setattr__(self, "cut", choice(Cut, self.cut, "cut"))

    def unit(self) -> Cell:
        """Return the unit on the grid.

        A drop must land on whole grid steps: the side it divides is rounded to a multiple of q µm, which
        moves it by less than 0.03 mm for the finest drop allowed.
        """
        drop, axis = parse_repeat(self.repeat)
        columns, rows = to_steps(self.size[0]), to_steps(self.size[1])
        q = drop.denominator
        if axis == DropAxis.COLUMN:
            rows = max(round(rows / q), 1) * q
        else:
            columns = max(round(columns / q), 1) * q
        return Cell(columns, rows, drop, axis)

    def cell(self) -> Cell:
        """Return the cell that the tile fills."""
        return self.unit().rectangle if self.cut == Cut.RECTANGLE else self.unit()


def parse_repeat(text: str) -> tuple[Fraction, DropAxis]:
    """Return the drop and its axis: ``"drop 1/3"`` → (1/3, column).

    Raises:
        GeometryError: saying what was expected.
    """
    words = text.strip().lower()
    if words in _NAMED:
        return _NAMED[words]
    match = _DROP.match(words)
    if match is None:
        raise GeometryError(
            f'repeat "{text}": expected "grid", "half-drop", "brick", "drop p/q" or "brick p/q"'
        )
    p, q = int(match[2]), int(match[3])
    if q == 0 or q > MAX_DENOMINATOR:
        raise GeometryError(f'repeat "{text}": expected a drop p/q with q from 1 to {MAX_DENOMINATOR}')
    return Fraction(p, q) % 1, DropAxis.COLUMN if match[1] == "drop" else DropAxis.ROW
