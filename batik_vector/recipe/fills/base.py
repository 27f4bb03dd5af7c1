"""What every fill says: its ink, spacing, width and margin; and what it is asked to fill."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, ClassVar, NamedTuple, TypeAlias

from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.fields import Between, Length, Says, Useful, check
from batik_vector.values import frozen

# How marks are laid is imported once a recipe has a fill.
if TYPE_CHECKING:
    from batik_vector.geometry.fills.insets import Parts
    from batik_vector.geometry.fills.periodic import Period
    from batik_vector.geometry.sampling import Array, Geometries, Indices

MOST_MARKS = 400_000
"""Marks of one fill past which it is refused before it is begun."""


class Room(NamedTuple):
    """What is to be filled, in mm, each region in the plane of its element.

    ``centres`` is where the motif's centre lies in each of them, shape (n, 2); ``turns`` the order of the
    turns about it that the cloth asks of the motif. Of a ground the ``period`` is told: then marks that do
    not lie in rows at an angle are laid once in each.
    """

    parts: Parts
    centres: Array
    turns: int
    tolerance: float
    seed: int
    period: Period | None = None


Marks: TypeAlias = "tuple[Geometries, Indices]"
"""Areas, and the number of the region that each lies in."""


Places: TypeAlias = "tuple[Array, Indices]"
"""Points, and the number of the region that each lies in."""


@frozen(kw_only=True)
class Fill:
    """Marks within an element or a ground: they keep a margin to its edge and what lies over it."""

    kind: ClassVar[str] = ""
    least: ClassVar[float] = 1.0
    """How many widths the spacing must be, at least."""
    marks_each: ClassVar[float] = 1.0
    """Marks in a square of the spacing, about."""
    whole: ClassVar[bool] = True
    """Whether a mark that something above would cut is left out instead."""
    isotropic: ClassVar[bool] = False
    """Whether a mark looks alike whichever way it is turned, and can lie on any mirror."""
    may_be_none: ClassVar[bool] = False
    """Whether an element in which nothing has room is left plain, and no fault."""

    ink: Annotated[
        str,
        Says(
            "ink it is drawn with; left out, bare in what is filled, and in the element's ink in what is not"
        ),
    ] = ""
    spacing: Annotated[
        Annotated[Length, Between(0.05, 1000)], Useful(1, 6), Says("from the middle of a mark to the next")
    ] = 2.0
    width: Annotated[
        Annotated[Length, Between(0.01, 100)], Useful(0.4, 1.2), Says("breadth of its dots or lines")
    ] = 0.6
    margin: Annotated[
        Annotated[Length, Between(0, 1000)], Useful(0.4, 2), Says("bare from the edge to its marks")
    ] = 0.7

    def __post_init__(self) -> None:
        check(self)
        least = self.least * self.width
        if self.spacing <= least:
            raise GeometryError(
                f"spacing = {self.spacing:g}: expected more than {least:g} mm with width = {self.width:g}, "
                "or the marks would touch"
            )

    def basis(self) -> tuple[tuple[float, float], tuple[float, float]] | None:
        """Return two translations, before they are turned by ``angle``, that bring its rows onto themselves.

        None where the marks lie in no rows at an angle.
        """
        return None

    @property
    def bare(self) -> float:
        """How far marks that ran into one another keep apart in a ground."""
        return 0.3 * (self.spacing - self.width)

    def lay(self, room: Room) -> Marks:
        """Return the marks of all regions.

        Raises:
            TooLargeError: where there would be far too many.
        """
        self._refuse_dense(room)
        return self._laid(room)

    def _refuse_dense(self, room: Room) -> None:
        import shapely

        area = float(shapely.area(room.parts.shapes).sum())
        count = self.marks_each * area / self.spacing**2
        if count > MOST_MARKS:
            least = math.sqrt(self.marks_each * area / MOST_MARKS)
            raise TooLargeError(
                f"spacing = {self.spacing:g}: about {count:,.0f} marks, past the limit of {MOST_MARKS:,}: "
                f"expected at least {math.ceil(least * 100) / 100:g} mm"
            )

    def _laid(self, room: Room) -> Marks:
        raise NotImplementedError


@frozen(kw_only=True)
class Angled(Fill):
    """Marks in rows that run at an angle."""

    angle: Annotated[float, Between(-360, 360), Says("degrees of its rows, in the plane of the element")] = (
        0.0
    )
