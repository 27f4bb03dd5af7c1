"""A placement as a recipe tells it: a motif set on the cloth, or along a border, by a layout."""

from __future__ import annotations

import enum
from dataclasses import field
from typing import Annotated, TypeAlias

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Length, Names, Says, Text, check
from batik_vector.recipe.fills import AnyFill
from batik_vector.recipe.references import quoted
from batik_vector.tiling.layouts import AnyLayout, Bend, DoubleSquare, FreeGround, Scattered, Single, Stripes
from batik_vector.tiling.symmetry.groups import GROUP_PATTERN, Group, group, group_name
from batik_vector.tiling.symmetry.spread import Spread
from batik_vector.values import frozen

MAX_SIDE_MM = 20_000.0
Side: TypeAlias = Annotated[Length, Between(0.1, MAX_SIDE_MM)]
Place2D: TypeAlias = tuple[
    Annotated[Length, Between(-MAX_SIDE_MM, MAX_SIDE_MM)],
    Annotated[Length, Between(-MAX_SIDE_MM, MAX_SIDE_MM)],
]


class Mirror(enum.StrEnum):
    """What of a placement changes sides."""

    ACROSS = "across"
    """Left and right."""
    DOWN = "down"
    """Above and below."""
    BOTH = "both"
    """All: it is turned by half a turn, marks of a toss with their places."""


