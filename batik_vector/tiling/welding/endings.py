"""Where lines end on the seam of a torus.

A place on the seam shows on two edges of the page, a corner on all four; it is told by the one it has on
the left edge, or else on the lower one. All places are in whole grid steps.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Geometries
from batik_vector.tiling.torus.torus import Steps

Places = set[tuple[int, int]]


def own_ends(lines: Geometries, cell: Cell) -> Places:
    """Return the places on the rim of the page at which open lines begin or end."""
    if not len(lines):
        return set()
    lines = lines[~shapely.is_closed(lines)]
    ends = [shapely.get_coordinates(shapely.get_point(lines, at)) for at in (0, -1)]
    return {(x, y) for x, y in _on_rim(np.vstack(ends), cell)[0].tolist()}


def tips(lines: Geometries, cell: Cell) -> Places:
    """Return the places on the rim of the page at which lines run back the way they came.

    There is the point of a shape that is thinner than a step: drawn once, its line ends there.
    """
    coords = shapely.get_coordinates(lines)
    sizes = shapely.get_num_coordinates(lines)
    last = np.cumsum(sizes) - 1
    first = last - sizes + 1
    following = np.arange(1, len(coords) + 1)
    # A closed line goes on from its end as it began; there and back alone begins where it was cut.
    following[last] = first + 1
    inner = np.ones(len(coords), bool)
    inner[first] = False
    inner[last[~shapely.is_closed(lines) | (sizes <= 3)]] = False
    at = np.flatnonzero(inner)
    come, gone = coords[at] - coords[at - 1], coords[following[at]] - coords[at]
    level = come[:, 0] * gone[:, 1] == come[:, 1] * gone[:, 0]
    back = at[level & ((come * gone).sum(axis=1) < 0)]
    return {(x, y) for x, y in _on_rim(coords[back], cell)[0].tolist()}


def lone_ends(lines: Geometries, cell: Cell) -> Places:
    """Return the places on the rim from which all lines run in a single direction: none goes on there.

    Lines that lie on one another, as the images of one beside a mirror may, count as one.
    """
    if not len(lines):
        return set()
    coords, owner = shapely.get_coordinates(lines, return_index=True)
    inside = owner[1:] == owner[:-1]
    begin, end = coords[:-1][inside], coords[1:][inside]
    places, at = _on_rim(np.vstack([begin, end]), cell)
    away: Steps = np.rint(np.vstack([end - begin, begin - end])[at]).astype(np.int64)
    away //= np.maximum(np.gcd(away[:, 0], away[:, 1]), 1)[:, None]
    directions = np.unique(np.column_stack([places, away]), axis=0)
    lone, counts = np.unique(directions[:, :2], axis=0, return_counts=True)
    return {(x, y) for x, y in lone[counts == 1].tolist()}


def on_edges(lines: Geometries) -> list[tuple[int, int, int]]:
    """Return the stretches of lines on the left and the lower edge of the page, as (axis, from, to)."""
    coords, owner = shapely.get_coordinates(lines, return_index=True)
    found = []
    for axis in (0, 1):
        on = coords[:, axis] == 0
        mine = on[1:] & on[:-1] & (owner[1:] == owner[:-1])
        ends = np.sort(np.column_stack([coords[:-1, 1 - axis], coords[1:, 1 - axis]])[mine], axis=1)
        found += [(axis, int(low), int(high)) for low, high in ends.tolist()]
    return found


def _on_rim(points: NDArray[np.float64], cell: Cell) -> tuple[Steps, NDArray[np.intp]]:
    """Return the places of those points that lie on the rim of the page, shape (n, 2), and their rows."""
    whole: Steps = np.rint(points).astype(np.int64)
    x, y = whole.T
    within = (x >= 0) & (x <= cell.columns) & (y >= 0) & (y <= cell.rows)
    at = np.flatnonzero(within & ((x == 0) | (x == cell.columns) | (y == 0) | (y == cell.rows)))
    places: Steps = whole[at]
    (_, slip_y), (slip_x, _) = cell.lattice
    sides = ((0, cell.columns, slip_y), (1, cell.rows, slip_x))
    # The direction that drops comes first: what it moves along the other edge may reach the end of it.
    for axis, side, slip in sides if slip_x == 0 else sides[::-1]:
        far = places[:, axis] == side
        places[far, axis] = 0
        places[far, 1 - axis] -= slip
        places[:, 1 - axis] %= sides[1 - axis][1]
    return places, at
