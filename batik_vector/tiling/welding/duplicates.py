"""Nothing is drawn twice: stretches that several lines share are kept once.

Exact integer arithmetic on grid steps. Two stretches overlap when they lie on one straight line, that
is, when their directions in lowest terms and their distances from the origin are equal whole numbers,
and their intervals along it overlap.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.tiling.welding.congruent import alike


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
    for name in np.unique(names_of):
        mine = names_of == name
        strokes = shapely.linestrings(np.stack([begins[mine], stops[mine]], axis=1).astype(float))
        joined = shapely.get_parts(
            shapely.line_merge(shapely.multilinestrings(np.asarray(strokes, dtype=object)))
        )
        kept.append(joined)
        kept_names.append(np.full(len(joined), name, np.intp))
    return np.concatenate(kept), np.concatenate(kept_names)
