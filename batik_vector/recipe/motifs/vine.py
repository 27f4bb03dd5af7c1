"""The vine: a stem along any curve, with leaves, tendrils and flowers in turn."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import field
from typing import Annotated, TypeAlias

import numpy as np

from batik_vector.errors import GeometryError, unknown_name
from batik_vector.fields import Between, Says, check
from batik_vector.geometry.curves import Blade, Wave, trace
from batik_vector.geometry.paths.bands import band, curl
from batik_vector.geometry.paths.matrix import Matrix, times
from batik_vector.geometry.paths.outline import Outline, joined
from batik_vector.geometry.paths.splines import through
from batik_vector.geometry.sampling import Array, Points
from batik_vector.recipe.element import AnyCurve
from batik_vector.recipe.look import Dress
from batik_vector.recipe.motifs.composing import (
    Composed,
    Isen,
    Keyed,
    Plate,
    dot,
    fan,
    outline_of,
    part,
    rib,
    similar,
    stroke,
)
from batik_vector.values import frozen

GROWTHS = ("leaf", "tendril", "flower", "bud")
Growths: TypeAlias = tuple[str, ...]


@frozen(kw_only=True)
class Stem(Plate):
    """The stem."""

    width: Annotated[float, Between(0.005, 0.3), Says("half its breadth, in steps")] = 0.07
    taper: Annotated[float, Between(0, 0.95), Says("how much slimmer an open one is at its end")] = 0.0


@frozen(kw_only=True)
class VineLeaf(Plate):
    """The leaves of a vine."""

    length: Annotated[float, Between(0.1, 4), Says("length, in steps")] = 1.08
    width: Annotated[float, Between(0.02, 1.2), Says("half the breadth, in steps")] = 0.24
    angle: Annotated[float, Between(0, 120), Says("degrees between a leaf and the stem")] = 44.0
    bend: Annotated[float, Between(-75, 75), Says("degrees by which it bends, away from the stem")] = 22.0


@frozen(kw_only=True)
class Tendril(Dress):
    """The tendrils of a vine: spirals that straighten towards the stem."""

    length: Annotated[float, Between(0.1, 8), Says("length, in steps")] = 2.3
    turn: Annotated[float, Between(30, 560), Says("degrees by which they curl")] = 470.0
    width: Annotated[float, Between(0.003, 0.1), Says("half the breadth at the stem, in steps")] = 0.03
    angle: Annotated[float, Between(0, 90), Says("degrees between a tendril's beginning and the stem")] = 24.0


@frozen(kw_only=True)
class VineFlower(Plate):
    """The flowers of a vine, on stalks."""

    petals: Annotated[int, Between(3, 24), Says("petals of a flower")] = 6
    size: Annotated[float, Between(0.05, 2), Says("radius, in steps")] = 0.48
    stalk: Annotated[float, Between(0, 4), Says("length of the stalk, in steps")] = 0.42


@frozen(kw_only=True)
class Vine(Composed):
    """Vine: a stem along any curve, on which leaves, tendrils, flowers and buds grow in turn.

    The curve is divided into ``count`` steps of one length, and all sizes are told in steps. What grows
    stands left and right in turn; on a closed curve it does so all round, and the stem has no end. Along a
    ``wave`` from 0 to 1 it runs on from copy to copy: in borders, and in the layout ``stripes``.
    """

    curve: Annotated[AnyCurve, Says("the curve that the stem runs along")] = field(default_factory=Wave)
    count: Annotated[int, Between(1, 400), Says("steps: places where something grows")] = 8
    grows: Annotated[tuple[str, ...], Says("what grows, in turn: leaf, tendril, flower, bud")] = (
        "leaf",
        "leaf",
        "tendril",
    )
    alternate: Annotated[bool, Says("whether it grows left and right in turn; else in pairs")] = True
    start: Annotated[float, Between(0, 1), Says("where in the first step it grows")] = 0.5
    stem: Annotated[Stem, Says("the stem")] = field(default_factory=Stem)
    leaf: Annotated[VineLeaf, Says("the leaves")] = field(default_factory=VineLeaf)
    vein: Annotated[Isen, Says("look of the veins of leaves and petals")] = field(default_factory=Isen)
    tendril: Annotated[Tendril, Says("the tendrils")] = field(default_factory=Tendril)
    flower: Annotated[VineFlower, Says("the flowers")] = field(default_factory=VineFlower)
    core: Annotated[Plate, Says("look of the hearts of the flowers")] = field(default_factory=Plate)

    def __post_init__(self) -> None:
        check(self)
        if not self.grows:
            raise GeometryError("grows = [], expected what grows on the stem: " + ", ".join(GROWTHS))
        for number, name in enumerate(self.grows):
            if name not in GROWTHS:
                raise GeometryError(f"grows[{number}]: {unknown_name(name, GROWTHS, 'growth of a vine')}")
        strands = trace(self.curve, 0.02).strands
        if self.curve.closed and self.alternate and self.count % 2:
            raise GeometryError(
                f"count = {self.count}: round a closed curve left and right meet, expected an even number "
                "or alternate = false"
            )
        if len(strands) * self.count > MOST:
            if len(strands) > MOST:
                raise GeometryError(f"curve: {len(strands):,} lines, expected at most {MOST:,} to grow along")
            words = f"count = {self.count} on {len(strands)} lines"
            raise GeometryError(f"{words}, expected at most {MOST // len(strands)}")
        self.parts()

    def compose(self) -> Iterator[Keyed]:
        """Yield what grows, and the stem over its beginnings."""
        found: dict[str, list[Outline]] = {name: [] for name in ORDER}
        ways = [_Way(strand, self.curve.closed) for strand in trace(self.curve, FINE).strands]
        for way in ways:
            step = way.length / self.count
            for number in range(self.count):
                name = self.grows[number % len(self.grows)]
                at = (number + self.start) * step
                for side in ((1.0, -1.0)[number % 2],) if self.alternate else (1.0, -1.0):
                    for key, shapes in self._growth(name, way.place(at, step), side):
                        found[key].extend(shapes)
        looks: dict[str, Dress] = {
            "tendril": self.tendril,
            "stalk": Dress(ink=self.stem.ink),
            "leaf": self.leaf,
            "bud": self.flower,
            "flower": self.flower,
            "vein": self.vein,
            "petal vein": self.vein,
            "core": self.core,
        }
        for name in ORDER:
            key = {"stalk": "stem", "bud": "flower", "petal vein": "vein"}.get(name, name)
            if name == "stem":
                yield part("stem", self.stem, [way.stem(self.stem, way.length / self.count) for way in ways])
            elif found[name]:
                yield part(key, looks[name], found[name], name=name)

    def _growth(self, name: str, at: Matrix, side: float) -> Iterator[tuple[str, list[Outline]]]:
        """Yield what grows at a place, by the names of elements; the map is from steps to the motif."""
        drawn = {"leaf": self._leaf, "tendril": self._tendril, "flower": self._flower, "bud": self._bud}[name]
        flip = times(at, (1.0, 0.0, 0.0, side, 0.0, 0.0))
        for key, shapes in drawn():
            yield key, [each.moved(flip) for each in shapes]

    def _leaf(self) -> Iterator[tuple[str, list[Outline]]]:
        look = self.leaf
        blade = Blade(look.length, look.width, 0.85, 1.1, look.bend)
        place = similar(look.angle)
        yield "leaf", [outline_of(blade).moved(place)]
        yield "vein", [rib(blade, 0.16, 0.84, 0.11 * look.width).moved(place)]

    def _tendril(self) -> Iterator[tuple[str, list[Outline]]]:
        look = self.tendril
        line = stroke(curl(look.length, look.turn, 1.8), look.width, 0.62 * look.width)
        yield "tendril", [line.moved(similar(look.angle, 1.0, (0.0, 0.2 * self.stem.width)))]

    def _stalk(self) -> tuple[Outline, Points]:
        look = self.flower
        way = curl(look.stalk + 0.6 * look.size + self.stem.width, 38.0, 1.0)
        place = similar(46.0)
        end = way[-1] @ np.array([[place[0], place[1]], [place[2], place[3]]])
        return stroke(way, 0.8 * self.stem.width, 0.6 * self.stem.width).moved(place), end

    def _flower(self) -> Iterator[tuple[str, list[Outline]]]:
        look = self.flower
        stalk, end = self._stalk()
        yield "stalk", [stalk]
        angles = 84.0 + 360 * np.arange(look.petals) / look.petals
        width = 0.92 * look.size * 0.64 * float(np.tan(np.pi / max(look.petals, 4)))
        petals, veins = fan(
            np.tile(end, (look.petals, 1)),
            angles,
            np.full(look.petals, 1.0),
            Blade(look.size, width, 1.0, 0.5),
            0.2,
            0.48,
        )
        yield "flower", petals
        yield "petal vein", veins
        yield "core", [dot((float(end[0]), float(end[1])), 0.26 * look.size)]

    def _bud(self) -> Iterator[tuple[str, list[Outline]]]:
        look = self.flower
        stalk, end = self._stalk()
        yield "stalk", [stalk]
        blade = Blade(1.3 * look.size, 0.4 * look.size, 0.6, 0.9)
        at = similar(84.0, 1.0, (float(end[0]), float(end[1]) - 0.3 * look.size))
        yield "bud", [outline_of(blade).moved(at)]
        yield "petal vein", [rib(blade, 0.3, 0.85, 0.05 * look.size).moved(at)]


ORDER = ("tendril", "leaf", "vein", "stalk", "stem", "bud", "flower", "petal vein", "core")
"""Elements, bottom first: the stem lies over the beginnings of leaves."""
FINE = 1e-4
"""Tolerance, in motif units, of the line along which lengths are measured."""
MOST = 2000
"""Growths on all lines of a curve."""
NODES = 0.35
"""Steps from node to node of a stem, at most."""
SHARPEST = 22.0
"""Degrees that a stem turns between two of its nodes, at most, where the curve is smooth."""
CORNER = 0.5
"""Radians: a sharper turn within the fine line is a corner of the curve, and of the stem."""


class _Way:
    """A line along which a vine grows, measured by its length."""

    def __init__(self, strand: Points, closed: bool) -> None:
        self.line = strand[:, 0] + 1j * strand[:, 1]
        self.closed = closed
        self.along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(self.line)))])

    @property
    def length(self) -> float:
        return float(self.along[-1])

    def at(self, along: Array) -> Array:
        """Return places at distances from its beginning, as complex numbers."""
        return np.asarray(
            np.interp(along, self.along, self.line.real) + 1j * np.interp(along, self.along, self.line.imag)
        )

    def place(self, at: float, step: float) -> Matrix:
        """Return the map that takes the x axis, in steps, to the line at a distance from its beginning."""
        at = at % self.length if self.closed else min(at, self.length)
        before, after = self._near(at, 0.05 * step)
        z = (after - before) / abs(after - before) * step
        (spot,) = self.at(np.array([at])).tolist()
        return z.real, z.imag, -z.imag, z.real, spot.real, spot.imag

    def _near(self, at: float, reach: float) -> tuple[complex, complex]:
        ends = np.array([at - reach, at + reach])
        ends = ends % self.length if self.closed else np.clip(ends, 0, self.length)
        before, after = self.at(ends).tolist()
        return before, after

    def stem(self, look: Stem, step: float) -> Outline:
        """Return the body of the line: two rings where it is closed, else a band with round ends."""
        half = look.width * step
        pieces = self._pieces(step)
        if self.closed and len(pieces) == 1:
            return joined([_ring(pieces[0], half), _ring(pieces[0][::-1], half)])
        found = []
        for piece in pieces:
            share = np.linspace(0, 1, len(piece))
            sizes = (
                half * (1 - look.taper * share)
                if not self.closed and len(pieces) == 1
                else np.full(len(piece), half)
            )
            found.append(band(np.column_stack([piece.real, piece.imag]), np.asarray(sizes)))
        return joined(found)

    def _pieces(self, step: float) -> list[Array]:
        """Return nodes of a spline along the line, a piece from corner to corner."""
        way = np.diff(self.line)
        turn = np.angle(way[1:] / way[:-1])
        corners = np.flatnonzero(np.abs(turn) > CORNER) + 1
        if self.closed and not len(corners) and abs(np.angle(way[0] / way[-1])) <= CORNER:
            return [self._nodes(0.0, self.length, step)[:-1]]
        stops = [0.0, *self.along[corners].tolist(), self.length]
        return [self._nodes(a, b, step) for a, b in itertools.pairwise(stops)]

    def _nodes(self, begin: float, end: float, step: float) -> Array:
        """Return places between two distances: closer where the line bends."""
        inner = (self.along > begin) & (self.along < end)
        along = np.concatenate([[begin], self.along[inner], [end]])
        line = self.at(along)
        way = np.diff(line)
        bent = np.concatenate([[0.0], np.cumsum(np.abs(np.angle(way[1:] / way[:-1]))), [0.0]])
        bent[-1] = bent[-2]
        need = np.degrees(bent) / SHARPEST + (along - begin) / (NODES * step)
        count = max(int(np.ceil(need[-1])), 4)
        return self.at(np.interp(np.linspace(0, need[-1], count + 1), need, along))


def _ring(line: Array, half: float) -> Outline:
    """Return the ring on the left of a closed line."""
    around = np.concatenate([line[-1:], line, line[:1]])
    out = around[2:] - around[:-2]
    side = line + 1j * half * out / np.abs(out)
    return through(np.column_stack([side.real, side.imag]), True, True)
