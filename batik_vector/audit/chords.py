"""Chords: the narrowest places between two stretches of contour, through ink or through bare ground.

Such a place is where the distance between two stretches is least, as seen from both: moved along either, it
grows or stays. A tip, where two sides run into one another, has none: it narrows up to its end. So a pointed
petal is no narrow line, and a slit that is equally wide from end to end is a narrow gap.
"""

from __future__ import annotations

import numpy as np

from batik_vector.audit.contours import Contours, Floats, Mask
from batik_vector.audit.edges import Edges
from batik_vector.audit.stretches import neighbours
from batik_vector.certificate.drawing import Frame
from batik_vector.geometry.outlines import Index
from batik_vector.values import frozen

EQUAL = 0.01
"""Distances that differ by less (steps) are equal: rounding alone is far more."""

UPRIGHT = 0.05
"""Cosine below which the sides of a corner do not tell on which side of it a chord lies."""


@frozen(eq=False)
class Chords:
    """Narrowest places: from ``here`` on edge ``one`` to ``there`` on edge ``other``, shape (n, 2), in steps.

    ``there`` is the translate next to ``here``, ``moved`` how far it was moved. They are ``apart``; ``along``
    is how far both may be moved to and fro before that changes. ``width`` is what lies between: the
    distance, less the ink of centre lines. ``inked`` tells chords through ink from those
    over bare ground. ``from_one`` and ``from_other`` are how far along their contours the ends lie.
    """

    one: Index
    other: Index
    here: Floats
    there: Floats
    moved: Floats
    apart: Floats
    along: Floats
    width: Floats
    inked: Mask
    from_one: Floats
    from_other: Floats

    def __len__(self) -> int:
        return len(self.one)

    def only(self, which: Mask | Index) -> Chords:
        """Return some of them."""
        return Chords(*(getattr(self, name)[which] for name in self.__dataclass_fields__))

    @property
    def middle(self) -> Floats:
        """Their middles, in steps."""
        return (self.here + self.there) / 2


