"""The bird: the phoenix of the north coast, with a fan of wing feathers and a long tail of eyes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import field
from typing import Annotated

import numpy as np

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves import Blade
from batik_vector.geometry.paths.bands import curl
from batik_vector.geometry.paths.matrix import Matrix
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
    dots,
    on,
    outline_of,
    part,
    rib,
    similar,
    stroke,
)
from batik_vector.values import frozen


@frozen(kw_only=True)
class BirdBody(Plate):
    """The body of a bird, from the root of the tail to the neck."""

    length: Annotated[float, Between(0.4, 3), Says("length")] = 1.0
    width: Annotated[float, Between(0.05, 0.6), Says("half its breadth")] = 0.26
    bend: Annotated[float, Between(0, 140), Says("degrees by which it rises to the neck")] = 78.0
    head: Annotated[float, Between(0.05, 0.5), Says("radius of the head")] = 0.15


@frozen(kw_only=True)
class Beak(Plate):
    """The beak: two blades, the upper one bent down."""

    length: Annotated[float, Between(0.02, 1), Says("length")] = 0.27
    bend: Annotated[float, Between(-60, 60), Says("degrees by which it bends down")] = 26.0


@frozen(kw_only=True)
class Crest(Plate):
    """The crest: feathers on the head, each with a knob."""

    feathers: Annotated[int, Between(0, 9), Says("feathers; 0 leaves them out")] = 3
    length: Annotated[float, Between(0.05, 2), Says("length of the longest")] = 0.42


@frozen(kw_only=True)
class WingFeathers(Plate):
    """The wing: a fan of feathers, each on the one before, and a shorter fan of coverts on them."""

    feathers: Annotated[int, Between(2, 16), Says("feathers")] = 7
    length: Annotated[float, Between(0.1, 4), Says("length of the longest")] = 1.12
    width: Annotated[
        float, Between(0.02, 0.4), Says("half the breadth of a feather, as a share of its length")
    ] = 0.085
    begin: Annotated[float, Between(0, 200), Says("direction of the foremost, in degrees")] = 70.0
    end: Annotated[float, Between(0, 200), Says("direction of the hindmost, in degrees")] = 158.0
    bend: Annotated[float, Between(-90, 90), Says("degrees by which they bend to the tail")] = 24.0


@frozen(kw_only=True)
class TailFeathers(Plate):
    """The tail: long feathers that bend, each with an eye at its end."""

    feathers: Annotated[int, Between(1, 12), Says("feathers")] = 5
    length: Annotated[float, Between(0.1, 6), Says("length of the longest")] = 1.7
    width: Annotated[
        float, Between(0.01, 0.3), Says("half the breadth of a feather, as a share of its length")
    ] = 0.07
    turn: Annotated[float, Between(90, 270), Says("direction of its middle, in degrees")] = 200.0
    spread: Annotated[float, Between(0, 120), Says("degrees from the first feather to the last")] = 62.0
    bend: Annotated[
        float, Between(-120, 120), Says("degrees by which they bend, down and on to the front")
    ] = 38.0


@frozen(kw_only=True)
class Bird(Composed):
    """Bird that looks along +x, its wing raised: blades about a bent body, as on the coast's batik.

    Each feather keeps a line of ground to the one beneath; ribs and the dots on the breast are *isen*.
    """

    tail: Annotated[TailFeathers, Says("the tail")] = field(default_factory=TailFeathers)
    wing: Annotated[WingFeathers, Says("the wing")] = field(default_factory=WingFeathers)
    covert: Annotated[Plate, Says("look of the short feathers on the wing")] = field(default_factory=Plate)
    crest: Annotated[Crest, Says("the crest")] = field(default_factory=Crest)
    body: Annotated[BirdBody, Says("body and head")] = field(default_factory=BirdBody)
    beak: Annotated[Beak, Says("the beak")] = field(default_factory=Beak)
    rib: Annotated[Isen, Says("look of the ribs of the feathers")] = field(default_factory=Isen)
    spot: Annotated[Isen, Says("look of the dots on the breast, and of the eyes of the tail")] = field(
        default_factory=Isen
    )
    spot_size: Annotated[
        float, Between(0, 0.1), Says("radius of the dots on the breast; 0 leaves them out")
    ] = 0.021
    eye: Annotated[Isen, Says("look of the eye")] = field(default_factory=Isen)
    pupil: Annotated[Dress, Says("look of its middle")] = field(default_factory=Dress)

    def compose(self) -> Iterator[Keyed]:
        """Yield the tail, the crest, the body and, on it, the wing; and the head last."""
        yield from centred(self._drawn())

    def _drawn(self) -> Iterator[Keyed]:
        body = self.body
        blade = Blade(body.length, body.width, 1.0, 0.75, body.bend)
        home = similar(-0.35 * body.bend, 1.0, (-0.42 * body.length, -0.05))
        yield from self._tail(home)
        face = direction(blade, 1.0) - 0.35 * body.bend
        nape = _moved(on(blade, 0.97, 0.0), home)[0]
        # The head lies on the end of the neck and looks ahead.
        head = nape + 0.55 * body.head * np.array(
            [math.cos(math.radians(face)), math.sin(math.radians(face))]
        )
        yield from self._crest(head)
        yield part("body", body, outline_of(blade, 14).moved(home))
        if self.spot_size:
            yield part("spot", self.spot, dots(_moved(self._breast(blade), home), self.spot_size))
        yield from self._wing(blade, home)
        yield from self._head(head)

    def _tail(self, home: Matrix) -> Iterator[Keyed]:
        tail = self.tail
        share = np.linspace(-1, 1, tail.feathers) if tail.feathers > 1 else np.zeros(1)
        root = _moved(np.array([[0.1 * self.body.length, 0.0]]), home)[0]
        # From both sides inwards, so that the longest in the middle lies on top.
        for place in sorted(share.tolist(), key=lambda each: (-abs(each), each)):
            length = tail.length * (1 - 0.34 * abs(place) ** 1.4)
            feather = Blade(length, tail.width * tail.length, 1.6, 0.5, tail.bend * (0.55 + 0.45 * place))
            at = similar(tail.turn - 0.5 * tail.spread * place, 1.0, (float(root[0]), float(root[1])))
            yield part("tail", tail, outline_of(feather, 12).moved(at))
            yield part("rib", self.rib, rib(feather, 0.3, 0.68, 0.1 * feather.width).moved(at))
            (eye,) = on(feather, 0.83, 0.0).tolist()
            yield part(
                "spot", self.spot, dot((eye[0], eye[1]), 0.58 * feather.width).moved(at), name="tail eye"
            )
            yield part(
                "tail",
                Dress(ink=tail.ink),
                dot((eye[0], eye[1]), 0.28 * feather.width).moved(at),
                name="tail eye",
            )

    def _wing(self, blade: Blade, home: Matrix) -> Iterator[Keyed]:
        wing = self.wing
        root = _moved(on(blade, 0.52, -0.05), home)[0]
        at = (float(root[0]), float(root[1]))
        for key, look, size, count in (
            ("wing", wing, 1.0, wing.feathers),
            ("covert", self.covert, 0.5, max(wing.feathers - 2, 2)),
        ):
            share = np.linspace(0, 1, count)
            for place in share[::-1].tolist():
                length = wing.length * size * (0.66 + 0.34 * math.sin(math.pi * (0.3 + 0.55 * place)))
                angle = wing.begin + (wing.end - wing.begin) * place
                feather = Blade(length, wing.width * wing.length * size**0.4, 1.5, 0.55, wing.bend)
                map_ = similar(angle, 1.0, at)
                yield part(key, look, outline_of(feather, 12).moved(map_))
                yield part(
                    "rib",
                    self.rib,
                    rib(feather, 0.5 if size == 1.0 else 0.36, 0.86, 0.13 * feather.width).moved(map_),
                )
        # The shoulder: a disc with a whorl, where all feathers meet.
        size = 0.55 * self.body.width
        yield part("covert", self.covert, dot(at, size), name="shoulder")
        whorl = curl(4.2 * size, 480.0, 0.62)
        whorl = (whorl - whorl.mean(axis=0)) * (0.62 * size / np.hypot(*(whorl - whorl.mean(axis=0)).T).max())
        yield part("rib", self.rib, stroke(whorl + root, 0.05 * size, 0.09 * size), name="whorl")

    def _crest(self, head: Points) -> Iterator[Keyed]:
        crest = self.crest
        for number in range(crest.feathers):
            place = number / max(crest.feathers - 1, 1)
            length = crest.length * (1 - 0.4 * place)
            feather = Blade(length, 0.16 * crest.length, 2.2, 0.5, 34.0)
            at = similar(74.0 + 58 * place, 1.0, (float(head[0]), float(head[1])))
            yield part("crest", crest, outline_of(feather).moved(at))
            (end,) = on(feather, 0.74, 0.0).tolist()
            yield part(
                "spot", self.spot, dot((end[0], end[1]), 0.4 * feather.width).moved(at), name="crest eye"
            )

    def _head(self, head: Points) -> Iterator[Keyed]:
        size, beak = self.body.head, self.beak
        x, y = float(head[0]), float(head[1])
        lower = Blade(0.8 * beak.length, 0.2 * beak.length, 0.6, 1.1, -0.3 * beak.bend)
        upper = Blade(beak.length, 0.26 * beak.length, 0.6, 1.1, -beak.bend)
        root = 0.72 * size
        yield part("beak", beak, outline_of(lower).moved(similar(-16.0, 1.0, (x + root, y - 0.2 * size))))
        yield part("beak", beak, outline_of(upper).moved(similar(6.0, 1.0, (x + root, y + 0.08 * size))))
        yield part("body", self.body, dot((x, y), size), name="head")
        yield part("eye", self.eye, dot((x + 0.2 * size, y + 0.2 * size), 0.4 * size))
        yield part("pupil", self.pupil, dot((x + 0.26 * size, y + 0.2 * size), 0.2 * size))

    def _breast(self, blade: Blade) -> Points:
        """Return places of dots in rows that follow the body, on the breast's side of the wing."""
        step = 4.4 * self.spot_size
        found = []
        for row, side in enumerate((-0.72, -0.44)):
            shares = np.arange(0.3 + 0.5 * (row % 2) * step, 0.86, step / blade.length)
            found.append(on(blade, shares, side))
        return np.vstack(found)


def _moved(points: Points, home: Matrix) -> Points:
    a, b, c, d, e, f = home
    return np.column_stack([a * points[:, 0] + c * points[:, 1] + e, b * points[:, 0] + d * points[:, 1] + f])
