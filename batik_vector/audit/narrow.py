"""Narrow places: chords that count, gathered where they belong together, and marks that are narrow all over.

A chord counts where the way round along the outline, from one of its ends to the other, is at least
``AROUND`` times its length on both sides, and where what it closes off is either wider than the chord or as
wide for at least that long. A tip that only gets thinner is neither. Between two contours that touch, the
way round leads over the place where they touch.
"""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.audit.chords import Chords
from batik_vector.audit.contours import Contours, Floats, Mask
from batik_vector.audit.edges import Edges
from batik_vector.audit.stretches import AROUND
from batik_vector.geometry.nets.components import components
from batik_vector.geometry.outlines import Index
from batik_vector.values import frozen

FAR = 100.0
"""Ways round longer than this many times the reach lead to something wider."""

STEADY = 0.85
"""Share of a strip as long as a tip and as wide as its chord that it must fill to be as wide all along."""

TOUCHING = 0.01
"""Contours nearer than this (steps) touch."""

APART = 2.0
"""Chords between the same contours further apart than this many times the reach are two places."""


@frozen(eq=False)
class Search:
    """What is looked through: contours, their edges, a reach, and how far (steps) edges stray from curves."""

    contours: Contours
    edges: Edges
    reach: float
    stray: float

    @property
    def circuit(self) -> Floats:
        """The length of each contour, in steps."""
        step = self.edges.end - self.edges.begin
        return np.asarray(
            np.bincount(self.edges.contour, np.hypot(*step.T), minlength=len(self.contours)), np.float64
        )


def counting(found: Chords, search: Search) -> Chords:
    """Return the chords that count as narrow places."""
    touching = found.apart < TOUCHING
    touches, found = found.only(touching), found.only(~touching)
    contour = search.edges.contour
    alone = contour[found.one] == contour[found.other]
    alone &= (found.moved == 0).all(axis=1)
    counts = np.ones(len(found), bool)
    counts[alone] = _round_one(found.only(alone), search)
    counts[~alone] = _round_two(found.only(~alone), touches, search)
    return found.only(counts)


def _round_one(found: Chords, search: Search) -> Mask:
    """Return which chords between two stretches of one contour count."""
    contours, contour = search.contours, search.edges.contour[found.one]
    circuit = search.circuit[contour]
    between = found.from_other - found.from_one
    closes = contours.closed[contour] & (contours.shift[contour] == 0).all(axis=1)
    counts = np.ones(len(found), bool)
    for ways, there, inner in (
        (between, np.ones(len(found), bool), True),
        (circuit - between, closes, False),
    ):
        counts &= ~there | (ways >= AROUND * found.apart)
        rows = np.flatnonzero(counts & there & (ways < FAR * search.reach))
        caps = [_cap(search, found, int(row), inner) for row in rows]
        counts[rows] = _wide(_polygons(caps), found.apart[rows], ways[rows], search)
    return counts


def _cap(search: Search, found: Chords, row: int, inner: bool) -> Floats:
    """Return the outline of what a chord closes off of its contour, on one side of it."""
    one, other = int(found.one[row]), int(found.other[row])
    points, starts = search.contours.points, search.contours.starts
    if inner:
        way = points[one + 1 : other + 1]
    else:
        which = search.edges.contour[one]
        way = np.concatenate(
            [points[starts[which] : one + 1][::-1], points[other + 1 : starts[which + 1]][::-1]]
        )
    return np.concatenate([found.here[row : row + 1], way, found.there[row : row + 1]])


def _polygons(rings: list[Floats]) -> Geometries:
    return np.array(
        [shapely.Polygon(ring) if len(ring) > 2 else shapely.Polygon() for ring in rings], dtype=object
    )


def _wide(caps: Geometries, apart: Floats, ways: Floats, search: Search) -> Mask:
    """Return which of what chords close off is wider than they are, or as wide for long enough."""
    if not len(caps):
        return np.empty(0, bool)
    area, rim = np.abs(shapely.area(caps)), shapely.length(caps)
    # A disc fits in whose radius is the area over the rim, or a larger one.
    radius = apart / 2 + search.stray
    wide = area > radius * rim
    rows = np.flatnonzero(~wide)
    shrunk = shapely.buffer(caps[rows], -radius[rows], quad_segs=2)
    wide[rows] = ~shapely.is_empty(shrunk)
    long = (ways - apart) / 2
    return np.asarray(wide | ((area >= STEADY * apart * long) & (ways >= AROUND * apart)))


