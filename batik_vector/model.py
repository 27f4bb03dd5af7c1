"""The recipe as values: what a recipe file says once it is read and every name in it is known."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, TypeAlias

from batik_vector.artwork import Overlap
from batik_vector.errors import Fault, GeometryError, RecipeError
from batik_vector.fields import Between, Colour, Hidden, Length, OneOf, Says, check, choice, parse_colour
from batik_vector.motif import MOTIFS, Motif, Treatment
from batik_vector.outputs import AnyOutput, OutputSpec
from batik_vector.references import dotted, unknown_references
from batik_vector.tiling.cells import Cut, TileSpec
from batik_vector.tiling.layouts import AnyLayout, Single

AnyMotif: TypeAlias = Annotated[Motif, OneOf(lambda: MOTIFS, "motif")]
MAX_SIDE_MM = 20_000.0
Side: TypeAlias = Annotated[Length, Between(0.1, MAX_SIDE_MM)]
Place2D: TypeAlias = tuple[
    Annotated[Length, Between(-MAX_SIDE_MM, MAX_SIDE_MM)],
    Annotated[Length, Between(-MAX_SIDE_MM, MAX_SIDE_MM)],
]


@dataclass(frozen=True, kw_only=True)
class InkSpec:
    """One bath, screen, pen or tool. The order of the inks in the recipe is their painting order."""

    colour: Annotated[Colour, Says("colour on screen")] = "#1a1a1a"
    width: Annotated[Annotated[Length, Between(0.01, 100)], Says("breadth of a line drawn with it")] = 1.0
    overlap: Annotated[Overlap, Says("what its marks do to one another and to inks beneath")] = Overlap.WELD

    def __post_init__(self) -> None:
        check(self)
        object.__setattr__(self, "colour", _colour(self.colour))
        object.__setattr__(self, "overlap", choice(Overlap, self.overlap, "overlap"))


@dataclass(frozen=True, kw_only=True)
class ClothSpec:
    """The ground."""

    colour: Annotated[Colour, Says("colour on screen")] = "#ffffff"

    def __post_init__(self) -> None:
        object.__setattr__(self, "colour", _colour(self.colour))


def _colour(text: str) -> str:
    try:
        return parse_colour(text)
    except ValueError as error:
        raise GeometryError(f'colour = "{text}", {error}') from None


@dataclass(frozen=True, kw_only=True)
class Placement:
    """A motif set on the cloth by a layout, at a size and a place."""

    motif: Annotated[str, Says("name of the motif")]
    layout: Annotated[AnyLayout, Says("how copies are set out")] = field(default_factory=Single)
    width: Annotated[
        Side | None,
        Says("breadth of all copies before they are turned, without bodies of lines; of one in a lattice"),
    ] = None
    scale: Annotated[Annotated[Length, Between(1e-3, MAX_SIDE_MM)] | None, Says("mm to one motif unit")] = (
        None
    )
    at: Annotated[
        Place2D | None, Says("where the layout's origin lies; the middle of the repeat when left out")
    ] = None
    turn: Annotated[float, Between(-360, 360), Says("degrees the whole is turned")] = 0.0
    ink: Annotated[str, Says("ink of the elements that name none; needed where there are several")] = ""

    def __post_init__(self) -> None:
        check(self)
        if self.width is not None and self.scale is not None:
            raise GeometryError("width and scale are both given: expected one of them")
        if self.width is None and self.scale is None:
            raise GeometryError(
                'neither width nor scale is given: expected one of them, such as width = "280 mm"'
            )


@dataclass(frozen=True, kw_only=True)
class Recipe:
    """All that is needed to make an artwork."""

    motif: Annotated[dict[str, AnyMotif], Says("the motifs, by name")]
    place: Annotated[tuple[Placement, ...], Says("what lies on the cloth, bottom first")]
    tile: Annotated[TileSpec, Says("the repeat")]
    title: Annotated[str, Says("what the design is called")] = "Untitled"
    tolerance: Annotated[
        Annotated[Length, Between(0.002, 5)], Says("how far a drawn edge may stand from the true curve")
    ] = 0.02
    seed: Annotated[int, Between(0, 2**63 - 1), Says("everything random hangs on it")] = 0
    limit: Annotated[int, Between(1000, 50_000_000), Says("vertices past which the recipe is refused")] = (
        10_000_000
    )
    ink: Annotated[dict[str, InkSpec], Says("the inks, by name, in painting order")] = field(
        default_factory=lambda: {"ink": InkSpec()}
    )
    cloth: Annotated[ClothSpec, Says("the ground")] = field(default_factory=ClothSpec)
    output: Annotated[tuple[AnyOutput, ...], Says("files to write")] = ()
    source: Annotated[str, Hidden()] = ""

    __pydantic_config__ = {"strict": True, "allow_inf_nan": False}  # noqa: RUF012

    def __post_init__(self) -> None:
        check(self)
        faults = [fault for _, fault in unknown_references(self)]
        faults += self._bad_names() + self._without_ink()
        if not self.motif or not self.place:
            faults.append(Fault("expected at least one", "place" if self.motif else "motif"))
        if faults:
            raise RecipeError(faults)

    def _bad_names(self) -> list[Fault]:
        """Return the names that a file could not show."""
        return [
            Fault("expected a name of 1 to 80 printable characters", dotted((what, name)))
            for what, names in (("motif", self.motif), ("ink", self.ink))
            for name in names
            if not (0 < len(name) <= 80 and name.isprintable())
        ]

    def _without_ink(self) -> list[Fault]:
        """Return the placements that leave open which of several inks draws them."""
        if len(self.ink) == 1:
            return []
        several = "several inks" if self.ink else "no inks"
        return [
            Fault(
                f"missing: the recipe has {several}, expected one of {', '.join(self.ink)}",
                f"place[{number}].ink",
            )
            for number, placement in enumerate(self.place)
            if not placement.ink
            and placement.motif in self.motif
            and any(
                not part.ink and part.treatment != Treatment.CUT
                for part in self.motif[placement.motif].parts()
            )
        ]


__all__ = ["ClothSpec", "Cut", "InkSpec", "OutputSpec", "Placement", "Recipe", "TileSpec"]
