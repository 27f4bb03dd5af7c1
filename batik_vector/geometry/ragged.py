"""Polygons and polylines as arrays of floats, so that many images of them are made in one stroke."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.sampling import Array, Geometries, Indices, Points
from batik_vector.values import frozen


@frozen(eq=False)
class Ragged:
    """Polygons, or polylines.

    ``points`` has shape (m, 2). Ring or polyline i is ``points[rings[i]:rings[i + 1]]``, a ring's first point
    repeated at its end. Polygon j is made of the rings ``polygons[j]`` to ``polygons[j + 1]``; of polylines
    ``polygons`` is None.
    """

    points: Points
    rings: Indices
    polygons: Indices | None

    @staticmethod
    def of(geometries: Geometries) -> Ragged:
        """Return geometries as arrays.

        Raises:
            ValueError: where they are neither polygons nor polylines throughout.
        """
        kinds = shapely.get_type_id(geometries)
        if (kinds == shapely.GeometryType.LINESTRING).all():
            return Ragged(shapely.get_coordinates(geometries), _ends(geometries), None)
        if not (kinds == shapely.GeometryType.POLYGON).all():
            raise ValueError("expected polygons, or polylines")
        rings, owner = shapely.get_rings(writable(geometries), return_index=True)
        polygons = np.searchsorted(owner, np.arange(len(geometries) + 1))
        return Ragged(shapely.get_coordinates(rings), _ends(rings), polygons)

    def geometries(self) -> Geometries:
        """Return the polygons or polylines."""
        return self.images(self.points[None])

    def images(self, places: Array, mirrored: NDArray[np.bool_] | None = None) -> Geometries:
        """Return images, one after another.

        Args:
            places: where the points of each image lie, shape (n, m, 2).
            mirrored: shape (n,): which images reflect. Rings keep their sense all the same.
        """
        if self.polygons is None:
            made = shapely.from_ragged_array(
                shapely.GeometryType.LINESTRING, places.reshape(-1, 2), (_repeated(self.rings, len(places)),)
            )
            return np.asarray(made, dtype=object)
        if mirrored is not None and mirrored.any():
            both = np.repeat(self.rings[:-1] + self.rings[1:] - 1, np.diff(self.rings))
            places[mirrored] = places[mirrored][:, both - np.arange(len(both))]
        made = shapely.from_ragged_array(
            shapely.GeometryType.POLYGON,
            places.reshape(-1, 2),
            (_repeated(self.rings, len(places)), _repeated(self.polygons, len(places))),
        )
        return np.asarray(made, dtype=object)


def writable(geometries: Geometries) -> Geometries:
    """Return geometries in an array that may be written: shapely before 2.2 takes no other apart."""
    return geometries if geometries.flags.writeable else geometries.copy()


def _ends(lines: Geometries) -> Indices:
    """Return where each of some lines begins in their points, and at last where the last one ends."""
    return np.append(0, np.cumsum(shapely.get_num_coordinates(lines)))


def _repeated(offsets: Indices, times: int) -> Indices:
    """Return offsets into as many copies of what they part, one after another."""
    if times == 1:
        return offsets
    starts = np.arange(times)[:, None] * offsets[-1] + offsets[:-1]
    return np.append(starts.ravel(), times * offsets[-1])
