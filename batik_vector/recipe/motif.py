"""Motifs: curves put together, each element with its own name, ink and treatment.

A motif is measured in its own units (the paper's: a petal is 1 long); only gaps and line widths are
millimetres on cloth. :data:`MOTIFS` is the catalogue; a kind says which :class:`Element` s it is made
of, bottom first, and all that follows (sampling, filling, laying out) is the same for every kind.
"""

from __future__ import annotations

import enum
import functools
from collections.abc import Callable
from dataclasses import field, fields
from typing import Annotated, TypeAlias

import numpy as np
import shapely

from batik_vector.errors import GeometryError, TooLargeError, shortened, unknown_name
from batik_vector.fields import Between, Length, OneOf, Says, check
from batik_vector.geometry import work
from batik_vector.geometry.curves import CURVES, Circle, Curve, Hypocycloid, Petal, Rose, Superellipse, trace
from batik_vector.geometry.ifs import distinct
from batik_vector.geometry.maps.affine import IDENTITY, Affine
from batik_vector.geometry.maps.affines import Affines, turns
from batik_vector.geometry.regions import FillRule, oriented, settle
from batik_vector.geometry.sampling import Array, Geometries, Points
from batik_vector.values import frozen


class Treatment(enum.StrEnum):
    """How an element is drawn."""

    AREA = "area"
    """Filled: solid resist."""
    LINE = "line"
    """A centre line, for pens and plotters. How broad it shows is left to the pen, so a line that runs within
    half its breadth of the tile's edge shows no other half on the opposite one: print with ``stroke``."""
    STROKE = "stroke"
    """A line with a body: the area a canting of the ink's width leaves."""
    BOTH = "both"
    """Filled, and its centre line drawn as well (in ``line_ink`` where one is named)."""
    CUT = "cut"
    """Not drawn: bare ground that cuts what lies beneath."""


AnyCurve: TypeAlias = Annotated[Curve, OneOf(lambda: CURVES, "curve")]


@frozen(kw_only=True)
class Dress:
    """What every element says of its look."""

    ink: Annotated[str, Says("ink it is drawn with; the placement's when left out")] = ""
    line_ink: Annotated[str, Says('ink of the line of treatment "both"')] = ""
    treatment: Annotated[
        Treatment, Says("filled, drawn as a line, as a line with a body, both, or cut out")
    ] = Treatment.AREA
    fill: Annotated[FillRule, Says("which faces of a self-crossing figure are inside")] = FillRule.NONZERO
    gap: Annotated[
        Annotated[Length, Between(0, 1000)] | None,
        Says("ground kept bare round it by cutting what lies beneath"),
    ] = None
    whole: Annotated[bool, Says("left out, not cut, where something above would cut it")] = False
    contours: Annotated[int, Between(1, 64), Says("nested contours, evenly spaced to the centre", "l")] = 1

    def __post_init__(self) -> None:
        check(self)


@frozen(kw_only=True)
class Element(Dress):
    """A curve and its copies turned about the motif's centre.

    A copy is first turned by ``spin`` about its own centre, then set ``radius`` out along +x, then turned
    by ``turn`` and on by arc/count from copy to copy.
    """

    curve: Annotated[AnyCurve, Says("the curve drawn")]
    name: Annotated[str, Says("what the element is called in the file")] = ""
    count: Annotated[int, Between(1, 1000), Says("copies round the centre")] = 1
    radius: Annotated[float, Between(-1e3, 1e3), Says("distance of the copies from the centre")] = 0.0
    turn: Annotated[float, Between(-360, 360), Says("degrees to which the first copy is turned")] = 0.0
    arc: Annotated[float, Between(-360, 360), Says("degrees over which the copies are spread")] = 360.0
    spin: Annotated[float, Between(-360, 360), Says("degrees each copy is turned about itself")] = 0.0
    mirror: Annotated[bool, Says("also draw each copy's mirror image")] = False

    @property
    def ring(self) -> Ring:
        """What says where the curve is drawn."""
        return self.count, self.radius, self.turn, self.arc, self.spin, self.mirror


