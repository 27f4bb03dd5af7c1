"""Which stroke lies inside which closed one, at every depth, in bulk."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines, to_polygons
from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.ordering.neighbours import NOBODY

PAIRS = 4_000_000
"""Pairs of strokes whose bounds meet that are held in memory at a time, at most."""
MOST = 1_000_000
"""Pairs that are all asked; past it each stroke is asked up to the smallest that holds it."""
ASKED = 3
"""Vertices of a stroke that are asked whether they lie inside: it may touch with one of them."""


def parents(strokes: Outlines) -> Index:
    """Return the closed stroke that each lies in, the smallest of several, or ``NOBODY``.

    Of closed strokes that cross and both hold a third, the smaller is taken to lie in the larger; so all
    that hold a stroke are its parent, that one's parent, and so on.

    Args:
        strokes: one ring or polyline to a mark, none of them empty.
    """
    count = len(strokes)
    found = np.full(count, NOBODY, np.intp)
    shut = np.flatnonzero(strokes.closed)
    bounds = strokes.bounds()
    if not len(shut) or count < 2:
        return found
    area = _areas(strokes)
    shut = shut[np.argsort(area[shut], kind="stable")]
    # A line says as much of its bounds as a box, and is made in a third of the time.
    boxes = np.asarray(shapely.linestrings(bounds.reshape(-1, 2, 2).astype(float)), dtype=object)
    tree = shapely.STRtree(boxes[shut])
    regions = _Regions(strokes)
    pairs = list[tuple[Index, Index]]()
    asked = 0
    step = max(64, PAIRS // len(shut))
    for first, stop in pairwise([*range(0, count, step), count]):
        child, held = tree.query(boxes[first:stop])
        child = child + first
        # Held in a larger one, or of two alike in the later.
        other = shut[held]
        inside = (bounds[other, :2] <= bounds[child, :2]).all(axis=1)
        inside &= (bounds[other, 2:] >= bounds[child, 2:]).all(axis=1)
        inside &= (area[other] > area[child]) | ((area[other] == area[child]) & (other > child))
        child, held = child[inside], held[inside]
        nearest = np.lexsort([held, child])
        child, held = child[nearest], held[nearest]
        asked += len(child)
        if asked <= MOST:
            true = regions.hold(shut[held], child)
            pairs.append((child[true], held[true]))
        else:
            pairs.append(_smallest(child, held, shut, regions))
    return _chained(count, shut, *(np.concatenate(each) for each in zip(*pairs, strict=True)))


def _chained(count: int, shut: Index, child: Index, held: Index) -> Index:
    """Return a parent for each stroke, such that all that hold it are among its parent's parents.

    This is the elimination tree of the pairs: J. W. H. Liu, The role of elimination trees in sparse
    factorization, SIAM Journal on Matrix Analysis and Applications 11 (1990).
    """
    order = np.lexsort([child, held])
    parent, top = [NOBODY] * count, [NOBODY] * count
    for one, other in zip(child[order].tolist(), shut[held[order]].tolist(), strict=True):
        # Up to the last that was found to hold it so far; what is passed goes straight there from now on.
        while top[one] not in (NOBODY, other):
            top[one], one = other, top[one]
        if top[one] == NOBODY and one != other:
            top[one] = parent[one] = other
    return np.array(parent, np.intp)


def _areas(strokes: Outlines) -> NDArray[np.int64]:
    """Return twice the area of each closed stroke, 0 of others."""
    points, rings = strokes.points, strokes.rings
    x, y = points[:, 0], points[:, 1]
    first, last = rings[:-1], rings[1:] - 1
    # Whole numbers: what goes past their range on the way comes back.
    cross = np.empty(len(points), np.int64)
    cross[:-1] = x[:-1] * y[1:] - y[:-1] * x[1:]
    cross[last] = x[last] * y[first] - y[last] * x[first]
    return np.where(strokes.closed, np.abs(np.add.reduceat(cross, rings[:-1])), 0)


class _Regions:
    """The regions of closed strokes, made when they are first asked for."""

    def __init__(self, strokes: Outlines) -> None:
        self._strokes = strokes
        self._made: Geometries = np.empty(len(strokes), dtype=object)
        self._there = np.zeros(len(strokes), bool)
        first, sizes = strokes.rings[:-1], np.diff(strokes.rings)
        part = np.arange(ASKED) * sizes[:, None] // ASKED
        self._asked = strokes.points[first[:, None] + part].astype(float)

    def hold(self, region: Index, stroke: Index) -> NDArray[np.bool_]:
        """Return which strokes lie inside which regions, pair by pair: most of what is asked of each."""
        if not len(region):
            return np.empty(0, bool)
        # np.unique would import all of masked arrays, which takes longer than most orders.
        asked_for = np.zeros(len(self._there), bool)
        asked_for[region] = True
        new = np.flatnonzero(asked_for & ~self._there)
        if len(new):
            self._made[new] = to_polygons(self._strokes.taken(new))
            shapely.prepare(self._made[new])
            self._there[new] = True
        asked = self._asked[stroke]
        regions = np.repeat(self._made[region], ASKED)
        inside = shapely.contains_xy(regions, asked[:, :, 0].ravel(), asked[:, :, 1].ravel())
        return np.asarray(inside.reshape(-1, ASKED).sum(axis=1) * 2 > ASKED)


def _smallest(child: Index, held: Index, shut: Index, regions: _Regions) -> tuple[Index, Index]:
    """Return for each child the first that holds it; pairs come by child, the smallest first."""
    found = list[tuple[Index, Index]]()
    while len(child):
        first = np.append(True, child[1:] != child[:-1])
        asked = np.flatnonzero(first)
        asked = asked[regions.hold(shut[held[asked]], child[asked])]
        found.append((child[asked], held[asked]))
        left = ~first & ~np.isin(child, child[asked])
        child, held = child[left], held[left]
    none = np.empty(0, np.intp)
    return np.concatenate([none, *(pair[0] for pair in found)]), np.concatenate(
        [none, *(pair[1] for pair in found)]
    )


def inside_first(sequence: Index, parent: Index) -> Index:
    """Return an order in which each stroke follows what lies inside it.

    Args:
        sequence: all strokes; those in the same one in the order in which they are wanted.
        parent: as :func:`parents` gives it.
    """
    if (parent == NOBODY).all():
        return sequence
    depth = np.zeros(len(parent), np.intp)
    above = parent.copy()
    while (deep := above != NOBODY).any():
        depth += deep
        above[deep] = parent[above[deep]]
    levels = np.argsort(depth, kind="stable")
    cuts = np.searchsorted(depth[levels], np.arange(depth.max() + 2))
    # How many are drawn up to and with each, itself the last.
    size = np.ones(len(parent), np.int64)
    for first, stop in zip(cuts[-2:0:-1].tolist(), cuts[:1:-1].tolist(), strict=True):
        some = levels[first:stop]
        np.add.at(size, parent[some], size[some])
    order = sequence[np.argsort(parent[sequence], kind="stable")]
    ends = np.cumsum(size[order])
    group = parent[order]
    heads = np.flatnonzero(np.append(True, group[1:] != group[:-1]))
    before = np.concatenate([[0], ends])[heads]
    place = np.empty(len(parent), np.int64)
    place[order] = ends - size[order] - np.repeat(before, np.diff(np.append(heads, len(order))))
    for first, stop in zip(cuts[1:-1].tolist(), cuts[2:].tolist(), strict=True):
        some = levels[first:stop]
        place[some] += place[parent[some]]
    return np.argsort(place + size - 1, kind="stable")
