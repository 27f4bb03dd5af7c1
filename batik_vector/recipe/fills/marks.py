"""Fills of single marks: dots, crosses, fragments and spirals."""

from __future__ import annotations

import enum
import math
from typing import TYPE_CHECKING, Annotated

from batik_vector.fields import Between, Length, Says, Useful
from batik_vector.recipe.fills.base import Angled, Fill, Marks, Places, Room
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.geometry.fills.insets import Parts
    from batik_vector.geometry.sampling import Array, Indices


class Rows(enum.StrEnum):
    """What dots follow."""

    ANGLE = "angle"
    """Straight rows at an angle, in the plane of the element: each of its copies is filled alike."""
    CONTOUR = "contour"
    """Rows along the edge, from the edge inwards."""
    CENTRE = "centre"
    """Circles about the motif's centre."""
    AXIS = "axis"
    """Rows at an angle to the midrib of each region, bent with it: along a leaf, whichever way it lies."""
    SCATTER = "scatter"
    """No rows: tossed, none nearer to another than the spacing (Poisson discs)."""


@frozen(kw_only=True)
class Cecek(Angled):
    """Dots (*cecek*)."""

    kind = "cecek"
    isotropic = True
    marks_each = 1.16

    width: Annotated[Annotated[Length, Between(0.01, 100)], Useful(0.5, 1.2), Says("breadth of a dot")] = 0.8
    follow: Annotated[Rows, Says("what its rows follow")] = Rows.ANGLE
    rows: Annotated[
        int, Between(0, 1000), Says('rows from the edge inwards, with follow = "contour"; 0 for all')
    ] = 0

    def basis(self) -> tuple[tuple[float, float], tuple[float, float]] | None:
        """Each has its six neighbours at the spacing."""
        return _hexagon(self.spacing) if self.follow == Rows.ANGLE else None

    @property
    def bare(self) -> float:
        """From middle to middle."""
        return 0.96 * self.spacing

    def _laid(self, room: Room) -> Marks:
        from batik_vector.geometry.fills.bodies import circle, stamped

        places, region = _places(self, self.follow, room, self.width / 2, self.rows)
        return stamped(circle(self.width / 2, room.tolerance), places), region


@frozen(kw_only=True)
class CacahGori(Angled):
    """Small crosses (*cacah gori*)."""

    kind = "cacah-gori"
    least = 2.5
    marks_each = 1.16

    spacing: Annotated[
        Annotated[Length, Between(0.05, 1000)], Useful(2, 6), Says("from the middle of a mark to the next")
    ] = 3.0
    follow: Annotated[Rows, Says("what its rows follow")] = Rows.ANGLE

    def basis(self) -> tuple[tuple[float, float], tuple[float, float]] | None:
        """Each has its six neighbours at the spacing."""
        return _hexagon(self.spacing) if self.follow == Rows.ANGLE else None

    @property
    def bare(self) -> float:
        """From middle to middle."""
        return 0.96 * self.spacing

    def _laid(self, room: Room) -> Marks:
        import numpy as np

        from batik_vector.geometry.fills.bodies import stamped
        from batik_vector.geometry.fills.figures import ARM, cross

        shape = cross(self.spacing, self.width, room.tolerance)
        reach = max(ARM * self.spacing, self.width)
        places, region = _places(self, self.follow, room, reach)
        turns = np.full(len(places), math.radians(self.angle))
        if self.follow == Rows.AXIS:
            turns += _turns(places, region, room)
        return stamped(shape, places, turns), region


@frozen(kw_only=True)
class Herangan(Fill):
    """Broken fragments (*herangan*): splinters of all directions, tossed."""

    kind = "herangan"
    least = 2.5
    marks_each = 0.8

    spacing: Annotated[
        Annotated[Length, Between(0.05, 1000)], Useful(2, 5), Says("from the middle of a mark to the next")
    ] = 2.6

    def _laid(self, room: Room) -> Marks:
        from batik_vector.geometry.fills.bodies import stamped
        from batik_vector.geometry.fills.figures import fragment
        from batik_vector.geometry.fills.insets import inset
        from batik_vector.geometry.fills.scatter import scattered, turns

        length = self.spacing - 0.8 * self.width
        within = inset(room.parts, self.margin + length / 2)
        places, part = scattered(within, self.spacing, room.seed, room.period, self.isotropic)
        shape = fragment(length, self.width, room.tolerance)
        return stamped(shape, places, turns(len(places), room.seed)), within.region[part]


@frozen(kw_only=True)
class Ukel(Angled):
    """Spirals (*ukel*), linked two and two."""

    kind = "ukel"
    least = 5.0

    spacing: Annotated[
        Annotated[Length, Between(0.05, 1000)], Useful(4, 12), Says("from spiral to spiral")
    ] = 5.0

    def basis(self) -> tuple[tuple[float, float], tuple[float, float]] | None:
        """Every other row is moved by a quarter of the way from pair to pair."""
        return (2 * self.spacing - self.width, 0.0), (0.0, 2 * self.spacing)

    def _laid(self, room: Room) -> Marks:
        from batik_vector.geometry.fills.figures import spirals

        return spirals(room.parts, self.margin, self.angle, self.spacing, self.width, room.tolerance)


def _hexagon(side: float) -> tuple[tuple[float, float], tuple[float, float]]:
    return (side, 0.0), (side / 2, side * math.sqrt(0.75))


def _places(fill: Cecek | CacahGori, follow: Rows, room: Room, reach: float, rows: int = 0) -> Places:
    """Return where marks that reach so far about their middle have room, and the region of each place."""
    from batik_vector.geometry.fills.contours import along
    from batik_vector.geometry.fills.insets import inset
    from batik_vector.geometry.fills.rows import circles, hexagonal
    from batik_vector.geometry.fills.scatter import scattered

    if follow == Rows.CONTOUR:
        told = fill.margin + reach, fill.spacing, rows
        return along(room.parts, room.centres, room.turns, *told, room.period, fill.isotropic)
    within = inset(room.parts, fill.margin + reach)
    if follow == Rows.CENTRE:
        places, part = circles(within, room.centres, fill.spacing, room.turns)
    elif follow == Rows.SCATTER:
        places, part = scattered(within, fill.spacing, room.seed, room.period, fill.isotropic)
    elif follow == Rows.AXIS:
        return _along_midribs(fill, room, within)
    else:
        places, part = hexagonal(within, fill.angle, fill.spacing)
    return places, within.region[part]


def _along_midribs(fill: Cecek | CacahGori, room: Room, within: Parts) -> Places:
    from batik_vector.geometry.fills.contours import CROWDED
    from batik_vector.geometry.fills.midribs import midribs, spots, straightened
    from batik_vector.geometry.fills.thinning import thinned

    ribs = midribs(room.parts.shapes)
    places, region = spots(straightened(within, ribs, fill.spacing / 4), ribs, fill.spacing)
    places = ribs.bent(places, region)
    kept = thinned(places, region, CROWDED * fill.spacing)
    return places[kept], region[kept]


def _turns(places: Array, region: Indices, room: Room) -> Array:
    """Return the directions of midribs beside places, in radians."""
    from batik_vector.geometry.fills.midribs import midribs

    ribs = midribs(room.parts.shapes)
    return ribs.turns(ribs.straight(places, region), region)
