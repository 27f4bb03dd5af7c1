"""Stretches chained to rings, in whole numbers: each goes on where another begins."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.congruence import same_points
from batik_vector.geometry.nets.cells import Cells, Mask, Places
from batik_vector.geometry.nets.meetings import Vector, between, same_way
from batik_vector.geometry.outlines import Index, Offsets, Steps
from batik_vector.values import frozen

SPLITS = 8
"""How often a ring that goes through points twice is cut in two."""


@frozen(eq=False)
class Chains:
    """Rings of stretches: ring i is made of the stretches ``order[ends[i]:ends[i + 1]]``, one after
    another."""

    order: Index
    ends: Offsets


def chained(start: Steps, end: Steps, first: Steps, last: Steps, whole: Mask) -> Chains | Index | None:
    """Chain stretches to rings.

    Return pairs of stretches where it is not sure how these go on, and None where some end nowhere.

    At a point where two end and two begin each goes on with the one that bounds the same area, as sharply to
    its left as can be: areas that touch there stay apart.

    Args:
        start, end: where each begins and ends, shape (n, 2).
        first, last: the second and the last but one point of each.
        whole: which are rings by themselves.
    """
    count = len(start)
    following = np.arange(count)
    open_ = np.flatnonzero(~whole)
    begin_key, end_key = _keys(start[open_], end[open_])
    by_begin, by_end = np.argsort(begin_key, kind="stable"), np.argsort(end_key, kind="stable")
    if not np.array_equal(begin_key[by_begin], end_key[by_end]):
        return None
    key = begin_key[by_begin]
    begins, ends = open_[by_begin], open_[by_end]
    same = np.append(key[1:] == key[:-1], False)[: len(key)]
    crowded = np.flatnonzero(same[1:] & same[:-1])
    if len(crowded):
        return _beside(begins, np.concatenate([crowded, crowded + 1]))
    several = np.flatnonzero(same)
    if len(several):
        a, b = begins[several], begins[several + 1]
        back = _minus(last[ends[several]], end[ends[several]])
        out_a, out_b = _minus(first[a], start[a]), _minus(first[b], start[b])
        other = _minus(last[ends[several + 1]], end[ends[several + 1]])
        # Clockwise from where it came: a comes before b where a lies between b and that.
        right, swapped = between(out_a, out_b, back), between(out_b, out_a, back)
        agrees = np.where(right, between(out_b, out_a, other), between(out_a, out_b, other))
        clash = same_way(out_a, out_b) | same_way(back, other)
        clash |= ~agrees | ~(right | swapped)
        if clash.any():
            return _beside(begins, several[clash])
        begins[several], begins[several + 1] = np.where(right, a, b), np.where(right, b, a)
    return _split(following, begins, ends, several)


def _split(following: Index, begins: Index, ends: Index, several: Index) -> Chains | Index:
    """Return rings none of which goes through a point twice: one that does is cut in two there."""
    for _ in range(SPLITS):
        following[ends] = begins
        chains = _cycles(following)
        ring = np.empty(len(chains.order), np.intp)
        ring[chains.order] = np.repeat(np.arange(len(chains.ends) - 1), np.diff(chains.ends))
        twice = several[ring[begins[several]] == ring[begins[several + 1]]]
        if not len(twice):
            return chains
        # One cut may bring apart what goes through other points twice.
        _, first = np.unique(ring[begins[twice]], return_index=True)
        at = twice[first]
        begins[at], begins[at + 1] = begins[at + 1], begins[at]
    return _beside(begins, twice)


def _beside(begins: Index, at: Index) -> Index:
    """Return the pairs of stretches that begin at some places of the list and at the next."""
    return np.column_stack([begins[at], begins[at + 1]])


def _keys(start: Steps, end: Steps) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return a number for each point, equal where they are."""
    low = np.minimum(start.min(axis=0, initial=0), end.min(axis=0, initial=0))
    one, other = ((each[:, 0] - low[0] << 32) + each[:, 1] - low[1] for each in (start, end))
    return one, other


def _minus(a: Steps, b: Steps) -> Vector:
    return a[:, 0] - b[:, 0], a[:, 1] - b[:, 1]


def _cycles(following: Index) -> Chains:
    """Return the cycles of a permutation, each from its least member on.

    Pointers are doubled, so the rounds grow with the logarithm of the longest cycle.
    """
    count = len(following)
    least, far = np.arange(count), following
    while True:
        lower = np.minimum(least, least[far])
        if np.array_equal(lower, least):
            break
        least, far = lower, far[far]
    # How far it is to the end of the cycle, before its least member.
    ends = following == least
    steps = np.where(ends, 0, 1)
    far = np.where(ends, np.arange(count), following)
    while True:
        more = steps[far]
        if not more.any():
            break
        steps, far = steps + more, far[far]
    sizes = np.bincount(least, minlength=count)
    heads = np.flatnonzero(sizes)
    offsets = np.concatenate([[0], np.cumsum(sizes[heads])])
    order = np.empty(count, np.intp)
    place = np.zeros(count, np.intp)
    place[heads] = offsets[:-1]
    order[place[least] + sizes[least] - 1 - steps] = np.arange(count)
    return Chains(order, offsets)


def entangled(start: Steps, end: Steps) -> Index | None:
    """Return the pairs of edges that meet elsewhere than at an end of both, shape (k, 2).

    None where there are too many to look at.

    Args:
        start, end: of each edge, shape (n, 2), different points.
    """
    if not len(start):
        return np.empty((0, 2), np.intp)
    (x, y), (to_x, to_y) = (np.ascontiguousarray(each.T) for each in (start, end))
    places = Places(x, y, to_x - x, to_y - y, np.arange(len(x)))
    cells = Cells.of(places)
    pairs = None if cells is None else cells.shared().pairs()
    if pairs is None:
        return None
    e, f = pairs
    gap_x, gap_y = x[f] - x[e], y[f] - y[e]
    ex, ey, fx, fy = places.dx[e], places.dy[e], places.dx[f], places.dy[f]
    turn = ex * fy - ey * fx
    from_e, from_f = ex * gap_y - ey * gap_x, fy * gap_x - fx * gap_y
    meet = np.sign(from_e) * np.sign(from_e + turn) <= 0
    meet &= np.sign(from_f) * np.sign(from_f - turn) <= 0
    # On one line they meet where their bounds do.
    for a, b, c, d in ((x[e], to_x[e], x[f], to_x[f]), (y[e], to_y[e], y[f], to_y[f])):
        meet &= np.maximum(np.minimum(a, b), np.minimum(c, d)) <= np.minimum(
            np.maximum(a, b), np.maximum(c, d)
        )
    ends = same_points(start[e], start[f]) | same_points(end[e], end[f])
    turned = same_points(start[e], end[f]) | same_points(end[e], start[f])
    along = ex * fx + ey * fy
    over = (from_e == 0) & (turn == 0) & np.where(ends, along > 0, along < 0)
    bad = meet & (~(ends | turned) | over)
    return np.column_stack([e[bad], f[bad]])
