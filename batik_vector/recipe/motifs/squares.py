"""Repeats in a square of side 1 about the origin: *kawung*, *truntum*, *ceplok* and *jlamprang*.

What stands on the square's corners and sides is drawn once, on the upper right: the repeat brings the others.
So a placement with a scale of 100 mm fills a tile of 100 × 100 mm, and the layout ``lattice`` any number of
squares.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field, replace
from typing import Annotated

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves import Blade, Circle
from batik_vector.geometry.paths.outline import Outline, polyline
from batik_vector.geometry.sampling import Array, Points
from batik_vector.recipe.look import Dress
from batik_vector.recipe.motifs.composing import (
    Composed,
    Isen,
    Keyed,
    Plate,
    dots,
    outline_of,
    part,
    rib,
    similar,
)
from batik_vector.recipe.motifs.rows import lozenge
from batik_vector.values import frozen

CORNER = np.array([[0.5, 0.5]])
SIDES = np.array([[0.5, 0.0], [0.0, 0.5]])


def wreath(shape: Outline, count: int, at: Points, radius: float, turn: float = 90.0) -> list[Outline]:
    """Return copies of what points along +x, set about places (n, 2) at a radius."""
    out = shape.moved(similar(0.0, 1.0, (radius, 0.0)))
    turned = [out.moved(similar(turn + 360 * k / count)) for k in range(count)]
    return [each.moved(similar(0.0, 1.0, (x, y))) for x, y in at.tolist() for each in turned]


def rings(count: int, at: Points, radius: float, size: float | Array, turn: float = 90.0) -> list[Outline]:
    """Return dots set about places at a radius."""
    angle = np.radians(turn) + 2 * np.pi * np.arange(count) / count
    ring = radius * np.column_stack([np.cos(angle), np.sin(angle)])
    return dots((at[:, None, :] + ring[None, :, :]).reshape(-1, 2), size)


@frozen(kw_only=True)
class Bean(Plate):
    """The fruits of a kawung: beans that point to a heart."""

    count: Annotated[int, Between(2, 4), Says("beans about a heart; with 4 they draw circles")] = 4
    length: Annotated[float, Between(0.3, 1), Says("as a share of the way to the next heart")] = 0.9
    width: Annotated[float, Between(0.1, 0.5), Says("half the breadth, as a share of the length")] = 0.26
    tip: Annotated[float, Between(0.36, 1.5), Says("power of its ends: ½ round, 1 a corner")] = 0.62


@frozen(kw_only=True)
class Kawung(Composed):
    """Kawung: beans about hearts on the middle and the corners of the square, so that rims draw circles.

    Cut fruits of the sugar palm; with two or three beans about a heart it is one ornament, for layouts of its
    own. Among the oldest of Java, on the garments of stone figures of the 13th century.
    """

    bean: Annotated[Bean, Says("the beans")] = field(default_factory=Bean)
    rim: Annotated[float, Between(0, 0.5), Says("breadth of the rim, as a share of a bean's half")] = 0.16
    ditch: Annotated[Isen, Says("look of the line within the rim")] = field(default_factory=Isen)
    flesh: Annotated[Isen, Says("look of the flesh within it")] = field(default_factory=Isen)
    seed: Annotated[Isen, Says("look of the seeds")] = field(default_factory=Isen)
    seeds: Annotated[int, Between(0, 3), Says("seeds in a bean, 2 as a rule; 0 leaves them out")] = 2
    heart: Annotated[Plate, Says("look of the hearts, four small leaves")] = field(default_factory=Plate)
    heart_size: Annotated[float, Between(0, 0.2), Says("radius of the hearts; 0 leaves them out")] = 0.07
    star: Annotated[Plate, Says("look of the crosses in the curved squares between")] = field(
        default_factory=Plate
    )
    star_size: Annotated[float, Between(0, 0.4), Says("radius of the crosses; 0 leaves them out")] = 0.2
    cecek: Annotated[Dress, Says("look of the dots about the crosses")] = field(default_factory=Dress)
    cecek_size: Annotated[float, Between(0, 0.03), Says("radius of the dots; 0 leaves them out")] = 0.011

    def compose(self) -> Iterator[Keyed]:
        """Yield crosses and dots, the beans and what is in them, and the hearts."""
        bean, whole = self.bean, self.bean.count == 4
        hearts = np.vstack([[[0.0, 0.0]], CORNER]) if whole else np.zeros((1, 2))
        way = float(np.sqrt(0.5))
        if self.star_size and whole:
            yield part("star", self.star, self._crosses())
            if self.cecek_size:
                places = [1.3 * self.star_size, 1.3 * self.star_size + 3 * self.cecek_size]
                yield part(
                    "cecek", self.cecek, [dot for r in places for dot in rings(4, SIDES, r, self.cecek_size)]
                )
        length = bean.length * way
        # Of two neighbours the halves meet in the circles that their rims draw.
        for key, look, inset in self._layers():
            wide = bean.width * length * (1 - inset)
            long = length - 2 * bean.width * length * inset
            shape = outline_of(Blade(long, max(wide, 1e-3), bean.tip, bean.tip))
            yield part(key, look, shape, count=bean.count, turn=45.0, radius=(way - long) / 2)
        if self.seeds:
            yield part("seed", self.seed, self._seeds(length), count=bean.count, turn=45.0)
        if self.heart_size:
            petal = outline_of(Blade(self.heart_size, 0.3 * self.heart_size, 0.9, 0.8))
            yield part("heart", self.heart, wreath(petal, bean.count, hearts, 0.0))

    def _layers(self) -> Iterator[tuple[str, Dress, float]]:
        yield "bean", self.bean, 0.0
        if self.rim:
            yield "ditch", self.ditch, self.rim
            flesh: Dress = self.flesh if self.flesh.ink else self.bean
            yield "flesh", replace(flesh, gap=0.0), 1.75 * self.rim

    def _seeds(self, length: float) -> list[Outline]:
        size = 0.5 * length * (0.46 if self.seeds == 2 else 0.36)
        middle = np.sqrt(0.5) / 2
        seed = outline_of(Blade(size, 0.23 * size, 0.8, 0.8))
        apart = (np.arange(self.seeds) - (self.seeds - 1) / 2) * 1.28 * size
        return [seed.moved(similar(0.0, 1.0, (middle + x - size / 2, 0.0))) for x in apart.tolist()]

    def _crosses(self) -> list[Outline]:
        petal = outline_of(Blade(0.8 * self.star_size, 0.22 * self.star_size, 0.9, 0.75))
        return wreath(petal, 4, SIDES, 0.2 * self.star_size)


@frozen(kw_only=True)
class Stars(Dress):
    """The flowers of a truntum: slim petals round a heart, and rays between."""

    petals: Annotated[int, Between(4, 16), Says("petals of a flower")] = 8
    size: Annotated[float, Between(0.1, 0.5), Says("radius of the larger flowers")] = 0.31
    least: Annotated[float, Between(0.2, 1), Says("radius of the smaller, as a share of it")] = 0.62
    width: Annotated[float, Between(0.04, 0.4), Says("half the breadth of a petal, as a share of it")] = 0.15


@frozen(kw_only=True)
class Truntum(Composed):
    """Truntum: star flowers of two sizes, the larger in the middle of the square, the smaller on its corners.

    Stars on a night sky, drawn by a queen of Solo whose love sprang up anew; dots between the petals.
    """

    petal: Annotated[Stars, Says("the flowers")] = field(default_factory=Stars)
    small: Annotated[Dress, Says("look of the smaller flowers, if it names an ink")] = field(
        default_factory=Dress
    )
    vein: Annotated[Isen, Says("look of the lines in the petals")] = field(default_factory=Isen)
    vein_size: Annotated[float, Between(0, 0.5), Says("breadth of the lines, as a share of a petal's")] = 0.26
    ray: Annotated[Dress, Says("look of the dots between the petals")] = field(default_factory=Dress)
    rays: Annotated[int, Between(0, 5), Says("dots between two petals; 0 leaves them out")] = 2
    core: Annotated[Plate, Says("look of the hearts")] = field(default_factory=Plate)
    spark: Annotated[Dress, Says("look of the dots on the square's sides")] = field(default_factory=Dress)
    spark_size: Annotated[float, Between(0, 0.05), Says("radius of these dots; 0 leaves them out")] = 0.016

    def compose(self) -> Iterator[Keyed]:
        """Yield dots, petals of both sizes, and the hearts."""
        petals = self.petal
        if self.spark_size:
            sparks = [*rings(4, SIDES, 2.1 * self.spark_size, self.spark_size), *dots(SIDES, self.spark_size)]
            yield part("spark", self.spark, sparks)
        for size, at, key, look in (
            (petals.size, np.zeros((1, 2)), "petal", petals),
            (petals.size * petals.least, CORNER, "small", self.small if self.small.ink else petals),
        ):
            blade = Blade(0.86 * size, petals.width * size, 1.15, 0.85)
            root, step = 0.14 * size, 180 / petals.petals
            if self.rays:
                out = size * (0.62 + 0.3 * np.arange(self.rays) / max(self.rays - 1, 1))
                spots = [
                    dot
                    for r in out.tolist()
                    for dot in rings(petals.petals, at, r, 0.05 * size * r / size, 90 + step)
                ]
                yield part("ray", self.ray, spots)
            yield part(key, look, wreath(outline_of(blade), petals.petals, at, root))
            if self.vein_size:
                line = rib(blade, 0.36, 0.84, self.vein_size * blade.width)
                yield part("vein", self.vein, wreath(line, petals.petals, at, root))
            yield part("core", self.core, rings(1, at, 0.0, 0.15 * size))


@frozen(kw_only=True)
class Ceplok(Composed):
    """Ceplok: a rosette in a square, petals to the sides and leaves to the corners, flowers between.

    Ground plans of flowers seen from above, set close in rows: the largest family of geometric batik.
    """

    frame: Annotated[Dress, Says("look of the lozenge's frame about the rosette")] = field(
        default_factory=Dress
    )
    frame_size: Annotated[float, Between(0, 0.06), Says("half its breadth; 0 leaves it out")] = 0.012
    leaf: Annotated[Plate, Says("look of the leaves to the corners")] = field(default_factory=Plate)
    petal: Annotated[Plate, Says("look of the petals to the sides")] = field(default_factory=Plate)
    petals: Annotated[int, Between(1, 4), Says("petals to each side")] = 1
    vein: Annotated[Isen, Says("look of the lines in leaves and petals")] = field(default_factory=Isen)
    vein_size: Annotated[float, Between(0, 0.5), Says("breadth of the lines, as a share of a petal's")] = 0.24
    wreath: Annotated[Plate, Says("look of the small petals in the middle")] = field(default_factory=Plate)
    count: Annotated[int, Between(4, 24), Says("small petals")] = 8
    core: Annotated[Plate, Says("look of the heart")] = field(default_factory=Plate)
    corner: Annotated[Plate, Says("look of the flowers on the corners")] = field(default_factory=Plate)
    corner_size: Annotated[float, Between(0, 0.4), Says("radius of these; 0 leaves them out")] = 0.19
    cecek: Annotated[Dress, Says("look of the dots along the sides")] = field(default_factory=Dress)
    spots: Annotated[int, Between(0, 12), Says("dots along half a side; 0 leaves them out")] = 4

    def compose(self) -> Iterator[Keyed]:
        """Yield frame and dots, the corners, leaves and petals, and the heart."""
        middle = np.zeros((1, 2))
        if self.frame_size:
            yield part("frame", self.frame, list(self._frame()))
        if self.spots:
            share = 0.12 + 0.3 * np.arange(self.spots) / max(self.spots - 1, 1)
            places = np.vstack([[[0.5, y], [0.5, -y], [y, 0.5], [-y, 0.5]] for y in share.tolist()])
            yield part("cecek", self.cecek, dots(places, min(0.012, 0.1 / self.spots)))
        if self.corner_size:
            petal = outline_of(Blade(0.8 * self.corner_size, 0.3 * self.corner_size, 0.9, 0.6))
            yield part("corner", self.corner, wreath(petal, 8, CORNER, 0.2 * self.corner_size))
            yield part("core", self.core, rings(1, CORNER, 0.0, 0.2 * self.corner_size))
        for key, look, blade, count, turn in (
            ("leaf", self.leaf, Blade(0.42, 0.085, 0.9, 1.1), 4, 45.0),
            ("petal", self.petal, Blade(0.37, 0.32 / (2 + self.petals), 0.9, 0.75), 4 * self.petals, 0.0),
        ):
            turn += 45 * (self.petals - 1) / self.petals if key == "petal" else 0.0
            yield part(key, look, wreath(outline_of(blade), count, middle, 0.06, turn))
            if self.vein_size:
                line = rib(blade, 0.42, 0.86, self.vein_size * blade.width)
                yield part("vein", self.vein, wreath(line, count, middle, 0.06, turn))
        small = outline_of(Blade(0.14, min(0.1, 0.48 / self.count), 0.9, 0.55))
        yield part("wreath", self.wreath, wreath(small, self.count, middle, 0.04))
        yield part("core", self.core, Circle(0.055))

    def _frame(self) -> Iterator[Outline]:
        """Yield the two rings of a lozenge whose corners are the middles of the sides, hollow a little."""
        for size, sense in ((0.47 + self.frame_size, 1.0), (0.47 - self.frame_size, -1.0)):
            yield lozenge(size, size, 0.1).moved((1.0, 0.0, 0.0, sense, 0.0, 0.0))


@frozen(kw_only=True)
class Jlamprang(Composed):
    """Jlamprang: eight-cornered stars of small blocks about a flower, set as on double ikat.

    The *patola* of Gujarat in wax, from Pekalongan: what threads do in steps, square blocks imitate.
    """

    ray: Annotated[Plate, Says("look of the star's points")] = field(default_factory=Plate)
    block: Annotated[Isen, Says("look of the blocks round the star")] = field(default_factory=Isen)
    rings: Annotated[int, Between(1, 6), Says("rings of blocks")] = 3
    blocks: Annotated[int, Between(1, 6), Says("blocks of the outmost ring to an eighth")] = 4
    petal: Annotated[Plate, Says("look of the eight petals")] = field(default_factory=Plate)
    slit: Annotated[Isen, Says("look of the slits in the petals")] = field(default_factory=Isen)
    core: Annotated[Plate, Says("look of the heart")] = field(default_factory=Plate)
    corner: Annotated[Plate, Says("look of the lozenges on the corners")] = field(default_factory=Plate)
    cross: Annotated[Isen, Says("look of the blocks in these")] = field(default_factory=Isen)
    corner_size: Annotated[float, Between(0.03, 0.3), Says("radius of these")] = 0.2

    def compose(self) -> Iterator[Keyed]:
        """Yield the corners, the star with its blocks, and the flower in its middle."""
        middle = np.zeros((1, 2))
        size = self.corner_size
        yield part("corner", self.corner, wreath(lozenge(size, size, 0.0), 1, CORNER, 0.0))
        steps = np.array([[x, y] for x in range(-2, 3) for y in range(-2, 3) if abs(x) + abs(y) <= 2])
        blocks = [
            lozenge(0.13 * size, 0.13 * size, 0.0).moved(similar(0.0, 1.0, (0.5 + x, 0.5 + y)))
            for x, y in (0.3 * size * steps).tolist()
        ]
        yield part("cross", self.cross, blocks)
        yield part("ray", self.ray, self._star())
        yield part("block", self.block, list(self._blocks()))
        petal = Blade(0.19, 0.07, 0.8, 0.9)
        yield part("petal", self.petal, wreath(outline_of(petal), 8, middle, 0.03))
        yield part("slit", self.slit, wreath(rib(petal, 0.35, 0.85, 0.24 * petal.width), 8, middle, 0.03))
        yield part("core", self.core, Circle(0.05))

    def _star(self) -> Outline:
        """Return two squares over one another: an octagram whose points end before the sides."""
        angle = np.pi * np.arange(16) / 8
        radius = np.where(np.arange(16) % 2, OCTAGRAM * 0.49, 0.49)
        return polyline(radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)]), True)

    def _blocks(self) -> Iterator[Outline]:
        room = (0.44 * OCTAGRAM * 1.12 - 0.25) / self.rings
        for ring in range(self.rings):
            radius = 0.25 + room * (ring + 0.5)
            count = 8 * max(1, self.blocks - (self.rings - 1 - ring) // 2)
            half = min(0.36 * room, 0.36 * 2 * np.pi * radius / count) * 1.2
            for k in range(count):
                at = similar(90 + 360 * (k + 0.5) / count)
                yield lozenge(half, half, 0.0).moved(similar(0.0, 1.0, (radius, 0.0))).moved(at)


OCTAGRAM = 0.7653668647301796
"""Where the sides of two squares over one another cross, as a share of their corners' radius: √(2 − √2)."""
