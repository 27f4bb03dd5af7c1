"""Places tossed into regions with a least distance between them (Poisson discs)."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.fills.insets import Parts
from batik_vector.geometry.fills.periodic import ASIDE, Period
from batik_vector.geometry.fills.symmetric import settled_places
from batik_vector.geometry.fills.thinning import thinned
from batik_vector.geometry.nearness import held
from batik_vector.geometry.sampling import Array, Geometries, Indices

ROUNDS, TRIES = 6, 2.0
"""How often places are tried, and how many for each square of the distance."""


def scattered(
    parts: Parts, spacing: float, seed: int, period: Period | None = None, onto_axes: bool = True
) -> tuple[Array, Indices]:
    """Return places within parts, no two of a region nearer than the spacing, and the part of each.

    Dart throwing in rounds: of those tried in one round the earlier has its way. In a ground, one period is
    thrown at; in one that keeps a group its region, and ``onto_axes`` says whether places may be moved onto
    its mirrors.
    """
    if period is not None and period.group is not None:
        return _scattered_within(parts, spacing, seed, period, onto_axes)
    if period is not None:
        return _scattered_round(parts, spacing, seed, period)
    rng = np.random.default_rng(seed)
    shapely.prepare(parts.shapes)
    points, part = np.empty((0, 2)), np.empty(0, np.intp)
    low, high = np.split(shapely.bounds(parts.shapes).reshape(-1, 4), 2, axis=1)
    count = np.ceil(TRIES * np.prod(high - low, axis=1) / spacing**2).astype(np.intp)
    of = np.repeat(np.arange(len(count)), count)
    for _ in range(ROUNDS):
        tried = low[of] + rng.random((len(of), 2)) * (high - low)[of]
        free = ~np.isin(_cells(tried, of, spacing), _cells(points, part, spacing))
        tried, mine = tried[free], of[free]
        inside = shapely.contains_xy(parts.shapes[mine], tried[:, 0], tried[:, 1])
        points, part = np.concatenate([points, tried[inside]]), np.concatenate([part, mine[inside]])
        kept = thinned(points, parts.region[part], spacing)
        points, part = points[kept], part[kept]
    return points, part


def _scattered_round(parts: Parts, spacing: float, seed: int, period: Period) -> tuple[Array, Indices]:
    """Return places within parts and the window of a period, no two nearer than the spacing over its seam."""
    rng = np.random.default_rng(seed)
    points, part = np.empty((0, 2)), np.empty(0, np.intp)
    count = int(np.ceil(TRIES * np.prod(period.window) / spacing**2))
    none = np.zeros(count, np.intp)
    for _ in range(2 * ROUNDS):
        tried = ASIDE + rng.random((count, 2)) * period.window
        free = ~np.isin(_cells(tried, none, spacing), _cells(points, none[:1], spacing))
        tried = tried[free]
        inside, of = held(tried, parts.shapes)
        points, part = np.concatenate([points, tried[inside]]), np.concatenate([part, of])
        if len(points):
            kept = period.apart(points, spacing)
            points, part = points[kept], part[kept]
    return points, part


def _scattered_within(
    parts: Parts, spacing: float, seed: int, period: Period, onto_axes: bool
) -> tuple[Array, Indices]:
    """Return places within parts and the region of a group, no two images nearer than the spacing."""
    assert period.group is not None
    rng = np.random.default_rng(seed)
    region = period.group.region
    shapely.prepare(region)
    low, high = np.split(np.array(region.bounds), 2)
    count = int(np.ceil(TRIES * np.prod(high - low) / spacing**2))
    points, none = np.empty((0, 2)), np.zeros(count, np.intp)
    for _ in range(2 * ROUNDS):
        tried = low + rng.random((count, 2)) * (high - low)
        free = ~np.isin(_cells(tried, none, spacing), _cells(points, none[:1], spacing))
        free &= shapely.contains_xy(region, tried[:, 0], tried[:, 1])
        free[free] = _within(parts.shapes, tried[free])
        points = np.concatenate([points, tried[free]])
        points, _ = settled_places(points, np.arange(len(points)), spacing, period, onto_axes)
        # What was moved may lie nearer to an edge.
        points = points[_within(parts.shapes, points)]
    inside, part = held(points, parts.shapes)
    return points[inside], part


def _within(shapes: Geometries, points: Array) -> NDArray[np.bool_]:
    """Return which points lie within any of some shapes."""
    found = np.zeros(len(points), bool)
    found[held(points, shapes)[0]] = True
    return found


def _cells(points: Array, part: Indices, spacing: float) -> Indices:
    """Return a number for the cell of each place: its diagonal is so short that no other has room in it."""
    column, row = np.floor(points * (1.42 / spacing)).astype(np.int64).T
    cells: Indices = (part * 2_000_003 + column) * 2_000_003 + row
    return cells


def turns(count: int, seed: int) -> Array:
    """Return directions in radians for so many marks."""
    found: Array = np.random.default_rng([seed, 1]).random(count) * 2 * np.pi
    return found
