"""Butterflies: wings by an iterated function system of curves, and wings of the polar butterfly curve."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field, replace
from typing import Annotated, TypeAlias

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves import Blade, Butterfly, Circle, Superellipse
from batik_vector.geometry.paths.bands import curl
from batik_vector.geometry.paths.matrix import Matrix, times
from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.sampling import Array, Points
from batik_vector.recipe.look import Dress, Treatment
from batik_vector.recipe.motifs.composing import (
    Composed,
    Isen,
    Keyed,
    Plate,
    dots,
    outline_of,
    part,
    similar,
    stroke,
)
from batik_vector.values import frozen

HEAD_UP = 90.0
"""Degrees: butterflies are drawn with their heads along +x, where a mirror is exact, and turned."""


BodyLength: TypeAlias = Annotated[float, Between(0.05, 3), Says("from the neck to the tail")]
BodyWidth: TypeAlias = Annotated[float, Between(0.01, 0.5), Says("half its breadth")]
Rings: TypeAlias = Annotated[int, Between(0, 24), Says("rings of the abdomen; 0 leaves them out")]
FeelerLength: TypeAlias = Annotated[float, Between(0, 3), Says("length; 0 leaves them out")]
FeelerWidth: TypeAlias = Annotated[float, Between(0.002, 0.2), Says("half their breadth")]
Knob: TypeAlias = Annotated[
    float, Between(0, 0.3), Says("radius of the knobs at their ends; 0 leaves them out")
]
Lobes: TypeAlias = Annotated[
    int, Between(1, 12), Says("images of the curve in a wing: the lobes of its margin")
]
LobeLength: TypeAlias = Annotated[float, Between(0.05, 3), Says("length of the longest lobe")]
Least: TypeAlias = Annotated[float, Between(0.2, 1), Says("length of the shortest, as a share of it")]
Begin: TypeAlias = Annotated[float, Between(0, 180), Says("degrees from the head to the first lobe's middle")]
End: TypeAlias = Annotated[float, Between(0, 180), Says("degrees from the head to the last lobe's middle")]
Longest: TypeAlias = Annotated[
    float, Between(0, 1), Says("where in the fan the longest lobe is: 0 first, 1 last")
]


@frozen(kw_only=True)
class Body(Plate):
    """The body of a butterfly: thorax and abdomen, and the head before them."""

    length: BodyLength = 0.86
    width: BodyWidth = 0.075
    rings: Rings = 5


@frozen(kw_only=True)
class Feeler(Dress):
    """The feelers: two tendrils that curl outwards."""

    length: FeelerLength = 0.62
    width: FeelerWidth = 0.018
    turn: Annotated[float, Between(-400, 400), Says("degrees by which they curl")] = 215.0
    knob: Knob = 0.034


@frozen(kw_only=True)
class Wing(Plate):
    """A pair of wings: one curve, and its images in a fan of lobes."""

    lobes: Lobes = 5
    length: LobeLength = 1.0
    least: Least = 0.7
    begin: Begin = 38.0
    end: End = 86.0
    longest: Longest = 0.2
    overlap: Annotated[
        float, Between(0.5, 3), Says("breadth of a lobe, as a share of its place in the fan")
    ] = 1.25

    def maps(self) -> list[Matrix]:
        """Return the maps of the fan: similarities about the root, from the head on."""
        share = np.arange(self.lobes) / max(self.lobes - 1, 1)
        away = np.abs(share - self.longest) / max(self.longest, 1 - self.longest)
        sizes = self.length * (1 - (1 - self.least) * away**1.6)
        angles = self.begin + (self.end - self.begin) * share
        return [similar(a, s) for a, s in zip(angles.tolist(), sizes.tolist(), strict=True)]

    def curve(self) -> Outline:
        """Return the curve whose images the lobes are, 1 long."""
        step = np.radians(abs(self.end - self.begin) / max(self.lobes - 1, 1)) if self.lobes > 1 else 0.6
        # Broadest at its outer part, where neighbours in the fan stand this far apart.
        width = float(np.clip(self.overlap * FULLEST * np.sin(step / 2), 0.02, 0.6))
        return outline_of(Blade(1.0, width, BASE, TIP))


BASE, TIP = 1.35, 0.42
"""Powers of a lobe's outline: drawn out to the root, round at the margin."""
FULLEST = BASE / (BASE + TIP)


