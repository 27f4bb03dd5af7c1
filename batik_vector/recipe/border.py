"""Borders as a recipe tells them: a frieze along the sides of a cloth, and what becomes of it at corners."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from typing import Annotated, TypeAlias

from batik_vector.errors import GeometryError, blame
from batik_vector.fields import Between, Length, Says, Text, check
from batik_vector.recipe.placement import Placement
from batik_vector.tiling.layouts import FreeGround
from batik_vector.tiling.symmetry.friezes import FRIEZE_NAMES, frieze
from batik_vector.units import to_steps
from batik_vector.values import frozen

MAX_DEPTH_MM = 20_000.0
Measure: TypeAlias = Annotated[Length, Between(0.1, MAX_DEPTH_MM)]


class Corner(enum.StrEnum):
    """How a band turns a corner of the cloth."""

    MITRE = "mitre"
    """Cut along the 45° line and mirrored across it: every line meets its mirror image. Opposite sides are
    turned into one another, neighbouring ones run against each other."""
    BEND = "bend"
    """Bent round a quarter circle, so that what runs goes on running all round."""
    MOTIF = "motif"
    """Ended at a square that holds placements of its own (``corner_place``)."""


class Facing(enum.StrEnum):
    """How bands with motif corners, or without corners, stand on their sides."""

    TURN = "turn"
    """Each side and corner is the one before, turned by a right angle."""
    MIRROR = "mirror"
    """Opposite sides and corners are mirror images."""


class Ends(enum.StrEnum):
    """What becomes of a band at an edge of the cloth where it turns no corner."""

    WHOLE = "whole"
    """It is stretched a little to end with a whole period."""
    TRIM = "trim"
    """It keeps its period and is cut off."""


class ClothSide(enum.StrEnum):
    """A side of the cloth."""

    BOTTOM = "bottom"
    RIGHT = "right"
    TOP = "top"
    LEFT = "left"


@frozen(kw_only=True)
class RailSpec:
    """A rule that runs along a border, round all its corners."""

    at: Annotated[
        Annotated[Length, Between(0, MAX_DEPTH_MM)], Says("from the border's outer edge to the rule's middle")
    ]
    width: Annotated[Annotated[Length, Between(0.01, MAX_DEPTH_MM)], Says("breadth of the rule")] = 1.0
    ink: Annotated[str, Says("ink it is drawn with; needed where there are several")] = ""

    def __post_init__(self) -> None:
        check(self)


def _checked_frieze(text: str) -> str:
    return frieze(text).name


@frozen(kw_only=True)
class BorderSpec:
    """A band along sides of the cloth: one period of a frieze, its rules and its corners.

    A period is drawn with x along the band, anticlockwise round the cloth, and y from the band's outer edge
    (0) inwards; what reaches beyond the depth is cut off.
    """

    size: Annotated[
        tuple[Measure, Measure],
        Says("period along the band, and depth from its outer edge", called="period, depth"),
    ]
    place: Annotated[
        tuple[Placement, ...], Says("what lies in one period, bottom first; the frieze repeats it")
    ] = ()
    frieze: Annotated[
        str, Text(_checked_frieze, FRIEZE_NAMES), Says(f"the band's symmetry: {FRIEZE_NAMES}")
    ] = "p1"
    phase: Annotated[
        Annotated[Length, Between(-MAX_DEPTH_MM, MAX_DEPTH_MM)],
        Says("where in the period a side begins, and mitres cut; the middle of a bent border's lower side"),
    ] = 0.0
    corner: Annotated[Corner, Says("how it turns a corner")] = Corner.MITRE
    corner_place: Annotated[
        tuple[Placement, ...],
        Says('what lies in the corner square of corner "motif", drawn for the lower left corner'),
    ] = ()
    radius: Annotated[
        Annotated[Length, Between(0, MAX_DEPTH_MM)] | None,
        Says('radius of the inner edge round a corner "bend"; half the depth when left out'),
    ] = None
    facing: Annotated[
        Facing, Says('how sides and corners stand to one another with corner "motif", or without corners')
    ] = Facing.TURN
    sides: Annotated[tuple[ClothSide, ...], Says("the sides it lies along")] = tuple(ClothSide)
    ends: Annotated[Ends, Says("at an edge of the cloth: a whole period, or cut off")] = Ends.WHOLE
    rails: Annotated[tuple[RailSpec, ...], Says("rules along the band, beneath what is placed")] = ()
    gap: Annotated[Annotated[Length, Between(0, MAX_DEPTH_MM)], Says("bare ground inside the border")] = 0.0
    limit: Annotated[
        float, Between(0, 50), Says("percent by which a period may be stretched or squeezed to fit its side")
    ] = 5.0

    def __post_init__(self) -> None:
        check(self)
        self._refuse_contradictions()

    def _refuse_contradictions(self) -> None:
        if not self.sides:
            raise GeometryError("sides = []: expected one or more of bottom, right, top, left")
        twice = [side for side in ClothSide if self.sides.count(side) > 1]
        if twice:
            raise GeometryError(
                f"sides = {_listed(self.sides)}: {twice[0]} is named twice, expected each once"
            )
        if not (self.place or self.rails or self.corner_place):
            raise GeometryError("the border is empty: expected placements in place, or rails")
        self._refuse_for_corner()
        for key, placements in (("place", self.place), ("corner_place", self.corner_place)):
            for number, placement in enumerate(placements):
                with blame(f"{key}[{number}]"):
                    _refuse_wallpaper(placement)
        for number, rail in enumerate(self.rails):
            with blame(f"rails[{number}].at"):
                self._refuse_beyond(rail)

    def _refuse_for_corner(self) -> None:
        """Raise where a key is given that the kind of corner makes nothing of."""
        given = f'with corner = "{self.corner}"'
        if self.corner_place and self.corner != Corner.MOTIF:
            with blame("corner_place"):
                raise GeometryError(f'given {given}: expected none, or corner = "motif"')
        if self.radius is not None and self.corner != Corner.BEND:
            raise GeometryError(f'radius = {self.radius:g} mm {given}: expected none, or corner = "bend"')
        level = {ClothSide.BOTTOM, ClothSide.TOP}
        turns = bool(level & set(self.sides)) and bool(set(self.sides) - level)
        if self.facing != Facing.TURN and turns and self.corner != Corner.MOTIF:
            raise GeometryError(
                f'facing = "{self.facing}" {given}, which sets how its sides stand: expected none, '
                'or corner = "motif"'
            )

    def _refuse_beyond(self, rail: RailSpec) -> None:
        half = rail.width / 2
        if rail.at - half >= 0 and rail.at + half <= self.size[1]:
            return
        words = f"a rail of {rail.width:g} mm at {rail.at:g} mm reaches beyond the border: expected "
        if rail.width > self.size[1]:
            raise GeometryError(f"{words}a width of {self.size[1]:g} mm at most")
        raise GeometryError(f"{words}its middle from {half:g} to {self.size[1] - half:g} mm")

    @property
    def period(self) -> int:
        """Length of a period in grid steps, before it is stretched."""
        return to_steps(self.size[0])

    @property
    def depth(self) -> int:
        """Depth in grid steps."""
        return to_steps(self.size[1])


def _refuse_wallpaper(placement: Placement) -> None:
    """Raise where a placement asks for what only a tile has."""
    if placement.symmetry not in ("", "p1"):
        with blame("symmetry"):
            raise GeometryError(
                f'"{placement.symmetry}": a border repeats by its frieze; expected "p1", '
                "which leaves the frieze's turns and mirrors out, or no symmetry"
            )
    keys = {
        "phase": placement.phase != (0.0, 0.0),
        "region": placement.region is not None,
        "counterchange": placement.counterchange,
        "layout": isinstance(placement.layout, FreeGround),
    }
    for key, given in keys.items():
        if given:
            with blame(key):
                raise GeometryError("belongs to a tile's placements: expected none in a border")


def _listed(words: Sequence[str]) -> str:
    return "[" + ", ".join(f'"{word}"' for word in words) + "]"


__all__ = ["BorderSpec", "ClothSide", "Corner", "Ends", "Facing", "RailSpec"]
