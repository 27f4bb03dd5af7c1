"""Longest paths: strokes that meet become one, with as few lifts of the pen as can be.

At every place the ends that go on straightest are paired; then each round way is taken into another path that
it meets. What is left is least: for what hangs together, half as many paths as it has places where an odd
number of ends meet, and one where there are none. This is Hierholzer's way to Euler's paths, begun with whole
paths in place of wandering ones. C. Hierholzer, Mathematische Annalen 6 (1873), 30-32.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Offsets, Outlines, Steps
from batik_vector.processes.plotting.touching import numbered
from batik_vector.values import frozen

ENDS = 64
"""Ends in one place of which the straightest are paired; where more meet, they are paired as they come."""

FINE = 1 << 20
"""Parts of one in which it is measured how straight two ends go on."""

FREE = -1

Directions: TypeAlias = NDArray[np.float64]


@frozen(eq=False)
class _Edges:
    """Runs of points from one place where strokes may meet to the next.

    Edge e has the ends 2e and 2e + 1: ``place`` has the number of the place of each, and ``heading`` the way
    that the edge goes from there, shape (2n, 2), of length 1. ``first`` and ``last`` are its points.
    """

    first: Index
    last: Index
    place: Index
    heading: Directions


def longest(strokes: Outlines) -> Outlines:
    """Return strokes joined to longest paths, without names; closed where they come back to their beginning.

    Strokes are joined where they begin, end or turn in the same place; where they only cross between vertices
    they stay apart. Vertices on a straight way, which say nothing, are left out.

    Args:
        strokes: one ring or polyline to a mark.

    Raises:
        GeometryError: where the drawing is broader or higher than 2 km.
    """
    if not len(strokes):
        return strokes
    points, rings = strokes.repeating()
    places, number = numbered(points)
    edges = _edges(points, rings, number, len(places))
    partner = _paired(edges)
    _take_in_round_ways(partner, edges)
    return _straightened(_drawn(points, edges, list(_paths(partner.tolist()))))


def _edges(points: Steps, rings: Offsets, number: Index, places: int) -> _Edges:
    """Return the runs between places where strokes end, or where more than two ways go."""
    tip = np.zeros(len(points), bool)
    tip[rings[:-1]] = tip[rings[1:] - 1] = True
    ways = np.bincount(number[~tip], minlength=places) * 2 + np.bincount(number[tip], minlength=places)
    stops = tip | (ways[number] != 2)
    at = np.flatnonzero(stops)
    last_of_stroke = np.zeros(len(points), bool)
    last_of_stroke[rings[1:] - 1] = True
    inner = ~last_of_stroke[at[:-1]]
    first, last = at[:-1][inner], at[1:][inner]
    ends = np.stack([first, last], axis=1).ravel()
    beside = np.stack([first + 1, last - 1], axis=1).ravel()
    step = (points[beside] - points[ends]).astype(float)
    step /= np.maximum(np.sqrt((step * step).sum(axis=1)), 1.0)[:, None]
    return _Edges(first, last, number[ends], step)


def _paired(edges: _Edges) -> Index:
    """Return for each end the end at the same place in which a path goes on, or ``FREE``."""
    order = np.argsort(edges.place, kind="stable")
    heads = np.flatnonzero(np.append(True, np.diff(edges.place[order]) != 0))
    counts = np.diff(np.append(heads, len(order)))
    partner = np.full(len(order), FREE)
    for count in np.unique(counts[counts > 1]).tolist():
        ends = order[heads[counts == count][:, None] + np.arange(count)]
        if count == 2:
            partner[ends[:, 0]], partner[ends[:, 1]] = ends[:, 1], ends[:, 0]
        elif count <= ENDS:
            _pair_straightest(partner, ends, edges.heading)
        else:
            one, other = ends[:, 0 : count - 1 : 2], ends[:, 1::2]
            partner[one], partner[other] = other, one
    return partner


def _pair_straightest(partner: Index, ends: Index, heading: Directions) -> None:
    """Pair ends, shape (k, m) for k places at which m ends meet, the straightest first."""
    one, other = np.triu_indices(ends.shape[1], 1)
    cost = _bend(heading[ends[:, one]], heading[ends[:, other]])
    used: NDArray[np.bool_] = np.zeros(ends.shape, bool)
    row = np.arange(len(ends))
    for _ in range(ends.shape[1] // 2):
        best = np.where(used[:, one] | used[:, other], 3 * FINE, cost).argmin(axis=1)
        used[row, one[best]] = used[row, other[best]] = True
        a, b = ends[row, one[best]], ends[row, other[best]]
        partner[a], partner[b] = b, a


def _bend(one: Directions, other: Directions) -> NDArray[np.int64]:
    """Return how much a path bends that comes against one heading and leaves along another: 0 is straight on.

    Whole numbers, rounded, so that every machine chooses alike.
    """
    straight = one[..., 0] * other[..., 0] + one[..., 1] * other[..., 1]
    return np.asarray(np.rint((1 + straight) * FINE), np.int64)


def _paths(partner: list[int]) -> Iterator[tuple[list[int], bool]]:
    """Yield paths: the ends at which edges are entered, one after another, and whether the path is closed."""
    left = [True] * (len(partner) // 2)
    free = (end for end, other in enumerate(partner) if other == FREE)
    for opened, ends in ((True, free), (False, iter(range(0, len(partner), 2)))):
        for begin in ends:
            at, path = begin, list[int]()
            while at != FREE and left[at >> 1]:
                left[at >> 1] = False
                path.append(at)
                at = partner[at ^ 1]
            if path:
                yield path, not opened


def _take_in_round_ways(partner: Index, edges: _Edges) -> None:
    """Pair ends anew so that no closed path meets another path."""
    path_of, shut = np.empty(len(partner), np.intp), list[bool]()
    for number, (path, closed) in enumerate(_paths(partner.tolist())):
        entered = np.array(path)
        path_of[entered] = path_of[entered ^ 1] = number
        shut.append(closed)
    if not any(shut):
        return
    root = list(range(len(shut)))
    for ends in _meetings(path_of, np.array(shut), edges.place):
        _take_in(partner, ends, path_of, root, shut, edges.heading)


def _meetings(path_of: Index, shut: NDArray[np.bool_], place: Index) -> Iterator[list[int]]:
    """Yield the ends at each place where a closed path meets another."""
    order = np.lexsort((path_of, place))
    heads = np.flatnonzero(np.append(True, np.diff(place[order]) != 0))
    paths, tails = path_of[order], np.append(heads[1:], len(order)) - 1
    several = (paths[heads] != paths[tails]) & np.logical_or.reduceat(shut[paths], heads)
    for head, tail in zip(heads[several].tolist(), tails[several].tolist(), strict=True):
        yield order[head : tail + 1].tolist()


def _take_in(
    partner: Index, ends: list[int], path_of: Index, root: list[int], shut: list[bool], heading: Directions
) -> None:
    """Take the closed paths at a place into one that they meet there, an open one if there is any."""

    def found(end: int) -> int:
        at = int(path_of[end])
        while root[at] != at:
            root[at] = at = root[root[at]]
        return at

    # Each path once, by its first end here; an open one is the host.
    each = {found(end): end for end in reversed(ends)}
    ways = sorted(each, key=lambda path: (shut[path], path))
    host = ways[0]
    for guest in ways[1:]:
        if shut[guest]:
            _swap(partner, each[host], each[guest], heading)
            root[guest] = host


def _swap(partner: Index, host: int, guest: int, heading: Directions) -> None:
    """Pair an end of one path with an end of another anew, and those that they were paired with."""
    beyond, behind = int(partner[host]), int(partner[guest])
    ways = []
    for near, far in ((guest, behind), (behind, guest)):
        bend = _bend(heading[host], heading[near])
        if beyond != FREE:
            bend = bend + _bend(heading[beyond], heading[far])
        ways.append((int(bend), near, far))
    _, near, far = min(ways)
    partner[host], partner[near] = near, host
    partner[far] = beyond
    if beyond != FREE:
        partner[beyond] = far


def _drawn(points: Steps, edges: _Edges, paths: list[tuple[list[int], bool]]) -> Outlines:
    """Return the points of paths."""
    entered = np.array([end for path, _ in paths for end in path], np.intp)
    shut = np.array([closed for _, closed in paths], bool)
    tails = np.cumsum([len(path) for path, _ in paths]) - 1
    edge, back = entered >> 1, (entered & 1).astype(bool)
    # Of each edge all points but the last, which begins the next edge or the path once more.
    sizes = edges.last[edge] - edges.first[edge]
    sizes[tails] += 1
    ends = np.cumsum(sizes)
    local = np.arange(ends[-1]) - np.repeat(ends - sizes, sizes)
    begin, way = np.where(back, edges.last[edge], edges.first[edge]), np.where(back, -1, 1)
    drawn = points[np.repeat(begin, sizes) + local * np.repeat(way, sizes)]
    rings = np.concatenate([[0], ends[tails]]).astype(np.int64)
    # There and back encloses nothing.
    shut &= np.diff(rings) > 3
    drawn = np.delete(drawn, rings[1:][shut] - 1, axis=0)
    rings[1:] -= np.cumsum(shut)
    return Outlines(drawn, rings, np.arange(len(rings)), shut)


def _straightened(strokes: Outlines) -> Outlines:
    """Return strokes without the vertices at which they go exactly straight on."""
    points, first, last = strokes.points, strokes.rings[:-1], strokes.rings[1:] - 1
    here = np.arange(len(points))
    before, after = here - 1, here + 1
    before[first], after[last] = last, first
    x, y = (points - points[before]).T
    u, v = (points[after] - points).T
    straight = (x * v == y * u) & (x * u + y * v > 0)
    for tips in (first, last):
        straight[tips[~strokes.closed]] = False
    gone = np.concatenate([[0], np.cumsum(straight)])
    return Outlines(points[~straight], strokes.rings - gone[strokes.rings], strokes.marks, strokes.closed)
