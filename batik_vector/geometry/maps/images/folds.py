"""Images of regions under maps that fold the plane: cut at the folds, mapped, and welded."""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.errors import TooLargeError
from batik_vector.geometry.maps.flame import FlameMap
from batik_vector.geometry.maps.images.polygons import chains_of, parts_of, points_of, thin_polygons
from batik_vector.geometry.maps.images.regions import regions
from batik_vector.geometry.maps.images.result import Images, Tolerance
from batik_vector.geometry.sampling import REFINE_SHARE, Array, Geometries, Indices

MAX_CELLS = 1_000_000
"""Pieces into which folds may cut the regions of one call."""

UNION_GRID = 1 / 1000
"""Relative to the tolerance: pieces on the two sides of a fold are welded on this grid, so that the
rounding of their common edge leaves no slit."""


def folded_images(flame: FlameMap, polygons: Geometries, tolerance: Tolerance) -> Images:
    """Return the images of regions under the core of a map that folds.

    Each piece between folds is mapped without folding; the image of the region is their union.
    """
    pieces, owner = _cut_at_creases(flame, polygons)
    images = regions(flame, pieces, tolerance, thinning=False)
    source = owner[images.source]
    finest = tolerance
    if callable(finest):
        finest = float(finest(points_of(chains_of(images.geometries)[0].z)).min(initial=np.inf))
    order = np.lexsort((source, images.branch))
    key = np.column_stack([images.branch, source])[order]
    starts = np.flatnonzero((key[1:] != key[:-1]).any(axis=1)) + 1
    found: list[Geometries] = [np.empty(0, dtype=object)]
    first: list[int] = []
    for group in np.split(order, starts):
        parts = images.geometries[group]
        if len(parts) > 1:
            parts = parts_of(shapely.union_all(parts, grid_size=finest * UNION_GRID))
        if not callable(tolerance):
            parts = thin_polygons(parts, tolerance * (1 - REFINE_SHARE - UNION_GRID))
        found.append(parts)
        first += [int(group[0])] * len(parts)
    at = np.array(first, np.intp)
    return Images(np.concatenate(found), source[at], images.branch[at])


def _cut_at_creases(flame: FlameMap, polygons: Geometries) -> tuple[Geometries, Indices]:
    """Return the pieces of regions between creases, and the region each comes from."""
    owner = np.arange(len(polygons), dtype=np.intp)
    for variation in (variation for _, variation in flame.terms if variation.folds):
        for axis in (0, 1):
            reach = float(np.abs(shapely.bounds(polygons)).max(initial=0.0)) + 1
            polygons, kept = _cut_across(polygons, variation.creases(-reach, reach), axis)
            owner = owner[kept]
    return polygons, owner


def _cut_across(polygons: Geometries, creases: Array, axis: int) -> tuple[Geometries, Indices]:
    """Cut polygons at x = c (axis 0) or y = c (axis 1) for all creases c."""
    bounds = shapely.bounds(polygons)
    low, high = bounds[:, axis], bounds[:, axis + 2]
    first = np.searchsorted(creases, low, side="right")
    count = np.maximum(np.searchsorted(creases, high, side="left") - first, 0) + 1
    if count.sum() > MAX_CELLS:
        raise TooLargeError(f"a shape is folded into {int(count.sum()):,} pieces: make it smaller")
    index = np.repeat(np.arange(len(polygons), dtype=np.intp), count)
    rank = np.arange(len(index)) - np.repeat(np.cumsum(count) - count, count)
    walls = np.concatenate([creases, [np.inf]])
    start = np.where(rank == 0, low[index] - 1, walls[np.maximum(first[index] + rank - 1, 0)])
    stop = np.where(rank == count[index] - 1, high[index] + 1, walls[first[index] + rank])
    across = (bounds[index, 1 - axis] - 1, bounds[index, 3 - axis] + 1)
    boxes = (
        shapely.box(start, across[0], stop, across[1])
        if axis == 0
        else shapely.box(across[0], start, across[1], stop)
    )
    cut = count[index] > 1
    pieces = polygons[index]
    pieces[cut] = shapely.intersection(pieces[cut], boxes[cut])
    # An overlay may return a collection that holds multipolygons.
    parts, once = shapely.get_parts(pieces, return_index=True)
    parts, again = shapely.get_parts(parts, return_index=True)
    solid = (shapely.get_dimensions(parts) == 2) & (shapely.area(parts) > 0)
    return np.asarray(parts[solid], dtype=object), index[once[again[solid]]]
