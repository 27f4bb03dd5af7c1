"""Copies that coincide: found, and drawn once."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry import work
from batik_vector.geometry.maps.affine import SIMILAR, Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.geometry.sampling import Array, Geometries, Indices


def distinct(
    transforms: Sequence[Affine], motif: Geometries | Sequence[Geometries], tolerance: float
) -> Affines:
    """Return the transforms that draw something no earlier one has drawn, in their order.

    Two copies coincide when the map between them is a symmetry of the motif: an eight-fold flower
    turned by 45° about its centre is the same drawing. Each such map is tested once.

    Args:
        transforms: the copies.
        motif: its geometries; or several arrays of them, one per ink, each of which must come to lie
            on itself.
        tolerance: in the motif's units: how far the motif's edges may stand from the true curves.
    """
    maps = Affines.of(transforms)
    groups = [motif] if isinstance(motif, np.ndarray) else list(motif)
    if len(maps) < 2 or not any(len(group) for group in groups):
        return maps
    if maps.are_translates:
        # No two of them differ by a symmetry, unless they are the same.
        later, earlier = _meeting(maps.shifts, maps, tolerance)
        alike = np.ones(len(later), bool)
    else:
        symmetry = _Symmetry([np.asarray(group, dtype=object) for group in groups], tolerance)
        later, earlier = _meeting(maps.at(symmetry.centre[None])[:, 0], maps, tolerance)
        alike = symmetry.hold(maps.linear[earlier], maps.linear[later])
    kept = np.ones(len(maps), bool)
    for i, j in zip(later[alike].tolist(), earlier[alike].tolist(), strict=True):
        kept[i] &= not kept[j]
    return maps.taken(kept)


def _meeting(places: Array, maps: Affines, tolerance: float) -> tuple[Indices, Indices]:
    """Return the pairs (later, earlier) of copies whose places all but coincide, in the order of both."""
    points = _points(places)
    reach = tolerance * np.abs(maps.linear).max(axis=1)
    later, earlier = shapely.STRtree(points).query(points, predicate="dwithin", distance=reach)
    pairs = earlier < later
    later, earlier = later[pairs], earlier[pairs]
    order = np.lexsort((earlier, later))
    return later[order], earlier[order]


class _Symmetry:
    """Answers whether a linear map about the motif's centre brings it onto itself."""

    def __init__(self, groups: list[Geometries], tolerance: float) -> None:
        self.groups, self.tolerance = groups, tolerance
        hull = shapely.convex_hull(shapely.geometrycollections(np.concatenate(groups)))
        self.centre: Array = shapely.get_coordinates(shapely.centroid(hull))[0]

    @cached_property
    def parts(self) -> list[Geometries]:
        """The areas and the lines of each group."""
        both = [(group, _areal(group)) for group in self.groups]
        parts = [part for group, areal in both for part in (group[areal], group[~areal])]
        return [part for part in parts if len(part)]

    @cached_property
    def trees(self) -> list[tuple[shapely.STRtree, Geometries]]:
        """For each part a tree of all its edges, and a point inside each of its geometries."""
        return [(shapely.STRtree(edges(part)), shapely.point_on_surface(part)) for part in self.parts]

    def hold(self, ones: Array, others: Array) -> NDArray[np.bool_]:
        """Whether pairs of copies over the same place draw the same.

        Args:
            ones, others: the linear parts of their maps, shape (n, 4).
        """
        if not len(ones):
            return np.empty(0, bool)
        relative = np.linalg.solve(ones.reshape(-1, 2, 2), others.reshape(-1, 2, 2))
        rigid = np.abs(np.abs(np.linalg.det(relative)) - 1) <= 1e-6
        _, first, number = np.unique(
            np.round(relative.reshape(-1, 4) * 1e7).astype(int),
            axis=0,
            return_index=True,
            return_inverse=True,
        )
        known = np.array([bool(rigid[i]) and self._test(relative[i]) for i in first.tolist()])
        return np.asarray(known[number.ravel()])

    def _test(self, linear: Array) -> bool:
        if np.allclose(linear, np.eye(2), rtol=0, atol=SIMILAR):
            return True
        # Both the curve and its image stand off the true ones by the tolerance.
        reach = 2 * self.tolerance
        for part in self.parts:
            points = shapely.get_coordinates(part) - self.centre
            moved = points @ linear.T
            if (
                np.abs(points.min(0) - moved.min(0)).max() > reach
                or np.abs(points.max(0) - moved.max(0)).max() > reach
            ):
                return False
        return all(self._lies_on_itself(i, linear, reach) for i in range(len(self.parts)))

    def _lies_on_itself(self, i: int, linear: Array, reach: float) -> bool:
        tree, inside = self.trees[i]
        points = shapely.get_coordinates(self.parts[i]) - self.centre
        # Onto itself in one direction is onto itself in both for a map of finite order; a motif of an
        # arc and a longer arc upon it tells the two apart, so ask both ways.
        for matrix in (linear, np.linalg.inv(linear)):
            moved = _points(points @ matrix.T + self.centre)
            hit = np.unique(tree.query(moved, predicate="dwithin", distance=reach)[0])
            if len(hit) < len(moved):
                return False
            if _areal(self.parts[i]).any():
                core = shapely.get_coordinates(inside) - self.centre
                moved = _points(core @ matrix.T + self.centre)
                areas = shapely.STRtree(self.parts[i])
                hit = np.unique(areas.query(moved, predicate="dwithin", distance=reach)[0])
                if len(hit) < len(moved):
                    return False
        return True


