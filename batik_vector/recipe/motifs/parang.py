"""The parang: bands of interlocking blades that run aslant, with rows of *mlinjon* lozenges between them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field
from typing import Annotated

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.paths.bands import band
from batik_vector.geometry.paths.outline import Outline, box
from batik_vector.geometry.sampling import Array, Points
from batik_vector.recipe.look import Dress
from batik_vector.recipe.motifs.composing import Banded, Isen, Keyed, Plate, dot, part, similar
from batik_vector.recipe.motifs.rows import lozenge
from batik_vector.values import frozen


@frozen(kw_only=True)
class ParangBlade(Plate):
    """The blades of a parang: an S that hooks at both ends, one in each link."""

    full: Annotated[float, Between(0.1, 0.9), Says("breadth, as a share of the room to the next blade")] = 0.7
    lean: Annotated[float, Between(50, 140), Says("degrees between its middle and the band")] = 118.0
    hook: Annotated[float, Between(0, 230), Says("degrees by which each end turns back")] = 145.0
    power: Annotated[float, Between(1, 5), Says("how late it turns: 1 evenly, above at its ends")] = 2.3
    belly: Annotated[float, Between(-0.6, 1.5), Says("how much broader it is towards its ends")] = 0.35


@frozen(kw_only=True)
class Tongue(Dress):
    """The flame between two blades (*uceng*): the blade's line, slimmer and shorter."""

    length: Annotated[float, Between(0, 0.95), Says("share of the blade's line; 0 leaves it out")] = 0.62
    full: Annotated[float, Between(0.05, 0.9), Says("breadth, as a share of the room left")] = 0.6


@frozen(kw_only=True)
class Mlinjon(Dress):
    """The row of lozenges between two bands (*mlinjon*), named after the fruit of *Gnetum gnemon*."""

    height: Annotated[float, Between(0, 0.6), Says("height of the row, in links; 0 leaves it out")] = 0.3
    count: Annotated[int, Between(1, 12), Says("lozenges to a link")] = 2
    full: Annotated[float, Between(0.1, 0.95), Says("size of a lozenge, as a share of its room")] = 0.74
    bow: Annotated[
        float, Between(-0.6, 0.6), Says("how far its sides bow out; below 0 they are hollow")
    ] = -0.08


