"""Triangles in a row along the ends of a cloth: *tumpal*, and the bamboo shoots of *pucuk rebung*."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field
from typing import Annotated, Any

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves import Blade
from batik_vector.geometry.paths.bands import band
from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.paths.splines import through
from batik_vector.geometry.sampling import Array
from batik_vector.recipe.look import Dress
from batik_vector.recipe.motifs.composing import (
    Banded,
    Isen,
    Keyed,
    Plate,
    dot,
    dots,
    outline_of,
    part,
    similar,
    stroke,
)
from batik_vector.values import frozen


def flank(half: float, high: float, bow: float, share: Array) -> Any:
    """Return places along the right side of a triangle on y = 0, from its foot to its tip, complex."""
    side = 1j * high - half
    # A sine that is steeper at the foot: a shoot swells low and runs out slim.
    return half + side * share - 1j * side * bow * np.sin(np.pi * share**0.8)


def triangle(half: float, high: float, bow: float) -> Outline:
    """Return a triangle on y = 0 whose sides bow out by a share of their length."""
    right = flank(half, high, bow, np.linspace(0, 1, 9)[:-1])
    ring = np.concatenate([[-half], right, [1j * high], -np.conj(right)[:0:-1]])
    return through(np.column_stack([ring.real, ring.imag]), True, True, (0, 1, 9))


@frozen(kw_only=True)
class TumpalTree(Isen):
    """The tree in a triangle: a stem with pairs of leaves, and a bud at its tip."""

    pairs: Annotated[int, Between(0, 12), Says("pairs of leaves; 0 leaves the tree out")] = 4
    full: Annotated[float, Between(0.2, 1), Says("reach of the leaves, as a share of the room")] = 0.84
    bend: Annotated[float, Between(-60, 60), Says("degrees by which the leaves bend, upwards")] = 46.0
    stem: Annotated[float, Between(0.002, 0.05), Says("half the breadth of the stem, in links")] = 0.011


@frozen(kw_only=True)
class Edge(Dress):
    """The edge of a triangle: flames along its sides (*untu walang*, a locust's teeth)."""

    count: Annotated[int, Between(0, 40), Says("flames along a side; 0 leaves them out")] = 12
    size: Annotated[float, Between(0.01, 0.3), Says("length of a flame, in links")] = 0.12


@frozen(kw_only=True)
class Pendant(Plate):
    """What hangs between two triangles, its tip down."""

    size: Annotated[float, Between(0, 1), Says("its length, as a share of the height; 0 leaves it out")] = (
        0.42
    )
    width: Annotated[float, Between(0.02, 0.3), Says("half its breadth, in links")] = 0.085


@frozen(kw_only=True)
class Tumpal(Banded):
    """Tumpal: a triangle on its base, one link from x = 0 to 1, with a frame and a tree in it, and flames.

    Rows of them stand along the ends of shoulder cloths and, two rows tip to tip, in the head (*kepala*) of a
    sarong. As a band it is told of about its middle: in a border its place is half its height in.
    """

    height: Annotated[float, Between(0.3, 6), Says("height of a triangle, in links")] = 1.9
    bow: Annotated[float, Between(-0.15, 0.2), Says("how far its sides bow out; below 0 they are hollow")] = (
        0.0
    )
    full: Annotated[float, Between(0.4, 1), Says("breadth of its base, in links")] = 0.94
    edge: Annotated[Edge, Says("the flames along its sides")] = field(default_factory=Edge)
    body: Annotated[Plate, Says("look of the triangle")] = field(default_factory=Plate)
    frame: Annotated[Isen, Says("look of the frame within")] = field(default_factory=Isen)
    frame_size: Annotated[
        float, Between(0, 0.5), Says("how far within it the frame lies, as a share; 0 leaves it out")
    ] = 0.2
    inner: Annotated[Isen, Says("look of the field in the frame")] = field(default_factory=Isen)
    frame_weight: Annotated[float, Between(0.01, 0.3), Says("breadth of the frame, likewise")] = 0.09
    bead: Annotated[Isen, Says("look of the beads along the frame")] = field(default_factory=Isen)
    beads: Annotated[int, Between(0, 60), Says("beads along a side; 0 leaves them out")] = 0
    tree: Annotated[TumpalTree, Says("the tree in it")] = field(default_factory=TumpalTree)
    pendant: Annotated[Pendant, Says("what hangs between two triangles")] = field(default_factory=Pendant)

    @property
    def across(self) -> float:
        """How broad the band is, in links."""
        return self.height

    def compose(self) -> Iterator[Keyed]:
        """Yield what hangs, the flames, the triangle, and what is in it."""
        half, high = self.full / 2, self.height
        home = similar(0.0, 1.0, (0.5, -high / 2))
        if self.pendant.size:
            yield part("pendant", self.pendant, self._pendant())
        if self.edge.count:
            yield part("edge", self.edge, [each.moved(home) for each in self._flames()])
        yield part("body", self.body, triangle(half, high, self.bow).moved(home))
        inmost = 1.0
        if self.frame_size:
            yield part("frame", self.frame, self._within(1 - self.frame_size).moved(home))
            inmost = 1 - self.frame_size - self.frame_weight
            inner: Dress = self.inner if self.inner.ink else self.body
            yield part("inner", inner, self._within(inmost).moved(home))
        if self.beads:
            yield part("bead", self.bead, [each.moved(home) for each in self._beads(inmost)])
        if self.tree.pairs:
            yield part("tree", self.tree, [each.moved(home) for each in self._tree(inmost)])

    @property
    def _middle(self) -> float:
        """How high the middle of its inscribed circle stands: sides drawn in about it stay as far within."""
        half = self.full / 2
        return half * self.height / (half + float(np.hypot(half, self.height)))

    def _within(self, size: float) -> Outline:
        """Return the triangle, smaller about its middle."""
        shift = (0.0, self._middle * (1 - size))
        return triangle(self.full / 2, self.height, self.bow).moved(similar(0.0, size, shift))

    def _flames(self) -> Iterator[Outline]:
        look, half, high = self.edge, self.full / 2, self.height
        share = (np.arange(look.count) + 0.5) / look.count
        roots = flank(half, high, self.bow, share)
        step = abs(complex(half, high)) / look.count
        flame = outline_of(Blade(look.size, min(0.4 * step, 0.3 * look.size), 0.6, 1.2, 34.0))
        out = np.degrees(np.arctan2(half, high))
        for root in roots.tolist():
            at = similar(out + 18.0, 1.0, (root.real - 0.2 * look.size, root.imag))
            yield flame.moved(at)
            yield flame.moved((-at[0], at[1], -at[2], at[3], -at[4], at[5]))

    def _pendant(self) -> list[Outline]:
        """Return a bud that hangs from the upper edge where the link begins."""
        look = self.pendant
        blade = Blade(look.size * self.height, look.width, 1.3, 0.9)
        return [outline_of(blade).moved(similar(-90.0, 1.0, (0.0, self.height / 2)))]

    def _beads(self, size: float) -> Iterator[Outline]:
        share = 0.06 + 0.86 * (np.arange(self.beads) + 0.5) / self.beads
        inner = size - 0.1
        line = flank(self.full / 2, self.height, self.bow, share) * inner + 1j * self._middle * (1 - inner)
        size = min(0.3 * abs(complex(self.full / 2, self.height)) * inner * 0.86 / self.beads, 0.02)
        places = np.concatenate([line, -np.conj(line)])
        yield from dots(np.column_stack([places.real, places.imag]), size)

    def _tree(self, size: float) -> Iterator[Outline]:
        """Yield the stem, its leaves and its bud, in the room that is left within."""
        look, foot = self.tree, self._middle * (1 - size)
        high, wide = self.height * size, self.full * size / 2
        line = np.column_stack([np.zeros(5), foot + high * np.linspace(0.02, 0.66, 5)])
        yield stroke(line, look.stem, 0.5 * look.stem)
        for pair in range(look.pairs):
            at = 0.06 + 0.5 * pair / look.pairs
            # The tip of a leaf rises by about half its length, where there is less room.
            room = wide * (1 - at) / (0.72 + 0.42 * wide / high)
            length = look.full * room
            blade = Blade(length, 0.21 * length, 0.8, 1.0, look.bend)
            leaf = outline_of(blade).moved(similar(14.0, 1.0, (0.6 * look.stem, 0.0)))
            for side in (1.0, -1.0):
                yield leaf.moved((side, 0.0, 0.0, 1.0, 0.0, foot + at * high))
        bud = Blade(0.2 * high, min(0.3 * wide, 0.07 * high), 0.7, 1.2)
        yield outline_of(bud).moved(similar(90.0, 1.0, (0.0, foot + 0.6 * high)))


@frozen(kw_only=True)
class Sheaths(Isen):
    """The sheaths of a bamboo shoot, left and right in turn."""

    count: Annotated[int, Between(0, 16), Says("sheaths on each side; 0 leaves them out")] = 5
    weight: Annotated[float, Between(0.05, 0.9), Says("breadth of a sheath, as a share of its room")] = 0.42


@frozen(kw_only=True)
class PucukRebung(Banded):
    """Bamboo shoot (*pucuk rebung*): a slim triangle with full sides, one link from x = 0 to 1, in sheaths.

    Sheaths lie over one another left and right, and dots rise in its heart: the border of Malay and Sumatran
    cloths.
    """

    height: Annotated[float, Between(0.4, 6), Says("height of a shoot, in links")] = 2.0
    bow: Annotated[float, Between(0, 0.2), Says("how far its sides swell")] = 0.07
    full: Annotated[float, Between(0.3, 1), Says("breadth of its foot, in links")] = 0.8
    back: Annotated[Plate, Says("look of a larger shoot behind, if it names an ink")] = field(
        default_factory=Plate
    )
    body: Annotated[Plate, Says("look of the shoot")] = field(default_factory=Plate)
    sheath: Annotated[Sheaths, Says("the sheaths")] = field(default_factory=Sheaths)
    heart: Annotated[Plate, Says("look of the shoot's heart")] = field(default_factory=Plate)
    heart_size: Annotated[
        float, Between(0, 0.9), Says("height of the heart, as a share of the shoot's; 0 leaves it out")
    ] = 0.46
    seed: Annotated[Isen, Says("look of the dots in the heart")] = field(default_factory=Isen)
    seeds: Annotated[int, Between(0, 24), Says("dots in the heart; 0 leaves them out")] = 5
    bead: Annotated[Dress, Says("look of the beads between two shoots")] = field(default_factory=Dress)
    beads: Annotated[int, Between(0, 24), Says("beads between two shoots; 0 leaves them out")] = 6

    @property
    def across(self) -> float:
        """How broad the band is, in links."""
        return self.height

    def compose(self) -> Iterator[Keyed]:
        """Yield the beads, the shoot, its sheaths and its heart."""
        half, high = self.full / 2, self.height
        home = similar(0.0, 1.0, (0.5, -high / 2))
        if self.beads:
            yield part("bead", self.bead, list(self._beads()))
        if self.back.ink:
            yield part("back", self.back, triangle(min(1.14 * half, 0.5), high, self.bow).moved(home))
        body = 0.93 if self.back.ink else 1.0
        yield part("body", self.body, triangle(half * body, high * body, self.bow).moved(home))
        if self.sheath.count:
            yield part("sheath", self.sheath, [each.moved(home) for each in self._sheaths(body)])
        if self.heart_size:
            heart = triangle(0.44 * half, self.heart_size * high, self.bow).moved(home)
            yield part("heart", self.heart, heart)
            if self.seeds:
                yield part("seed", self.seed, [each.moved(home) for each in self._seeds()])

    def _sheaths(self, body: float) -> Iterator[Outline]:
        """Yield crescents that rise along a side and bend in to the middle."""
        look, half, high = self.sheath, self.full / 2 * body, self.height * body
        room, step = 0.74 / look.count, np.linspace(0, 1, 11)
        for number in range(look.count):
            for side, late in ((1.0, 0.0), (-1.0, 0.5)):
                at = 0.03 + room * (number + late) + (0.16 + 0.7 * room) * step
                # Shares of the shoot's own breadth, so that none leaves it.
                across = flank(half, high, self.bow, np.minimum(at, 0.98)).real * (0.9 - 0.84 * step**2.2)
                width = 0.5 * look.weight * (0.5 * room * high) * np.sin(np.pi * step)
                width = np.minimum(width, 0.3 * across + 0.004)
                line = np.column_stack([side * across, at * high])
                yield band(line, np.concatenate([[0.0], width[1:-1], [0.0]]))

    def _seeds(self) -> Iterator[Outline]:
        high = self.heart_size * self.height
        share = 0.1 + 0.62 * np.arange(self.seeds) / max(self.seeds, 1)
        most = 0.3 * 0.62 * high / max(self.seeds, 1)
        for at in share.tolist():
            size = min(0.2 * self.full * (1 - at) * 0.5, most)
            yield dot((0.0, at * high), size)

    def _beads(self) -> Iterator[Outline]:
        """Yield a row that climbs between two shoots, larger where there is more room."""
        share = (np.arange(self.beads) + 0.5) / self.beads
        room = 0.5 - flank(self.full / 2, self.height, self.bow, share).real
        size = np.minimum(0.4 * (room - NARROW), min(0.3 * self.height / self.beads, 0.05))
        free = size > 0.3 * NARROW
        # At the tips there is room for one at least.
        free[-1] = True
        places = np.column_stack([np.zeros(len(share)), (share - 0.5) * self.height])
        yield from dots(places[free], np.maximum(size, 0.3 * NARROW)[free])


NARROW = 0.03
"""Half the gap between two shoots, in links, in which no bead has room."""
