"""Polygons from rings: built in bulk, and made valid where a map or the thinning left them crossing."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.maps.affine import Complexes
from batik_vector.geometry.maps.images.chains import Chains
from batik_vector.geometry.maps.images.thinning import ever_finer
from batik_vector.geometry.sampling import Array, Geometries, Indices, Points


def chains_of(geometries: Geometries) -> tuple[Chains, NDArray[np.bool_]]:
    """Return the rings of polygons, or polylines, as chains, and which of them are holes."""
    if (shapely.get_dimensions(geometries) == 1).any():
        rings, owner = geometries, np.arange(len(geometries))
    else:
        rings, owner = shapely.get_rings(geometries, return_index=True)
    coords = np.ascontiguousarray(shapely.get_coordinates(rings))
    offsets = np.concatenate([[0], np.cumsum(shapely.get_num_coordinates(rings))]).astype(np.intp)
    holes = np.zeros(len(rings), bool)
    holes[1:] = owner[1:] == owner[:-1]
    return Chains(coords.view(np.complex128).reshape(-1), offsets, owner.astype(np.intp)), holes


def points_of(z: Complexes) -> Points:
    """Return complex numbers as points, shape (n, 2)."""
    return np.ascontiguousarray(z, np.complex128).view(np.float64).reshape(-1, 2)


def polygons_of(z: Complexes, offsets: Indices, owner: Indices, by_size: bool) -> Geometries:
    """Return one polygon for each run of equal owners.

    Args:
        z, offsets: closed rings.
        owner: ascending; the first ring of each is the shell.
        by_size: the largest ring is the shell instead: for maps that may turn regions inside out.
    """
    rings: Geometries = np.asarray(
        shapely.linearrings(points_of(z), indices=np.repeat(np.arange(len(owner)), np.diff(offsets))),
        dtype=object,
    )
    if by_size:
        order = np.lexsort((-np.abs(ring_areas(z, offsets)), owner))
        rings = rings[order]
    _, index = np.unique(owner, return_inverse=True)
    return np.asarray(shapely.polygons(rings, indices=index), dtype=object)


def ring_areas(z: Complexes, offsets: Indices) -> Array:
    """Return the signed areas of closed rings."""
    # About each ring's own first point, lest small rings far out lose their digits.
    local = z - np.repeat(z[offsets[:-1]], np.diff(offsets))
    cross = np.zeros(len(z))
    cross[:-1] = (np.conj(local[:-1]) * local[1:]).imag
    cross[offsets[1:] - 1] = 0
    return np.asarray(np.add.reduceat(cross, offsets[:-1]) / 2)


def parts_of(geometry: shapely.Geometry) -> Geometries:
    """Return the polygons of a geometry that have an area."""
    parts = shapely.get_parts(shapely.get_parts(geometry))
    parts = np.asarray(parts, dtype=object)
    solid: Geometries = parts[(shapely.get_dimensions(parts) == 2) & (shapely.area(parts) > 0)]
    return solid


def settle(polygon: shapely.Polygon, injective: bool) -> Geometries:
    """Return the valid polygons that a polygon with crossing rings stands for.

    The image of a region under an injective map crosses itself by rounding only, and is mended. Otherwise
    what the boundary winds round is meant.
    """
    if injective:
        return parts_of(shapely.make_valid(polygon, method="structure", keep_collapsed=False))
    return nonzero(shapely.get_rings(polygon))


def nonzero(rings: Geometries) -> Geometries:
    """Return the region that closed rings together wind round a number of times other than 0."""
    noded = shapely.unary_union(rings)
    faces = shapely.get_parts(shapely.polygonize([noded]))
    faces = np.asarray(faces, dtype=object)
    if not len(faces):
        return faces
    inside = shapely.get_coordinates(shapely.point_on_surface(faces))
    coords, owner = shapely.get_coordinates(rings, return_index=True)
    ok = owner[1:] == owner[:-1]
    wound = winding(inside, coords[:-1][ok], coords[1:][ok])
    return parts_of(shapely.union_all(faces[wound != 0]))


def winding(points: Points, start: Points, end: Points) -> Indices:
    """Return how often closed rings, given by their edges, wind round each point."""
    total = np.zeros(len(points), np.intp)
    for i, (x, y) in enumerate(points):
        up = (start[:, 1] <= y) & (end[:, 1] > y)
        down = (start[:, 1] > y) & (end[:, 1] <= y)
        side = (end[:, 0] - start[:, 0]) * (y - start[:, 1]) - (x - start[:, 0]) * (end[:, 1] - start[:, 1])
        total[i] = np.count_nonzero(up & (side > 0)) - np.count_nonzero(down & (side < 0))
    return total


def thin_polygons(polygons: Geometries, tolerance: float) -> Geometries:
    """Return valid polygons with the vertices that the tolerance needs; those it would break stay whole."""
    if not len(polygons):
        return polygons
    chains, _ = chains_of(polygons)
    found = polygons.copy()
    bad = np.ones(len(polygons), bool)
    for keep in ever_finer(chains.z, chains.offsets, tolerance, np.ones(len(chains), bool)):
        offsets = np.concatenate([[0], np.cumsum(keep)]).astype(np.intp)[chains.offsets]
        part = Chains(chains.z[keep], offsets, chains.owner).take(bad[chains.owner])
        found[bad] = polygons_of(part.z, part.offsets, part.owner, by_size=False)
        bad[bad] = ~shapely.is_valid(found[bad])
        if not bad.any():
            break
    return np.where(bad, polygons, found)