@frozen(kw_only=True)
class Leaf(Dress):
    """The leaves of a flower: superellipses through the centre. Tian et al. 2019, Eq. 6."""

    a: Annotated[float, Between(0.02, 50), Says("how full the leaf is towards its tips", "a")] = 0.2
    b: Annotated[float, Between(0.02, 50), Says("how pointed the tips are", "b")] = 10.0
    length: Annotated[float, Between(1e-3, 1e3), Says("distance of a tip from the centre", "r1 = 2l")] = 1.2
    width: Annotated[float, Between(1e-3, 1e3), Says("half the breadth of a leaf", "r2 = l/2")] = 0.3
    count: Annotated[int, Between(0, 360), Says("leaf tips; 0 leaves them out")] = 8
    turn: Annotated[float, Between(-360, 360), Says("degrees; 0 sets the leaves between the petals")] = 0.0

    def element(self) -> Element:
        """Two opposite leaves are one superellipse; with an odd count each is one of half the size."""
        first = self.turn + 180 / self.count
        if self.count % 2 == 0:
            curve = Superellipse(self.a, self.b, self.length, self.width)
            copies = self.count // 2
            # Each is its own image under a half turn.
            return _dressed(self, "leaf", curve, copies, turn=first, arc=180.0)
        curve = Superellipse(self.a, self.b, self.length / 2, self.width)
        return _dressed(self, "leaf", curve, self.count, turn=first, radius=self.length / 2)


@frozen(kw_only=True)
class Petals(Dress):
    """The petals of a flower: those of a rose, set round the centre. Tian et al. 2019, Eq. 9 and 10."""

    length: Annotated[float, Between(1e-3, 1e3), Says("length of a petal", "a1")] = 1.0
    n: Annotated[int, Between(1, 64), Says("the rose whose petal it is; the larger, the slimmer", "n")] = 2
    count: Annotated[int, Between(0, 360), Says("petals; 0 leaves them out")] = 8
    turn: Annotated[float, Between(-360, 360), Says("degrees; 0 points a petal along +x")] = 0.0

    def element(self) -> Element:
        """Every petal is a ring of its own from the centre and back."""
        return _dressed(self, "petal", Petal(self.n, self.length), self.count, turn=self.turn)


@frozen(kw_only=True)
class Pistil(Dress):
    """The pistils of a flower: the cusps of a hypocycloid. Tian et al. 2019, Eq. 13 and 14."""

    length: Annotated[float, Between(1e-3, 1e3), Says("distance of the cusps from the centre", "r1")] = 0.8
    count: Annotated[int, Between(0, 96), Says("cusps; 0 leaves them out", "m")] = 16
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
        return _dressed(self, "pistil", self._star(), 1, turn=self.turn)