def _round_two(found: Chords, touches: Chords, search: Search) -> Mask:
    """Return which chords between two contours count: others end where these touch."""
    counts = np.ones(len(found), bool)
    if not len(touches) or not len(found):
        return counts
    places: dict[tuple[int, ...], list[int]] = {}
    for row, key in enumerate(_keys(touches, search)):
        places.setdefault(key, []).append(row)
    for row, key in enumerate(_keys(found, search)):
        if key in places:
            rows = np.array(places[key])
            first = _way(found.from_one[row], touches.from_one[rows], search.circuit[key[0]], search, key[0])
            second = _way(
                found.from_other[row], touches.from_other[rows], search.circuit[key[1]], search, key[1]
            )
            best = int(np.argmin(first + second))
            way = float(first[best] + second[best])
            counts[row] = _counts_by(found, row, touches, int(rows[best]), way, search)
    return counts


def _keys(found: Chords, search: Search) -> list[tuple[int, ...]]:
    contour = search.edges.contour
    moved = np.rint(found.moved).astype(np.int64)
    return [
        tuple(each) for each in np.column_stack([contour[found.one], contour[found.other], moved]).tolist()
    ]


def _way(here: float, there: Floats, circuit: float, search: Search, contour: int) -> Floats:
    apart = np.abs(there - here)
    return np.minimum(apart, circuit - apart) if search.contours.closed[contour] else apart


def _counts_by(found: Chords, row: int, touches: Chords, touch: int, way: float, search: Search) -> bool:
    """Return whether a chord counts beside a place where its contours touch, so far away along them."""
    apart = found.apart[row]
    if way < AROUND * apart:
        return False
    if way > FAR * search.reach:
        return True
    mine = _stretch(search, int(found.one[row]), int(touches.one[touch]))
    yours = _stretch(search, int(found.other[row]), int(touches.other[touch])) + found.moved[row]
    ring = np.concatenate(
        [
            found.here[row : row + 1],
            mine,
            touches.here[touch : touch + 1],
            yours[::-1],
            found.there[row : row + 1],
        ]
    )
    cap = np.array([shapely.make_valid(shapely.Polygon(ring))], dtype=object)
    return bool(_wide(cap, np.array([apart]), np.array([way]), search)[0])


def _stretch(search: Search, begin: int, end: int) -> Floats:
    """Return the vertices between two edges of a contour, the shorter way round."""
    contours, edges = search.contours, search.edges
    points, which = contours.points, int(edges.contour[begin])
    first, stop = contours.starts[which : which + 2].tolist()
    forward = begin <= end
    low, high = (begin, end) if forward else (end, begin)
    across = edges.travel[high] - edges.travel[low] > search.circuit[which] / 2 and contours.closed[which]
    if across:
        way = np.concatenate(
            [points[first : low + 1][::-1], points[high + 1 : stop][::-1] - contours.shift[which]]
        )
    else:
        way = points[low + 1 : high + 1]
    return way if forward else way[::-1]


@frozen(eq=False)
class Places:
    """Narrow places: which chord is the narrowest of each, and over what length (steps) it is narrow."""

    chord: Index
    length: Floats


def places(found: Chords, search: Search) -> Places:
    """Return what chords between the same contours, one beside the other, have in common: one place."""
    if not len(found):
        return Places(np.empty(0, np.intp), np.empty(0))
    contour = search.edges.contour
    key = np.column_stack([contour[found.one], contour[found.other], found.inked])
    low, high = found.middle - found.along, found.middle + found.along
    spans = np.asarray(shapely.points(low), dtype=object)
    spread = np.hypot(*found.along.T)
    long = np.flatnonzero(spread > 0)
    spans[long] = shapely.linestrings(np.stack([low[long], high[long]], axis=1))
    one, other = shapely.STRtree(spans).query(spans, predicate="dwithin", distance=APART * search.reach)
    same = (one < other) & (key[one] == key[other]).all(axis=1)
    group = components(len(found), np.column_stack([one[same], other[same]]))
    order = np.lexsort((np.arange(len(found)), -spread, np.round(found.width, 1), group))
    first = np.flatnonzero(np.append(True, np.diff(group[order]) != 0))
    low, high = np.minimum(low, high), np.maximum(low, high)
    low, high = np.minimum.reduceat(low[order], first), np.maximum.reduceat(high[order], first)
    return Places(order[first], np.hypot(*(high - low).T))
