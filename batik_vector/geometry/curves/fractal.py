"""Regions by rules: fractals under iterated similarities, and figures of a shape grammar."""

from __future__ import annotations

import enum
import functools
from typing import Annotated

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Says, check
from batik_vector.geometry.curves.base import Outlined
from batik_vector.geometry.generators.grammar import RULES, generations, rules_of
from batik_vector.geometry.generators.systems import SYSTEMS, region_of
from batik_vector.geometry.paths.geometries import outline_of
from batik_vector.geometry.paths.outline import Outline, joined, polyline
from batik_vector.geometry.sampling import Geometries
from batik_vector.values import frozen

WORDS = f'what is made of it in turn, such as "inscribe 0.3": {", ".join(RULES)}'


class FractalName(enum.StrEnum):
    """The regions that are known by name."""

    SIERPINSKI_TRIANGLE = "sierpinski-triangle"
    """Three halves of a triangle, in its corners."""
    SIERPINSKI_CARPET = "sierpinski-carpet"
    """Eight thirds of a square, round its middle."""
    VICSEK = "vicsek"
    """Five thirds of a square, as a cross."""
    HEXAFLAKE = "hexaflake"
    """Seven thirds of a hexagon."""
    KOCH = "koch"
    """A triangle, and on the middle third of every side a smaller one."""


@frozen(kw_only=True)
class Fractal(Outlined):
    """A region under similarities, S ← ⋃ F_i(S), `level` times over, about 1 broad.

    Sierpinski's triangle consists of 3ᵏ triangles, his carpet of 8ᵏ squares; "koch" adds a triangle on every
    side instead, S ← T ∪ ⋃ F_i(S). Hutchinson, "Fractals and self similarity" (1981).
    """

    system: Annotated[FractalName, Says("which it is")] = FractalName.SIERPINSKI_TRIANGLE
    level: Annotated[int, Between(0, 9), Says("how often the similarities are applied")] = 4

    def __post_init__(self) -> None:
        check(self)
        most = SYSTEMS[self.system].most
        if self.level > most:
            raise GeometryError(f"level = {self.level}, expected 0 to {most} of {self.system}")

    def region(self, tolerance: float) -> Geometries:
        """Return the region, which is exact."""
        return self._region

    @functools.cached_property
    def _region(self) -> Geometries:
        return region_of(self.system, self.level)

    def outline(self) -> Outline:
        """Return the rings round it."""
        return self._outline

    @functools.cached_property
    def _outline(self) -> Outline:
        return outline_of(self._region)


@frozen(kw_only=True)
class ShapeGrammar(Outlined):
    """A figure that rules make of a regular polygon: each takes the shapes of the last, and makes others.

    Rules, each with a number: inscribe 0.5, shrink 0.5, turn 45, corners 0.5, sides 1, spikes 0.5, hold. All
    generations are drawn; with fill "evenodd" they are bare and waxed in turn. Stiny & Gips, "Shape grammars"
    (1972); Zhang et al., the paper's reference 29.
    """

    sides: Annotated[int, Between(3, 24), Says("sides of the first shape")] = 4
    radius: Annotated[float, Between(1e-3, 1e3), Says("distance of its corners from the centre")] = 1.0
    rules: Annotated[tuple[str, ...], Says(WORDS)] = ("inscribe", "inscribe", "corners 0.3")
    first: Annotated[int, Between(0, 30), Says("generation from which on shapes are drawn")] = 0

    def __post_init__(self) -> None:
        check(self)
        if len(self.rules) > 30:
            raise GeometryError(f"rules = a list of {len(self.rules)}, expected 30 at most")
        if self.first > len(self.rules):
            raise GeometryError(f"first = {self.first}, expected 0 to {len(self.rules)}, the last generation")
        self.outline()

    def outline(self) -> Outline:
        """Return all shapes as rings."""
        return self._outline

    @functools.cached_property
    def _outline(self) -> Outline:
        shapes = generations(self.sides, self.radius, rules_of(self.rules))[self.first :]
        found = [
            polyline(np.column_stack([shape.real, shape.imag]), True) for made in shapes for shape in made
        ]
        return joined(found)
