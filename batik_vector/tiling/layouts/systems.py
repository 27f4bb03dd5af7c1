"""Layouts that carry a motif through maps: the paper's JuliaN layouts, and iterated systems of one's own."""

from __future__ import annotations

from dataclasses import field
from functools import cached_property
from typing import Annotated, TypeAlias

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, OneOf, Says, Useful, check
from batik_vector.geometry.ifs import Ifs
from batik_vector.geometry.maps import VARIATIONS
from batik_vector.geometry.maps.affine import IDENTITY, Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.geometry.maps.base import Variation
from batik_vector.geometry.maps.flame import FlameMap
from batik_vector.geometry.maps.julian import JuliaN, Reading
from batik_vector.geometry.maps.linear import Linear
from batik_vector.tiling.layouts.base import Bend, Layout, Pair, carried
from batik_vector.tiling.layouts.copies import Spot
from batik_vector.values import frozen


@frozen(kw_only=True)
class Julian(Layout):
    """The paper's layout: the motif is moved, spread by JuliaN, and both again ``level`` times.

    Power 2 is symmetric, 3 the three-circle, 4 the four-square, 5 the five-circle layout.
    Tian et al. 2019, Eq. 22 and 23.
    """

    power: Annotated[int, Between(-64, 64), Useful(2, 6), Says("number of flowers", "P1")] = 4
    dist: Annotated[
        float,
        Between(-64, 64),
        Useful(0.2, 6),
        Says("how they bend; equal to power they keep their shape", "P2", "bending"),
    ] = 4.0
    level: Annotated[int, Between(0, 100_000), Says("how often the spreading is repeated")] = 1
    shift: Annotated[Pair, Says("move before each spreading", "dx, dy")] = (4 / 3, 4 / 3)
    turn: Annotated[float, Between(-360, 360), Says("degrees the motif is turned first")] = 0.0
    reading: Annotated[Reading, Says("which reading of Eq. 22")] = "rotate"

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """``level`` times moved and spread."""
        return self._images

    @cached_property
    def _images(self) -> Affines | Bend:
        spread = FlameMap(
            pre=Affine.translation(self.shift), terms=((1.0, JuliaN(self.power, self.dist, self.reading)),)
        )
        return carried(Affine.turn(self.turn), Ifs((spread,), self.level))


AnyVariation: TypeAlias = Annotated[Variation, OneOf(lambda: VARIATIONS, "variation")]


@frozen(kw_only=True)
class Term:
    """One weighted variation of a map."""

    variation: Annotated[AnyVariation, Says("the variation V_j")]
    weight: Annotated[float, Between(-100, 100), Says("its weight", "v_ij")] = 1.0

    def __post_init__(self) -> None:
        check(self)


@frozen(kw_only=True)
class MapSpec:
    """One map of an iterated system: affine, then a weighted sum of variations, then affine."""

    pre: Annotated[Spot, Says("affine map before the variations")] = field(default_factory=Spot)
    terms: Annotated[tuple[Term, ...], Says("the weighted variations; none is the identity")] = ()
    post: Annotated[Spot, Says("affine map after the variations")] = field(default_factory=Spot)

    def __post_init__(self) -> None:
        check(self)

    def flame(self) -> FlameMap:
        """Return the map itself."""
        terms = tuple((term.weight, term.variation) for term in self.terms) or ((1.0, Linear()),)
        return FlameMap(pre=self.pre.affine(), terms=terms, post=self.post.affine())


@frozen(kw_only=True)
class System(Layout):
    """An iterated function system in the flame form. Tian et al. 2019, Eq. 7; Draves & Reckase 2003."""

    maps: Annotated[tuple[MapSpec, ...], Says("the maps F_i")]
    level: Annotated[int, Between(0, 100_000), Says("how often they are applied")] = 1

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """The union of all images under all maps, ``level`` times."""
        return self._images

    @cached_property
    def _images(self) -> Affines | Bend:
        if not self.maps:
            raise GeometryError("an ifs layout needs at least one map")
        return carried(IDENTITY, Ifs(tuple(spec.flame() for spec in self.maps), self.level))
