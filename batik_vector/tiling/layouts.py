"""Layouts: how copies of one motif are set out. The catalogue is ``LAYOUTS``.

A layout is measured in motif units and returns either the affine images of the motif, or an iterated
system of maps where it bends the motif.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, ClassVar, TypeAlias

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, OneOf, Says, check
from batik_vector.geometry.ifs import Ifs
from batik_vector.geometry.maps import VARIATIONS
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.maps.base import Variation
from batik_vector.geometry.maps.flame import FlameMap
from batik_vector.geometry.maps.julian import JuliaN, Reading
from batik_vector.geometry.maps.linear import Linear

Pair: TypeAlias = tuple[Annotated[float, Between(-1e4, 1e4)], Annotated[float, Between(-1e4, 1e4)]]
"""A vector in motif units."""


@dataclass(frozen=True)
class Bend:
    """Images that are no affine copies: the motif is moved by ``first`` and carried through ``system``."""

    first: Affine
    system: Ifs


def _carried(first: Affine, system: Ifs) -> list[Affine] | Bend:
    affine = system.affine_images()
    return Bend(first, system) if affine is None else [image @ first for image in affine]


class Layout:
    """What every layout offers. ``spreads`` says whether a placement's width measures all copies together."""

    spreads: ClassVar[bool] = True

    def __post_init__(self) -> None:
        check(self)

    def images(self, cell: tuple[float, float]) -> list[Affine] | Bend:
        """Return the images of the motif; ``cell`` is the repeat's width and height in motif units."""
        raise NotImplementedError


@dataclass(frozen=True, kw_only=True)
class Single(Layout):
    """The motif once."""

    turn: Annotated[float, Between(-360, 360), Says("degrees the motif is turned")] = 0.0

    def images(self, cell: tuple[float, float]) -> list[Affine] | Bend:
        """One image."""
        return [Affine.turn(self.turn)]


@dataclass(frozen=True, kw_only=True)
class Julian(Layout):
    """The paper's layout: the motif is moved, spread by JuliaN, and both again ``level`` times.

    Power 2 is symmetric, 3 the three-circle, 4 the four-square, 5 the five-circle layout.
    Tian et al. 2019, Eq. 22 and 23.
    """

    power: Annotated[int, Between(-64, 64), Says("number of flowers", "P1")] = 4
    dist: Annotated[
        float, Between(-64, 64), Says("how they bend; equal to power they keep their shape", "P2")
    ] = 4.0
    level: Annotated[int, Between(0, 100_000), Says("how often the spreading is repeated")] = 1
    shift: Annotated[Pair, Says("move before each spreading", "dx, dy")] = (4 / 3, 4 / 3)
    turn: Annotated[float, Between(-360, 360), Says("degrees the motif is turned first")] = 0.0
    reading: Annotated[Reading, Says("which reading of Eq. 22")] = "rotate"

    def images(self, cell: tuple[float, float]) -> list[Affine] | Bend:
        """``level`` times moved and spread."""
        spread = FlameMap(
            pre=Affine.translation(self.shift), terms=((1.0, JuliaN(self.power, self.dist, self.reading)),)
        )
        return _carried(Affine.turn(self.turn), Ifs((spread,), self.level))


@dataclass(frozen=True, kw_only=True)
class Ring(Layout):
    """Copies on a circle, each turned with it or all upright."""

    count: Annotated[int, Between(1, 1000), Says("number of copies")] = 6
    radius: Annotated[float, Between(0, 1e4), Says("distance of the copies from the centre")] = 2.0
    upright: Annotated[bool, Says("keep every copy upright instead of turning it with the ring")] = False
    turn: Annotated[float, Between(-360, 360), Says("degrees to which the first copy is turned")] = 0.0

    def images(self, cell: tuple[float, float]) -> list[Affine] | Bend:
        """One image per copy."""
        out = Affine.translation((self.radius, 0))
        angles = [self.turn + 360 * k / self.count for k in range(self.count)]
        if self.upright:
            return [Affine.turn(a) @ out @ Affine.turn(-a) for a in angles]
        return [Affine.turn(a) @ out for a in angles]


@dataclass(frozen=True, kw_only=True)
class Mirror(Layout):
    """The motif and its mirror image."""

    axis: Annotated[float, Between(-360, 360), Says("direction of the mirror in degrees; 90 is upright")] = (
        90.0
    )
    shift: Annotated[Pair, Says("move of the motif away from the mirror")] = (1.0, 0.0)
    turn: Annotated[float, Between(-360, 360), Says("degrees the motif is turned first")] = 0.0

    def images(self, cell: tuple[float, float]) -> list[Affine] | Bend:
        """Two images."""
        first = Affine.translation(self.shift) @ Affine.turn(self.turn)
        return [first, Affine.mirror(self.axis) @ first]


