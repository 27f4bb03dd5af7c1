"""What can be chosen of each way to fill areas, with bounds and help. Importing it costs nothing heavy."""

from __future__ import annotations

from typing import Annotated, ClassVar, TypeAlias

from batik_vector.fields import Between, Length, OneOf, Says, check
from batik_vector.values import frozen

LEAST_MM, MOST_MM = 0.001, 1000.0


@frozen(kw_only=True)
class Hatch:
    """How areas are filled by strokes. Each way has a class of its own in ``HATCHES``."""

    kind: ClassVar[str] = ""

    spacing: Annotated[
        Annotated[Length, Between(LEAST_MM, MOST_MM)] | None,
        Says("from stroke to stroke; the pen's width if unset"),
    ] = None
    inset: Annotated[
        Annotated[Length, Between(0, MOST_MM)] | None,
        Says(
            "how far within the edge the pen stays; half its width if unset, so that no ink leaves the area"
        ),
    ] = None
    edge: Annotated[bool, Says("draw the edge as well, at last")] = True
    thin: Annotated[bool, Says("draw the edge of areas that are too narrow for the pen")] = True

    def __post_init__(self) -> None:
        check(self)


@frozen(kw_only=True)
class ParallelHatch(Hatch):
    """Parallel strokes, to and fro.

    They lie at multiples of the spacing from the page's lower left corner, whatever the shape, so that areas
    side by side are hatched alike.
    """

    kind = "parallel"

    angle: Annotated[float, Between(-360, 360), Says("degrees anticlockwise from the right")] = 45.0
    join: Annotated[bool, Says("go from stroke to stroke along the edge, without lifting the pen")] = True


@frozen(kw_only=True)
class CrossHatch(ParallelHatch):
    """Parallel strokes in two directions, one after the other."""

    kind = "cross"

    between: Annotated[float, Between(1, 179), Says("degrees from the first direction to the second")] = 90.0


@frozen(kw_only=True)
class ConcentricHatch(Hatch):
    """Rings, each the spacing within the one before; the inmost is drawn first if the edge comes last."""

    kind = "concentric"


@frozen(kw_only=True)
class SpiralHatch(Hatch):
    """Spirals: the rings of the concentric way, each joined to the one within.

    A simple area is one stroke from the outside in. Where an area parts in two further in, or has holes, each
    part and each hole has a spiral of its own.
    """

    kind = "spiral"


HATCHES: dict[str, type[Hatch]] = {
    each.kind: each for each in (ParallelHatch, CrossHatch, ConcentricHatch, SpiralHatch)
}
"""The catalogue of ways to fill areas."""

AnyHatch: TypeAlias = Annotated[Hatch, OneOf(lambda: HATCHES, "hatch")]