def together(parts: list[Chords]) -> Chords:
    """Return chords of several searches as one."""
    names = Chords.__dataclass_fields__
    return Chords(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


def chords(contours: Contours, edges: Edges, least: Widths, frame: Frame) -> Chords:
    """Return the narrowest places below given widths (steps), on the torus; and where contours touch.

    An arc that turns too little to come near itself is not held against itself.
    """
    half = contours.half[edges.contour]
    body = 2 * float(half.max(initial=0.0))
    reach = max(least.ink, least.ground) + body
    found = []
    for one, other, moved in neighbours(edges, reach, frame):
        pairs = _closest(edges, one, other, moved)
        pairs = pairs.only(pairs.apart < reach)
        inked = _inked(contours, edges, pairs)
        width = np.maximum(pairs.apart - half[pairs.one] - half[pairs.other], 0.0)
        narrow = (width < np.where(inked > 0, least.ink, least.ground)) & (inked != MIXED)
        # Where lines of some breadth overlap there is no gap between them.
        rows = np.flatnonzero((pairs.apart < EQUAL) | (narrow & (width > 0)))
        pairs, width, inked = pairs.only(rows), width[rows], inked[rows]
        rows = np.flatnonzero(_least(edges, pairs))
        found.append(_told(edges, pairs.only(rows), width[rows], inked[rows] > 0))
    return together(found) if found else _none()


@frozen
class Widths:
    """Below which widths (steps) chords are looked for: through ink, and over bare ground."""

    ink: float
    ground: float


MIXED = 0
"""Told of a way that leaves one contour through ink and comes to the other over ground."""


@frozen(eq=False)
class _Pairs:
    """Pairs of edges, where each is closest to the other, and how far apart they are there."""

    one: Index
    other: Index
    moved: Floats
    here: Floats
    there: Floats
    along: Floats
    apart: Floats

    def only(self, which: Mask | Index) -> _Pairs:
        """Return some of them."""
        return _Pairs(*(getattr(self, name)[which] for name in self.__dataclass_fields__))


def _told(edges: Edges, pairs: _Pairs, width: Floats, inked: Mask) -> Chords:
    here, there = pairs.here, pairs.there - pairs.moved
    return Chords(
        pairs.one,
        pairs.other,
        here,
        pairs.there,
        pairs.moved,
        pairs.apart,
        pairs.along,
        width,
        inked,
        edges.travel[pairs.one] + np.hypot(*(here - edges.begin[pairs.one]).T),
        edges.travel[pairs.other] + np.hypot(*(there - edges.begin[pairs.other]).T),
    )


def _none() -> Chords:
    nothing = np.empty(0, np.intp)
    places = np.empty((0, 2))
    flat = np.empty(0)
    return Chords(nothing, nothing, places, places, places, flat, places, flat, np.empty(0, bool), flat, flat)


def _nearest_on(point: Floats, begin: Floats, end: Floats) -> Floats:
    step = end - begin
    square = (step * step).sum(axis=1)
    share = ((point - begin) * step).sum(axis=1) / np.where(square > 0, square, 1.0)
    return np.asarray(begin + step * np.clip(share, 0.0, 1.0)[:, None])


def _cross(a: Floats, b: Floats) -> Floats:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def _segments(a: Floats, b: Floats, c: Floats, d: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the closest points of segments a–b and c–d, and how far both may be moved along them.

    Of segments side by side they are in the middle of the stretch on which these are closest. Where they
    cross, they are one point.
    """
    ways = [
        (a, _nearest_on(a, c, d)),
        (b, _nearest_on(b, c, d)),
        (_nearest_on(c, a, b), c),
        (_nearest_on(d, a, b), d),
    ]
    rows = np.arange(len(a))
    from_, to = (np.stack([way[side] for way in ways]) for side in (0, 1))
    apart = np.hypot(*np.moveaxis(to - from_, 2, 0))
    best = apart.argmin(axis=0)
    here, there = from_[best, rows], to[best, rows]
    off = np.hypot(*np.moveaxis(from_ - here, 2, 0))
    off[apart > apart[best, rows] + EQUAL] = 0.0
    last = off.argmax(axis=0)
    along = from_[last, rows] - here
    beside = off[last, rows] > EQUAL
    here[beside] += along[beside] / 2
    there[beside] = ((there + to[last, rows]) / 2)[beside]
    cross = _cross(b - a, c - a) * _cross(b - a, d - a) < 0
    cross &= _cross(d - c, a - c) * _cross(d - c, b - c) < 0
    there[cross] = here[cross]
    return here, there, np.where((beside & ~cross)[:, None], along / 2, 0.0)


def _closest(edges: Edges, one: Index, other: Index, moved: Floats) -> _Pairs:
    begin, end = edges.begin[other] + moved, edges.end[other] + moved
    here, there, along = _segments(edges.begin[one], edges.end[one], begin, end)
    return _Pairs(one, other, moved, here, there, along, np.hypot(*(there - here).T))


def _least(edges: Edges, pairs: _Pairs) -> Mask:
    """Return whether the way grows or stays when either end moves on to the next edge."""
    mine = _beside(edges, pairs.one, pairs.here)
    yours = _beside(edges, pairs.other, pairs.there - pairs.moved)
    least = np.ones(len(mine), bool)
    for a, b in ((mine, pairs.other), (pairs.one, yours), (mine, yours)):
        rows = np.flatnonzero(least & (a >= 0) & (b >= 0))
        # A contour that closes round the torus jumps by a period from its last edge to its first.
        shift = (
            pairs.moved[rows]
            + _jump(edges, pairs.other[rows], b[rows])
            - _jump(edges, pairs.one[rows], a[rows])
        )
        least[rows] = _closest(edges, a[rows], b[rows], shift).apart > pairs.apart[rows] - EQUAL
    return least


def _beside(edges: Edges, which: Index, at: Floats) -> Index:
    """Return the edge on the other side of the vertex that a place is; the edge itself if it is none."""
    begins = (at == edges.begin[which]).all(axis=1)
    ends = (at == edges.end[which]).all(axis=1)
    return np.where(begins, edges.before[which], np.where(ends, edges.after[which], which))


def _jump(edges: Edges, edge: Index, neighbour: Index) -> Floats:
    """Return how far the neighbour has to be moved to hang on to the edge."""
    forward = edges.end[edge] - edges.begin[neighbour]
    back = edges.begin[edge] - edges.end[neighbour]
    found = np.where((edges.after[edge] == neighbour)[:, None], forward, back)
    found[edge == neighbour] = 0.0
    return np.asarray(found)


def _inked(contours: Contours, edges: Edges, pairs: _Pairs) -> Floats:
    """Return 1 where the way between two edges leads through ink, -1 over ground, ``MIXED`` where neither."""
    first = _side(contours, edges, pairs.one, pairs.here, pairs.there - pairs.here)
    second = _side(contours, edges, pairs.other, pairs.there - pairs.moved, pairs.here - pairs.there)
    # From a centre line the way leads over ground.
    return np.where(
        first == second,
        np.where(first == 0, -1.0, first),
        np.where(first * second == 0, first + second, MIXED),
    )


def _side(contours: Contours, edges: Edges, which: Index, here: Floats, way: Floats) -> Floats:
    """Return 1 where the way from a place on an edge leads through ink, -1 over ground, 0 from a line."""
    way = way / np.maximum(np.hypot(*way.T), 1e-9)[:, None]
    beside = _beside(edges, which, here)
    beside = np.where(beside >= 0, beside, which)
    mine, yours = (_heading(edges, each) for each in (which, beside))
    left = _cross(mine, way) + _cross(yours, way)
    follows = edges.after[which] == beside
    turn = np.where(follows, _cross(mine, yours), _cross(yours, mine))
    # In front of a corner that juts out lies ground, before one that juts in lies ink.
    side = np.where(np.abs(left) > UPRIGHT, np.sign(left), -np.sign(turn))
    return np.asarray(np.where(contours.outline[edges.contour[which]], side, 0.0))


def _heading(edges: Edges, which: Index) -> Floats:
    step = edges.end[which] - edges.begin[which]
    return np.asarray(step / np.maximum(np.hypot(*step.T), 1e-9)[:, None])
