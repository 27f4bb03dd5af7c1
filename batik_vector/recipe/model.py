"""The recipe as values: what a recipe file says once it is read and every name in it is known."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field, replace
from typing import Annotated, TypeAlias

from batik_vector.artwork import Cmyk, Dyeing, Ink, Lab, Overlap
from batik_vector.errors import Fault, GeometryError, RecipeError
from batik_vector.fields import HIDDEN, Between, Colour, Length, OneOf, Says, Unset, check
from batik_vector.recipe.border import BorderSpec
from batik_vector.recipe.colourways import ColourwaySpec, wrong_palette
from batik_vector.recipe.colourways import faults_of as wrong_colourways
from batik_vector.recipe.drawing import Svg
from batik_vector.recipe.dyeing import BathSpec, Dyed, Inks, dyeing_of, faults_of, ink_key
from batik_vector.recipe.fills import Fill
from batik_vector.recipe.motif import MOTIFS, Motif, Treatment
from batik_vector.recipe.outputs import AnyOutput, OutputSpec
from batik_vector.recipe.placement import Placement
from batik_vector.recipe.references import Path, dotted, places, unknown_references
from batik_vector.tiling.cloth.spec import YardageSpec
from batik_vector.tiling.layouts import FreeGround
from batik_vector.tiling.symmetry.repeats import Cut, TileSpec
from batik_vector.values import frozen

AnyMotif: TypeAlias = Annotated[Motif, OneOf(lambda: MOTIFS, "motif")]


@frozen(kw_only=True)
class InkSpec:
    """One bath, screen, pen or tool. The order of the inks in the recipe is their painting order."""

    colour: Annotated[Colour, Says("colour on screen; where there are baths, what they give if left out")] = (
        Unset("#1a1a1a")
    )
    width: Annotated[Annotated[Length, Between(0.01, 100)], Says("breadth of a line drawn with it")] = 1.0
    overlap: Annotated[Overlap, Says("what its marks do to one another and to inks beneath")] = Overlap.WELD
    baths: Annotated[
        tuple[str, ...] | None, Says("the baths that cloth of this colour sees; [] for what stays undyed")
    ] = None
    drawn: Annotated[
        Colour | None, Says("colour that is this ink in drawings which keep theirs; its own when left out")
    ] = None
    cmyk: Annotated[
        Cmyk | None,
        Says(
            "its colour in print, in per cent: the alternate of its separation in PDF",
            called="cyan, magenta, yellow, black",
        ),
    ] = None
    lab: Annotated[
        Lab | None,
        Says(
            "its colour as measured, L*, a*, b* under D50: the alternate of its separation in PDF",
            called="L*, a*, b*",
        ),
    ] = None

    def __post_init__(self) -> None:
        check(self)
        if self.cmyk and 0 < max(self.cmyk) <= 1 and any(part % 1 for part in self.cmyk):
            shown = ", ".join(f"{part:g}" for part in self.cmyk)
            raise GeometryError(
                f"cmyk = [{shown}], expected per cent: 1 is next to nothing, 100 the full ink"
            )

    def named(self, name: str) -> Ink:
        """Return the ink as an artwork has it."""
        return Ink(name, self.colour, self.width, self.overlap, self.cmyk, self.lab)


def _one_ink() -> dict[str, InkSpec]:
    return {"ink": InkSpec()}


@frozen(kw_only=True)
class ClothSpec:
    """The ground."""

    colour: Annotated[Colour, Says("colour on screen; where there are baths, what they give if left out")] = (
        Unset("#ffffff")
    )
    baths: Annotated[tuple[str, ...] | None, Says("the baths that bare cloth sees; all if left out")] = None
    undyed: Annotated[Colour, Says("colour of the cloth before the first bath")] = Unset("#f4efe2")

    def __post_init__(self) -> None:
        check(self)


@frozen(kw_only=True)
class Recipe:
    """All that is needed to make an artwork."""

    motif: Annotated[dict[str, AnyMotif], Says("the motifs, by name")]
    place: Annotated[tuple[Placement, ...], Says("what lies on the cloth, bottom first")] = ()
    tile: Annotated[TileSpec | None, Says("the repeat; left out where borders alone are drawn")] = None
    yardage: Annotated[YardageSpec | None, Says("a cloth of given size, filled from the tile")] = None
    border: Annotated[tuple[BorderSpec, ...], Says("bands along the sides of the yardage")] = ()
    title: Annotated[str, Says("what the design is called")] = "Untitled"
    tolerance: Annotated[
        Annotated[Length, Between(0.002, 5)], Says("how far a drawn edge may stand from the true curve")
    ] = 0.02
    seed: Annotated[int, Between(0, 2**63 - 1), Says("everything random hangs on it")] = 0
    limit: Annotated[int, Between(1000, 50_000_000), Says("vertices past which the recipe is refused")] = (
        10_000_000
    )
    ink: Annotated[dict[str, InkSpec], Says("the inks, by name, in painting order")] = field(
        default_factory=_one_ink
    )
    cloth: Annotated[ClothSpec, Says("the ground")] = field(default_factory=ClothSpec)
    bath: Annotated[tuple[BathSpec, ...], Says("the dye baths, in the order of dyeing")] = ()
    palette: Annotated[
        str, Says("palette from which all colours are taken by lightness, such as solo; none if unset")
    ] = ""
    colourway: Annotated[dict[str, ColourwaySpec], Says("other colours for the recipe, by name")] = field(
        default_factory=dict
    )
    output: Annotated[tuple[AnyOutput, ...], Says("files to write")] = ()
    drawing: Annotated[
        dict[str, str],
        Says("SVG drawings and machines by the names of their files; what is not here is read from there"),
    ] = field(default_factory=dict)
    source: str = field(default="", metadata={HIDDEN: True})
    plugins: tuple[str, ...] = field(default=(), metadata={HIDDEN: True})
    """The packages, with their versions, that brought kinds which it uses."""

    __pydantic_config__ = {"strict": True, "allow_inf_nan": False}  # noqa: RUF012

    def __post_init__(self) -> None:
        check(self)
        self._take_colours()
        faults = [fault for _, fault in unknown_references(self)]
        faults += self._missing() + self._bad_names() + self._without_ink() + self._bad_symmetries()
        faults += faults_of(self.bath, self.cloth.undyed, self._dyed(), self._ground())
        faults += wrong_colourways(self.colourway, self.ink, bool(self.bath))
        faults += wrong_palette(self.palette, self.ink, "palette")
        if faults:
            raise RecipeError(faults)
        self._take_dyes()

    def _repr_svg_(self) -> str | None:
        """Show the tile in a notebook, where there is one."""
        from batik_vector.compiling.compiler import compile_recipe

        return compile_recipe(self)._repr_svg_() if self.tile is not None else None

    def _take_colours(self) -> None:
        """Make inks of the colours that drawings keep: of each that no ink has, one called after it."""
        drawings = {name: each for name, each in self.motif.items() if isinstance(each, Svg)}
        colours = dict.fromkeys(colour for each in drawings.values() for colour in each.colours_kept())
        if not colours:
            return
        written = {} if self.ink == _one_ink() else self.ink
        known = {spec.colour: name for name, spec in reversed(written.items()) if spec.drawn is None}
        known |= {spec.drawn: name for name, spec in reversed(written.items()) if spec.drawn is not None}
        fresh = {colour: InkSpec(colour=colour) for colour in colours if colour not in {**known, **written}}
        inks = tuple((colour, known.get(colour, colour)) for colour in colours)
        motifs = {
            name: replace(each, inks=inks)
            for name, each in drawings.items()
            if each.colours and not each.inks
        }
        object.__setattr__(self, "motif", self.motif | motifs)
        object.__setattr__(self, "ink", written | fresh)

    def _dyed(self) -> Inks:
        return {name: Dyed(ink_key(name), ink.baths, ink.colour) for name, ink in self.ink.items()}

    def _ground(self) -> Dyed:
        return Dyed("cloth", self.cloth.baths, self.cloth.colour)

    def _take_dyes(self) -> None:
        """Give inks and ground that name no colour the one that their baths give them."""
        dyeing = self.dyeing
        if dyeing is None:
            return
        inks = {name: replace(ink, colour=dyeing.colour(dyeing.inks[name])) for name, ink in self.ink.items()}
        cloth = replace(self.cloth, colour=dyeing.colour(dyeing.ground), undyed=dyeing.undyed)
        object.__setattr__(self, "ink", inks)
        object.__setattr__(self, "cloth", cloth)

    @property
    def dyeing(self) -> Dyeing | None:
        """How the cloth is dyed, where the recipe has baths."""
        return dyeing_of(self.bath, self.cloth.undyed, self._dyed(), self._ground()) if self.bath else None

    @property
    def tiling(self) -> TileSpec:
        """The repeat.

        Raises:
            RecipeError: where the recipe has none, but borders alone.
        """
        if self.tile is None:
            raise RecipeError([Fault("missing: the recipe has borders alone, and no tile", "tile")])
        return self.tile

    @property
    def written(self) -> str:
        """The page of TOML as it was written, without the drawings that its ``source`` carries behind it."""
        from batik_vector.recipe.reading.sources import parted

        return parted(self.source)[0]

    def placements(self) -> Iterator[tuple[Path, Placement]]:
        """Yield every placement, those of the tile first, and where it stands in the recipe."""
        return places(self)

    def _missing(self) -> list[Fault]:
        """Return what a recipe cannot do without."""
        bare = bool(self.border) and not self.place and self.tile is None
        found = []
        if not self.motif and not bare:
            found.append(Fault("expected at least one", "motif"))
        if not self.place and not bare:
            words = "missing, expected a list of tables: write [[place]] (what lies on the cloth)"
            found.append(Fault(words, "place"))
        if self.tile is None and not bare:
            found.append(Fault("missing, expected a table (the repeat)", "tile"))
        if self.border and self.yardage is None:
            words = "missing, expected a table: the size of the cloth that borders go round"
            found.append(Fault(words, "yardage"))
        if bare and self.yardage is not None and self.yardage.length is None:
            found.append(
                Fault("missing: a cloth of borders alone has no repeat to be as long as", "yardage.length")
            )
        return found

    def _bad_names(self) -> list[Fault]:
        """Return the names that a file could not show."""
        return [
            Fault("expected a name of 1 to 80 printable characters", dotted((what, name)))
            for what, names in (("motif", self.motif), ("ink", self.ink))
            for name in names
            if not (0 < len(name) <= 80 and name.isprintable())
        ]

    def _bad_symmetries(self) -> list[Fault]:
        """Return the placements whose symmetry the repeat does not admit."""
        found = []
        for number, placement in enumerate(self.place if self.tile else ()):
            try:
                self.tiling.orbit(placement.symmetry, placement.phase, placement.spread)
            except GeometryError as error:
                key = "symmetry" if placement.symmetry else "region"
                found.append(Fault(str(error), f"place[{number}].{key}"))
        return found

    def _without_ink(self) -> list[Fault]:
        """Return the placements and rails that leave open which of several inks draws them."""
        if len(self.ink) == 1:
            return []
        several = "several inks" if self.ink else "no inks"
        words = f"missing: the recipe has {several}, expected one of {', '.join(self.ink)}"
        open_places = [path for path, placement in self.placements() if self._needs_ink(placement)]
        rails: list[Path] = [
            ("border", number, "rails", index)
            for number, border in enumerate(self.border)
            for index, rail in enumerate(border.rails)
            if not rail.ink
        ]
        return [Fault(words, dotted((*path, "ink"))) for path in open_places + rails]

    def _needs_ink(self, placement: Placement) -> bool:
        if isinstance(placement.layout, FreeGround):
            return not placement.ink and not (placement.fill_with and placement.fill_with.ink)
        return not placement.ink and any(
            not part.ink and not (part.treatment == Treatment.CUT and _is_bare(part.fill_with))
            for name in placement.motifs
            if name in self.motif
            for part in self.motif[name].parts()
        )


def _is_bare(fill: Fill | None) -> bool:
    """Whether a fill takes no ink from elsewhere."""
    return fill is None or bool(fill.ink)


__all__ = [
    "BathSpec",
    "ClothSpec",
    "Cut",
    "InkSpec",
    "OutputSpec",
    "Placement",
    "Recipe",
    "TileSpec",
    "YardageSpec",
]
