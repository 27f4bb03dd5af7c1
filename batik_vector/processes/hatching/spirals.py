"""Rings within rings joined to spirals.

Each ring is left at the place nearest to the beginning of the next one within, and begun a little beyond that
place. So the way from ring to ring is the shortest from the inner one outwards, and lies between them. A ring
in which several others lie goes on to one of them; the others begin spirals of their own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines, Steps, nothing, to_polylines, together
from batik_vector.processes.hatching.paths import Stretches, chains, lengths, polylines
from batik_vector.processes.hatching.regions import Regions
from batik_vector.processes.hatching.rings import Level, levels
from batik_vector.values import frozen

GAP = 0.75
"""How many spacings of a ring are left out between its end and its beginning; ends are round, and at a whole
spacing white would stay on either side."""
LARGEST_GAP = 0.25
"""How much of a ring is left out between end and beginning at most: some are shorter than a spacing."""


@frozen(eq=False)
class _Walks:
    """Where the walk round each ring begins and where it ends, as distances along it in steps, and which ring
    it goes on to, or -1.
    """

    begin: NDArray[np.float64]
    end: NDArray[np.float64]
    onward: Index


def spirals(regions: Regions, spacing: float, width: float, *, edge_last: bool) -> tuple[Outlines, Index]:
    """Return a spiral of each chain of rings, from the outside in, and the mark of each.

    Args:
        regions: bounded by the outmost rings.
        spacing: from ring to ring, in steps.
        width: of the pen, in steps.
        edge_last: whether the outmost rings are strokes of their own, which come last.
    """
    found = list(levels(regions, spacing, width))
    edge, found = (found[:1], found[1:]) if edge_last else ([], found)
    marks = np.concatenate([np.empty(0, np.intp), *(level.marks for level in found)])
    rings = together([level.strokes for level in found])
    first = np.cumsum([0, *(len(level.strokes) for level in found)])
    walks = _walks(rings, first, found, spacing)
    strokes, heads = _drawn(rings, walks)
    drawn = [strokes, *(level.strokes for level in edge)]
    return together(drawn), np.concatenate([marks[heads], *(level.marks for level in edge)])


def _walks(rings: Outlines, first: Index, found: Sequence[Level], spacing: float) -> _Walks:
    """Return the walks round rings, settled from the inside out.

    Args:
        rings: all of them, level by level.
        first: where each level begins among them.
        found: the levels.
        spacing: in steps.
    """
    lines = to_polylines(rings)
    whole = shapely.length(lines)
    # Lines that are no rings are drawn from end to end.
    gap = np.where(rings.closed, np.minimum(GAP * spacing, LARGEST_GAP * whole), 0.0)
    begin, end = np.zeros(len(rings)), whole - gap
    onward = np.full(len(rings), -1, np.intp)
    for number in range(len(found) - 1, 0, -1):
        inner, outer = (
            np.arange(first[number], first[number + 1]),
            np.arange(first[number - 1], first[number]),
        )
        starts = shapely.line_interpolate_point(lines[inner], begin[inner])
        child, parent = _pairs(found[number].within, found[number - 1].bounds)
        away = np.rint(shapely.distance(starts[child], lines[outer[parent]]))
        nearest = np.lexsort((parent, away, child))
        nearest = nearest[np.diff(child[nearest], prepend=-1) > 0]
        child, parent = child[nearest], parent[nearest]
        longest = np.lexsort((child, -np.rint(whole[inner[child]]), parent))
        longest = longest[np.diff(parent[longest], prepend=-1) > 0]
        child, parent = child[longest], outer[parent[longest]]
        onward[parent] = inner[child]
        end[parent] = shapely.line_locate_point(lines[parent], starts[child])
        begin[parent] = np.mod(end[parent] + gap[parent], whole[parent])
    return _Walks(begin, end, onward)


def _pairs(children: Index, parents: Index) -> tuple[Index, Index]:
    """Return all pairs of places in two lists that hold the same number; the second list is sorted."""
    low, high = (np.searchsorted(parents, children, side=side) for side in ("left", "right"))
    counts = high - low
    child = np.repeat(np.arange(len(children)), counts)
    return child, np.arange(len(child)) - np.repeat(np.cumsum(counts) - counts - low, counts)


def _drawn(rings: Outlines, walks: _Walks) -> tuple[Outlines, Index]:
    """Return chains of walks as strokes, and the ring with which each begins; a single ring is closed."""
    before = np.full(len(rings), -1, np.intp)
    linked = np.flatnonzero(walks.onward >= 0)
    before[walks.onward[linked]] = linked
    order, heads = chains(before)
    if not len(rings):
        return nothing(), heads
    begun, first = _places(rings, walks.begin)
    ended, last = _places(rings, walks.end)
    count = last - first + np.where(walks.end < walks.begin, np.diff(rings.rings), 0)
    ways = Stretches(np.arange(len(rings)), first + 1, count, np.zeros(len(rings), bool)).taken(order)
    lone = np.diff(np.append(heads, len(order))) == 1
    sizes = ways.count + 2
    # The whole ring, which neither begins nor ends, or the whole line.
    ways.first[heads[lone]] = rings.rings[order[heads[lone]]]
    ways.count[heads[lone]] = sizes[heads[lone]] = np.diff(rings.rings)[order[heads[lone]]]
    ends = np.concatenate([[0], np.cumsum(sizes)])
    points = np.empty((ends[-1], 2), np.int64)
    points[ends[:-1]], points[ends[1:] - 1] = begun[order], ended[order]
    members, of, nth = ways.members(rings)
    points[ends[of] + (sizes - ways.count > 0)[of] + nth] = rings.points[members]
    strokes, kept = polylines(points, np.append(ends[heads], ends[-1]))
    return replace(strokes, closed=lone[kept] & rings.closed[order[heads[kept]]]), order[heads[kept]]


def _places(rings: Outlines, along: NDArray[np.float64]) -> tuple[Steps, Index]:
    """Return the place so far along each ring, and the point at which the edge begins on which it lies."""
    length, before = lengths(rings)
    first, last = rings.rings[:-1], rings.rings[1:] - 1
    at = np.minimum(before[first] + along, before[last + 1])
    edge = np.clip(np.searchsorted(before, at, side="right") - 1, first, last)
    share = (at - before[edge]) / np.maximum(length[edge], 1.0)
    a, b = rings.points[edge], rings.points[np.where(edge == last, first, edge + 1)]
    places: Steps = np.rint(a + (b - a) * share[:, None]).astype(np.int64)
    return places, edge