@frozen(kw_only=True)
class Placement:
    """A motif set on the cloth by a layout, at a size and a place."""

    motif: Annotated[
        Names,
        Says(
            "name of the motif; tosses, packs, rings, lattices and the paper's layouts may have several, "
            "grounds none"
        ),
    ] = ""
    layout: Annotated[AnyLayout, Says("how copies are set out")] = field(default_factory=Single)
    width: Annotated[
        Side | None,
        Says("breadth of all copies before they are turned, without bodies of lines; of one in a ground"),
    ] = None
    scale: Annotated[Annotated[Length, Between(1e-3, MAX_SIDE_MM)] | None, Says("mm to one motif unit")] = (
        None
    )
    at: Annotated[
        Place2D | None, Says("where the layout's origin lies; the middle of the repeat when left out")
    ] = None
    turn: Annotated[float, Between(-360, 360), Says("degrees the whole is turned")] = 0.0
    mirror: Annotated[
        Mirror | None,
        Says("which sides of the whole change places, before it is turned; those of a toss in its repeat"),
    ] = None
    ink: Annotated[str, Says("ink of the elements that name none; needed where there are several")] = ""
    fill_with: Annotated[
        AnyFill | None, Says("marks that fill the elements which have no fill of their own (isen)")
    ] = None
    symmetry: Annotated[
        str,
        Text(group_name, "one of the 17 wallpaper groups, such as p4m", GROUP_PATTERN),
        Says("wallpaper group that multiplies it; the repeat's own when left out"),
    ] = ""
    phase: Annotated[Place2D, Says("move of the symmetry's origin, and of the placement with it")] = (
        0.0,
        0.0,
    )
    region: Annotated[
        Spread | None,
        Says("what the symmetry multiplies; in a mirror repeat cut, but for a toss, and free elsewhere"),
    ] = None
    gap: Annotated[
        Annotated[Length, Between(0, 1000)] | None,
        Says("ground kept bare round the whole motif by cutting what is placed beneath"),
    ] = None
    counterchange: Annotated[
        bool, Says("trade inks with what is drawn beneath in its ink: bare over it, inked beside it")
    ] = False

    def __post_init__(self) -> None:
        check(self)
        if isinstance(self.layout, FreeGround):
            self._refuse_beside_ground()
            return
        if self.motif == "":
            raise GeometryError("motif is missing: expected the name of a motif")
        if self.width is not None and self.scale is not None:
            raise GeometryError("width and scale are both given: expected one of them")
        if self.width is None and self.scale is None:
            raise GeometryError(
                'neither width nor scale is given: expected one of them, such as width = "280 mm"'
            )
        self._refuse_contradictions()

    def _refuse_contradictions(self) -> None:
        """Raise where the layout cannot do what other keys ask for."""
        if len(self.motifs) != 1:
            self._refuse_several()
        if self.counterchange and self.gap is not None:
            raise GeometryError(
                f"gap = {self.gap:g}: in a counterchange figure and ground meet at an edge, expected no gap"
            )
        if isinstance(self.layout, Scattered) and len(set(self.motifs)) < len(self.motifs):
            raise GeometryError(
                f"motif = {self._listed()}: a motif is named twice, expected weights in the layout instead"
            )
        if isinstance(self.layout, Scattered) and self.at is not None:
            x, y = self.at
            raise GeometryError(
                f"at = [{x:g}, {y:g}]: a {self.layout.kind} fills the whole repeat, expected no place"
            )
        if isinstance(self.layout, Scattered | Stripes) and self.turn:
            what = "turn of the layout" if isinstance(self.layout, Scattered) else "winding of the layout"
            raise GeometryError(f"turn = {self.turn:g}: expected the {what} instead")

    def _refuse_beside_ground(self) -> None:
        """Raise where a ground has what only motifs have, or nothing to be filled with."""
        if self.fill_with is None:
            raise GeometryError(
                "fill_with is missing: a ground is filled with marks, expected them, such as "
                'fill_with = { kind = "cecek" }'
            )
        for key in ("motif", "width", "scale", "at", "turn", "mirror", "gap", "phase", "region"):
            value = getattr(self, key)
            if value not in (None, "", 0.0, (0.0, 0.0), ()):
                shown = (
                    quoted(value)
                    if isinstance(value, str)
                    else f"{value:g}"
                    if isinstance(value, float)
                    else value
                )
                raise GeometryError(f"{key} = {shown}: a ground is filled with marks, expected no {key}")
        if self.symmetry not in ("", "p1") and self.fill_with.basis():
            raise GeometryError(
                f'symmetry = "{self.symmetry}": rows at an angle repeat by translations alone, expected '
                "marks that follow the contour or are scattered, or no symmetry"
            )
        if self.counterchange:
            raise GeometryError("counterchange = true: a ground lies over nothing, expected none")
        follow = str(getattr(self.fill_with, "follow", ""))
        if follow in ("centre", "axis") or self.fill_with.kind == "veins":
            told = f'follow = "{follow}"' if self.fill_with.kind != "veins" else 'kind = "veins"'
            raise GeometryError(f"fill_with.{told}: a ground has no centre and no axis, expected another one")

    def _refuse_several(self) -> None:
        """Raise where several motifs, or none, are more than the layout or the size can deal with."""
        if isinstance(self.layout, Scattered) and self.motifs:
            return
        if not (self.motifs and self.layout.deals):
            raise GeometryError(
                f"motif = {self._listed()}: only a toss or a pack mixes several, and only rings, lattices "
                "and the paper's layouts deal their places out in turn, expected one"
            )
        if self.scale is None:
            raise GeometryError(
                f"motif = {self._listed()}: several motifs are set out at one scale, "
                "expected scale instead of width"
            )
        images = self.layout.images((1.0, 1.0))
        places, names = 1 if isinstance(images, Bend) else len(images), len(self.motifs)
        if places < names or (places % names and not isinstance(self.layout, DoubleSquare)):
            raise GeometryError(
                f"motif = {self._listed()}: {names} motifs in turn do not come out even on {places} "
                f"places, expected a number of motifs that divides {places}"
            )

    def _listed(self) -> str:
        return "[" + ", ".join(quoted(name) for name in self.motifs[:6]) + "]"

    @property
    def spread(self) -> Spread | None:
        """What its symmetry multiplies; tossed marks stay whole, whatever the repeat does with others."""
        return self.region or (Spread.FREE if isinstance(self.layout, Scattered) else None)

    def keeps(self, asked: Group) -> bool:
        """Return whether what it draws has the symmetry of a tile whose group is ``asked``."""
        if isinstance(self.layout, FreeGround) and (self.fill_with is None or self.fill_with.basis()):
            return False
        return self.phase == (0.0, 0.0) and (not self.symmetry or group(self.symmetry) == asked)

    @property
    def motifs(self) -> tuple[str, ...]:
        """The names of its motifs."""
        if isinstance(self.motif, str):
            return (self.motif,) if self.motif else ()
        return self.motif
