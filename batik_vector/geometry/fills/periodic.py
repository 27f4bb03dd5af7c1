"""Fills of a ground that repeats: every mark is laid once, and lies between its neighbours on the seam too.

What is to be filled is drawn larger than a repeat, and of what is found there once in every repeat one is
taken. Rows close on the repeat when the plane is first drawn a little aslant or apart, so that the lattice of
the marks holds that of the repeat.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.fills.thinning import near_pairs, settled
from batik_vector.geometry.maps.affine import IDENTITY, Affine
from batik_vector.geometry.sampling import Array, Geometries, Indices

ASIDE = 0.000371
"""By how many mm the window is moved, so that no row of marks runs along its edge."""

AROUND = [(i, j) for i in (-2, -1, 0, 1, 2) for j in (-2, -1, 0, 1, 2)]
"""Translates that may come near the window, each by so many of the two translations."""


class Group(NamedTuple):
    """A wallpaper group, in mm.

    Attributes:
        operations: one of every class of its maps that translations of the repeat join, the identity first.
        region: a fundamental region, convex: its images under all of these cover the cloth once.
    """

    operations: tuple[Affine, ...]
    region: shapely.Polygon


class Period(NamedTuple):
    """A repeat, in mm.

    Attributes:
        lattice: its two translations, rows of shape (2, 2); the first or the second parallel to its axis.
        pad: how far beyond the window of a repeat regions are told.
        group: that its marks keep; None where translations are all.
    """

    lattice: Array
    pad: float
    group: Group | None = None

    @property
    def window(self) -> Array:
        """Width and height of the rectangle that holds every place once."""
        return np.diag(self.lattice)

    @property
    def operations(self) -> tuple[Affine, ...]:
        """Those of its group, the identity first."""
        return self.group.operations if self.group else (IDENTITY,)

    def owns(self, points: Array) -> NDArray[np.bool_]:
        """Return which points, shape (n, 2), lie in the window."""
        return np.asarray(((points >= ASIDE) & (points < self.window + ASIDE)).all(axis=1))

    def rings(self, rings: Geometries, reach: float) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Return which rings lie about a middle in the window and hang on nothing beyond the pad.

        Returned besides is which are so broad that none of their translates does: only what of them lies in
        the window is sure, and it goes on in the next repeat.

        Args:
            rings: that keep ``reach`` from the edges of their regions.
            reach: in mm.
        """
        middles = shapely.get_coordinates(shapely.centroid(shapely.polygons(rings)))
        way = np.tile(self.home(middles) - middles, 2)
        bounds = shapely.bounds(rings) + way
        most = self.pad - 1.05 * reach
        inside = ((bounds[:, :2] > -most) & (bounds[:, 2:] < self.window + most)).all(axis=1)
        return inside & self.owns(middles), np.logical_not(inside)

    def apart(self, points: Array, least: float) -> NDArray[np.bool_]:
        """Return which of points stay so that none lie nearer than ``least``, over the seam too.

        The earlier has its way.
        """
        copies, owner = self.images(points, least)
        group = np.zeros(len(copies), np.intp)
        a, b = near_pairs(copies, group, least)
        a, b = owner[a], owner[b]
        return settled(np.arange(len(points)), a[a != b], b[a != b])

    def images(self, points: Array, reach: float) -> tuple[Array, Indices]:
        """Return points and their images within ``reach`` of the box round them, and whose they are.

        The points themselves come first.
        """
        if not len(points):
            return points, np.empty(0, np.intp)
        low, high = points.min(axis=0) - reach, points.max(axis=0) + reach
        found, owner = [points], [np.arange(len(points))]
        for number, operation in enumerate(self.operations):
            image = self.home(operation.at(points)) if number else points
            for i, j in AROUND:
                if number or i or j:
                    moved = image + i * self.lattice[0] + j * self.lattice[1]
                    near = np.flatnonzero(((moved >= low) & (moved <= high)).all(axis=1))
                    found.append(moved[near])
                    owner.append(near)
        return np.concatenate(found), np.concatenate(owner)

    def home(self, points: Array) -> Array:
        """Return points moved by translations into the window."""
        moved = points.copy()
        # The axis that the other translation leaves alone comes first.
        for axis in (0, 1) if self.lattice[1, 0] == 0 else (1, 0):
            times = np.floor((moved[:, axis] - ASIDE) / self.lattice[axis, axis])
            moved -= times[:, None] * self.lattice[axis]
        return moved

    def apart_modulo(self, ways: Array) -> Array:
        """Return ways, shape (n, 2), less the translation next to each."""
        shares = np.rint(ways @ np.linalg.inv(self.lattice))
        return np.asarray(ways - shares @ self.lattice)

    def images_of(self, marks: Geometries, reach: float) -> tuple[Geometries, Indices]:
        """Return images of marks within ``reach`` of the box round them, themselves left out, and whose."""
        box = shapely.total_bounds(marks)
        low, high = box[:2] - reach, box[2:] + reach
        centres = shapely.get_coordinates(shapely.centroid(marks)) if self.group else np.empty((0, 2))
        found, owner = [marks[:0]], [np.empty(0, np.intp)]
        for number, operation in enumerate(self.operations):
            image = marks
            if number:
                places = operation.at(centres)
                image = moved_each(operation.apply(marks), self.home(places) - places)
            bounds = shapely.bounds(image)
            for i, j in AROUND:
                shift = i * self.lattice[0] + j * self.lattice[1]
                meets = (bounds[:, :2] + shift <= high) & (bounds[:, 2:] + shift >= low)
                near = np.flatnonzero(meets.all(axis=1))
                if number or i or j:
                    found.append(Affine.translation((float(shift[0]), float(shift[1]))).apply(image[near]))
                    owner.append(near)
        return np.concatenate(found), np.concatenate(owner)

    def clear(self, marks: Geometries, bare: float) -> NDArray[np.bool_]:
        """Return which marks stay so that none comes nearer to a translate of another than ``bare``."""
        there, of = self.images_of(marks, bare)
        a, b = shapely.STRtree(marks).query(there, predicate="dwithin", distance=bare)
        a = of[a]
        return settled(np.arange(len(marks)), a[a != b], b[a != b])


def moved_each(marks: Geometries, shifts: Array) -> Geometries:
    """Return marks, each moved by its own shift, shape (n, 2)."""
    points, of = shapely.get_coordinates(marks, return_index=True)
    copies = np.array(marks, dtype=object)
    return np.asarray(shapely.set_coordinates(copies, points + shifts[of]), dtype=object)


def closing(basis: Array, lattice: Array) -> Array:
    """Return the map nearest to the identity, shape (2, 2), under which a lattice holds another.

    Args:
        basis: of the lattice of marks, a row each, shape (2, 2).
        lattice: that it shall hold, a row each.
    """
    times = np.rint(np.linalg.solve(basis.T, lattice.T).T)
    if abs(np.linalg.det(times)) < 0.5:
        return np.full((2, 2), np.nan)
    # With rows r, basis @ map.T is the new basis, and times of it are the lattice.
    return np.asarray(np.linalg.solve(basis, np.linalg.solve(times, lattice)).T)
