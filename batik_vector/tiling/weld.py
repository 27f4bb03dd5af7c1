"""Welding: areas that meet become one, component by component.

Uniting everything at once costs far more than uniting each connected group by itself, and an area that
meets no other needs nothing done. Coordinates are whole grid steps.
"""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.geometry.sampling import Indices
from batik_vector.tiling import overlay
from batik_vector.tiling.torus import polygons_of

ROUNDS = 6
"""How often areas that joining brought together are joined again; two are seldom needed, and dense scribbles
that never come apart on the grid are left as they are."""


def welded(areas: Geometries) -> tuple[Geometries, Indices]:
    """Join the areas that meet; return them with the index of the first area that each is made of.

    Areas that touch in points only stay apart.
    """
    origin = np.arange(len(areas))
    pairs = meeting(areas)
    # Joining moves crossings onto the grid, and may push an edge over a neighbour that it only came
    # near to; then these two are joined as well.
    for _ in range(ROUNDS):
        if not len(pairs):
            break
        areas, first = united(areas, pairs)
        origin = origin[first]
        pairs = meeting(areas)
        pairs = pairs[shapely.relate_pattern(areas[pairs[:, 0]], areas[pairs[:, 1]], "T********")]
    return areas, origin


def meeting(areas: Geometries) -> Indices:
    """Return the pairs of areas that have a point in common, shape (n, 2)."""
    if len(areas) < 2:
        return np.empty((0, 2), np.intp)
    a, b = shapely.STRtree(areas).query(areas, predicate="intersects")
    return np.asarray(np.column_stack([a, b])[a < b])


def components(count: int, pairs: Indices) -> Indices:
    """Return for each of ``count`` items the least item that a chain of pairs connects it with.

    Labels are hooked onto smaller ones and pointers doubled, so the rounds grow with the logarithm of the
    longest chain (Shiloach and Vishkin, 1982).
    """
    label = np.arange(count)
    while True:
        low = np.minimum(label[pairs[:, 0]], label[pairs[:, 1]])
        before = label.copy()
        for side in (0, 1):
            np.minimum.at(label, before[pairs[:, side]], low)
            np.minimum.at(label, pairs[:, side], low)
        while True:
            jumped = label[label]
            if np.array_equal(jumped, label):
                break
            label = jumped
        if np.array_equal(label, before):
            return label


def united(areas: Geometries, pairs: Indices) -> tuple[Geometries, Indices]:
    """Unite every connected group of areas, all groups of one size in one call."""
    label = components(len(areas), pairs)
    order = np.argsort(label, kind="stable")
    heads, start, sizes = np.unique(label[order], return_index=True, return_counts=True)
    parts, origins = [areas[heads[sizes == 1]]], [heads[sizes == 1]]
    for size in np.unique(sizes[sizes > 1]):
        mine = sizes == size
        groups = areas[order[start[mine][:, None] + np.arange(size)]]
        whole = overlay.united(groups)
        pieces, row = polygons_of(whole, np.arange(len(whole)))
        origin = heads[mine][row]
        # Areas that only touch fall apart again, each under its own name.
        several = np.flatnonzero(np.bincount(row, minlength=len(whole))[row] > 1)
        if len(several):
            members = order[start[mine][row[several]][:, None] + np.arange(size)]
            holds = shapely.intersects(areas[members], shapely.point_on_surface(pieces[several])[:, None])
            found = holds.any(axis=1)
            origin[several[found]] = members[found, holds.argmax(axis=1)[found]]
        parts.append(pieces)
        origins.append(origin)
    return np.concatenate(parts), np.concatenate(origins)
