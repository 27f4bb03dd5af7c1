"""The marks of a toss as arrays: motifs, poses, and marks as they lie. Grid steps; places are complex."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.sampling import Array, Indices
from batik_vector.tiling.torus.torus import Steps
from batik_vector.values import frozen

Complexes = NDArray[np.complex128]
Flags = NDArray[np.bool_]

DISCS = 7
"""Discs within an outline that stand for it where it is compared roughly."""

AT_ONCE = 4096
"""Pairs whose discs are compared at one go: what that takes stays near the processor."""

PROBES = 32
"""Places along each side of an outline's box at which discs may have their centres."""


@frozen
class Poses:
    """How marks lie, one array each: which motif, how large, turned (degrees), flipped, where."""

    motif: Indices
    size: Array
    turn: Array
    flip: Flags
    place: Complexes

    @staticmethod
    def none() -> Poses:
        """No marks."""
        return Poses(
            np.empty(0, np.intp), np.empty(0), np.empty(0), np.empty(0, bool), np.empty(0, np.complex128)
        )

    def __len__(self) -> int:
        return len(self.motif)

    def take(self, index: Indices | Flags) -> Poses:
        """Return some of them."""
        return Poses(
            self.motif[index], self.size[index], self.turn[index], self.flip[index], self.place[index]
        )

    def joined(self, more: Poses) -> Poses:
        """Return these and then those."""
        return Poses(
            np.concatenate([self.motif, more.motif]),
            np.concatenate([self.size, more.size]),
            np.concatenate([self.turn, more.turn]),
            np.concatenate([self.flip, more.flip]),
            np.concatenate([self.place, more.place]),
        )

    def shifted(self, index: Indices, to: Poses) -> Poses:
        """Return all poses with the turns and places of some replaced."""
        turn, place = self.turn.copy(), self.place.copy()
        turn[index], place[index] = to.turn, to.place
        return replace(self, turn=turn, place=place)

    def carry(self, points: Complexes, stretch: Array | None) -> Complexes:
        """Return points of the motifs, shape (n,) or (n, m), where the poses bring them."""
        rows = (-1,) + (1,) * (points.ndim - 1)
        return _carried(
            points,
            self._factor().reshape(rows),
            self.flip.reshape(rows),
            self.place.reshape(rows),
            stretch,
        )

    def carry_each(self, points: Complexes, of: Indices, stretch: Array | None) -> Complexes:
        """Return points, shape (n,), where the poses ``of[i]`` bring them."""
        return _carried(points, self._factor()[of], self.flip[of], self.place[of], stretch)

    def _factor(self) -> Complexes:
        """Return by what the poses multiply a point that is not flipped."""
        return np.asarray(self.size * np.exp(1j * np.radians(self.turn)))


def _carried(
    points: Complexes, factor: Complexes, flip: Flags, place: Complexes, stretch: Array | None
) -> Complexes:
    points = np.asarray(np.where(flip, -points.conj(), points) * factor if flip.any() else points * factor)
    if stretch is not None:
        (a, b), (c, d) = stretch.tolist()
        points = points.real * complex(a, c) + points.imag * complex(b, d)
    return np.asarray(points + place)


