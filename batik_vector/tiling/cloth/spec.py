"""Yardage as a recipe tells it: how large the cloth is, and what becomes of the tile at its edges."""

from __future__ import annotations

import enum
from typing import Annotated, TypeAlias

from batik_vector.artwork import Cell
from batik_vector.fields import Between, Length, Says, check
from batik_vector.units import to_steps
from batik_vector.values import frozen

MAX_WIDTH_MM = 20_000.0
MAX_LENGTH_MM = 200_000.0
MAX_VERTICES = 400_000_000
"""Vertices that a cloth may be allowed at most: an SVG of them has some 6 GB."""

Move: TypeAlias = Annotated[Length, Between(-MAX_WIDTH_MM, MAX_WIDTH_MM)]


class Edge(enum.StrEnum):
    """What becomes of marks at the edge of the printed area."""

    TRIM = "trim"
    """They are cut there."""
    BLEED = "bleed"
    """They go on beyond it as far as ``bleed`` says, and are cut there."""
    WHOLE = "whole"
    """Motifs that would be cut are left out. Marks without end, as bars, are cut all the same."""


class Align(enum.StrEnum):
    """Where the repeat starts."""

    CORNER = "corner"
    """A tile's lower left corner lies in the field's."""
    CENTRE = "centre"
    """A tile's middle lies in the field's."""


@frozen(kw_only=True)
class YardageSpec:
    """A cloth of given size, filled from the tile."""

    width: Annotated[Annotated[Length, Between(1, MAX_WIDTH_MM)], Says("breadth of the printed area")]
    length: Annotated[
        Annotated[Length, Between(1, MAX_LENGTH_MM)] | None, Says("one repeat when left out")
    ] = None
    edge: Annotated[Edge, Says("what becomes of marks at the edge: trim, bleed or whole")] = Edge.TRIM
    bleed: Annotated[
        Annotated[Length, Between(0, 100)], Says('how far marks go on beyond the edge with edge = "bleed"')
    ] = 5.0
    selvedge: Annotated[
        Annotated[Length, Between(0, 500)], Says("bare cloth left and right of the printed area")
    ] = 0.0
    marks: Annotated[
        bool, Says("trim marks, crosses, repeats and a bar of 100 mm, on a layer that plotters skip")
    ] = False
    align: Annotated[Align, Says("where the repeat starts: in a corner or in the centre")] = Align.CORNER
    phase: Annotated[tuple[Move, Move], Says("move of the repeat from there")] = (0.0, 0.0)

    limit: Annotated[int, Between(1000, MAX_VERTICES), Says("vertices past which the cloth is refused")] = (
        50_000_000
    )

    def __post_init__(self) -> None:
        check(self)

    @property
    def bleed_steps(self) -> int:
        """How far the field goes on beyond the printed area, in grid steps."""
        return to_steps(self.bleed) if self.edge == Edge.BLEED else 0

    def size(self, cell: Cell) -> tuple[int, int]:
        """Return the breadth and length of the printed area in grid steps, given the tile's cell."""
        length = cell.rectangle.rows if self.length is None else to_steps(self.length)
        return to_steps(self.width), length