@frozen(kw_only=True)
class HindWing(Wing):
    """The hind wings, likewise."""

    lobes: Lobes = 4
    length: LobeLength = 0.78
    least: Least = 0.72
    begin: Begin = 112.0
    end: End = 160.0
    longest: Longest = 0.6


@frozen(kw_only=True)
class ButterflyMotif(Composed):
    """Butterfly with wings by an iterated function system of curves; head up, a fore wing about 1 long.

    A wing is the union of the images of one curve under similarities about its root, S ← ⋃ F_i(S): a fan of
    lobes. The same maps, squeezed into every lobe, draw a smaller fan in it, and once more in that one: as
    many times as ``level`` says, in turn bare and waxed. After Yuan, Lv and Huang 2016 (the paper's
    reference 28), who make butterflies of curves by iterated functions.
    """

    fore: Annotated[Wing, Says("the fore wings")] = field(default_factory=Wing)
    hind: Annotated[HindWing, Says("the hind wings")] = field(default_factory=HindWing)
    level: Annotated[int, Between(1, 3), Says("how often the maps are applied; 1 draws lobes alone")] = 2
    cell: Annotated[Isen, Says("look of the cells in the lobes: the fans of level 2")] = field(
        default_factory=Isen
    )
    cell_size: Annotated[float, Between(0.1, 0.9), Says("breadth of a cell, as a share of its lobe's")] = 0.52
    isen: Annotated[Dress, Says("look of the fans of level 3 in the cells")] = field(default_factory=Dress)
    spot: Annotated[Isen, Says("look of the dots along the margin")] = field(default_factory=Isen)
    spot_size: Annotated[float, Between(0, 0.2), Says("radius of these dots; 0 leaves them out")] = 0.03
    body: Annotated[Body, Says("body and head")] = field(default_factory=Body)
    feeler: Annotated[Feeler, Says("the feelers")] = field(default_factory=Feeler)

    def compose(self) -> Iterator[Keyed]:
        """Yield the hind wings, the fore wings over them, and the body over both."""
        yield from _feelers(self.feeler, self.body, NECK)
        for key, wing in (("hind", self.hind), ("fore", self.fore)):
            yield from self._wing(key, wing)
        yield from _body(self.body, NECK)

    def _wing(self, key: str, wing: Wing) -> Iterator[Keyed]:
        maps, curve = wing.maps(), wing.curve()
        yield part(key, wing, [curve.moved(f) for f in maps], mirror=True, turn=HEAD_UP)
        if self.level > 1:
            within: Matrix = (0.84 - CELL, 0.0, 0.0, self.cell_size, CELL, 0.0)
            cells = [times(f, within) for f in maps]
            yield part("cell", self.cell, [curve.moved(f) for f in cells], mirror=True, turn=HEAD_UP)
        if self.level > 2:
            rays = [curve.moved(times(f, g)) for f in cells for g in _slim(wing, maps)]
            yield part("isen", self.isen, rays, mirror=True, turn=HEAD_UP)
        if self.spot_size:
            at = np.array([[f[0] * SPOT + f[4], f[1] * SPOT + f[5]] for f in maps])
            yield part("spot", self.spot, dots(at, self.spot_size), mirror=True, turn=HEAD_UP)


NECK, POLAR_NECK = 0.34, 0.52
"""How far before the roots of the wings the neck is, as a share of the body's length. The polar curve has a
lobe between its fore wings, which the body covers."""
CELL = 0.24
"""Where the cell in a lobe begins, as a share of its length: nearer to the root no line would be left."""
MANY = 4
"""More lines than that in a cell no canting draws."""
RAYS = 0.7
"""How much of a cell's breadth the fan in it has."""
SPOT = 0.9
"""Where the dot of a lobe stands, as a share of its length."""


