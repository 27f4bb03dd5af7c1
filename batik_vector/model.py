"""The recipe as values: what a recipe file says once it is read and every name in it is known."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Any, TypeAlias

from batik_vector.artwork import Overlap
from batik_vector.fields import Between, Length, OneOf, Says, check
from batik_vector.motif import MOTIFS, Motif
from batik_vector.tiling.cells import Cut, TileSpec
from batik_vector.tiling.layouts import AnyLayout, Single

AnyMotif: TypeAlias = Annotated[Motif, OneOf(lambda: MOTIFS, "motif")]
MAX_SIDE_MM = 20_000.0
Side: TypeAlias = Annotated[Length, Between(0.1, MAX_SIDE_MM)]
Place2D: TypeAlias = tuple[
    Annotated[Length, Between(-MAX_SIDE_MM, MAX_SIDE_MM)], Annotated[Length, Between(-MAX_SIDE_MM, MAX_SIDE_MM)]
]


@dataclass(frozen=True, kw_only=True)
class InkSpec:
    """One bath, screen, pen or tool. The order of the inks in the recipe is their painting order."""

    colour: Annotated[str, Says("colour on screen, #rrggbb")] = "#1a1a1a"
    width: Annotated[Annotated[Length, Between(0.01, 100)], Says("breadth of a line drawn with it")] = 1.0
    overlap: Annotated[Overlap, Says("what its marks do to one another and to inks beneath")] = Overlap.WELD


@dataclass(frozen=True, kw_only=True)
class ClothSpec:
    """The ground."""

    colour: Annotated[str, Says("colour on screen, #rrggbb")] = "#ffffff"


@dataclass(frozen=True, kw_only=True)
class Placement:
    """A motif set on the cloth by a layout, at a size and a place."""

    motif: Annotated[str, Says("name of the motif")]
    layout: AnyLayout = field(default_factory=Single)
    width: Annotated[Side | None, Says("breadth of all copies together on cloth")] = None
    scale: Annotated[Annotated[Length, Between(1e-3, MAX_SIDE_MM)] | None, Says("mm to one motif unit")] = None
    at: Annotated[Place2D | None, Says("where its centre lies; the middle of the repeat when left out")] = None
    turn: Annotated[float, Between(-360, 360), Says("degrees the whole is turned")] = 0.0
    ink: Annotated[str, Says("ink of the elements that name none; needed where there are several")] = ""

    def __post_init__(self) -> None:
        check(self)


@dataclass(frozen=True, kw_only=True)
class OutputSpec:
    """A file to write beside those asked for on the command line."""

    format: Annotated[str, Says("svg, pdf, dxf or png")]
    name: Annotated[str, Says("added to the file's name, to tell several of one format apart")] = ""
    options: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class Recipe:
    """All that is needed to make an artwork."""

    motif: Annotated[dict[str, AnyMotif], Says("the motifs, by name")]
    place: Annotated[tuple[Placement, ...], Says("what lies on the cloth, bottom first")]
    tile: Annotated[TileSpec, Says("the repeat")]
    title: Annotated[str, Says("what the design is called")] = "Untitled"
    tolerance: Annotated[Annotated[Length, Between(0.002, 5)], Says("how far a drawn edge may stand from the true curve")] = 0.02
    seed: Annotated[int, Between(0, 2**63 - 1), Says("everything random hangs on it")] = 0
    limit: Annotated[int, Between(1000, 50_000_000), Says("vertices past which the recipe is refused")] = 10_000_000
    ink: Annotated[dict[str, InkSpec], Says("the inks, by name, in painting order")] = field(
        default_factory=lambda: {"ink": InkSpec()}
    )
    cloth: Annotated[ClothSpec, Says("the ground")] = field(default_factory=ClothSpec)
    output: Annotated[tuple[OutputSpec, ...], Says("files to write")] = ()
    source: str = ""

    def __post_init__(self) -> None:
        check(self)


__all__ = ["ClothSpec", "Cut", "InkSpec", "OutputSpec", "Placement", "Recipe", "TileSpec"]
