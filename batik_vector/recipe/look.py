"""How an element is drawn: its treatment, its inks, and the ground that it keeps bare."""

from __future__ import annotations

import enum
from typing import Annotated

from batik_vector.fields import Between, Length, Says, Useful, check
from batik_vector.geometry.regions import FillRule
from batik_vector.recipe.fills import AnyFill
from batik_vector.values import frozen


class Treatment(enum.StrEnum):
    """How an element is drawn."""

    AREA = "area"
    """Filled: solid resist."""
    LINE = "line"
    """A centre line, for pens and plotters. How broad it shows is left to the pen, so a line that runs within
    half its breadth of the tile's edge shows its other half on the opposite one in a PDF with spot
    inks alone: print so, or with ``stroke``."""
    STROKE = "stroke"
    """A line with a body: the area a canting of the ink's width leaves."""
    BOTH = "both"
    """Filled, and its centre line drawn as well (in ``line_ink`` where one is named)."""
    CUT = "cut"
    """Not drawn: bare ground that cuts what lies beneath."""


@frozen(kw_only=True)
class Dress:
    """What every element says of its look."""

    ink: Annotated[str, Says("ink it is drawn with; the placement's when left out")] = ""
    line_ink: Annotated[str, Says('ink of the line of treatment "both"')] = ""
    treatment: Annotated[
        Treatment, Says("filled, drawn as a line, as a line with a body, both, or cut out")
    ] = Treatment.AREA
    fill: Annotated[FillRule, Says("which faces of a self-crossing figure are inside")] = FillRule.NONZERO
    gap: Annotated[
        Annotated[Length, Between(0, 1000)] | None,
        Says("ground kept bare round it by cutting what lies beneath"),
    ] = None
    whole: Annotated[bool, Says("left out, not cut, where something above would cut it")] = False
    contours: Annotated[
        int, Between(1, 64), Useful(1, 6), Says("nested contours, evenly spaced to the centre", "l")
    ] = 1
    fill_with: Annotated[AnyFill | None, Says("marks that fill it (isen): dots, lines, scales and more")] = (
        None
    )

    def __post_init__(self) -> None:
        check(self)
