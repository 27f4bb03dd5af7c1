"""Chaining: edges that go on in one another alone, as one line from fork to fork.

GEOS makes polygons of lines several times sooner than of their edges one by one.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.arrangement.noding import in_one
from batik_vector.geometry.nesting import rings_of
from batik_vector.geometry.outlines import Index, Steps
from batik_vector.geometry.sampling import Geometries
from batik_vector.geometry.stretches import ranges


def chained(ends: Steps) -> Geometries:
    """Return lines that are made of edges, each from where others than two meet to where they do again.

    Args:
        ends: shape (n, 4), edges that meet at their ends alone, each there once.
    """
    if not len(ends):
        return np.empty(0, dtype=object)
    states, first, count = _chains(ends)
    # State 2k runs along edge k, state 2k + 1 back.
    begin = ends.reshape(-1, 2)
    points = np.empty((int(count.sum()) + len(count), 2))
    line = np.repeat(np.arange(len(count)), count + 1)
    last = np.cumsum(count + 1) - 1
    inner = np.ones(len(points), bool)
    inner[last] = False
    chosen = states[ranges(first, count)]
    points[inner] = begin[chosen]
    points[last] = begin[states[first + count - 1] ^ 1]
    return np.asarray(shapely.linestrings(points, indices=line), dtype=object)


def _chains(ends: Steps) -> tuple[Index, Index, Index]:
    """Return states as they follow one another, where each chain begins, and its length."""
    following = _following(ends)
    order, sizes = rings_of(following)
    begin = np.cumsum(sizes) - sizes
    turns = following[order] == order ^ 1
    # There and back again: a chain begins behind one of its two turns. A ring has none, and is there twice.
    ring = np.repeat(np.arange(len(sizes)), sizes)
    turn = np.flatnonzero(turns)
    with_turn, at = np.unique(ring[turn], return_index=True)
    rings = np.setdiff1d(np.arange(len(sizes)), with_turn, assume_unique=True)
    rings = rings[order[begin[rings]] % 2 == 0]
    first = np.concatenate([turn[at] + 1, begin[rings]])
    return order, first, np.concatenate([sizes[with_turn] // 2, sizes[rings]])


def _following(ends: Steps) -> NDArray[np.int64]:
    """Return the state that follows each: where two edges meet the other one, elsewhere the way back."""
    begin = in_one(ends.reshape(-1, 2))
    order = np.argsort(begin, kind="stable")
    same = begin[order][1:] == begin[order][:-1]
    # The first of two that begin in a place where no third does.
    two = same & ~np.append(same[1:], False) & ~np.append(False, same[:-1])
    at = np.flatnonzero(two)
    other = np.arange(len(begin))
    one, following = order[at], order[at + 1]
    other[one], other[following] = following, one
    # What begins where a state ends is the state back, or the other one that begins there.
    back = np.arange(len(begin)) ^ 1
    return np.asarray(other[back], np.int64)