def _slim(wing: Wing, maps: list[Matrix]) -> list[Matrix]:
    """Return the maps of a fan made so slim that it lies within a lobe; of many lobes every other."""
    few = maps if wing.lobes <= MANY else maps[::2]
    middle = (wing.begin + wing.end) / 2 if wing.lobes > 1 else wing.begin
    widest = float(wing.curve().points[:, 1].max())
    found: list[Matrix] = []
    for f in few:
        angle = np.arctan2(f[1], f[0]) - np.radians(middle)
        reach = float(np.hypot(f[0], f[1])) / wing.length
        spread = max(abs(wing.end - wing.begin) / 2, 1.0)
        # Along the lobe as long as in the fan, across it at its place in the lobe's breadth.
        lean = np.degrees(angle) / spread * RAYS * widest / FULLEST
        found.append(similar(float(np.degrees(np.arctan(lean))), 1.0))
        thin: Matrix = (0.6 * reach, 0.0, 0.0, 0.95 * RAYS / len(few), 0.3, 0.0)
        found[-1] = times(found[-1], thin)
    return found


def _body(body: Body, at_neck: float) -> Iterator[Keyed]:
    """Yield abdomen, thorax and head along the x axis, turned up."""
    long, width, neck = body.length, body.width, body.length * at_neck
    middle = neck - 0.5 * long
    yield part("body", body, Superellipse(1.0, 1.15, long / 2, width), radius=middle, turn=HEAD_UP)
    if body.rings:
        at = middle + 0.06 * long - np.arange(body.rings) * (0.42 * long / body.rings)
        slit = 0.11 * long / body.rings
        # As far as the body reaches there, and a little into the bare line about it.
        away = np.abs(at - middle) / (0.5 * long)
        reach = 1.06 * width * np.maximum(1 - away**2, 0.05) ** 0.575
        rings = [
            stroke(np.array([[x - 0.3 * y, -y], [x, 0.0], [x - 0.3 * y, y]]), slit, slit)
            for x, y in zip(at.tolist(), reach.tolist(), strict=True)
        ]
        yield part("ring", Isen(), rings, turn=HEAD_UP)
    yield part("head", body, Circle(1.15 * width), radius=neck + 0.6 * width, turn=HEAD_UP)
    yield part("eye", Isen(), dots(_pair(neck + 0.8 * width, 0.5 * width), 0.26 * width), turn=HEAD_UP)


def _pair(x: float, y: float) -> Array:
    return np.array([[x, y], [x, -y]])


def _feelers(feeler: Feeler, body: Body, at_neck: float) -> Iterator[Keyed]:
    if not feeler.length:
        return
    root = (at_neck * body.length + 1.2 * body.width, 0.35 * body.width)
    centre = curl(feeler.length, feeler.turn, 3.0)
    line = stroke(centre, feeler.width, feeler.width * 0.8)
    shapes = [line, *(dots(centre[-1:], feeler.knob) if feeler.knob else [])]
    place = similar(10.0, 1.0, root)
    yield part("feeler", feeler, [each.moved(place) for each in shapes], mirror=True, turn=HEAD_UP)


@frozen(kw_only=True)
class PolarBody(Body):
    """The body, likewise: it covers the lobe that the curve has between its fore wings."""

    length: BodyLength = 0.98
    width: BodyWidth = 0.082
    rings: Rings = 6


@frozen(kw_only=True)
class PolarFeeler(Feeler):
    """The feelers, likewise."""

    length: FeelerLength = 0.46
    width: FeelerWidth = 0.015
    knob: Knob = 0.03


@frozen(kw_only=True)
class Heart(Isen):
    """The inmost band: waxed unless it says otherwise."""

    def settled(self) -> Dress:
        """Return its look, filled where no treatment is named."""
        return replace(self, treatment=self.treatment or Treatment.AREA).plain()


