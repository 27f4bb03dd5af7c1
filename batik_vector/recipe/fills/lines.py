"""Fills of lines: parallel or crossing, along the contour or square to it, scales and veins."""

from __future__ import annotations

import enum
import math
from typing import TYPE_CHECKING, Annotated, TypeAlias

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Length, Says, Useful
from batik_vector.recipe.fills.base import Angled, Fill, Marks, Room
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.geometry.fills.insets import Parts

Basis: TypeAlias = tuple[tuple[float, float], tuple[float, float]] | None
"""Two translations, or None: see :meth:`~batik_vector.recipe.fills.base.Fill.basis`."""


def _square(side: float) -> Basis:
    return (side, 0.0), (0.0, side)


class Follow(enum.StrEnum):
    """What the rows of a fill follow."""

    ANGLE = "angle"
    """Straight rows at an angle, in the plane of the element: each of its copies is filled alike."""
    CONTOUR = "contour"
    """Rows along the edge, from the edge inwards."""
    CENTRE = "centre"
    """Circles about the motif's centre."""
    AXIS = "axis"
    """Rows at an angle to the midrib of each region, bent with it: along a leaf, whichever way it lies."""


@frozen(kw_only=True)
class Galaran(Angled):
    """Parallel lines (*galaran*)."""

    kind = "galaran"
    whole = False
    marks_each = 0.05

    follow: Annotated[Follow, Says("what its lines follow")] = Follow.ANGLE

    def basis(self) -> Basis:
        """Its rows, of which each may be moved along itself."""
        return _square(self.spacing) if self.follow == Follow.ANGLE else None

    def _laid(self, room: Room) -> Marks:
        from batik_vector.geometry.fills import figures
        from batik_vector.geometry.fills.bodies import strokes
        from batik_vector.geometry.fills.contours import bands
        from batik_vector.geometry.fills.insets import inset
        from batik_vector.geometry.fills.rows import parted, radii, runs, segments

        if self.follow == Follow.CONTOUR:
            told = self.margin, self.spacing, self.width, 1.0, 0, room.tolerance
            return bands(room.parts, *told, room.period)
        within, short = inset(room.parts, self.margin + self.width / 2), self.spacing / 2
        if self.follow == Follow.CENTRE:
            ring, centre, part = radii(within, room.centres, self.spacing)
            some = ring > 0
            radius = ring[some] * self.spacing
            return figures.arcs(within, radius, centre[some], part[some], self.width, short, room.tolerance)
        bare = self.width + 0.4 * (self.spacing - self.width)
        if self.follow == Follow.AXIS:
            return self._along_midribs(room, within, bare)
        found = parted(runs(within, self.angle, self.spacing), within.region, bare)
        found = found.taken(found.end - found.begin >= short)
        begin, end = segments(found, self.angle, self.spacing)
        return strokes(begin, end, self.width, room.tolerance), within.region[found.part]

    def _along_midribs(self, room: Room, within: Parts, bare: float) -> Marks:
        from batik_vector.geometry.fills.bodies import bodies
        from batik_vector.geometry.fills.midribs import bent_lines, midribs, straightened
        from batik_vector.geometry.fills.rows import parted, runs, segments

        ribs = midribs(room.parts.shapes)
        straight = straightened(within, ribs, self.spacing / 4)
        found = parted(runs(straight, self.angle, self.spacing), within.region, bare)
        found = found.taken(found.end - found.begin >= self.spacing / 2)
        lines = bent_lines(found, *segments(found, self.angle, self.spacing), within, ribs)
        return bodies(lines, self.width, room.tolerance), within.region[found.part]


