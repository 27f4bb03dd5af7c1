"""Copies that coincide: found, and drawn once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from batik_vector.geometry.maps.affine import SIMILAR, Affine
from batik_vector.geometry.sampling import Array, Geometries, Indices


def distinct(
    transforms: Sequence[Affine], motif: Geometries | Sequence[Geometries], tolerance: float
) -> list[Affine]:
    """Return the transforms that draw something no earlier one has drawn, in their order.

    Two copies coincide when the map between them is a symmetry of the motif: an eight-fold flower
    turned by 45° about its centre is the same drawing. Each such map is tested once.

    Args:
        transforms: the copies.
        motif: its geometries; or several arrays of them, one per ink, each of which must come to lie
            on itself.
        tolerance: in the motif's units: how far the motif's edges may stand from the true curves.
    """
    groups = [motif] if isinstance(motif, np.ndarray) else list(motif)
    symmetry = _Symmetry([np.asarray(group, dtype=object) for group in groups], tolerance)
    if symmetry.centre is None or len(transforms) < 2:
        return list(transforms)
    rows = np.array([each.row for each in transforms])
    centre = symmetry.centre
    places = np.column_stack([rows[:, :2] @ centre + rows[:, 4], rows[:, 2:4] @ centre + rows[:, 5]])
    near = _earlier_neighbours(places, tolerance * np.abs(rows[:, :4]).max(axis=1))
    kept: list[bool] = []
    for i, others in enumerate(near):
        kept.append(not any(kept[j] and symmetry.holds(rows[j], rows[i]) for j in others))
    return [each for each, keep in zip(transforms, kept, strict=True) if keep]


def _earlier_neighbours(places: Array, reach: Array) -> list[list[int]]:
    """Return, for each place, the earlier ones within its reach."""
    points = _points(places)
    query, found = shapely.STRtree(points).query(points, predicate="dwithin", distance=reach)
    earlier = found < query
    near: list[list[int]] = [[] for _ in range(len(places))]
    order = np.lexsort((found[earlier], query[earlier]))
    for i, j in zip(query[earlier][order].tolist(), found[earlier][order].tolist(), strict=True):
        near[i].append(j)
    return near


class _Symmetry:
    """Answers whether a linear map about the motif's centre brings it onto itself."""

    def __init__(self, groups: list[Geometries], tolerance: float) -> None:
        self.tolerance = tolerance
        self.known: dict[tuple[int, ...], bool] = {}
        groups = [group for group in groups if len(group)]
        self.parts = [
            part for group in groups for area in (True, False) if len(part := group[_areal(group) == area])
        ]
        self.centre: Array | None = None
        self.trees: list[tuple[shapely.STRtree, Geometries]] | None = None
        if self.parts:
            hull = shapely.convex_hull(shapely.GeometryCollection(np.concatenate(self.parts).tolist()))
            self.centre = shapely.get_coordinates(shapely.centroid(hull))[0]

    def holds(self, one: Array, other: Array) -> bool:
        """Whether two copies, given as rows of an affine map over the same place, draw the same."""
        first, second = one[:4].reshape(2, 2), other[:4].reshape(2, 2)
        relative: Array = np.asarray(np.linalg.solve(first, second), np.float64)
        if abs(abs(np.linalg.det(relative)) - 1) > 1e-6:
            return False
        key = tuple(np.round(relative.ravel() * 1e7).astype(int).tolist())
        if key not in self.known:
            self.known[key] = self._test(relative)
        return self.known[key]

    def _test(self, linear: Array) -> bool:
        if np.allclose(linear, np.eye(2), rtol=0, atol=SIMILAR):
            return True
        assert self.centre is not None
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
        assert self.centre is not None
        tree, inside = self._tree(i)
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

    def _tree(self, i: int) -> tuple[shapely.STRtree, Geometries]:
        """Return a tree of all edges of a part, and a point inside each of its geometries."""
        if self.trees is None:
            self.trees = [
                (shapely.STRtree(_edges(part)), shapely.point_on_surface(part)) for part in self.parts
            ]
        return self.trees[i]


def _points(coordinates: Array) -> Geometries:
    return np.asarray(shapely.points(coordinates), dtype=object)


def _areal(geometries: Geometries) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    return np.asarray(shapely.get_dimensions(geometries) == 2)


def _edges(geometries: Geometries) -> Geometries:
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
    """
    count = len(geometries)
    bounds = shapely.bounds(geometries)
    corner, opposite = bounds[:, :2], bounds[:, 2:]
    points = _points(corner)
    later, earlier = shapely.STRtree(points).query(points, predicate="dwithin", distance=2 * reach)
    alike = earlier < later
    alike &= (np.abs(opposite[later] - opposite[earlier]) <= reach * 2).all(axis=1)
    size, length = shapely.area(geometries), shapely.length(geometries)
    alike &= np.abs(size[later] - size[earlier]) <= 2 * reach * (length[later] + length[earlier])
    alike &= _areal(geometries)[later] == _areal(geometries)[earlier]
    pairs = np.column_stack([later[alike], earlier[alike]])
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
