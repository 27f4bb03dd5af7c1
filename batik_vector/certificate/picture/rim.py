"""What a drawing shows along the edges of its page, place by place.

Bodies are followed along an edge just inside the page, and just outside it, and painted one over another as a
screen would: a painter's algorithm on a line. So what lies on top, what shows through and what is hidden all
count as they show; and of each body it is known whether the page cuts it or it ends there of itself.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.certificate.drawing import SNAP
from batik_vector.certificate.picture.bodies import Bodies
from batik_vector.certificate.seam import Seam
from batik_vector.geometry.congruence import distinct
from batik_vector.values import frozen

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

RAMP_PARTS = 64
"""Into how many parts an edge is divided at least where a colour runs along it."""

ROUNDING = 1e-3
"""Steps by which places that are one may differ, since crossings are worked out in floats."""


@frozen(eq=False)
class Spans:
    """Stretches of an edge that bodies cover, in steps on the near edge: ``low`` to ``high`` by ``body``.

    ``lean`` of shape (n, 2) is how far the body's border leans along the edge where it leaves at either
    end (the part along the edge of a unit vector away from it), ``run`` of shape (n, 2) how long that piece
    of the border is, in steps; 0 where it is the page that ends the stretch. ``tangent`` of shape (n, 2) is
    as ``lean``, of the curve that the piece is a chord of.
    """

    low: Floats
    high: Floats
    body: Indices
    lean: Floats
    tangent: Floats
    run: Floats

    def only(self, which: NDArray[np.bool_] | Indices) -> Spans:
        """Return some of them."""
        return Spans(*(getattr(self, name)[which] for name in self.__dataclass_fields__))


class Rim:
    """The borders of bodies in steps, what all but lies on an edge of the page on it."""

    def __init__(self, bodies: Bodies, seams: list[Seam]) -> None:
        self.bodies = bodies
        per_mm = seams[0].frame.per_mm
        rings, owner = shapely.get_rings(bodies.shapes, return_index=True)
        xy, ring = shapely.get_coordinates(rings, return_index=True)
        self.xy, self.ring = xy * per_mm, ring
        self.body = owner[ring] if len(ring) else np.empty(0, np.intp)
        for seam in seams:
            for value in (seam.near, seam.far):
                self.xy[np.abs(self.xy[:, seam.axis] - value) <= SNAP * per_mm, seam.axis] = value

    @staticmethod
    def vertices(bodies: Bodies, per_mm: int) -> tuple[Floats, Indices]:
        """Return the vertices of bodies in steps, shape (n, 2), and the number of each one's paint."""
        xy, owner = shapely.get_coordinates(bodies.shapes, return_index=True)
        return xy * per_mm, bodies.paint[owner]

    def spans(self, seam: Seam, far: bool, beyond: float = 0.0) -> Spans:
        """Return what bodies cover just inside an edge of the page, or that many steps ``beyond`` it.

        Less than nought is further inside.
        """
        value = (seam.far if far else seam.near) + (beyond if far else -beyond)
        across, along = self.xy[:, seam.axis], self.xy[:, 1 - seam.axis]
        there = across > value if far == (beyond > 0) else across < value
        cross = np.flatnonzero((there[1:] != there[:-1]) & (self.ring[1:] == self.ring[:-1]))
        root = np.where(there[cross], cross + 1, cross)
        tip = 2 * cross + 1 - root
        share = (value - across[root]) / (across[tip] - across[root])
        place = along[root] + share * (along[tip] - along[root])
        step = np.column_stack([across[tip] - value, along[tip] - place])
        run = np.hypot(step[:, 0], step[:, 1])
        lean = step[:, 1] / run
        body = self.body[cross]
        order = np.lexsort([place, body]).reshape(-1, 2)
        tangent = self._tangents(root, tip, run)[:, 1 - seam.axis]
        ends = (place[order[:, 0]], place[order[:, 1]], body[order[:, 0]])
        return _round(Spans(*ends, lean[order], tangent[order], run[order]), seam, far)

    def _tangents(self, root: Indices, tip: Indices, run: Floats) -> Floats:
        """Return unit tangents, shape (n, 2), of what goes from roots to tips, ``run`` before these."""
        after = 2 * tip - root
        # A ring's last vertex is its first.
        first = np.searchsorted(self.ring, self.ring[tip])
        last = np.searchsorted(self.ring, self.ring[tip], side="right") - 1
        after = np.where(after > last, first + 1, np.where(after < first, last - 1, after))
        chord, next_ = self.xy[tip] - self.xy[root], self.xy[after] - self.xy[tip]
        length = np.hypot(*chord.T)
        back = off_chord(turns(chord, next_), length, np.hypot(*next_.T)) * (1 - 2 * run / length)
        turned = chord[:, 0] + 1j * chord[:, 1]
        turned *= np.exp(1j * back) / length
        return np.column_stack([turned.real, turned.imag])


BENDS = np.radians(20.0)
"""By how much a curve turns at most from chord to chord; what turns more is a corner."""

EVEN = 4.0
"""How many times as long as the next a chord of a curve is, at most; what is longer is straight."""


def turns(one: Floats, next_: Floats) -> Floats:
    """Return by how many radians steps, shape (n, 2), turn left into the next."""
    cross = one[:, 0] * next_[:, 1] - one[:, 1] * next_[:, 0]
    return np.asarray(np.arctan2(cross, (one * next_).sum(axis=1)))