@frozen(kw_only=True)
class Parang(Banded):
    """Parang, one link of a band from x = 0 to 1; ``stripes`` with ``fit`` lays bands side by side.

    A blade's line turns by hook·s^power at a share s of the way from its middle to either end, so that it is
    its own image under a half turn. Across the line it is as broad as the room to the next one allows, the
    sine of the direction. Its defaults are *parang rusak*; a hook of 70 with a lean of 105 gives the soft
    blades of *klitik*. Bands run at 45° as a rule, with rows of lozenges between them
    (https://infobatik.id/bentuk-dasar-pola-parang-rusak-barong/ names the parts).
    """

    breadth: Annotated[float, Between(0.5, 6), Says("of the band with its row of lozenges, in links")] = 2.05
    ground: Annotated[Dress, Says("look of the ground under the lozenges, if it names an ink")] = field(
        default_factory=Dress
    )
    blade: Annotated[ParangBlade, Says("the blades")] = field(default_factory=ParangBlade)
    spine: Annotated[Isen, Says("look of the line within a blade")] = field(default_factory=Isen)
    spine_size: Annotated[
        float, Between(0, 0.8), Says("breadth of this line, as a share of the blade's; 0 leaves it out")
    ] = 0.45
    gareng: Annotated[Dress, Says("look of the eyes (*mata gareng*) in the crooks of the blades")] = field(
        default_factory=Dress
    )
    gareng_size: Annotated[
        float, Between(0, 0.12), Says("radius of the eyes, in links; 0 leaves them out")
    ] = 0.045
    tongue: Annotated[Tongue, Says("the flames between the blades")] = field(default_factory=Tongue)
    rule: Annotated[Dress, Says("look of the rules beside the lozenges (*sujen*)")] = field(
        default_factory=Dress
    )
    rule_size: Annotated[
        float, Between(0, 0.12), Says("half the breadth of a rule, in links; 0 leaves them out")
    ] = 0.026
    mlinjon: Annotated[Mlinjon, Says("the lozenges")] = field(default_factory=Mlinjon)
    pip: Annotated[Isen, Says("look of the dots in the lozenges")] = field(default_factory=Isen)
    pip_size: Annotated[
        float,
        Between(0, 0.5),
        Says("radius of these dots, as a share of a lozenge's height; 0 leaves them out"),
    ] = 0.14

    @property
    def across(self) -> float:
        """How broad the band is, in links."""
        return self.breadth

    def compose(self) -> Iterator[Keyed]:
        """Yield the ground of the row, rules and lozenges, then flames and blades and what is in them."""
        mlinjon = self.mlinjon
        middle, row = self.breadth / 2, min(mlinjon.height, 0.6 * self.breadth)
        if mlinjon.height:
            if self.ground.ink:
                yield part("ground", self.ground, box(0.0, middle - row / 2, 1.0, row))
            yield part("mlinjon", mlinjon, list(self._lozenges(middle, row)))
            if self.pip_size:
                size = self.pip_size * row * mlinjon.full
                pips = [dot((x, middle), size) for x in self._places()]
                yield part("pip", self.pip, pips)
        if self.rule_size:
            half = min(self.rule_size, 0.2 * self.breadth)
            rules = [
                box(0.0, y - half, 1.0, 2 * half)
                for y in ((middle - row / 2, row / 2 - middle) if row else (middle,))
            ]
            yield part("rule", self.rule, rules)
        yield from self._blades((self.breadth - row) / 2 - 2.2 * self.rule_size)

    def _places(self) -> list[float]:
        places: list[float] = ((np.arange(self.mlinjon.count) + 0.5) / self.mlinjon.count).tolist()
        return places

    def _lozenges(self, middle: float, row: float) -> Iterator[Outline]:
        """Yield lozenges whose sides are parabolas."""
        look = self.mlinjon
        half, high = 0.5 * look.full / look.count, 0.5 * look.full * row
        shape = lozenge(half, high, look.bow)
        for x in self._places():
            yield shape.moved(similar(0.0, 1.0, (x, middle)))

    def _blades(self, high: float) -> Iterator[Keyed]:
        """Yield the flames and the blades of a band from -high to high."""
        look, high = self.blade, max(high, 0.1 * self.breadth)
        middle = similar(0.0, 1.0, (0.5, 0.0))
        if self.tongue.length:
            body = self.tongue.full * (1 - look.full)
            yield part("tongue", self.tongue, self._spindle(high, self.tongue.length, body))
        if self.gareng_size:
            yield part("gareng", self.gareng, [each.moved(middle) for each in self._eyes(high)])
        yield part("blade", look, self._spindle(high, 1.0, look.full).moved(middle))
        if self.spine_size:
            yield part(
                "spine", self.spine, self._spindle(high, SPINE, self.spine_size * look.full).moved(middle)
            )

    def _spindle(self, high: float, length: float, full: float) -> Outline:
        """Return a body along a share of a blade's line that is pointed at both ends."""
        share = np.linspace(-1, 1, NODES)
        line, direction, bend = self._line(share * length, high)
        room = np.maximum(np.sin(direction), ROOM)
        away = np.abs(share)
        half = 0.5 * full * room * (1 - away**2.2) ** 1.1 * (1 + self.blade.belly * (away**1.6 - 0.3))
        # Where the line bends more closely, a broad body would fold over itself.
        half = half / (1 + (half * bend / FOLD) ** 4) ** 0.25
        return band(line, np.concatenate([[0.0], half[1:-1], [0.0]]))

    def _eyes(self, high: float) -> list[Outline]:
        """Return a dot in the crook of each end."""
        share = np.array([-EYE, EYE])
        line, direction, _ = self._line(share, high)
        inwards = -1j * np.sign(share) * np.exp(1j * direction)
        away = 0.26 * self.blade.full + 1.6 * self.gareng_size
        place = line[:, 0] + 1j * line[:, 1] + inwards * away
        return [dot((each.real, each.imag), self.gareng_size) for each in place.tolist()]

    def _line(self, u: Array, high: float) -> tuple[Points, Array, Array]:
        """Return places on a blade's line, its direction (radians) and its bend (1 over the radius)."""
        look = self.blade
        share = (np.arange(FINE) + 0.5) / FINE
        angle = np.radians(look.lean - look.hook * share**look.power)
        # From the middle on; the other half is its image under a half turn.
        way = np.concatenate([[0.0], np.cumsum(np.exp(1j * angle))]) / FINE
        size = high / float(way.imag.max())
        away, known = np.abs(u), np.arange(FINE + 1) / FINE
        place = np.interp(away, known, way.real) + 1j * np.interp(away, known, way.imag)
        place *= np.sign(u) * size
        direction = np.radians(look.lean - look.hook * away**look.power)
        bend = np.radians(look.hook) * look.power * away ** (look.power - 1) / size
        return np.column_stack([place.real, place.imag]), direction, bend


NODES, FINE = 33, 480
"""Nodes of a blade's outline along its line, and steps of the sum that draws half of it."""
ROOM = 0.3
"""Least room between the lines of two blades, in links: where they run along the band."""
FOLD = 0.85
"""Half the breadth of a blade, as a share of its bend's radius at most."""
EYE, SPINE = 0.8, 0.8
"""Where a blade's eyes are and how far the line in it runs, as shares of half its line."""