@frozen
class Field:
    """Marks as they lie, one array each.

    ``shapes`` are their outlines, ``owners`` a number each, ``kinds`` their motifs; ``middles`` and
    ``reach`` the circle round each; ``discs`` and ``radii``, shape (n, DISCS), discs within it, of radius
    minus infinity where there are fewer. Where circles and discs are all that is asked for, outlines may
    not be drawn yet: ``shapes`` are None.
    """

    shapes: Geometries
    owners: Indices
    kinds: Indices
    middles: Complexes
    reach: Array
    discs: Complexes
    radii: Array

    @staticmethod
    def of(shapes: Geometries) -> Field:
        """Return what is no mark: without discs, its owner and kind -1."""
        count = len(shapes)
        circle = shapely.get_coordinates(shapely.centroid(shapely.minimum_bounding_circle(shapes)))
        middle = circle[:, 0] + 1j * circle[:, 1]
        return Field(
            np.asarray(shapes, dtype=object),
            np.full(count, -1, np.intp),
            np.full(count, -1, np.intp),
            middle,
            np.asarray(shapely.minimum_bounding_radius(shapes), float).reshape(count),
            np.zeros((count, DISCS), np.complex128),
            np.full((count, DISCS), -np.inf),
        )

    @staticmethod
    def joined(fields: Sequence[Field]) -> Field:
        """Return several as one."""
        return Field(
            np.concatenate([field.shapes for field in fields]),
            np.concatenate([field.owners for field in fields]),
            np.concatenate([field.kinds for field in fields]),
            np.concatenate([field.middles for field in fields]),
            np.concatenate([field.reach for field in fields]),
            np.concatenate([field.discs for field in fields]),
            np.concatenate([field.radii for field in fields]),
        )

    def __len__(self) -> int:
        return len(self.shapes)

    def take(self, index: Indices | Flags | slice) -> Field:
        """Return some of them."""
        return Field(
            self.shapes[index],
            self.owners[index],
            self.kinds[index],
            self.middles[index],
            self.reach[index],
            self.discs[index],
            self.radii[index],
        )

    def put(self, index: Indices, marks: Field) -> Field:
        """Return all with some replaced."""
        order = np.arange(len(self))
        order[index] = len(self) + np.arange(len(index))
        return Field.joined([self, marks]).take(order)

    def owned(self, owners: Indices) -> Field:
        """Return the same marks under other numbers."""
        return replace(self, owners=owners)

    def nobody(self) -> Field:
        """Return marks that are no longer to be moved: their owners and kinds are -1."""
        none = np.full(len(self), -1, np.intp)
        return replace(self, owners=none, kinds=none)

    def grown(self, by: float) -> Field:
        """Return larger marks, their outlines moved outwards."""
        shapes = np.asarray(shapely.buffer(self.shapes, by, quad_segs=4), dtype=object)
        # The buffer's corners are cut: at its flattest it reaches to 0.98 of the distance.
        return replace(self, shapes=shapes, reach=self.reach + by, radii=self.radii + 0.98 * by)

    def shifted(self, shift: Steps, shapes: Geometries) -> Field:
        """Return marks moved, each by its own shift, shape (n, 2); ``shapes`` are moved already."""
        by = shift[:, 0] + 1j * shift[:, 1]
        return replace(self, shapes=shapes, middles=self.middles + by, discs=self.discs + by[:, None])

    def moved(self, by: Affine) -> Field:
        """Return the images of marks."""
        if by.is_identity:
            return self
        return replace(
            self,
            shapes=by.apply(self.shapes),
            middles=by.at_complex(self.middles),
            reach=self.reach * by.stretch,
            discs=by.at_complex(self.discs),
        )

    def apart(self, i: Indices, other: Field, j: Indices) -> Array:
        """Return how far the circles round pairs of marks stand apart: never farther than the marks."""
        return np.asarray(_length(self.middles[i] - other.middles[j]) - self.reach[i] - other.reach[j])

    def hearts_apart(self, i: Indices, other: Field, j: Indices) -> Array:
        """Return how far the largest discs within pairs of marks stand apart: never nearer than all discs."""
        gaps = _length(self.discs[i, 0] - other.discs[j, 0])
        return np.asarray(gaps - self.radii[i, 0] - other.radii[j, 0])

    def discs_apart(self, i: Indices, other: Field, j: Indices) -> Array:
        """Return how far the discs within pairs of marks stand apart: never nearer than the marks."""
        least = np.full(len(i), np.inf)
        for first in range(0, len(i), AT_ONCE):
            part = slice(first, first + AT_ONCE)
            # Disc by disc: rows of one number each are worked on several times as fast as columns.
            here, there = self.discs[i[part]].T, other.discs[j[part]].T
            x, y, to_x, to_y = map(np.ascontiguousarray, (here.real, here.imag, there.real, there.imag))
            mine, theirs = self.radii[i[part]].T, np.ascontiguousarray(other.radii[j[part]].T)
            for k in range(DISCS):
                gaps = np.sqrt((to_x - x[k]) ** 2 + (to_y - y[k]) ** 2) - theirs
                np.minimum(least[part], gaps.min(axis=0) - mine[k], out=least[part])
        return least


