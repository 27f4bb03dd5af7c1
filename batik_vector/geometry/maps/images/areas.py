"""Where to ask for the images of regions: exact for affine maps, folded or plain for the others."""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.geometry.maps.flame import FlameMap
from batik_vector.geometry.maps.images.folds import folded_images
from batik_vector.geometry.maps.images.regions import regions, valid_parts
from batik_vector.geometry.maps.images.result import (
    NO_IMAGES,
    Images,
    Tolerance,
    affine_images,
    core_tolerance,
)
from batik_vector.geometry.sampling import Geometries


def area_images(flame: FlameMap, polygons: Geometries, tolerance: Tolerance) -> Images:
    """Return the images of polygons under a map.

    Args:
        flame: the map.
        polygons: valid polygons (no multipolygons), shape (n,).
        tolerance: how far an edge may stand from the exact image of the given edges.

    Returns:
        Valid polygons, outer rings anticlockwise.

    Raises:
        TornRingError: where a region contains or touches a point that goes to infinity, or winds
            round a branch point under a sum of variations.
    """
    polygons = np.asarray(polygons, dtype=object)
    exact = affine_images(flame, shapely.orient_polygons(polygons))
    if exact is not None:
        return exact
    if not len(polygons):
        return NO_IMAGES
    tolerance = core_tolerance(flame, tolerance)
    inner = flame.pre.apply(polygons)
    if any(variation.folds for _, variation in flame.terms):
        images = folded_images(flame, inner, tolerance)
    else:
        images = regions(flame, inner, tolerance, thinning=not callable(tolerance))
    found, at = flame.post.apply(images.geometries), np.arange(len(images.geometries), dtype=np.intp)
    if not flame.post.is_identity:
        # Rings that touch may come to cross by the rounding of one more map.
        found, at = valid_parts(found, at, injective=True)
    source, branch = images.source[at], images.branch[at]
    order = np.lexsort((source, branch))
    return Images(shapely.orient_polygons(found)[order], source[order], branch[order])