@dataclass(frozen=True, kw_only=True)
class Spot:
    """One hand-made copy: mirrored, scaled, turned and moved in this order; or a matrix."""

    shift: Annotated[Pair, Says("move in motif units")] = (0.0, 0.0)
    turn: Annotated[float, Between(-360, 360), Says("degrees")] = 0.0
    scale: Annotated[float, Between(1e-3, 1e3), Says("size")] = 1.0
    mirror: Annotated[bool, Says("mirrored at the x axis first")] = False
    matrix: Annotated[
        tuple[float, float, float, float, float, float] | None,
        Says("x' = ax + by + e, y' = cx + dy + f as [a, b, c, d, e, f], instead of all the above"),
    ] = None

    def __post_init__(self) -> None:
        check(self)

    def affine(self) -> Affine:
        """Return the map.

        Raises:
            GeometryError: where the matrix flattens the plane.
        """
        if self.matrix is not None:
            a, b, c, d, e, f = self.matrix
            if abs(a * d - b * c) < 1e-9:
                raise GeometryError(f"the matrix {list(self.matrix)} flattens the motif to a line")
            return Affine(a, b, c, d, e, f)
        image = Affine.turn(self.turn) @ Affine.scale(self.scale)
        return Affine.translation(self.shift) @ image @ (Affine.mirror(0) if self.mirror else Affine())


@dataclass(frozen=True, kw_only=True)
class Free(Layout):
    """Copies set by hand. Tian et al. 2019, Eq. 2."""

    spots: Annotated[tuple[Spot, ...], Says("one table for each copy")] = (Spot(),)

    def images(self, cell: tuple[float, float]) -> list[Affine] | Bend:
        """One image per spot."""
        if not self.spots:
            raise GeometryError("a free layout needs at least one spot")
        return [spot.affine() for spot in self.spots]


@dataclass(frozen=True, kw_only=True)
class Lattice(Layout):
    """Copies in even rows over the whole repeat, for grounds of dots and small flowers."""

    spreads: ClassVar[bool] = False
    columns: Annotated[int, Between(1, 2000), Says("copies across the repeat")] = 4
    rows: Annotated[int, Between(1, 2000), Says("copies up the repeat")] = 4
    stagger: Annotated[bool, Says("shift every other row by half a step")] = False
    turn: Annotated[float, Between(-360, 360), Says("degrees each copy is turned")] = 0.0

    def images(self, cell: tuple[float, float]) -> list[Affine] | Bend:
        """One image per place; the first stands half a step in from the corner."""
        if self.stagger and self.rows % 2:
            raise GeometryError(f"rows = {self.rows}: staggered rows repeat only when their number is even")
        dx, dy = cell[0] / self.columns, cell[1] / self.rows
        turned = Affine.turn(self.turn)
        return [
            Affine.translation(
                (
                    (column + 0.5 + (0.5 if self.stagger and row % 2 else 0.0)) * dx - cell[0] / 2,
                    (row + 0.5) * dy - cell[1] / 2,
                )
            )
            @ turned
            for row in range(self.rows)
            for column in range(self.columns)
        ]


AnyVariation: TypeAlias = Annotated[Variation, OneOf(lambda: VARIATIONS, "variation")]


@dataclass(frozen=True, kw_only=True)
class Term:
    """One weighted variation of a map."""

    variation: Annotated[AnyVariation, Says("the variation V_j")]
    weight: Annotated[float, Between(-100, 100), Says("its weight", "v_ij")] = 1.0

    def __post_init__(self) -> None:
        check(self)


@dataclass(frozen=True, kw_only=True)
class MapSpec:
    """One map of an iterated system: affine, then a weighted sum of variations, then affine."""

    pre: Annotated[Spot, Says("affine map before the variations")] = field(default_factory=Spot)
    terms: Annotated[tuple[Term, ...], Says("the weighted variations; none is the identity")] = ()
    post: Annotated[Spot, Says("affine map after the variations")] = field(default_factory=Spot)

    def flame(self) -> FlameMap:
        """Return the map itself."""
        terms = tuple((term.weight, term.variation) for term in self.terms) or ((1.0, Linear()),)
        return FlameMap(pre=self.pre.affine(), terms=terms, post=self.post.affine())


@dataclass(frozen=True, kw_only=True)
class System(Layout):
    """An iterated function system in the flame form. Tian et al. 2019, Eq. 7; Draves & Reckase 2003."""

    maps: Annotated[tuple[MapSpec, ...], Says("the maps F_i")]
    level: Annotated[int, Between(0, 100_000), Says("how often they are applied")] = 1

    def images(self, cell: tuple[float, float]) -> list[Affine] | Bend:
        """The union of all images under all maps, ``level`` times."""
        if not self.maps:
            raise GeometryError("an ifs layout needs at least one map")
        return _carried(Affine(), Ifs(tuple(spec.flame() for spec in self.maps), self.level))


LAYOUTS: dict[str, type[Layout]] = {
    "single": Single,
    "julian": Julian,
    "ring": Ring,
    "mirror": Mirror,
    "free": Free,
    "lattice": Lattice,
    "ifs": System,
}

AnyLayout: TypeAlias = Annotated[Layout, OneOf(lambda: LAYOUTS, "layout")]
