"""Plants seen from the side, upright: the lotus, the peach and the cockscomb."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import field
from typing import Annotated

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves import Blade
from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.paths.splines import through
from batik_vector.geometry.sampling import Points
from batik_vector.recipe.look import Dress
from batik_vector.recipe.motifs.composing import (
    Composed,
    Isen,
    Keyed,
    Plate,
    centred,
    dots,
    on,
    outline_of,
    part,
    rib,
    similar,
    stroke,
)
from batik_vector.values import frozen

UP = 90.0
"""Degrees: these plants are drawn along +x, where a mirror is exact, and turned up."""


@frozen(kw_only=True)
class LotusPetals(Plate):
    """The petals of a lotus: one in the middle, and pairs behind it."""

    pairs: Annotated[int, Between(1, 8), Says("pairs of petals beside the middle one")] = 3
    width: Annotated[
        float, Between(0.08, 0.5), Says("half the breadth of the middle petal; it is 1 long")
    ] = 0.29
    spread: Annotated[float, Between(20, 120), Says("degrees from the middle to the outmost petal")] = 76.0
    least: Annotated[
        float, Between(0.3, 1.2), Says("length of the outmost petals, as a share of the middle one's")
    ] = 0.86
    bend: Annotated[float, Between(-60, 60), Says("degrees by which the outmost bend, upwards")] = 30.0


@frozen(kw_only=True)
class PetalLines(Isen):
    """Lines in a petal, from its base on and apart."""

    count: Annotated[int, Between(0, 9), Says("lines; 0 leaves them out")] = 3
    weight: Annotated[float, Between(0.002, 0.05), Says("half the breadth of the middle line")] = 0.017


@frozen(kw_only=True)
class Lotus(Composed):
    """Lotus from the side, upright: pairs of petals behind one another, stamens, sepals and a stalk."""

    stalk: Annotated[Dress, Says("look of the stalk")] = field(default_factory=Dress)
    stalk_length: Annotated[float, Between(0, 3), Says("length of the stalk; 0 leaves it out")] = 0.5
    stamen: Annotated[Plate, Says("look of the stamens behind the petals")] = field(default_factory=Plate)
    stamens: Annotated[int, Between(0, 24), Says("stamens; 0 leaves them out")] = 8
    petal: Annotated[LotusPetals, Says("the petals")] = field(default_factory=LotusPetals)
    heart: Annotated[Plate, Says("look of the middle petal, if it names an ink")] = field(
        default_factory=Plate
    )
    vein: Annotated[PetalLines, Says("the lines in the petals")] = field(default_factory=PetalLines)
    sepal: Annotated[Plate, Says("look of the small leaves beneath")] = field(default_factory=Plate)

    def compose(self) -> Iterator[Keyed]:
        """Yield stalk and stamens, then the petals from the outmost to the middle one, and the sepals."""
        petals = self.petal
        if self.stalk_length:
            line = np.column_stack([np.linspace(0.05, -self.stalk_length, 5), np.zeros(5)])
            yield part("stalk", self.stalk, stroke(line, 0.035, 0.05), turn=UP)
        if self.stamens:
            yield part("stamen", self.stamen, list(self._stamens()), turn=UP)
        for pair in range(petals.pairs, 0, -1):
            away = pair / petals.pairs
            # Behind the first, petals stand in the gaps: the longer, the more they are in the middle.
            size = 1 - (1 - petals.least) * away**1.5 if pair > 1 else 0.94
            blade = Blade(size, petals.width * (1 - 0.12 * away), 0.85, 1.15, -petals.bend * away)
            at = similar(petals.spread * away, 1.0, (0.0, 0.03 * away))
            yield part("petal", petals, outline_of(blade).moved(at), mirror=True, turn=UP)
            if self.vein.count:
                lines = [each.moved(at) for each in self._lines(blade)]
                yield part("vein", self.vein, lines, mirror=True, turn=UP)
        heart: Dress = self.heart if self.heart.ink else petals
        blade = Blade(1.0, petals.width, 0.85, 1.15)
        yield part("heart", heart, outline_of(blade), name="petal", turn=UP)
        if self.vein.count:
            yield part("vein", self.vein, list(self._lines(blade)), turn=UP)
        sepal = Blade(0.4, 0.1, 0.8, 1.2, -50.0)
        for angle in (118.0, 70.0):
            yield part("sepal", self.sepal, outline_of(sepal).moved(similar(angle)), mirror=True, turn=UP)

    def _lines(self, blade: Blade) -> Iterator[Outline]:
        """Yield the lines of a petal: the middle one, and pairs that part and are shorter."""
        vein = self.vein
        for number in range(vein.count):
            side = 0.0 if vein.count == 1 else 2 * number / (vein.count - 1) - 1
            shares = np.linspace(0.2, 0.8 - 0.22 * abs(side), 6)
            half = vein.weight * (1 - 0.3 * abs(side))
            yield stroke(on(blade, shares, 0.52 * side), 0.5 * half, 0.5 * half, 0.5 * half)

    def _stamens(self) -> Iterator[Outline]:
        share = (np.arange(self.stamens) + 0.5) / self.stamens * 2 - 1
        for place in share.tolist():
            reach = 1.08 - 0.16 * abs(place)
            line = np.column_stack([np.linspace(0.5, reach, 4), np.zeros(4)])
            at = similar(0.8 * self.petal.spread * place)
            yield stroke(line, 0.009, 0.009).moved(at)
            yield from (each.moved(at) for each in dots(np.array([[reach, 0.0]]), 0.028))


@frozen(kw_only=True)
class PeachFruit(Plate):
    """The fruit of a peach."""

    width: Annotated[float, Between(0.25, 0.8), Says("half its breadth; it is 1 high")] = 0.52
    point: Annotated[float, Between(0.4, 1.6), Says("how pointed its tip is: 1 a corner, below round")] = 0.8
    lean: Annotated[float, Between(-0.4, 0.4), Says("how much broader its left side is")] = 0.08


@frozen(kw_only=True)
class PeachLeaves(Plate):
    """The leaves under a peach, in pairs."""

    pairs: Annotated[int, Between(0, 4), Says("pairs of leaves; 0 leaves them out")] = 2
    length: Annotated[float, Between(0.2, 2), Says("length of the longest")] = 0.72
    width: Annotated[float, Between(0.02, 0.4), Says("half the breadth of a leaf")] = 0.13
    bend: Annotated[float, Between(-80, 80), Says("degrees by which they bend")] = 42.0


@frozen(kw_only=True)
class Peach(Composed):
    """Peach, the fruit of long life, its tip up: a blade with a furrow, a blush of dots, and leaves."""

    stalk: Annotated[Dress, Says("look of the stalk")] = field(default_factory=Dress)
    leaf: Annotated[PeachLeaves, Says("the leaves")] = field(default_factory=PeachLeaves)
    vein: Annotated[Isen, Says("look of their veins")] = field(default_factory=Isen)
    fruit: Annotated[PeachFruit, Says("the fruit")] = field(default_factory=PeachFruit)
    furrow: Annotated[Isen, Says("look of the furrow")] = field(default_factory=Isen)
    spot: Annotated[Isen, Says("look of the dots")] = field(default_factory=Isen)
    rows: Annotated[int, Between(0, 8), Says("rows of dots; 0 leaves them out")] = 3
    spot_size: Annotated[float, Between(0.004, 0.06), Says("radius of the largest dots")] = 0.021

    def compose(self) -> Iterator[Keyed]:
        """Yield the leaves from the lowest, the fruit, its furrow and its dots."""
        yield from centred(self._drawn())

    def _drawn(self) -> Iterator[Keyed]:
        line = np.column_stack([np.zeros(5), np.linspace(0.06, -0.3, 5)])
        yield part("stalk", self.stalk, stroke(line, 0.022, 0.036))
        leaf = self.leaf
        for pair in range(leaf.pairs):
            place = pair / max(leaf.pairs - 1, 1)
            size = leaf.length * (1 - 0.24 * place)
            blade = Blade(size, leaf.width, 0.9, 1.1, leaf.bend)
            for side in (-1.0, 1.0):
                shape, vein = outline_of(blade), rib(blade, 0.08, 0.86, 0.13 * leaf.width)
                angle = -28 + 44 * place
                at = similar(angle, 1.0, (0.0, 0.0))
                mirror = (side * at[0], at[1], side * at[2], at[3], 0.0, -0.05)
                yield part("leaf", leaf, shape.moved(mirror))
                yield part("vein", self.vein, vein.moved(mirror))
        fruit = self.fruit
        blade = Blade(1.0, fruit.width, 0.5, fruit.point, 0.0, fruit.lean)
        up = similar(UP)
        yield part("fruit", fruit, outline_of(blade, 12).moved(up))
        shares = np.linspace(0.03, 0.93, 11)
        furrow = stroke(on(blade, shares, -0.42 * np.sin(np.pi * shares) ** 0.8), 0.006, 0.006, 0.016)
        yield part("furrow", self.furrow, furrow.moved(up))
        if self.rows:
            yield part("spot", self.spot, [each.moved(up) for each in self._blush(blade)])

    def _blush(self, blade: Blade) -> Iterator[Outline]:
        """Yield rows of dots along the left side that follow it, smaller and fewer from row to row."""
        for row in range(self.rows):
            side = 0.8 - 0.22 * row
            size = self.spot_size * (1 - 0.5 * row / max(self.rows, 1))
            begin, end = 0.16 + 0.05 * row, 0.8 - 0.05 * row
            count = max(int((end - begin) / (3.6 * self.spot_size)), 2)
            shares = begin + (end - begin) * (np.arange(count) + 0.5 * (row % 2)) / count
            yield from dots(on(blade, shares, side), size)


@frozen(kw_only=True)
class Comb(Plate):
    """The comb of a cockscomb: an arc that meanders."""

    folds: Annotated[int, Between(3, 24), Says("folds of its margin")] = 9
    depth: Annotated[float, Between(0.02, 0.3), Says("depth of the folds, as a share of its height")] = 0.12
    swell: Annotated[float, Between(0, 1), Says("how far they swell: 0 waves, 1 all but touch")] = 0.85
    spread: Annotated[float, Between(20, 95), Says("degrees from its middle to its sides")] = 64.0
    bands: Annotated[int, Between(1, 6), Says("bands from the margin inwards, waxed and bare in turn")] = 3


@frozen(kw_only=True)
class Cockscomb(Composed):
    """Cockscomb (*Celosia*), upright: a fan whose margin meanders in folds, on a stalk with leaves.

    A margin place at a share s of the arc is (R + A·cos nψ)·e^{iφ}, its angle φ behind by swell·sin nψ: as
    the meanders of a river are, whose direction is a sine of the way. The comb is 1 high.
    """

    stalk: Annotated[Dress, Says("look of the stalk")] = field(default_factory=Dress)
    stalk_length: Annotated[float, Between(0, 3), Says("length of the stalk; 0 leaves it out")] = 0.62
    leaf: Annotated[Plate, Says("look of the leaves")] = field(default_factory=Plate)
    leaves: Annotated[int, Between(0, 4), Says("pairs of leaves on the stalk; 0 leaves them out")] = 2
    vein: Annotated[Isen, Says("look of their veins")] = field(default_factory=Isen)
    comb: Annotated[Comb, Says("the comb")] = field(default_factory=Comb)
    inner: Annotated[Isen, Says("look of every second band")] = field(default_factory=Isen)
    plume: Annotated[Isen, Says("look of the lines that rise in it")] = field(default_factory=Isen)
    spot: Annotated[Isen, Says("look of the dots at its foot")] = field(default_factory=Isen)

    def compose(self) -> Iterator[Keyed]:
        """Yield stalk and leaves, the bands of the comb, and what is in its heart."""
        comb = self.comb
        if self.stalk_length:
            line = np.column_stack([np.linspace(0.1, -self.stalk_length, 5), np.zeros(5)])
            yield part("stalk", self.stalk, stroke(line, 0.05, 0.034), turn=UP)
            yield from self._leaves()
        for band in range(comb.bands):
            key: str = "inner" if band % 2 else "comb"
            look: Dress = self.inner if band % 2 else comb
            yield part(key, look, self._margin(1 - 0.13 * band), turn=UP)
        top = 1 - 0.13 * (comb.bands - 1) - 2.4 * comb.depth
        # What is bare inmost takes no lines but waxed ones.
        lines = list(self._plumes(top)) if comb.bands % 2 or self.plume.ink else []
        if lines:
            yield part("plume", self.plume, lines, turn=UP)
            yield part("spot", self.spot, dots(self._foot(top), 0.02), turn=UP)

    def _margin(self, reach: float) -> Outline:
        """Return the comb's outline at a share of its height: from the foot round its margin and back."""
        comb = self.comb
        spread, folds = math.radians(comb.spread), comb.folds
        # From the crest of the first fold to that of the last.
        s = (0.5 + np.arange(12 * (folds - 1) + 1) / 12) / folds
        phase = 2 * np.pi * folds * s
        ahead = -comb.swell * SWELL * np.sin(phase) / folds
        angle = spread * (2 * s - 1 + ahead)
        radius = reach - comb.depth * (0.5 + 0.5 * np.cos(phase))
        foot = FOOT + 0.5 * (1 - reach)
        place = foot + (radius - foot) * np.exp(1j * angle)
        low = foot - FOOT * reach
        # The sides swing out from the foot.
        side = [low + (place[0] - low) * 0.5 * np.exp(-0.16j), low + (place[-1] - low) * 0.5 * np.exp(0.16j)]
        ring = np.concatenate([[low], side[:1], place, side[1:]])
        return through(np.column_stack([ring.real, ring.imag]), True, True, (0,))

    def _plumes(self, top: float) -> Iterator[Outline]:
        comb, low = self.comb, self._low()
        if top < low + 0.1:
            return
        begin, spread = low + 0.5 * (top - low), (0.2 + 0.42 * top) * comb.spread
        line = np.column_stack([np.linspace(begin, top, 6), np.zeros(6)])
        # As many as stand apart where they begin.
        count = min(int(2 * math.radians(spread) * begin / PLUMES), comb.folds) // 2 * 2 + 1
        for place in (np.arange(count) + 0.5 - 0.5 * count).tolist():
            yield stroke(line, 0.006, 0.006, 0.014).moved(similar(2 * spread * place / count))

    def _foot(self, top: float) -> Points:
        low = self._low()
        angle = np.radians((0.16 + 0.36 * top) * self.comb.spread) * np.linspace(
            -1, 1, max(self.comb.folds // 2, 2)
        )
        return (low + 0.34 * (top - low)) * np.column_stack([np.cos(angle), np.sin(angle)])

    def _low(self) -> float:
        """Return how high the inmost band's foot is."""
        return FOOT + 0.13 * (self.comb.bands - 1) * (0.5 + FOOT) - FOOT

    def _leaves(self) -> Iterator[Keyed]:
        blade = Blade(0.62, 0.1, 0.8, 1.3, 34.0)
        for pair in range(self.leaves):
            root = -self.stalk_length * (0.42 + 0.5 * pair / max(self.leaves, 1))
            at = similar(38.0, 1.0 - 0.16 * (pair % 2), (root, 0.01))
            yield part("leaf", self.leaf, outline_of(blade).moved(at), mirror=True, turn=UP)
            yield part("vein", self.vein, rib(blade, 0.1, 0.84, 0.013).moved(at), mirror=True, turn=UP)


PLUMES = 0.058
"""Distance of the lines in a comb from one another at their feet."""
FOOT = 0.16
"""Where the sides of the comb come together, above its foot."""
SWELL = 0.15
"""Angle, in folds, by which a margin stays behind where its folds all but touch."""
