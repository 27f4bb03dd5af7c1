"""The leaf: a blade with a midrib and side veins that run to its margin as powers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field
from typing import Annotated

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves import Blade
from batik_vector.geometry.paths.outline import Outline
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
    stroke,
)
from batik_vector.values import frozen


@frozen(kw_only=True)
class LeafBlade(Plate):
    """The blade of a leaf."""

    width: Annotated[float, Between(0.02, 0.8), Says("half its breadth; it is 1 long")] = 0.27
    base: Annotated[float, Between(0.35, 4), Says("power at its base: below 1 round, above drawn out")] = 0.75
    tip: Annotated[float, Between(0.35, 4), Says("power at its tip, likewise")] = 1.15
    bend: Annotated[float, Between(-65, 65), Says("degrees by which it bends, to the left")] = 24.0
    teeth: Annotated[int, Between(0, 40), Says("teeth along each side; 0 leaves it smooth")] = 0
    depth: Annotated[float, Between(0, 0.5), Says("depth of the teeth, as a share of the breadth")] = 0.14


@frozen(kw_only=True)
class Veins(Isen):
    """The veins: a midrib, and pairs of side veins along u = u₀ + reach·v^power, v from midrib to margin."""

    pairs: Annotated[int, Between(0, 24), Says("pairs of side veins")] = 6
    reach: Annotated[float, Between(0.02, 0.5), Says("how far ahead they meet the margin, in lengths")] = 0.17
    power: Annotated[float, Between(0.5, 4), Says("how they run: 1 straight, above bent to the tip")] = 1.5
    weight: Annotated[float, Between(0.002, 0.06), Says("half the breadth of the midrib at its base")] = 0.017


@frozen(kw_only=True)
class LeafMotif(Composed):
    """Leaf that points along +x, its blade 1 long; the stalk lies behind.

    As its sides bend, so do its veins; between them rows of dots may stand.
    """

    stalk: Annotated[Dress, Says("look of the stalk")] = field(default_factory=Dress)
    stalk_length: Annotated[float, Between(0, 1), Says("length of the stalk; 0 leaves it out")] = 0.2
    blade: Annotated[LeafBlade, Says("the blade")] = field(default_factory=LeafBlade)
    vein: Annotated[Veins, Says("the veins")] = field(default_factory=Veins)
    spot: Annotated[Isen, Says("look of dots between the veins")] = field(default_factory=Isen)
    spot_size: Annotated[float, Between(0, 0.05), Says("radius of these dots; 0 leaves them out")] = 0.0

    def compose(self) -> Iterator[Keyed]:
        """Yield the stalk, the blade and its veins."""
        yield from centred(self._drawn())

    def _drawn(self) -> Iterator[Keyed]:
        look, veins = self.blade, self.vein
        blade = Blade(1.0, look.width, look.base, look.tip, look.bend, 0.0, look.teeth, look.depth)
        if self.stalk_length:
            back = np.linspace(0.06, -self.stalk_length, 6)
            line = np.column_stack([back, -0.3 * look.bend / 65 * back**2])
            yield part("stalk", self.stalk, stroke(line, 1.3 * veins.weight, 2.1 * veins.weight))
        yield part("blade", look, outline_of(blade, 12 + 3 * look.teeth))
        yield part("vein", veins, list(self._veins(blade)))
        if self.spot_size and veins.pairs:
            yield part("spot", self.spot, list(self._spots(blade)))

    def _veins(self, blade: Blade) -> Iterator[Outline]:
        veins = self.vein
        yield stroke(on(blade, np.linspace(0.02, 0.93, 9), 0.0), veins.weight, 0.25 * veins.weight)
        across = np.linspace(0.04, 0.84, 7)
        for begin in self._roots():
            # Where the leaf is slim, so are they.
            half = veins.weight * (0.35 + 0.4 * float(blade.half(np.array([begin + 0.05]))[0]) / blade.width)
            for side in (1.0, -1.0):
                line = on(blade, begin + veins.reach * across**veins.power, side * across)
                yield stroke(line, half, 0.4 * half)

    def _roots(self) -> list[float]:
        """Return where the side veins leave the midrib."""
        last = 0.86 - self.vein.reach
        return np.linspace(0.1, max(last, 0.12), self.vein.pairs).tolist() if self.vein.pairs else []

    def _spots(self, blade: Blade) -> Iterator[Outline]:
        roots = self._roots()
        gap = (roots[1] - roots[0]) / 2 if len(roots) > 1 else 0.1
        across = np.array([0.32, 0.6])
        for begin in roots[:-1] or roots:
            for side in (1.0, -1.0):
                places = on(blade, begin + gap + self.vein.reach * across**self.vein.power, side * across)
                yield from dots(places, self.spot_size)
