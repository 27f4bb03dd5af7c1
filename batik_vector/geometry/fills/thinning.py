"""Which of many places can stay where some lie too near to one another."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.sampling import Array, Geometries, Indices

NEIGHBOURS = ((0, 0), (1, 0), (-1, 1), (0, 1), (1, 1))
"""Cells that are asked for each: of two cells side by side, one asks for the other."""


def near_pairs(points: Array, group: Indices, least: float) -> tuple[Indices, Indices]:
    """Return which places of one group lie nearer than ``least``, each pair once, the lower number first."""
    if len(points) < 2:
        return np.empty(0, np.intp), np.empty(0, np.intp)
    cell = np.floor((points - points.min(axis=0)) / least).astype(np.int64) + 1
    wide, tall = cell.max(axis=0) + 2
    key = (group.astype(np.int64) * tall + cell[:, 1]) * wide + cell[:, 0]
    order = np.argsort(key, kind="stable")
    key, at = key[order], points[order]
    firsts, seconds = [], []
    for dx, dy in NEIGHBOURS:
        wanted = key + dy * wide + dx
        same = dx == dy == 0
        low = np.arange(1, len(key) + 1) if same else np.searchsorted(key, wanted, side="left")
        count = np.maximum(np.searchsorted(key, wanted, side="right") - low, 0)
        a = np.repeat(np.arange(len(key)), count)
        b = low[a] + np.arange(len(a)) - np.repeat(np.cumsum(count) - count, count)
        apart = at[a] - at[b]
        near = (apart**2).sum(axis=1) < least**2
        firsts.append(order[a[near]])
        seconds.append(order[b[near]])
    a, b = np.concatenate(firsts), np.concatenate(seconds)
    return np.minimum(a, b), np.maximum(a, b)


def settled(rank: Indices, first: Indices, second: Indices) -> NDArray[np.bool_]:
    """Return which things stay so that of no pair both do: the lower rank has its way, of equals neither.

    In each round those stay whose rivals of lower rank are all gone, and their rivals go. That equals both go
    keeps the symmetry of what is ranked alike on both sides of an axis.
    """
    kept, open_ = np.ones(len(rank), bool), np.ones(len(rank), bool)
    swap = rank[first] > rank[second]
    first, second = np.where(swap, second, first), np.where(swap, first, second)
    while len(first):
        equal = rank[first] == rank[second]
        held = np.zeros(len(rank), bool)
        held[second[~equal]] = True
        free, a, b = open_ & ~held, first[equal], second[equal]
        waits = np.zeros(len(rank), bool)
        waits[a[held[b]]] = waits[b[held[a]]] = True
        drawn = free[a] & free[b]
        gone = np.concatenate([a[drawn], b[drawn]])
        kept[gone] = open_[gone] = False
        stays = free & ~waits & kept
        gone = second[stays[first]]
        kept[gone] = open_[gone] = False
        open_ &= ~stays
        alive = open_[first] & open_[second]
        first, second = first[alive], second[alive]
    return kept


def thinned(points: Array, group: Indices, least: float, rank: Indices | None = None) -> NDArray[np.bool_]:
    """Return which places stay so that none of a group lie nearer than ``least``; the lower rank has its way.

    Where no rank is given, the earlier has its way.
    """
    order = np.arange(len(points)) if rank is None else rank
    return settled(order, *near_pairs(points, group, least))


def clear(lines: Geometries, group: Indices, least: float, rank: Indices) -> NDArray[np.bool_]:
    """Return which lines stay so that none of a group lie nearer than ``least``, as above."""
    if len(lines) < 2:
        return np.ones(len(lines), bool)
    alone = _apart(lines, group, least)
    a, b = shapely.STRtree(alone).query(alone, predicate="dwithin", distance=least)
    return settled(rank, a[a < b], b[a < b])


def _apart(lines: Geometries, group: Indices, least: float) -> Geometries:
    """Return lines with every group moved to a place of its own: they all lie about one centre."""
    points, of = shapely.get_coordinates(lines, return_index=True)
    points[:, 0] += group[of] * (np.ptp(points[:, 0]) + 2 * least)
    return np.asarray(shapely.set_coordinates(np.array(lines, dtype=object), points), dtype=object)


def by_length(lines: Geometries) -> Indices:
    """Return ranks by which the longer line has its way; equals are those of one length but for rounding."""
    _, rank = np.unique(np.rint(-shapely.length(lines) * 1e6), return_inverse=True)
    return np.asarray(rank, dtype=np.intp)
