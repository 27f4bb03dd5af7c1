"""Blossoms seen from above: the chrysanthemum in wreaths, and the sunflower with its spiral of seeds."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import field
from typing import Annotated

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves import Blade, Circle
from batik_vector.geometry.paths.outline import Outline
from batik_vector.recipe.look import Dress
from batik_vector.recipe.motifs.composing import Composed, Isen, Keyed, Plate, dots, part, rib
from batik_vector.values import frozen

GOLDEN = 180 * (3 - math.sqrt(5))
"""The golden angle, in degrees: 137.508."""


@frozen(kw_only=True)
class ChrysanthemumPetals(Plate):
    """The petals of a chrysanthemum: wreaths one on another, each petal between two of the wreath beneath."""

    wreaths: Annotated[int, Between(1, 6), Says("wreaths")] = 3
    count: Annotated[int, Between(3, 64), Says("petals of a wreath")] = 16
    least: Annotated[
        float, Between(0.2, 1), Says("reach of the inmost wreath, as a share of the outmost's")
    ] = 0.5
    broad: Annotated[
        float, Between(0.2, 1), Says("breadth of a petal, as a share of its place in the wreath")
    ] = 0.86
    bend: Annotated[float, Between(-70, 70), Says("degrees by which petals bend; 0 keeps the mirrors")] = 0.0


@frozen(kw_only=True)
class Chrysanthemum(Composed):
    """Chrysanthemum from above: wreaths of blades about a heart of dots; a petal's tip is 1 from the centre.

    With straight petals it has the symmetry Dn of its wreaths, n petals each.
    """

    petal: Annotated[ChrysanthemumPetals, Says("the petals")] = field(default_factory=ChrysanthemumPetals)
    inner: Annotated[Plate, Says("look of every second wreath, if it names an ink")] = field(
        default_factory=Plate
    )
    vein: Annotated[Isen, Says("look of the lines in the petals")] = field(default_factory=Isen)
    vein_size: Annotated[float, Between(0, 0.6), Says("breadth of the lines, as a share of a petal's")] = 0.22
    core: Annotated[Plate, Says("look of the heart")] = field(default_factory=Plate)
    core_size: Annotated[float, Between(0.02, 0.6), Says("radius of the heart")] = 0.2
    stamen: Annotated[Isen, Says("look of the dots on it")] = field(default_factory=Isen)
    rings: Annotated[int, Between(0, 6), Says("rings of dots; 0 leaves them out")] = 2

    def compose(self) -> Iterator[Keyed]:
        """Yield the wreaths from the outmost, the lines in each, and the heart."""
        petals = self.petal
        for wreath in range(petals.wreaths):
            reach = 1 - (1 - petals.least) * wreath / max(petals.wreaths - 1, 1)
            odd = wreath % 2 == 1
            key, look = ("inner", self.inner) if odd and self.inner.ink else ("petal", petals)
            # Two neighbours meet where each is broadest, at a share m = base/(base + tip) of its length.
            middle = reach * BASE / (BASE + TIP)
            width = petals.broad * middle * math.tan(math.pi / petals.count)
            blade = Blade(reach, width, BASE, TIP, petals.bend)
            turn = 90 + (180 / petals.count if odd else 0.0)
            yield part(key, look, blade, name="petal", count=petals.count, turn=turn)
            if self.vein_size:
                line = rib(blade, 0.42, 0.86, self.vein_size * width)
                yield part("vein", self.vein, line, count=petals.count, turn=turn)
        yield part("core", self.core, Circle(self.core_size))
        yield from self._stamens()

    def _stamens(self) -> Iterator[Keyed]:
        size = self.core_size / (2.4 * self.rings + 1.2) if self.rings else 0.0
        for ring in range(self.rings, 0, -1):
            radius = self.core_size * (ring / (self.rings + 0.42))
            # As many as keep the symmetry of the petals and do not touch.
            most = int(2 * math.pi * radius / (2.6 * size))
            count = next(
                (n for n in range(self.petal.count, 0, -1) if self.petal.count % n == 0 and n <= most), 1
            )
            turn = 90 + (180 / count if ring % 2 else 0.0)
            yield part("stamen", self.stamen, Circle(size), count=count, radius=radius, turn=turn)
        if self.rings:
            yield part("stamen", self.stamen, Circle(1.15 * size))


BASE, TIP = 1.5, 0.42


@frozen(kw_only=True)
class Rays(Plate):
    """The ray petals of a sunflower, in two wreaths."""

    count: Annotated[int, Between(3, 64), Says("rays of a wreath")] = 21
    broad: Annotated[float, Between(0.2, 2), Says("breadth of a ray, as a share of its place")] = 1.0
    point: Annotated[float, Between(0.4, 3), Says("how pointed they are: below 1 round")] = 0.9


@frozen(kw_only=True)
class Seeds(Isen):
    """The seeds, r = c·√k at k times the golden angle. Vogel, "A better way to construct the sunflower head",
    Mathematical Biosciences 44 (1979) 179–189.
    """

    count: Annotated[int, Between(1, 1500), Says("seeds")] = 144
    size: Annotated[float, Between(0.2, 0.98), Says("diameter of a seed, as a share of its room")] = 0.76
    grow: Annotated[float, Between(0, 1), Says("how much smaller they are towards the middle")] = 0.35


@frozen(kw_only=True)
class Sunflower(Composed):
    """Sunflower from above: two wreaths of rays about seeds on Vogel's spiral; 1 from centre to tip."""

    back: Annotated[Plate, Says("look of the rays behind, if it names an ink")] = field(default_factory=Plate)
    petal: Annotated[Rays, Says("the rays")] = field(default_factory=Rays)
    vein: Annotated[Isen, Says("look of the lines in the rays")] = field(default_factory=Isen)
    vein_size: Annotated[float, Between(0, 0.6), Says("breadth of these lines, as a share of a ray's")] = 0.2
    disc: Annotated[Plate, Says("look of the disc that the seeds lie on")] = field(default_factory=Plate)
    disc_size: Annotated[float, Between(0.1, 0.9), Says("radius of the disc")] = 0.56
    seed: Annotated[Seeds, Says("the seeds")] = field(default_factory=Seeds)

    def compose(self) -> Iterator[Keyed]:
        """Yield the rays behind, those before them, the disc and its seeds."""
        rays, root = self.petal, 0.7 * self.disc_size
        length = 1 - root
        middle = rays.point / (0.8 + rays.point)
        width = rays.broad * (root + length * (1 - middle)) * math.tan(math.pi / rays.count) * 0.8
        blade = Blade(length, min(width, length), 0.8, rays.point)
        behind: Dress = self.back if self.back.ink else rays
        half = 180 / rays.count
        for key, look, turn in (("back", behind, 90 + half), ("petal", rays, 90.0)):
            yield part(key, look, blade, name="petal", count=rays.count, radius=root, turn=turn)
            if self.vein_size:
                line = rib(blade, 0.5, 0.88, self.vein_size * width)
                yield part("vein", self.vein, line, count=rays.count, radius=root, turn=turn)
        yield part("disc", self.disc, Circle(self.disc_size))
        yield part("seed", self.seed, self._spiral())

    def _spiral(self) -> list[Outline]:
        seeds = self.seed
        number = np.arange(seeds.count) + 0.5
        # Each has the same share of the disc, π·c².
        room = 0.93 * self.disc_size / math.sqrt(seeds.count)
        angle = np.radians(GOLDEN) * np.arange(seeds.count)
        radius = room * np.sqrt(number)
        size = 0.5 * seeds.size * room * NEAREST * (1 - seeds.grow * (1 - number / seeds.count))
        return dots(np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]), size)


NEAREST = 1.63
"""Distance of neighbours on Vogel's spiral, in c: 1.65 to 1.9 but for the inmost few."""
