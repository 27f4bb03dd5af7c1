"""Touching: which places lie on which segments, and the numbers of places.

Segments are told apart by the numbers of their ends: the same place has the same number wherever it is drawn.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import Index, Steps
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

Ints: TypeAlias = NDArray[np.int64]

MOST = 1 << 31
"""Steps from one edge of a drawing to the other, at most, so that areas of it are whole numbers yet: 2 km."""

AT_ONCE = 1 << 19
"""Candidates that are looked at together: what is made of them fits in memory."""


def numbered(points: Steps) -> tuple[Steps, Index]:
    """Return all places that points lie in, shape (k, 2), and the number of its place for each point.

    Raises:
        GeometryError: where the drawing is broader or higher than 2 km.
    """
    if not len(points):
        return points, np.empty(0, np.intp)
    low = points.min(axis=0)
    span = points.max(axis=0) - low + 1
    if (span >= MOST).any():
        raise GeometryError(f"a drawing is {int(span.max()) // STEPS_PER_MM} mm large, expected at most 2 km")
    keys, number = np.unique((points[:, 0] - low[0]) * span[1] + (points[:, 1] - low[1]), return_inverse=True)
    return np.stack([keys // span[1] + low[0], keys % span[1] + low[1]], axis=1), number


def pairs(one: Index, other: Index, count: int) -> Ints:
    """Return a number for each pair of places, whichever comes first, of so many places."""
    return np.asarray(np.minimum(one, other), np.int64) * count + np.maximum(one, other)


@frozen(eq=False)
class _Strips:
    """Places sorted into upright strips, and by height within each."""

    left: int
    low: int
    width: int
    height: int
    keys: Ints
    order: Index

    @staticmethod
    def of(places: Steps) -> _Strips:
        (left, low), (right, high) = places.min(axis=0).tolist(), places.max(axis=0).tolist()
        across, up = right - left + 1, high - low + 1
        # About as broad as places lie apart: then few stand beside a segment without touching it.
        width = max(1, round((across * up / len(places)) ** 0.5), across // len(places))
        keys = (places[:, 0] - left) // width * up + (places[:, 1] - low)
        order = np.argsort(keys, kind="stable")
        return _Strips(left, low, width, up, keys[order], order)


def touching(places: Steps, start: Index, end: Index, reach: int = 1) -> tuple[Index, Index]:
    """Return which places lie upon which segments, between their ends: (segments, places), along each.

    Args:
        places: shape (k, 2), each of them once.
        start: shape (n,), numbers of the places where segments begin.
        end: where they end, elsewhere.
        reach: how many steps a place may lie beside a segment.
    """
    way = places[end] - places[start]
    steep = np.abs(way[:, 1]) > np.abs(way[:, 0])
    found = [(np.empty(0, np.intp), np.empty(0, np.intp))]
    for which, axes in ((np.flatnonzero(~steep), (0, 1)), (np.flatnonzero(steep), (1, 0))):
        if len(which):
            seen = np.stack([places[:, axes[0]], places[:, axes[1]]], axis=1)
            found += [
                (which[segment], place) for segment, place in _along(seen, start[which], end[which], reach)
            ]
    segment, place = (np.concatenate(each) for each in zip(*found, strict=True))
    step = places[place] - places[start[segment]]
    along = (step * way[segment]).sum(axis=1)
    order = np.lexsort((place, along, segment))
    return segment[order], place[order]


def _along(places: Steps, start: Index, end: Index, reach: int) -> Iterator[tuple[Index, Index]]:
    """Yield segments that are not steep with the places upon them."""
    strips = _Strips.of(places)
    ends = np.stack([places[start], places[end]])
    turned = ends[0, :, 0] > ends[1, :, 0]
    first, last = np.where(turned[:, None], ends[::-1], ends)
    near = (np.maximum(first[:, 0] - reach, strips.left) - strips.left) // strips.width
    far = (last[:, 0] + reach - strips.left) // strips.width
    counts = far - near + 1
    for some in _portions(counts):
        segment, strip = _spread(some, near[some], counts[some])
        lower, upper = _heights(strips, first[segment], last[segment], strip, reach)
        base = strip * strips.height
        begin = np.searchsorted(strips.keys, base + lower)
        members = np.searchsorted(strips.keys, base + upper, side="right") - begin
        for few in _portions(members):
            row, at = _spread(few, begin[few], members[few])
            which, place = segment[row], strips.order[at]
            upon = _upon(places[place], first[which], last[which], reach)
            upon &= (place != start[which]) & (place != end[which])
            yield which[upon], place[upon]


def _portions(counts: Ints) -> Iterator[Index]:
    """Yield what is to be looked at in portions of about ``AT_ONCE``, and nothing of what counts none."""
    some = np.flatnonzero(counts > 0)
    if len(some):
        total = np.cumsum(counts[some]) // AT_ONCE
        yield from np.split(some, np.flatnonzero(np.diff(total)) + 1)


def _spread(which: Index, begin: Ints, counts: Ints) -> tuple[Index, Ints]:
    """Return each of ``which`` so many times, and beside it numbers that count up from where it begins."""
    ends = np.cumsum(counts)
    return np.repeat(which, counts), np.arange(ends[-1]) + np.repeat(begin - ends + counts, counts)


def _heights(strips: _Strips, first: Steps, last: Steps, strip: Ints, reach: int) -> tuple[Ints, Ints]:
    """Return how low and how high segments come within strips, and a little more, above the lowest place."""
    across, up = last[:, 0] - first[:, 0], last[:, 1] - first[:, 1]
    begin = strip * strips.width + strips.left - first[:, 0]
    slope = up / across
    ends = [np.clip(each, 0, across) * slope for each in (begin, begin + strips.width)]
    above, more = first[:, 1] - strips.low, 2 * reach + 2
    lower = above + np.floor(np.minimum(*ends)).astype(np.int64) - more
    upper = above + np.ceil(np.maximum(*ends)).astype(np.int64) + more
    return np.clip(lower, 0, strips.height - 1), np.clip(upper, 0, strips.height - 1)


def _upon(places: Steps, first: Steps, last: Steps, reach: int) -> NDArray[np.bool_]:
    """Return which places lie beside a segment by no more than the reach, and between its ends."""
    x, y = last[:, 0] - first[:, 0], last[:, 1] - first[:, 1]
    u, v = places[:, 0] - first[:, 0], places[:, 1] - first[:, 1]
    square, along = x * x + y * y, x * u + y * v
    aside = np.abs(x * v - y * u)
    return np.asarray((along > 0) & (along < square) & (aside <= reach * np.sqrt(square)))