def _points(coordinates: Array) -> Geometries:
    return np.asarray(shapely.points(coordinates), dtype=object)


def _areal(geometries: Geometries) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    return np.asarray(shapely.get_dimensions(geometries) == 2)


def edges(geometries: Geometries) -> Geometries:
    """Return all edges as single segments."""
    parts = shapely.get_parts(geometries)
    areal = _areal(parts)
    lines = np.concatenate([shapely.get_rings(parts[areal]), parts[~areal]])
    coords, owner = shapely.get_coordinates(lines, return_index=True)
    inside = owner[1:] == owner[:-1]
    pairs = np.stack([coords[:-1][inside], coords[1:][inside]], axis=1)
    return np.asarray(shapely.linestrings(pairs), dtype=object)


def drawn_once(geometries: Geometries, reach: float) -> Indices:
    """Return the indices of the geometries that no earlier one has drawn already, ascending.

    Two geometries are the same drawing when every vertex of each lies within ``reach`` of the other's
    edges. Only those whose bounds agree are compared, so a large drawing costs one query of a tree.

    Raises:
        TooLargeError: where too many are as small as ``reach``, and lie at one place.
    """
    count = len(geometries)
    bounds = shapely.bounds(geometries)
    corner, opposite = bounds[:, :2], bounds[:, 2:]
    points = _points(corner)
    tree = shapely.STRtree(points)
    work.refuse_pairs(tree, points, within=2 * reach)
    later, earlier = tree.query(points, predicate="dwithin", distance=2 * reach)
    alike = earlier < later
    alike &= (np.abs(opposite[later] - opposite[earlier]) <= reach * 2).all(axis=1)
    size, length = shapely.area(geometries), shapely.length(geometries)
    alike &= np.abs(size[later] - size[earlier]) <= 2 * reach * (length[later] + length[earlier])
    alike &= _areal(geometries)[later] == _areal(geometries)[earlier]
    pairs = np.column_stack([later[alike], earlier[alike]])
    work.spend_on_pairs(len(pairs))
    drawn = np.zeros(count, bool)
    for j, i in pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))].tolist():
        if not drawn[j] and not drawn[i] and _same(geometries[i], geometries[j], reach):
            drawn[j] = True
    return np.flatnonzero(~drawn)


def _same(one: shapely.Geometry, other: shapely.Geometry, reach: float) -> bool:
    for a, b in ((one, other), (other, one)):
        edges = shapely.boundary(a) if shapely.get_dimensions(a) == 2 else a
        shapely.prepare(edges)
        if not shapely.dwithin(edges, shapely.points(shapely.get_coordinates(b)), reach).all():
            return False
    return True