def off_chord(turn: Floats, length: Floats, next_: Floats) -> Floats:
    """Return by how many radians a curve turns off a chord at its ends: a circle through three points does.

    Args:
        turn: from the chord to the next one.
        length, next_: of the two; where they are uneven, or turn as a corner does, the chord is no chord.
    """
    even = (length <= EVEN * next_) & (next_ <= EVEN * length) & (np.abs(turn) <= BENDS)
    return np.where(even, turn * length / np.maximum(length + next_, 1e-12), 0.0)


def _round(spans: Spans, seam: Seam, far: bool) -> Spans:
    """Return stretches on the near edge's circle, cut at its beginning; those of no length are left out."""
    length = float(seam.length)
    run = np.where(np.column_stack([spans.low < 0, spans.high > length]), 0.0, spans.run)
    low, high = np.clip(spans.low, 0.0, length), np.clip(spans.high, 0.0, length)
    spans = replace(spans, low=low, high=high, run=run).only(high - low > ROUNDING)
    slip = seam.slip if far else 0
    if not slip:
        return spans
    low = (spans.low - slip) % length
    high = low + (spans.high - spans.low)
    over = high > length + ROUNDING
    first = replace(
        spans, low=low, high=np.minimum(high, length), run=spans.run * ~(over[:, None] & [False, True])
    )
    again = replace(spans, low=np.zeros(len(low)), high=high - length, run=spans.run * [0.0, 1.0]).only(over)
    return Spans(
        *(np.concatenate([getattr(first, n), getattr(again, n)]) for n in spans.__dataclass_fields__)
    )


@frozen(eq=False)
class Shown:
    """What an edge shows, in the stretches between ``cuts`` (n + 1,), in steps on the near edge.

    ``levels`` (n, 4) are its colours, premultiplied, just inside the page; ``deeper`` those a hair further
    inside; ``top`` (n,) is the topmost body, -1 where it is bare.
    """

    cuts: Floats
    levels: Floats
    deeper: Floats
    top: Indices
    spans: Spans
    inner: Spans
    beyond: Spans

    def stack(self, place: float, tolerance: float) -> list[tuple[int, bool]]:
        """Return the bodies at a place, the topmost first, and whether each goes on beyond the page."""
        here = (self.spans.low <= place) & (place <= self.spans.high)
        on = (self.beyond.low <= place + tolerance) & (place - tolerance <= self.beyond.high)
        cut = set(self.beyond.body[on].tolist())
        return [(body, body in cut) for body in sorted(set(self.spans.body[here].tolist()), reverse=True)]


def shown(rim: Rim, seam: Seam, slack: float, hair: float) -> tuple[Shown, Shown]:
    """Return what the near and the far edge of a seam show, cut at the same places.

    Args:
        rim: the bodies.
        seam: the edges.
        slack: by how many steps a body must reach beyond the page to go on there.
        hair: how many steps inside the page they are looked at once more.
    """
    sides = [[rim.spans(seam, far, depth) for depth in (0.0, -hair, slack)] for far in (False, True)]
    ends = [part for side in sides for spans in side[:2] for part in (spans.low, spans.high)]
    cuts = np.concatenate([[0.0, float(seam.length)], *ends])
    runs = np.array([paint.runs for paint in rim.bodies.paints], bool)
    if any(runs[rim.bodies.paint[side[0].body]].any() for side in sides):
        cuts = np.concatenate([cuts, np.linspace(0.0, seam.length, RAMP_PARTS + 1)])
    cuts = distinct(cuts)
    cuts = cuts[np.concatenate([[True], np.diff(cuts) > ROUNDING])]
    found = []
    for far, (spans, inner, beyond) in zip((False, True), sides, strict=True):
        levels, top = _painted(rim, seam, far, cuts, spans)
        deeper, _ = _painted(rim, seam, far, cuts, inner)
        found.append(Shown(cuts, levels, deeper, top, spans, inner, beyond))
    return found[0], found[1]


def _painted(rim: Rim, seam: Seam, far: bool, cuts: Floats, spans: Spans) -> tuple[Floats, Indices]:
    """Return colours, premultiplied, and the topmost body of each stretch."""
    middle = (cuts[1:] + cuts[:-1]) / 2
    levels, top = np.zeros((len(middle), 4)), np.full(len(middle), -1, np.intp)
    order = np.argsort(spans.body, kind="stable")
    first = np.searchsorted(cuts, spans.low[order] - ROUNDING)
    last = np.searchsorted(cuts, spans.high[order] - ROUNDING)
    bodies = rim.bodies
    plain = [paint.levels(np.zeros((1, 2)))[0] if paint.runs is False else None for paint in bodies.paints]
    for i, j, body in zip(first.tolist(), last.tolist(), spans.body[order].tolist(), strict=True):
        number = bodies.paint[body]
        colour = plain[number]
        if colour is None:
            places = np.array([seam.steps(along, far) for along in middle[i:j].tolist()]).reshape(-1, 2)
            colour = bodies.paints[number].levels(places / seam.frame.per_mm)
        solid = colour[..., 3:]
        over = np.concatenate([colour[..., :3] * solid, solid], axis=-1)
        levels[i:j] = over + (1 - solid) * levels[i:j]
        top[i:j] = body
    return levels, top