@frozen(kw_only=True)
class PolarButterfly(Composed):
    """Butterfly of the polar curve r = e^sin t − wings·cos 4t + level, one within another; the head is up.

    The bands between two levels are waxed and left bare in turn, and the broad ones hold rows of dots. The
    levels are those between which the twelve turns of the whole curve run: see the curve ``butterfly``.
    T. H. Fay, "The Butterfly Curve", American Mathematical Monthly 96 (1989) 442–443.
    """

    wings: Annotated[float, Between(1.8, 6), Says("how deeply the wings are parted")] = 2.0
    bands: Annotated[int, Between(1, 12), Says("bands from the margin inwards, waxed and bare in turn")] = 5
    inmost: Annotated[float, Between(-1, 0.9), Says("level of the inmost band; the margin's is 1")] = -0.55
    weight: Annotated[float, Between(0.2, 4), Says("breadth of a waxed band, in bare ones")] = 1.6
    wing: Annotated[Plate, Says("look of the margin, and of every second band within it")] = field(
        default_factory=Plate
    )
    cell: Annotated[Isen, Says("look of the bands between")] = field(default_factory=Isen)
    heart: Annotated[Heart, Says("look of the inmost band")] = field(default_factory=Heart)
    spots: Annotated[int, Between(0, 40), Says("dots in a fore wing's inmost band; 0 leaves them out")] = 7
    spot: Annotated[Isen, Says("look of these dots")] = field(default_factory=Isen)
    spot_size: Annotated[float, Between(0.002, 0.2), Says("radius of these dots")] = 0.026
    body: Annotated[PolarBody, Says("body and head")] = field(default_factory=PolarBody)
    feeler: Annotated[PolarFeeler, Says("the feelers")] = field(default_factory=PolarFeeler)

    def levels(self) -> list[float]:
        """Return the levels of the bands' outer edges, from the margin inwards."""
        steps = np.array([self.weight if k % 2 == 0 else 1.0 for k in range(self.bands - 1)])
        total = max(float(steps.sum()), 1.0)
        return [1.0, *(1 - (1 - self.inmost) * np.cumsum(steps) / total).tolist()]

    def compose(self) -> Iterator[Keyed]:
        """Yield the bands, each on the one round it, the dots on the inmost, and the body on all."""
        yield from _feelers(self.feeler, self.body, POLAR_NECK)
        for number, level in enumerate(self.levels()):
            inmost = number == self.bands - 1 and number > 0
            key = "cell" if number % 2 else "heart" if inmost else "wing"
            look: Dress = {"cell": self.cell, "heart": self.heart, "wing": self.wing}[key]
            if key == "wing" and number:
                look = replace(look, gap=0.0)
            yield part(key, look, Butterfly(1.0, self.wings, 0.0, level))
        if self.spots:
            yield part("spot", self.spot, dots(self._row(), self.spot_size), mirror=True, turn=HEAD_UP)
        yield from _body(self.body, POLAR_NECK)

    def _row(self) -> Points:
        """Return places along the middle of the inmost band of the left wings, head along +x."""
        angle = np.radians(np.linspace(1, 89, 400))
        inner = Butterfly(1.0, self.wings, 0.0, self.levels()[-1] - ROW)
        # The curve begins at the head, which is up: its places here are as seen with the head along +x.
        line = inner.at(angle / (2 * np.pi))
        place = line[:, 1] - 1j * line[:, 0]
        # The small lobes beside are drawn where the radius is negative.
        out = (place * np.exp(-1j * angle)).real
        kept = place[out > 0.42 * out.max()]
        along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(kept)))])
        at = (np.arange(self.spots) + 0.5) / self.spots * along[-1]
        return np.column_stack([np.interp(at, along, kept.real), np.interp(at, along, kept.imag)])


ROW = 0.6
"""How far the row of dots lies within the inmost band's edge, as a level."""
