"""Motifs: curves put together, each element with its own name, ink and treatment.

A motif is measured in its own units (the paper's: a petal is 1 long); only gaps and line widths are
millimetres on cloth. :data:`MOTIFS` is the catalogue; a kind says which :class:`Element` s it is made
of, bottom first, and all that follows (sampling, filling, laying out) is the same for every kind.
"""

from __future__ import annotations

import functools
from dataclasses import field
from typing import Annotated, TypeAlias

from batik_vector.errors import GeometryError, unknown_name
from batik_vector.fields import Between, Catalogue, Says, Useful, check
from batik_vector.geometry.curves import (
    Circle,
    Hypocycloid,
    PathCurve,
    Petal,
    Rose,
    Superellipse,
    YAxis,
)
from batik_vector.geometry.curves.path import PATH_DATA, Coordinate, path_middle
from batik_vector.recipe.drawing import Svg
from batik_vector.recipe.element import Element as Element
from batik_vector.recipe.element import Ring as Ring
from batik_vector.recipe.element import dressed
from batik_vector.recipe.look import Dress as Dress
from batik_vector.recipe.look import Treatment as Treatment
from batik_vector.recipe.lsystem import Grown
from batik_vector.recipe.motifs.composing import Composed
from batik_vector.values import frozen


@frozen(kw_only=True)
class Leaf(Dress):
    """The leaves of a flower: superellipses through the centre. Tian et al. 2019, Eq. 6."""

    a: Annotated[
        float,
        Between(0.02, 50),
        Useful(0.1, 1.2),
        Says("how full the leaf is towards its tips", "a", "fullness"),
    ] = 0.2
    b: Annotated[
        float, Between(0.02, 50), Useful(0.6, 20), Says("how pointed the tips are", "b", "points")
    ] = 10.0
    length: Annotated[float, Between(1e-3, 1e3), Says("distance of a tip from the centre", "r1 = 2l")] = 1.2
    width: Annotated[float, Between(1e-3, 1e3), Says("half the breadth of a leaf", "r2 = l/2")] = 0.3
    count: Annotated[int, Between(0, 360), Useful(4, 24), Says("leaf tips; 0 leaves them out")] = 8
    turn: Annotated[float, Between(-360, 360), Says("degrees; 0 sets the leaves between the petals")] = 0.0

    def element(self) -> Element:
        """Two opposite leaves are one superellipse; with an odd count each is one of half the size."""
        first = self.turn + 180 / self.count
        if self.count % 2 == 0:
            curve = Superellipse(self.a, self.b, self.length, self.width)
            copies = self.count // 2
            # Each is its own image under a half turn.
            return dressed(self, "leaf", curve, copies, turn=first, arc=180.0)
        curve = Superellipse(self.a, self.b, self.length / 2, self.width)
        return dressed(self, "leaf", curve, self.count, turn=first, radius=self.length / 2)


@frozen(kw_only=True)
class Petals(Dress):
    """The petals of a flower: those of a rose, set round the centre. Tian et al. 2019, Eq. 9 and 10."""

    length: Annotated[float, Between(1e-3, 1e3), Says("length of a petal", "a1")] = 1.0
    n: Annotated[
        int,
        Between(1, 64),
        Useful(2, 6),
        Says("the rose whose petal it is; the larger, the slimmer", "n", "slimness"),
    ] = 2
    count: Annotated[int, Between(0, 360), Useful(3, 24), Says("petals; 0 leaves them out")] = 8
    turn: Annotated[float, Between(-360, 360), Says("degrees; 0 points a petal along +x")] = 0.0

    def element(self) -> Element:
        """Every petal is a ring of its own from the centre and back."""
        return dressed(self, "petal", Petal(self.n, self.length), self.count, turn=self.turn)