@frozen(kw_only=True)
class Hatching(Angled):
    """Lines in two directions, which make a net."""

    kind = "hatching"
    least = 1.5
    marks_each = 0.5
    whole = False

    between: Annotated[float, Between(20, 160), Says("degrees from the first direction to the second")] = 90.0

    def basis(self) -> Basis:
        """The sides of a mesh of the net."""
        side, turn = self.spacing / math.sin(math.radians(self.between)), math.radians(self.between)
        return (side, 0.0), (side * math.cos(turn), side * math.sin(turn))

    def _laid(self, room: Room) -> Marks:
        from batik_vector.geometry.fills.bodies import net, strokes
        from batik_vector.geometry.fills.insets import inset
        from batik_vector.geometry.fills.rows import parted, runs, segments

        within = inset(room.parts, self.margin + self.width / 2)
        found = []
        for angle in (self.angle, self.angle + self.between):
            lines = parted(runs(within, angle, self.spacing), within.region, self.width * 1.4)
            lines = lines.taken(lines.end - lines.begin >= self.spacing / 2)
            body = strokes(*segments(lines, angle, self.spacing), self.width, room.tolerance)
            found.append((body, within.region[lines.part]))
        return net(*found)


@frozen(kw_only=True)
class Contours(Fill):
    """Bands along the contour, each within the one before, as in the clouds of *mega mendung*."""

    kind = "contours"
    whole = False
    marks_each = 0.1

    taper: Annotated[
        float, Between(0.3, 1), Says("share of a band's width and spacing that the next one has")
    ] = 1.0
    rows: Annotated[int, Between(0, 1000), Says("bands from the edge inwards; 0 for all")] = 0

    def _laid(self, room: Room) -> Marks:
        from batik_vector.geometry.fills.contours import bands

        told = self.margin, self.spacing, self.width, self.taper, self.rows, room.tolerance
        return bands(room.parts, *told, room.period)


@frozen(kw_only=True)
class Sawut(Fill):
    """Short strokes from the edge inwards, square to it (*sawut*)."""

    kind = "sawut"
    marks_each = 0.1

    spacing: Annotated[
        Annotated[Length, Between(0.05, 1000)], Useful(0.9, 3), Says("from stroke to stroke along the edge")
    ] = 1.4
    length: Annotated[
        Annotated[Length, Between(0.05, 1000)], Useful(2, 10), Says("length of a stroke, at most")
    ] = 4.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.length <= self.width:
            raise GeometryError(
                f"length = {self.length:g}: expected more than width = {self.width:g}, or nothing is left"
            )

    def _laid(self, room: Room) -> Marks:
        from batik_vector.geometry.fills.contours import fringe

        return fringe(
            room.parts,
            room.centres,
            room.turns,
            self.margin,
            self.spacing,
            self.width,
            self.length,
            room.tolerance,
            room.period,
        )


@frozen(kw_only=True)
class Sisik(Angled):
    """Scales (*sisik*): arcs in rows, each row moved by half a scale; the edge cuts them off."""

    kind = "sisik"
    least = 4.0
    marks_each = 2.0
    whole = False

    spacing: Annotated[Annotated[Length, Between(0.05, 1000)], Useful(3, 10), Says("breadth of a scale")] = (
        4.0
    )

    angle: Annotated[
        float,
        Between(-360, 360),
        Says("degrees of its rows; at -90 its scales lie towards the tip, along +x"),
    ] = -90.0

    def basis(self) -> Basis:
        """Every other row is moved by half a scale."""
        return (self.spacing, 0.0), (self.spacing / 2, self.spacing / 2)

    def _laid(self, room: Room) -> Marks:
        from batik_vector.geometry.fills.figures import scales

        return scales(room.parts, self.margin, self.angle, self.spacing, self.width, room.tolerance)


@frozen(kw_only=True)
class VeinLines(Fill):
    """The veins of a leaf: a midrib along its axis and side veins that leave it on both sides."""

    kind = "veins"
    least = 2.0
    marks_each = 0.2
    whole = False

    spacing: Annotated[
        Annotated[Length, Between(0.05, 1000)], Useful(2, 8), Says("from side vein to side vein")
    ] = 3.0
    angle: Annotated[
        float, Between(15, 90), Says("degrees between the midrib and a side vein where it leaves it")
    ] = 45.0

    def _laid(self, room: Room) -> Marks:
        from batik_vector.geometry.fills.figures import veins

        return veins(room.parts, self.margin, self.angle, self.spacing, self.width, room.tolerance)