@frozen(kw_only=True)
class Core(Dress):
    """The core of a flower: a small rose, and a circle in its middle. Tian et al. 2019, Eq. 20."""

    length: Annotated[float, Between(1e-3, 1e3), Says("length of the core's petals", "a2")] = 0.5
    count: Annotated[int, Between(0, 128), Says("petals of the core; 0 leaves them out")] = 8
    radius: Annotated[float, Between(0, 1e3), Says("radius of the circle; 0 leaves it out", "a3")] = 0.1
    turn: Annotated[float, Between(-360, 360), Says("degrees; 0 points a petal along +x")] = 0.0

    def element(self) -> Element:
        """A rose has 2n petals for even n and n for odd; other counts are single petals."""
        if self.count % 4 == 0:
            return _dressed(self, "core", Rose(self.count // 2, 1, self.length), 1, turn=self.turn)
        if self.count % 2 == 1:
            return _dressed(self, "core", Rose(self.count, 1, self.length), 1, turn=self.turn)
        return _dressed(self, "core", Petal(self.count // 2, self.length), self.count, turn=self.turn)


def _dressed(
    part: Dress,
    name: str,
    curve: Curve,
    count: int,
    *,
    turn: float = 0.0,
    radius: float = 0.0,
    arc: float = 360.0,
) -> Element:
    look = {f.name: getattr(part, f.name) for f in fields(Dress)}
    return Element(curve=curve, name=name, count=count, turn=turn, radius=radius, arc=arc, **look)


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
            drawn["disc"] = _dressed(self.disc, "disc", Circle(self.core.radius), 1)
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


MOTIFS: dict[str, type] = {"flower": Flower, "rosette": Rosette}
"""The catalogue of kinds: each has ``parts()``."""

Motif: TypeAlias = Flower | Rosette


def most_contours(motif: Motif) -> tuple[str, int]:
    """Return the key in a motif's table that asks for the most contours, and how many."""
    if isinstance(motif, Flower):
        asked = {f"{part.name}.contours": part.contours for part in motif.parts()}
    else:
        asked = {f"elements[{number}].contours": part.contours for number, part in enumerate(motif.parts())}
    return max(asked.items(), key=lambda each: each[1])


@frozen
class Figure:
    """An element as geometry, in motif units: ``areas`` filled, ``lines`` its centre lines."""

    element: Element
    areas: Geometries
    lines: Geometries


def draw(motif: Motif, tolerance: float | Callable[[Points], Array]) -> list[Figure]:
    """Sample and settle every element of a motif.

    Args:
        motif: in its own units.
        tolerance: in motif units; or a function of places in the motif, shape (n, 2) → (n,).

    Returns:
        One figure per element, bottom first. Line and region of an element share their vertices.

    Raises:
        TooLargeError: where a curve crosses itself too often to be filled.
    """
    return [_named(element, tolerance) for element in motif.parts()]


def _named(element: Element, tolerance: float | Callable[[Points], Array]) -> Figure:
    try:
        return _draw(element, tolerance)
    except TooLargeError as error:
        known = f'element "{shortened(element.name)}"' if element.name else "an element without a name"
        contours = f", contours = {element.contours}" if element.contours > 1 else ""
        raise TooLargeError(f"{known} ({type(element.curve).__name__.lower()}{contours}): {error}") from None


def _draw(element: Element, tolerance: float | Callable[[Points], Array]) -> Figure:
    if not callable(tolerance):
        look = element.curve, element.fill, element.contours, tolerance
        return Figure(element, *_copied(look, element.ring))
    copies = copies_of(*element.ring)

    def everywhere(points: Points) -> Array:
        return np.asarray(np.min([tolerance(images) for images in copies.at(points)], axis=0))

    areas, lines = _outlined(element.curve, element.fill, element.contours, everywhere)
    reach = float(np.min(everywhere(shapely.get_coordinates(lines))))
    return Figure(element, *_turned(areas, lines, copies, reach))


Look: TypeAlias = tuple[Curve, FillRule, int, float]
"""What a curve's geometry hangs on: the curve, its fill rule, its contours, the tolerance."""


Ring: TypeAlias = tuple[int, float, float, float, float, bool]
"""The arguments of :func:`copies_of`."""


def copies_of(count: int, radius: float, turn: float, arc: float, spin: float, mirror: bool) -> Affines:
    """Return where the copies of an element are drawn: see :class:`Element`."""
    shift = Affine.translation((radius, 0)) @ Affine.turn(spin)
    turned = turns([turn + arc * k / count for k in range(count)])
    return (turned.after(Affines.of([IDENTITY, Affine.mirror(0)])) if mirror else turned) @ shift


@functools.lru_cache(maxsize=128)
def _copied(look: Look, ring: Ring) -> tuple[Geometries, Geometries]:
    """Return areas and lines of a curve and its copies. Kept: who turns one knob draws the rest again."""
    areas, lines = _turned(*_alone(look), copies_of(*ring), look[-1])
    for marks in (areas, lines):
        marks.flags.writeable = False
    return areas, lines


@functools.lru_cache(maxsize=128)
def _alone(look: Look) -> tuple[Geometries, Geometries]:
    return _outlined(*look)


def _outlined(
    curve: Curve, fill: FillRule, contours: int, tolerance: float | Callable[[Points], Array]
) -> tuple[Geometries, Geometries]:
    """Return the region and the centre lines of a curve."""
    traced = trace(curve, tolerance)
    scales = [k / contours for k in range(contours, 0, -1)]
    lines = np.array(
        [shapely.linestrings(strand * k) for strand in traced.strands for k in scales], dtype=object
    )
    areas = np.empty(0, dtype=object)
    if traced.rings:
        region = settle(traced.rings, fill)
        areas = _bands([Affine.scale(k).apply(region) for k in scales])
    return areas, lines


def _turned(
    areas: Geometries, lines: Geometries, copies: Affines, reach: float
) -> tuple[Geometries, Geometries]:
    """Return the copies of an element that differ."""
    kept = distinct(copies, [np.concatenate([areas, lines])], reach)
    return kept.apply(areas), kept.apply(lines)


def _bands(nested: list[Geometries]) -> Geometries:
    """Return every other band between nested contours, the outermost filled."""
    if len(nested) == 1:
        return nested[0]
    # Two by two, and these two by two again: one after another, each would be overlaid with all before it.
    total = np.array([shapely.union_all(part) for part in nested], dtype=object)
    while len(total) > 1:
        pairs = len(total) // 2
        work.spend(float(shapely.get_num_coordinates(total).sum()))
        joined = shapely.symmetric_difference(total[: 2 * pairs : 2], total[1 : 2 * pairs : 2])
        total = np.concatenate([joined, total[2 * pairs :]])
    # Where bands meet in a point a hair of line may be left.
    parts = shapely.get_parts(total)
    return oriented(parts[shapely.get_type_id(parts) == shapely.GeometryType.POLYGON])
