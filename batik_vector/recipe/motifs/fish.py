"""The fish: a blade that swims in a bend, with scales in rows and fins of rays."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field
from typing import Annotated

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves import Blade
from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.sampling import Points
from batik_vector.recipe.look import Dress
from batik_vector.recipe.motifs.composing import (
    Composed,
    Isen,
    Keyed,
    Plate,
    centred,
    direction,
    dot,
    fan,
    on,
    outline_of,
    part,
    similar,
    stroke,
)
from batik_vector.values import frozen


@frozen(kw_only=True)
class FishBody(Plate):
    """The body of a fish."""

    length: Annotated[float, Between(0.2, 4), Says("from the root of the tail to the mouth")] = 1.5
    width: Annotated[float, Between(0.05, 1), Says("half its breadth")] = 0.36
    bend: Annotated[float, Between(-90, 90), Says("degrees by which it bends, to its left")] = 30.0
    full: Annotated[float, Between(0.5, 2), Says("how slim it runs out to the tail")] = 1.05


@frozen(kw_only=True)
class Scales(Isen):
    """The scales, in rows between tail and gill: arcs with a body, open to the head."""

    rows: Annotated[int, Between(0, 24), Says("rows where the body is broadest; 0 leaves them out")] = 7
    weight: Annotated[
        float, Between(0.05, 0.45), Says("half the breadth of an arc, as a share of a scale")
    ] = 0.13


@frozen(kw_only=True)
class Fins(Plate):
    """Fins: fans of rays that end in lobes."""

    rays: Annotated[int, Between(1, 16), Says("rays of the fin on the back")] = 6
    length: Annotated[float, Between(0.05, 2), Says("length of its longest ray")] = 0.4


@frozen(kw_only=True)
class TailFin(Plate):
    """The tail: a forked fan."""

    rays: Annotated[int, Between(2, 16), Says("rays")] = 6
    length: Annotated[float, Between(0.05, 3), Says("length of the outer rays")] = 0.62
    fork: Annotated[float, Between(0.2, 1), Says("length of the inner rays, as a share of it")] = 0.62
    spread: Annotated[float, Between(5, 85), Says("degrees from its middle to an outer ray")] = 38.0


@frozen(kw_only=True)
class Fish(Composed):
    """Fish that swims along +x, its back up; the body is a blade, and what is on it follows its bend."""

    body: Annotated[FishBody, Says("the body")] = field(default_factory=FishBody)
    scale: Annotated[Scales, Says("the scales")] = field(default_factory=Scales)
    fin: Annotated[Fins, Says("fins on back, belly and side")] = field(default_factory=Fins)
    tail: Annotated[TailFin, Says("the tail")] = field(default_factory=TailFin)
    ray: Annotated[Isen, Says("look of the lines in fins and tail")] = field(default_factory=Isen)
    ray_size: Annotated[float, Between(0, 0.6), Says("breadth of these lines, as a share of a lobe's")] = 0.26
    gill: Annotated[Isen, Says("look of the gill and the mouth")] = field(default_factory=Isen)
    eye: Annotated[Isen, Says("look of the eye")] = field(default_factory=Isen)
    pupil: Annotated[Dress, Says("look of its middle")] = field(default_factory=Dress)
    eye_size: Annotated[float, Between(0.02, 0.4), Says("radius of the eye, as a share of the breadth")] = 0.2

    def compose(self) -> Iterator[Keyed]:
        """Yield tail and fins, the body over them, and what is on the body."""
        yield from centred(self._drawn())

    def _drawn(self) -> Iterator[Keyed]:
        body = self.body
        blade = Blade(body.length, body.width, body.full, 0.62, body.bend)
        # Its midrib is along +x in the middle.
        home = similar(-direction(blade, 0.42))

        def at_home(shapes: list[Outline]) -> list[Outline]:
            return [each.moved(home) for each in shapes]

        for key, (lobes, lines) in (("tail", self._tail()), ("fin", self._fins(blade))):
            yield part(key, self.tail if key == "tail" else self.fin, at_home(lobes))
            if lines:
                yield part("ray", self.ray, at_home(lines))
        yield part("body", body, outline_of(blade, 14).moved(home))
        if self.scale.rows:
            yield part("scale", self.scale, at_home(self._scales(blade)))
        yield part("gill", self.gill, at_home(self._face(blade)))
        lobes, lines = self._side(blade)
        yield part("fin", self.fin, at_home(lobes))
        if lines:
            yield part("ray", self.ray, at_home(lines))
        (place,) = on(blade, EYE, 0.24).tolist()
        size = self.eye_size * body.width
        yield part("eye", self.eye, dot((place[0], place[1]), size).moved(home))
        yield part("pupil", self.pupil, dot((place[0], place[1]), 0.5 * size).moved(home))

    def _tail(self) -> tuple[list[Outline], list[Outline]]:
        tail = self.tail
        share = np.linspace(-1, 1, tail.rays)
        angles = 180 + tail.spread * share
        lengths = tail.length * (tail.fork + (1 - tail.fork) * np.abs(share) ** 1.3)
        # Wide enough for the lobes to meet where the fan is broadest.
        step = np.radians(2 * tail.spread / (tail.rays - 1))
        lobe = Blade(1.0, float(np.clip(0.62 * step, 0.03, 0.42)), 1.1, 0.5)
        return fan(
            np.tile([[0.06 * self.body.length, 0.0]], (tail.rays, 1)), angles, lengths, lobe, self.ray_size
        )

    def _fins(self, blade: Blade) -> tuple[list[Outline], list[Outline]]:
        """Return the fin on the back, and two small ones beneath."""
        found: tuple[list[Outline], list[Outline]] = [], []
        few = max(self.fin.rays // 2, 1)
        for begin, end, side, rays, size in (
            (0.36, 0.66, 1.0, self.fin.rays, 1.0),
            (0.24, 0.34, -1.0, few, 0.62),
            (0.5, 0.58, -1.0, few, 0.7),
        ):
            share = np.linspace(begin, end, rays) if rays > 1 else np.array([(begin + end) / 2])
            rise = np.linspace(0, 1, rays) if rays > 1 else np.array([0.5])
            lengths = self.fin.length * size * (0.62 + 0.38 * np.sin(np.pi * (0.25 + 0.6 * rise)))
            angles = blade.bend * share + side * (152 - 46 * rise)
            apart = (end - begin) * blade.length / max(rays - 1, 1)
            width = float(np.clip(0.85 * apart / (self.fin.length * size) + 0.05, 0.06, 0.3))
            lobes, lines = fan(
                on(blade, share, 0.8 * side), angles, lengths, Blade(1.0, width, 0.9, 0.5), self.ray_size
            )
            found[0].extend(lobes)
            found[1].extend(lines)
        return found

    def _side(self, blade: Blade) -> tuple[list[Outline], list[Outline]]:
        """Return the fin on the side, behind the gill."""
        rays = 3
        root = on(blade, GILL - 0.01, -0.3)
        angles = direction(blade, GILL) + 180 + np.linspace(34, -6, rays)
        lengths = 0.62 * self.fin.length * np.array([0.8, 1.0, 0.86])
        return fan(np.tile(root, (rays, 1)), angles, lengths, Blade(1.0, 0.2, 0.9, 0.5), self.ray_size, 0.45)

    def _scales(self, blade: Blade) -> list[Outline]:
        """Return the arcs of the scales, row by row from the tail, every other row by half a scale aside."""
        first, last = 0.14, GILL - 0.07
        step = 2 * blade.width / self.scale.rows
        rows = max(int((last - first) * blade.length / step), 1)
        radius = 0.62 * step
        found = []
        for row in range(rows):
            share = first + (last - first) * (row + 0.5) / rows
            half = float(blade.half(np.array([share]))[0])
            count = int((half - 1.1 * radius) / (1.12 * step) + (0 if row % 2 else 0.5))
            places = np.arange(-count, count + 1) if row % 2 else np.arange(-count, count) + 0.5
            for place in places.tolist() if half > 1.2 * radius else []:
                found.append(_arc(blade, share, place * 1.12 * step, radius, self.scale.weight * radius))
        return found or [_arc(blade, 0.4, 0.0, radius, self.scale.weight * radius)]

    def _face(self, blade: Blade) -> list[Outline]:
        """Return gill and mouth."""
        sides = np.linspace(-0.82, 0.82, 9)
        line = on(blade, GILL - 0.035 * (1 - (sides / 0.82) ** 2), sides)
        gill = stroke(line, 0.004 * blade.length, 0.004 * blade.length, 0.009 * blade.length)
        mouth = stroke(
            on(blade, np.linspace(0.97, 0.9, 5), np.linspace(-0.8, -0.3, 5)), *[0.009 * blade.length] * 2
        )
        return [gill, mouth]


GILL, EYE = 0.7, 0.83
"""Where gill and eye are, as shares of the body's length from the tail."""


def _arc(blade: Blade, share: float, away: float, radius: float, half: float) -> Outline:
    """Return a scale: an arc about a place on a blade, open to the head, that swells in its middle."""
    angle = np.radians(np.linspace(108, 252, 7))
    along = share + radius * np.cos(angle) / blade.length
    breadth = np.maximum(blade.half(np.clip(along, 0.02, 0.98)), 1e-6)
    line: Points = blade.spread(along, (away + radius * np.sin(angle)) / breadth)
    return stroke(line, 0.35 * half, 0.35 * half, 0.65 * half)
