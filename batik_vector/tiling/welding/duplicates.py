"""Nothing is drawn twice: stretches that several lines share are kept once.

Exact integer arithmetic on grid steps. Two stretches overlap when they lie on one straight line, that
is, when their directions in lowest terms and their distances from the origin are equal whole numbers,
and their intervals along it overlap.

Copies of one line that come to lie on one another by different ways, turned or mirrored, are rounded apart by
a step here and there. Their segments are made the same first.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry.congruence import alike, distinct
from batik_vector.geometry.nets.components import components
from batik_vector.tiling.torus.torus import Window

ROUNDED = 1
"""By how many steps along each axis the roundings of one point may stand apart."""

LEAST = 8
"""Segments up to this long (steps) are too short to be told apart from their neighbours."""


def drawn_once(lines: Geometries, names: NDArray[np.intp]) -> tuple[Geometries, NDArray[np.intp]]:
    """Return polylines (whole grid steps) without shared stretches, and their names.

    Lines that share nothing stay as they are; those that do are taken apart, each stretch kept once
    under the name of the first that draws it, and joined again end to end.
    """
    if not len(lines):
        return lines, names
    coords, owner = shapely.get_coordinates(lines, return_index=True)
    xy = coords.astype(np.int64)
    keep = owner[1:] == owner[:-1]
    segments = np.hstack([xy[:-1], xy[1:]])[keep]
    owner = owner[:-1][keep]
    line, low, high, ends = _on_lines(segments)
    order = np.lexsort([owner, high, low, line])
    group = line[order]
    # The farthest end reached so far on the same line; offsetting each line keeps the maxima apart.
    span = int(high.max() - low.min()) + 1
    reach = np.maximum.accumulate(high[order] - low.min() + group * span) - group * span + low.min()
    chained = np.zeros(len(order), bool)
    chained[1:] = (group[1:] == group[:-1]) & (low[order][1:] < reach[:-1])
    if not chained.any():
        return lines, names
    return _rejoined(lines, names, owner, order, chained, (high, ends))


def aligned(lines: Geometries, window: Window) -> Geometries:
    """Return polylines whose segments are the same where they were so but for a step of rounding.

    What lies on the edges of the window stays where it is.
    """
    if not len(lines):
        return lines
    coords, owner = shapely.get_coordinates(lines, return_index=True)
    xy = coords.astype(np.int64)
    begin = np.flatnonzero(owner[1:] == owner[:-1])
    begin = begin[np.abs(xy[begin + 1] - xy[begin]).max(axis=1) > LEAST]
    pairs = _near_alike(xy, begin)
    x, y = xy.T
    free = (x > window.left) & (y > window.bottom) & (x < window.right) & (y < window.top)
    pairs = pairs[free[pairs].all(axis=1) & (xy[pairs[:, 0]] != xy[pairs[:, 1]]).any(axis=1)]
    if not len(pairs):
        return lines
    label = components(len(xy), pairs)
    # The least of all places is the same wherever the lines lie.
    order = np.lexsort([xy[:, 1], xy[:, 0], label])
    heads, number = np.unique(label[order], return_index=True)
    moved = xy[order[number]][np.searchsorted(heads, label)]
    return np.asarray(shapely.set_coordinates(lines.copy(), moved.astype(float)), dtype=object)


def _near_alike(xy: NDArray[np.int64], begin: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return the pairs of vertices that segments, ``begin`` to the next, share but for rounding."""
    middle = xy[begin] + xy[begin + 1]
    found = [np.empty((0, 2), np.intp)]
    side = 4 * ROUNDED
    # Two that are near share a square of one of four grids, each set off by half a square.
    for corner in ((0, 0), (0, side // 2), (side // 2, 0), (side // 2, side // 2)):
        square = (middle + corner) // side
        order = np.lexsort([square[:, 1], square[:, 0]])
        follows = (square[order[1:]] == square[order[:-1]]).all(axis=1)
        one, other = begin[order[:-1][follows]], begin[order[1:][follows]]
        for there, back in ((other, other + 1), (other + 1, other)):
            near = np.abs(xy[one] - xy[there]).max(axis=1) <= ROUNDED
            near &= np.abs(xy[one + 1] - xy[back]).max(axis=1) <= ROUNDED
            found += [np.column_stack([one, there])[near], np.column_stack([one + 1, back])[near]]
    return np.concatenate(found)


def _on_lines(
    segments: NDArray[np.int64],
) -> tuple[NDArray[np.intp], NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Return for each segment: the number of its straight line, its interval on it, its ordered ends."""
    step = segments[:, 2:] - segments[:, :2]
    back = (step[:, 0] < 0) | ((step[:, 0] == 0) & (step[:, 1] < 0))
    ends = segments.copy()
    ends[back] = ends[back][:, [2, 3, 0, 1]]
    step[back] *= -1
    step //= np.gcd(step[:, 0], step[:, 1])[:, None]
    distance = step[:, 0] * ends[:, 1] - step[:, 1] * ends[:, 0]
    _, line = alike(np.column_stack([step, distance]))
    # Along a line the abscissa orders the points; along an upright one the ordinate does.
    axis = np.where(step[:, 0] == 0, 1, 0)
    index = np.arange(len(ends))
    return line, ends[index, axis], ends[index, axis + 2], ends


def _rejoined(
    lines: Geometries,
    names: NDArray[np.intp],
    owner: NDArray[np.intp],
    order: NDArray[np.intp],
    chained: NDArray[np.bool_],
    where: tuple[NDArray[np.int64], NDArray[np.int64]],
) -> tuple[Geometries, NDArray[np.intp]]:
    high, ends = where
    chain = np.cumsum(~chained) - 1
    sizes = np.bincount(chain)
    touched = np.zeros(len(lines), bool)
    touched[owner[order][sizes[chain] > 1]] = True
    part = touched[owner[order]]
    number = chain[part]
    members = order[part]
    _, first = np.unique(number, return_index=True)
    begins = ends[members[first], :2]
    highest = members[np.lexsort([high[members], number])]
    stops = ends[highest[np.append(first[1:], len(members)) - 1], 2:]
    names_of = np.minimum.reduceat(names[owner[members]], first)
    kept, kept_names = [lines[~touched]], [names[~touched]]
    for name in distinct(names_of):
        mine = names_of == name
        strokes = shapely.linestrings(np.stack([begins[mine], stops[mine]], axis=1).astype(float))
        joined = shapely.get_parts(
            shapely.line_merge(shapely.multilinestrings(np.asarray(strokes, dtype=object)))
        )
        kept.append(joined)
        kept_names.append(np.full(len(joined), name, np.intp))
    return np.concatenate(kept), np.concatenate(kept_names)
