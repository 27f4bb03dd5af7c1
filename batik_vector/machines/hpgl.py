"""What a machine makes of HP-GL: its unit, its pages, its pens, and the words it takes.

Limits are those that a machine answers to ``OH;``: beyond them it draws nothing. A machine of one's own is
best asked itself, with its usual sheet loaded.
"""

from __future__ import annotations

import enum
from typing import Annotated

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Length, Says, check
from batik_vector.values import frozen

FARTHEST = 10**8
"""Units: a hundred times what any table or roll has, and far from where whole numbers end."""
Coordinate = Annotated[int, Between(-FARTHEST, FARTHEST)]


class Origin(enum.StrEnum):
    """Where on its sheet a machine counts from, and so where a drawing is put."""

    CORNER = "corner"
    """The lower left corner of what it can draw on."""
    CENTRE = "centre"
    """The middle."""


@frozen(kw_only=True)
class HpglPage:
    """What a machine can draw on a sheet of one size, in its units, x and y as the machine has them."""

    name: Annotated[str, Says("what people call the sheet")]
    low: Annotated[tuple[Coordinate, Coordinate], Says("x and y of the lower left corner, in units")] = (0, 0)
    high: Annotated[tuple[Coordinate, Coordinate], Says("x and y of the upper right corner, in units")]
    words: Annotated[str, Says("words that make the machine take the sheet for what it is")] = ""

    def __post_init__(self) -> None:
        check(self)
        if not all(low < high for low, high in zip(self.low, self.high, strict=True)):
            raise GeometryError(
                f'page "{self.name}": high = {self.high}, expected more than low = {self.low} both ways'
            )


@frozen(kw_only=True)
class Hpgl:
    """How a machine is spoken to in HP-GL. As it stands, one of 0.025 mm of which nothing else is known."""

    unit: Annotated[Annotated[Length, Between(0.001, 1)], Says("length of one plotter unit")] = 0.025
    origin: Annotated[Origin, Says("where (0, 0) lies, and a drawing is put: corner or centre")] = (
        Origin.CORNER
    )
    downwards: Annotated[bool, Says("y grows towards the lower edge of the sheet")] = False
    page: Annotated[tuple[HpglPage, ...], Says("sheets it takes, the usual first; none: no limits")] = ()
    pens: Annotated[Annotated[int, Between(1, 64)], Says("how many pens or tools it changes by itself")] = 8
    encoded: Annotated[bool, Says("whether it understands PE, coordinates in few characters")] = True
    speed: Annotated[
        float, Between(0, 10_000), Says("the fastest that VS may ask for, in mm/s; 0: it takes no VS")
    ] = 10_000.0
    force: Annotated[int, Between(0, 1000), Says("the most that FS may ask for; 0: it takes no FS")] = 1000
    points: Annotated[
        Annotated[int, Between(1, 1_000_000)],
        Says("most points that follow one PD, as its buffer holds them"),
    ] = 1_000_000
    start: Annotated[str, Says("words that begin a file")] = "IN;"
    end: Annotated[str, Says("words that end a file")] = "SP0;"

    def __post_init__(self) -> None:
        check(self)

    @property
    def unit_nm(self) -> int:
        """Length of one unit in nanometres, a whole number, so that rounding is exact."""
        return round(self.unit * 1_000_000)


def sheet_of(name: str, size: tuple[float, float], device: Hpgl) -> HpglPage:
    """Return a sheet of a given size, all of which a machine can draw on.

    Args:
        name: of the sheet.
        size: breadth and height in mm.
        device: the machine, which counts from a corner of it or from its middle.
    """
    width, height = (round(side * 1_000_000) // device.unit_nm for side in size)
    low = (-(width // 2), -(height // 2)) if device.origin is Origin.CENTRE else (0, 0)
    return HpglPage(name=name, low=low, high=(low[0] + width, low[1] + height))