@frozen(kw_only=True)
class Pistil(Dress):
    """The pistils of a flower: the cusps of a hypocycloid. Tian et al. 2019, Eq. 13 and 14."""

    length: Annotated[float, Between(1e-3, 1e3), Says("distance of the cusps from the centre", "r1")] = 0.8
    count: Annotated[int, Between(0, 96), Useful(5, 24), Says("cusps; 0 leaves them out", "m")] = 16
    cusp: Annotated[int, Between(1, 48), Says("how far apart joined cusps stand", "n")] = 5
    turn: Annotated[float, Between(-360, 360), Says("degrees; 0 points a cusp along +x")] = 0.0

    def __post_init__(self) -> None:
        check(self)
        if self.count:
            self._star()

    def _star(self) -> Hypocycloid:
        try:
            return Hypocycloid(self.count, self.cusp, self.length)
        except GeometryError as error:
            raise GeometryError(f"count = {self.count} with cusp = {self.cusp}: {error}") from None

    def element(self) -> Element:
        """One star."""
        return dressed(self, "pistil", self._star(), 1, turn=self.turn)


@frozen(kw_only=True)
class Core(Dress):
    """The core of a flower: a small rose, and a circle in its middle. Tian et al. 2019, Eq. 20."""

    length: Annotated[float, Between(1e-3, 1e3), Says("length of the core's petals", "a2")] = 0.5
    count: Annotated[int, Between(0, 128), Useful(4, 16), Says("petals of the core; 0 leaves them out")] = 8
    radius: Annotated[float, Between(0, 1e3), Says("radius of the circle; 0 leaves it out", "a3")] = 0.1
    turn: Annotated[float, Between(-360, 360), Says("degrees; 0 points a petal along +x")] = 0.0

    def element(self) -> Element:
        """A rose has 2n petals for even n and n for odd; other counts are single petals."""
        if self.count % 4 == 0:
            return dressed(self, "core", Rose(self.count // 2, 1, self.length), 1, turn=self.turn)
        if self.count % 2 == 1:
            return dressed(self, "core", Rose(self.count, 1, self.length), 1, turn=self.turn)
        return dressed(self, "core", Petal(self.count // 2, self.length), self.count, turn=self.turn)


FLOWER_ORDER = ("leaf", "petal", "pistil", "core", "disc")


@frozen(kw_only=True)
class Flower:
    """The paper's flower: leaves, petals, pistils and a core. Tian et al. 2019, §4; defaults of §5.1."""

    leaf: Leaf = field(default_factory=Leaf)
    petal: Petals = field(default_factory=Petals)
    pistil: Pistil = field(default_factory=Pistil)
    core: Core = field(default_factory=Core)
    disc: Annotated[Dress, Says("look of the circle in the core")] = field(default_factory=Dress)
    order: Annotated[tuple[str, ...], Says("its elements, bottom first")] = FLOWER_ORDER

    def __post_init__(self) -> None:
        check(self)
        for name in self.order:
            if name not in FLOWER_ORDER:
                raise GeometryError(unknown_name(name, FLOWER_ORDER, "element of a flower"))
        if len(set(self.order)) < len(self.order):
            raise GeometryError("an element stands twice in the order")
        if not self.parts():
            raise GeometryError("the flower has no elements: its order is empty, or every count is 0")

    def parts(self) -> tuple[Element, ...]:
        """Return the elements that are drawn, bottom first."""
        return self._parts

    def keys(self) -> tuple[str, ...]:
        """Return the keys of its elements' tables, as ``parts`` has them."""
        return tuple(part.name for part in self._parts)

    @functools.cached_property
    def _parts(self) -> tuple[Element, ...]:
        parts: dict[str, Leaf | Petals | Pistil | Core] = {
            "leaf": self.leaf,
            "petal": self.petal,
            "pistil": self.pistil,
            "core": self.core,
        }
        drawn = {name: part.element() for name, part in parts.items() if part.count}
        if self.core.radius:
            drawn["disc"] = dressed(self.disc, "disc", Circle(self.core.radius), 1)
        return tuple(drawn[name] for name in self.order if name in drawn)


@frozen(kw_only=True)
class Rosette:
    """Any curves, each repeated round the centre, bottom first."""

    elements: Annotated[tuple[Element, ...], Says("the elements, bottom first")]

    def __post_init__(self) -> None:
        check(self)
        if not self.elements:
            raise GeometryError("the rosette has no elements")

    def parts(self) -> tuple[Element, ...]:
        """Return the elements, bottom first."""
        return self.elements

    def keys(self) -> tuple[str, ...]:
        """Return the keys of their tables."""
        return tuple(f"elements[{number}]" for number in range(len(self.elements)))


Place: TypeAlias = tuple[Coordinate, Coordinate]


@frozen(kw_only=True)
class PathMotif(Dress):
    """A drawing of one's own, written as SVG path data: a single element of a ``path`` curve."""

    d: Annotated[str, Says(PATH_DATA, called="path")]
    y: Annotated[YAxis, Says("where their y points")] = YAxis.DOWN
    centre: Annotated[
        Place | None,
        Says("the point of theirs that becomes the motif's centre; left out, the middle of the drawing"),
    ] = None

    def __post_init__(self) -> None:
        check(self)
        self.parts()

    def parts(self) -> tuple[Element, ...]:
        """Return the one element."""
        return self._parts

    @functools.cached_property
    def _parts(self) -> tuple[Element, ...]:
        centre = self.centre or path_middle(self.d)
        return (dressed(self, "", PathCurve(self.d, self.y, centre), 1),)

    def keys(self) -> tuple[str, ...]:
        """Return the keys of its elements' tables: there is but its own."""
        return ("",)


MOTIFS: Catalogue[type] = Catalogue(
    "motifs",
    {
        "flower": Flower,
        "rosette": Rosette,
        "path": PathMotif,
        "svg": Svg,
        "lsystem": Grown,
        "butterfly": "batik_vector.recipe.motifs.butterfly:ButterflyMotif",
        "polar-butterfly": "batik_vector.recipe.motifs.butterfly:PolarButterfly",
        "fish": "batik_vector.recipe.motifs.fish:Fish",
        "bird": "batik_vector.recipe.motifs.bird:Bird",
        "chrysanthemum": "batik_vector.recipe.motifs.blossoms:Chrysanthemum",
        "sunflower": "batik_vector.recipe.motifs.blossoms:Sunflower",
        "lotus": "batik_vector.recipe.motifs.upright:Lotus",
        "peach": "batik_vector.recipe.motifs.upright:Peach",
        "cockscomb": "batik_vector.recipe.motifs.upright:Cockscomb",
        "leaf": "batik_vector.recipe.motifs.leaf:LeafMotif",
        "vine": "batik_vector.recipe.motifs.vine:Vine",
        "parang": "batik_vector.recipe.motifs.parang:Parang",
        "lereng": "batik_vector.recipe.motifs.lereng:Lereng",
        "miao-band": "batik_vector.recipe.motifs.lereng:MiaoBand",
        "tumpal": "batik_vector.recipe.motifs.tumpal:Tumpal",
        "pucuk-rebung": "batik_vector.recipe.motifs.tumpal:PucukRebung",
        "kawung": "batik_vector.recipe.motifs.squares:Kawung",
        "truntum": "batik_vector.recipe.motifs.squares:Truntum",
        "ceplok": "batik_vector.recipe.motifs.squares:Ceplok",
        "jlamprang": "batik_vector.recipe.motifs.squares:Jlamprang",
        "nitik": "batik_vector.recipe.motifs.nitik:Nitik",
        "mega-mendung": "batik_vector.recipe.motifs.cloud:MegaMendung",
        "buketan": "batik_vector.recipe.motifs.bouquet:Buketan",
    },
    lambda: Composed,
)
"""The catalogue of kinds: each has ``parts()``, and ``keys()`` that say where these stand in its table."""

Motif: TypeAlias = Flower | Rosette | PathMotif | Svg | Grown | Composed


def most_contours(motif: Motif) -> tuple[str, int]:
    """Return the key in a motif's table that asks for the most contours, and how many."""
    asked = [
        (f"{key}.contours" if key else "contours", part.contours)
        for key, part in zip(motif.keys(), motif.parts(), strict=True)
    ]
    return max(asked, key=lambda each: each[1])
