"""Copies that coincide: found, and drawn once."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry import work
from batik_vector.geometry.maps.affine import SIMILAR, Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.geometry.sampling import Array, Geometries, Indices

AT_ONCE = 50_000
"""Pairs of geometries that are looked at one after the other."""


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
            places = points @ matrix.T
            off = _points(places[~_close(places, points, reach)] + self.centre)
            hit = np.unique(tree.query(off, predicate="dwithin", distance=reach)[0])
            if len(hit) < len(off):
                return False
            if _areal(self.parts[i]).any():
                core = shapely.get_coordinates(inside) - self.centre
                moved = _points(core @ matrix.T + self.centre)
                areas = shapely.STRtree(self.parts[i])
                hit = np.unique(areas.query(moved, predicate="dwithin", distance=reach)[0])
                if len(hit) < len(moved):
                    return False
        return True


def _close(points: Array, others: Array, reach: float) -> NDArray[np.bool_]:
    """Return which points surely have one of the others within reach: most have, and need no search.

    What lies in one cell of a grid is no farther apart than its diagonal.
    """
    found = np.zeros(len(points), bool)
    if not reach:
        return found
    side = reach / math.sqrt(2)
    for shift in (0.25, 0.75):
        cells, known = (np.floor(xy / side + shift) @ [1.0, 1j] for xy in (points, others))
        found |= np.isin(cells, known)
    return found


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
    pairs = pairs[np.lexsort((pairs[:, 0], pairs[:, 1]))]
    outlines = np.where(_areal(geometries), shapely.boundary(geometries), geometries)
    drawn = np.zeros(count, bool)
    for first in range(0, len(pairs), AT_ONCE):
        part = pairs[first : first + AT_ONCE]
        while len(part := part[~drawn[part].any(axis=1)]):
            # No earlier one can have drawn these: they are drawn, and all others are compared with them.
            sure = ~np.isin(part[:, 1], part[:, 0])
            asked, part = part[sure], part[~sure]
            drawn[asked[_same(outlines, asked, reach), 0]] = True
    return np.flatnonzero(~drawn)


def _same(outlines: Geometries, pairs: Indices, reach: float) -> NDArray[np.bool_]:
    """Return which pairs of outlines, given by their numbers, have all vertices near each other's edges."""
    shapely.prepare(outlines[np.unique(pairs)])
    found = np.ones(len(pairs), bool)
    one, other = pairs.T
    # A single vertex tells most of those apart that differ.
    for a, b in ((one, other), (other, one)):
        found[found] = shapely.dwithin(outlines[a[found]], _first(outlines[b[found]]), reach)
    for a, b in ((one, other), (other, one)):
        open_ = np.flatnonzero(found)
        coords, of = shapely.get_coordinates(outlines[b[open_]], return_index=True)
        near = shapely.dwithin(outlines[a[open_[of]]], _points(coords), reach)
        found[open_[of[~near]]] = False
    return found


def _first(outlines: Geometries) -> Geometries:
    """Return the first vertex of each outline, as points."""
    coords, of = shapely.get_coordinates(outlines, return_index=True)
    return _points(coords[np.flatnonzero(np.r_[True, of[1:] != of[:-1]][: len(of)])])