def _length(z: Complexes) -> Array:
    """Return lengths, made of roots and products alone: the same on every processor."""
    return np.asarray(np.sqrt(z.real**2 + z.imag**2))


@frozen
class Kit:
    """The motifs to scatter, at their least size, each moved so that its middle lies at the origin.

    Attributes:
        outlines: shape (k,), polygons or multipolygons.
        middles: where the middle (of the smallest circle round it) lies in the motif's own frame.
        reach: radius of that circle.
        discs: centres of discs within, from the middle, shape (k, DISCS); the first is the largest there is.
        radii: of the discs, minus infinity where there are fewer.
    """

    outlines: Geometries
    middles: Complexes
    reach: Array
    discs: Complexes
    radii: Array

    @staticmethod
    def of(outlines: Geometries) -> Kit:
        """Measure outlines given in their own frames."""
        middle = shapely.get_coordinates(shapely.centroid(shapely.minimum_bounding_circle(outlines)))
        coords, owner = shapely.get_coordinates(outlines, return_index=True)
        moved = np.asarray(shapely.set_coordinates(outlines.copy(), coords - middle[owner]), dtype=object)
        discs = [_discs(shape) for shape in moved]
        return Kit(
            moved,
            middle[:, 0] + 1j * middle[:, 1],
            np.asarray(shapely.minimum_bounding_radius(outlines)),
            np.array([centres for centres, _ in discs]),
            np.array([radii for _, radii in discs]),
        )

    def marks(self, poses: Poses, stretch: Array | None) -> Field:
        """Return marks as they lie on the cloth, owned by their numbers."""
        shapes = self.outlines[poses.motif]
        coords, owner = shapely.get_coordinates(shapes, return_index=True)
        z = poses.carry_each(coords[:, 0] + 1j * coords[:, 1], owner, stretch)
        shapes = shapely.set_coordinates(shapes, np.column_stack([z.real, z.imag]))
        return replace(self.undrawn(poses, stretch), shapes=np.asarray(shapes, dtype=object))

    def undrawn(self, poses: Poses, stretch: Array | None) -> Field:
        """Return the same as :meth:`marks`, with circles and discs and without outlines."""
        growth = 1.0 if stretch is None else float(np.linalg.norm(stretch, 2))
        return Field(
            np.full(len(poses), None, dtype=object),
            np.arange(len(poses)),
            poses.motif,
            poses.place,
            self.reach[poses.motif] * poses.size * growth,
            poses.carry(self.discs[poses.motif], stretch),
            self.radii[poses.motif] * poses.size[:, None],
        )


def _discs(shape: shapely.Geometry) -> tuple[Complexes, Array]:
    """Return discs within a shape, the largest first, then always the largest that has its centre in none."""
    low_x, low_y, high_x, high_y = shapely.bounds(shape)
    x, y = np.meshgrid(np.linspace(low_x, high_x, PROBES), np.linspace(low_y, high_y, PROBES))
    heart = shapely.get_coordinates(shapely.maximum_inscribed_circle(np.array([shape], dtype=object)))[:1]
    points = np.vstack([heart, np.column_stack([x.ravel(), y.ravel()])])
    points = points[shapely.contains_xy(shape, points[:, 0], points[:, 1])]
    room: Array = np.asarray(shapely.distance(shapely.points(points), shapely.boundary(shape)))
    z = points[:, 0] + 1j * points[:, 1]
    centres, radii = np.zeros(DISCS, np.complex128), np.full(DISCS, -np.inf)
    for k in range(DISCS):
        if not len(z):
            break
        best = int(room.argmax())
        centres[k], radii[k] = z[best], room[best]
        outside = np.abs(z - z[best]) > room[best]
        z, room = z[outside], room[outside]
    return centres, radii
