"""The bouquet, *buketan*: stems from one root that bend apart, with blossoms, buds and leaves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field
from typing import Annotated

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves import Blade
from batik_vector.geometry.paths.bands import curl
from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.sampling import Points
from batik_vector.recipe.look import Dress
from batik_vector.recipe.motifs.composing import (
    Composed,
    Isen,
    Keyed,
    Plate,
    dot,
    dots,
    outline_of,
    part,
    rib,
    similar,
    stroke,
)
from batik_vector.values import frozen


@frozen(kw_only=True)
class Stems(Dress):
    """The stems of a bouquet."""

    count: Annotated[int, Between(1, 11), Says("stems")] = 7
    spread: Annotated[float, Between(10, 170), Says("degrees between the outmost two")] = 150.0
    bend: Annotated[float, Between(-90, 120), Says("degrees by which the outmost bend, outwards")] = 58.0
    uneven: Annotated[float, Between(0, 1), Says("how unlike they are: 0 mirrors left and right")] = 0.7
    width: Annotated[float, Between(0.003, 0.04), Says("half the breadth at the root")] = 0.013
    root: Annotated[float, Between(0, 0.6), Says("length below the knot where they meet")] = 0.26


@frozen(kw_only=True)
class Blossoms(Plate):
    """The blossoms of a bouquet, seen a little from the side: wreaths of petals within one another."""

    size: Annotated[float, Between(0.03, 0.5), Says("radius of the largest")] = 0.29
    petals: Annotated[int, Between(4, 16), Says("petals of a wreath")] = 7
    wreaths: Annotated[int, Between(1, 4), Says("wreaths")] = 2
    tilt: Annotated[float, Between(0.4, 1), Says("how round they show: 1 from above")] = 0.84


@frozen(kw_only=True)
class BouquetLeaves(Plate):
    """The leaves of a bouquet."""

    pairs: Annotated[int, Between(0, 6), Says("pairs along a stem; 0 leaves them out")] = 2
    length: Annotated[float, Between(0.03, 0.6), Says("length of the longest")] = 0.4
    width: Annotated[float, Between(0.05, 0.4), Says("half the breadth, as a share of the length")] = 0.17
    bend: Annotated[float, Between(-70, 70), Says("degrees by which they bend, to the tip of the stem")] = (
        38.0
    )


@frozen(kw_only=True)
class Buketan(Composed):
    """Bouquet (*buketan*), upright, about 2 high: stems from one root, blossoms and buds at their tips.

    After the flower books that Pekalongan's workshops of about 1900 drew from: no two stems alike, every
    second one with a bud, leaves along all, so that the bouquet fills its outline.
    """

    stem: Annotated[Stems, Says("the stems")] = field(default_factory=Stems)
    leaf: Annotated[BouquetLeaves, Says("the leaves")] = field(default_factory=BouquetLeaves)
    vein: Annotated[Isen, Says("look of the veins of leaves and petals")] = field(default_factory=Isen)
    tendril: Annotated[Dress, Says("look of the tendrils")] = field(default_factory=Dress)
    tendrils: Annotated[int, Between(0, 8), Says("tendrils at the knot; 0 leaves them out")] = 4
    bud: Annotated[Plate, Says("look of the buds")] = field(default_factory=Plate)
    blossom: Annotated[Blossoms, Says("the blossoms")] = field(default_factory=Blossoms)
    inner: Annotated[Plate, Says("look of their inner wreaths, if it names an ink")] = field(
        default_factory=Plate
    )
    core: Annotated[Plate, Says("look of their hearts")] = field(default_factory=Plate)
    stamen: Annotated[Isen, Says("look of the dots in the hearts")] = field(default_factory=Isen)

    def compose(self) -> Iterator[Keyed]:
        """Yield tendrils and stems, leaves, buds and blossoms from the outmost stems to the middle ones."""
        ways = self._ways()
        width = self.stem.width
        if self.tendrils:
            yield part("tendril", self.tendril, list(self._curls()))
        stems = [stroke(way, width, 0.6 * width) for way in ways]
        if self.stem.root:
            foot = np.column_stack([0.06 * np.linspace(0, 1, 5) ** 2, -self.stem.root * np.linspace(0, 1, 5)])
            for turn, size in ((0.0, 1.0), (13.0, 0.8), (-15.0, 0.72)):
                stems.append(stroke(foot * size, width, 0.7 * width).moved(similar(turn)))
        yield part("stem", self.stem, stems)
        order = sorted(range(len(ways)), key=lambda k: -abs(2 * k - len(ways) + 1))
        if self.leaf.pairs:
            placed = [each for k in order for each in self._leaves(ways[k], k)]
            yield part("leaf", self.leaf, [leaf for leaf, _ in placed])
            yield part("vein", self.vein, [vein for _, vein in placed])
        for k in order:
            yield from self._bud(ways[k]) if self._budding(k) else self._blossom(ways[k], self._size(k))

    def _budding(self, number: int) -> bool:
        """Return whether a stem ends in a bud: every second does, seen from the middle."""
        return self.stem.count > 1 and number % 2 == (self.stem.count // 2 + 1) % 2

    def _size(self, number: int) -> float:
        return self.blossom.size * (1 - 0.22 * self.stem.uneven * ((number * 3) % 5) / 4)

    def _ways(self) -> list[Points]:
        """Return the line of each stem, from the right to the left."""
        look = self.stem
        share = np.linspace(-1, 1, look.count) if look.count > 1 else np.zeros(1)
        odd = look.uneven * UNEVEN[: look.count]
        found = []
        for side, chance in zip(share.tolist(), odd.tolist(), strict=True):
            length = (1.3 - 0.34 * abs(side)) * (1 + 0.16 * chance)
            angle = 90 + (look.spread / 2) * (side + 0.12 * chance) * 0.62
            turn = look.bend * (side if abs(side) > 0.2 else 0.5 * chance) * (1 + 0.3 * chance)
            line = curl(length, turn, 1.3, 12)
            found.append(line @ _turned(angle))
        return found

    def _leaves(self, way: Points, number: int) -> Iterator[tuple[Outline, Outline]]:
        """Yield the leaves of a stem with their veins: alternate, smaller towards its tip."""
        look = self.leaf
        for k in range(2 * look.pairs):
            share = 0.3 + 0.5 * (k + 0.35 * (number % 2)) / (2 * look.pairs)
            side = 1.0 if (k + number) % 2 else -1.0
            (x, y), heading = _on(way, share)
            length = look.length * (1 - 0.5 * share) * (0.84 + 0.16 * ((k + 2 * number) % 3) / 2)
            blade = Blade(length, look.width * length, 0.8, 1.2, look.bend)
            at = similar(heading)
            flip = (at[0], at[1], side * at[2], side * at[3], x, y)
            turned = similar(40.0)
            yield (
                outline_of(blade).moved(turned).moved(flip),
                rib(blade, 0.08, 0.86, 0.13 * look.width * length).moved(turned).moved(flip),
            )

    def _bud(self, way: Points) -> Iterator[Keyed]:
        (x, y), heading = _on(way, 1.0)
        size = 0.72 * self.blossom.size
        blade = Blade(1.15 * size, 0.36 * size, 0.6, 1.0)
        at = similar(heading, 1.0, (x, y))
        yield part("bud", self.bud, outline_of(blade).moved(at))
        yield part("vein", self.vein, rib(blade, 0.34, 0.86, 0.07 * size).moved(at))
        sepal = outline_of(Blade(0.72 * size, 0.13 * size, 0.8, 1.2, -22.0))
        mirror = (at[0], at[1], -at[2], -at[3], x, y)
        cups = [sepal.moved(similar(34.0)).moved(each) for each in (at, mirror)]
        yield part("leaf", self.leaf, cups, name="sepal")

    def _blossom(self, way: Points, size: float) -> Iterator[Keyed]:
        look = self.blossom
        (x, y), heading = _on(way, 1.0)
        at = similar(heading, size, (x, y))
        tilt = (at[0] * look.tilt, at[1] * look.tilt, at[2], at[3], x, y)
        for wreath in range(look.wreaths):
            reach = 1 - 0.62 * wreath / max(look.wreaths, 2)
            width = 0.98 * reach * float(np.tan(np.pi / max(look.petals, 4))) * 0.62
            blade = Blade(reach, width, 1.1, 0.42)
            step = 360 / look.petals
            turns = [similar(step * (k + 0.5 * wreath)) for k in range(look.petals)]
            inner = wreath % 2 == 1 and bool(self.inner.ink)
            petal = [outline_of(blade).moved(turn).moved(tilt) for turn in turns]
            yield part("inner" if inner else "blossom", self.inner if inner else look, petal, name="petal")
            veins = [rib(blade, 0.5, 0.88, 0.16 * width).moved(turn).moved(tilt) for turn in turns]
            yield part("vein", self.vein, veins)
        yield part("core", self.core, dot((0.0, 0.0), 0.2).moved(tilt))
        angle = 2 * np.pi * np.arange(6) / 6
        ring = 0.115 * np.column_stack([np.cos(angle), np.sin(angle)])
        spots = dots(np.vstack([ring, [[0.0, 0.0]]]), 0.034)
        yield part("stamen", self.stamen, [each.moved(tilt) for each in spots])

    def _curls(self) -> Iterator[Outline]:
        for number in range(self.tendrils):
            side = 1.0 if number % 2 else -1.0
            line = stroke(
                curl(0.72 - 0.07 * number, 420.0, 1.9), 0.7 * self.stem.width, 0.4 * self.stem.width
            )
            at = similar(24.0 + 26.0 * (number // 2) - (14.0 * self.stem.uneven if side > 0 else 0.0))
            yield line.moved((side * at[0], at[1], side * at[2], at[3], 0.0, 0.02))


UNEVEN = np.array([0.6, -0.9, 0.4, -0.3, 1.0, -0.7, 0.2, 0.8, -0.5, 0.9, -0.2])
"""By how much stems differ from what is even, one after another."""


def _turned(angle: float) -> Points:
    """Return the matrix by which rows of points are turned, degrees."""
    x, y, *_ = similar(angle)
    return np.array([[x, y], [-y, x]])


def _on(way: Points, share: float) -> tuple[tuple[float, float], float]:
    """Return a place on a line at a share of its nodes, and the direction there in degrees."""
    at = share * (len(way) - 1)
    k = min(int(at), len(way) - 2)
    step = way[k + 1] - way[k]
    x, y = (way[k] + (at - k) * step).tolist()
    return (x, y), float(np.degrees(np.arctan2(step[1], step[0])))
