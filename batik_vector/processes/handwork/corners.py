"""Corners: outlines get them wherever they have to bend together with others, and often enough."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from batik_vector.artwork import Cell
from batik_vector.geometry.outlines import Offsets, Outlines, Steps
from batik_vector.processes.trapping.meeting import NEAR, with_corners


def cornered(layers: Sequence[Outlines], cell: Cell) -> list[Outlines]:
    """Return areas with corners wherever others have them on their outlines, across the seam too."""
    around = [_neighbours(each, cell) for each in layers]
    return with_corners([*layers, *around])[: len(layers)]


def _neighbours(areas: Outlines, cell: Cell) -> Outlines:
    """Return the repeats of areas that touch the tile from without."""
    (ax, ay), (bx, by) = cell.lattice
    bounds = areas.bounds()
    which, shifts = [], []
    for i in range(-2, 3):
        for j in range(-2, 3):
            shift = np.array([i * ax + j * bx, i * ay + j * by])
            low, high = bounds[:, :2] + shift - NEAR, bounds[:, 2:] + shift + NEAR
            near = (low <= (cell.columns, cell.rows)).all(axis=1) & (high >= 0).all(axis=1)
            if shift.any():
                which.append(np.flatnonzero(near))
                shifts.append(np.broadcast_to(shift, (len(which[-1]), 2)))
    return areas.taken(np.concatenate(which), np.concatenate(shifts))


def densified(areas: Outlines, step: float) -> Outlines:
    """Return areas with no edge longer than a step."""
    if not len(areas.points):
        return areas
    following = np.append(areas.points[1:], areas.points[:1], axis=0)
    following[areas.rings[1:] - 1] = areas.points[areas.rings[:-1]]
    points, counts = divided(areas.points, following, step)
    return replace(areas, points=points, rings=np.append(0, np.cumsum(counts))[areas.rings])


def densified_lines(points: Steps, offsets: Offsets, step: float) -> tuple[Steps, Offsets]:
    """Return lines, one after another, with no edge longer than a step."""
    following = np.append(points[1:], points[-1:], axis=0)
    last = offsets[1:] - 1
    following[last] = points[last]
    made, counts = divided(points, following, step)
    return made, np.append(0, np.cumsum(counts))[offsets]


def divided(begin: Steps, end: Steps, step: float) -> tuple[Steps, Offsets]:
    """Return edges with corners a step apart at most, and how many each has then; its end is not among them.

    An edge that runs back along another has its corners where that has them: both are counted from the same
    end, in whole numbers.
    """
    way = end - begin
    squares = way[:, 0].astype(float) ** 2 + way[:, 1].astype(float) ** 2
    counts = np.maximum(np.ceil(np.sqrt(squares) / step).astype(np.int64), 1)
    edge = np.repeat(np.arange(len(begin)), counts)
    k = np.arange(len(edge)) - np.repeat(np.cumsum(counts) - counts, counts)
    back = (way[:, 0] < 0) | ((way[:, 0] == 0) & (way[:, 1] < 0))
    low, way = np.where(back[:, None], end, begin), np.where(back[:, None], -way, way)
    k = np.where(back[edge], counts[edge] - k, k)
    parts = counts[edge]
    return low[edge] + (2 * way[edge] * k[:, None] + parts[:, None]) // (2 * parts[:, None]), counts
