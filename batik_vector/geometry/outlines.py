"""Marks as plain arrays: what the tiling hands over and the writers spell out, in bulk.

Coordinates are whole grid steps of 1 µm, y upwards, so that moving, repeating and comparing are exact.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.errors import GeometryError
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

Steps: TypeAlias = NDArray[np.int64]
"""Coordinates in whole grid steps of 1 µm."""
Offsets: TypeAlias = NDArray[np.int64]
"""Where runs begin in an array, and at last where it ends: k + 1 numbers for k runs."""
Index: TypeAlias = NDArray[np.intp]

FAR = 2.0**52
"""A float beyond int64 would wrap round unseen; brought to here it is still beyond every range we write."""


@frozen
class Outlines:
    """The marks of an ink as arrays.

    ``points`` has shape (n, 2), in steps of 1 µm, y up. Ring (or polyline) i is
    ``points[rings[i]:rings[i + 1]]``, and a closed one does not repeat its first point. Mark j is made of
    the rings ``marks[j]`` to ``marks[j + 1]``: a polygon's outer ring and its holes, or one polyline.

    Where a drawing comes in pieces, ``unfinished`` says that the last mark goes on with the first mark of
    the piece that follows, which is then under the same name: an area with more holes than fit in memory.
    """

    points: Steps
    rings: Offsets
    marks: Offsets
    closed: NDArray[np.bool_]
    names: Sequence[str] = ()
    unfinished: bool = False

    def __len__(self) -> int:
        return len(self.marks) - 1

    def moved(self, right: int = 0, up: int = 0) -> Outlines:
        """Return the same marks elsewhere."""
        if right == up == 0:
            return self
        return self._placed(self.points[:, 0] + right, self.points[:, 1] + up)

    def flipped(self, height: int, right: int = 0) -> Outlines:
        """Return the same marks with y pointing down from ``height``, and moved to the right."""
        return self._placed(self.points[:, 0] + right, height - self.points[:, 1])

    def _placed(self, x: NDArray[np.int64], y: NDArray[np.int64]) -> Outlines:
        # Column by column: NumPy's loop over the two numbers of each point is many times dearer.
        points = np.empty_like(self.points)
        points[:, 0], points[:, 1] = x, y
        return replace(self, points=points)

    def repeating(self) -> tuple[Steps, Offsets]:
        """Return points and ring offsets with the first point of each closed ring repeated at its end."""
        shut = np.flatnonzero(self.closed)
        points = np.insert(self.points, self.rings[shut + 1], self.points[self.rings[shut]], axis=0)
        return points, self.rings + np.r_[0, np.cumsum(self.closed)]

    def repeated(self) -> Index:
        """Return for each point of :meth:`repeating` which of the points it is."""
        shut = np.flatnonzero(self.closed)
        return np.insert(np.arange(len(self.points)), self.rings[shut + 1], self.rings[shut])

    def taken(self, which: Index, shift: Steps | None = None) -> Outlines:
        """Return copies of some marks, without names.

        Args:
            which: shape (k,), numbers of marks, in any order and as often as one likes.
            shift: shape (k, 2), how far each copy is moved.
        """
        rings, marks = runs(self.marks, which)
        points, ends = runs(self.rings, rings)
        moved = self.points.take(points, axis=0)
        if shift is not None:
            sizes = self.rings[self.marks[1:]] - self.rings[self.marks[:-1]]
            moved += np.repeat(shift, sizes[which], axis=0)
        return Outlines(moved, ends, marks, self.closed[rings])

    def sizes(self) -> Offsets:
        """Return how many points each mark has."""
        return np.diff(self.rings[self.marks])

    def bounds(self) -> Steps:
        """Return the bounds of each mark: left, lower, right and upper edge, shape (k, 4)."""
        if not len(self):
            return np.empty((0, 4), np.int64)
        first = self.rings[self.marks[:-1]]
        low, high = (edge.reduceat(self.points, first, axis=0) for edge in (np.minimum, np.maximum))
        return np.hstack([low, high])


def runs(offsets: Offsets, which: Index) -> tuple[Index, Offsets]:
    """Return the numbers of the members of some runs, one run after another, and where each begins."""
    first = offsets[:-1][which]
    counts = offsets[1:][which] - first
    ends = np.concatenate([[0], np.cumsum(counts)])
    members = np.arange(ends[-1]) + np.repeat(first - ends[:-1], counts)
    return members, ends


def nothing() -> Outlines:
    """Return no marks at all."""
    zero = np.zeros(1, np.int64)
    return Outlines(np.empty((0, 2), np.int64), zero, zero, np.empty(0, bool))


def of_polygons(areas: NDArray[np.object_], scale: float = 1.0) -> Outlines:
    """Return polygons as outlines, their coordinates multiplied by a scale and rounded.

    Raises:
        GeometryError: where a coordinate is not finite.
    """
    if not len(areas):
        return nothing()
    points = _rounded(shapely.get_coordinates(areas), scale)
    sizes, counts = _ring_sizes(areas)
    ends = np.cumsum(sizes)
    keep = np.ones(len(points), bool)
    keep[ends - 1] = False
    return Outlines(
        points.take(np.flatnonzero(keep), axis=0),
        np.concatenate([[0], ends - np.arange(1, len(ends) + 1)]),
        np.concatenate([[0], np.cumsum(counts)]),
        np.ones(len(ends), bool),
    )


def _ring_sizes(areas: NDArray[np.object_]) -> tuple[Offsets, Offsets]:
    """Return how many coordinates each ring of some polygons has, and how many rings each polygon."""
    sizes = np.asarray(shapely.get_num_coordinates(areas), np.int64)
    counts = np.where(sizes > 0, shapely.get_num_interior_rings(areas) + 1, 0).astype(np.int64)
    # To make a ring costs more than to read its points: only where there are holes.
    holed = counts > 1
    of_holed = np.repeat(holed, counts)
    rings = np.empty(len(of_holed), np.int64)
    rings[~of_holed] = sizes[counts == 1]
    rings[of_holed] = shapely.get_num_points(shapely.get_rings(areas[holed]))
    return rings, counts


def of_polylines(lines: NDArray[np.object_], scale: float = 1.0) -> Outlines:
    """Return polylines as outlines; those that end where they began are closed.

    Raises:
        GeometryError: where a coordinate is not finite.
    """
    if not len(lines):
        return nothing()
    points = _rounded(shapely.get_coordinates(lines), scale)
    offsets = np.concatenate([[0], np.cumsum(shapely.get_num_coordinates(lines), dtype=np.int64)])
    first, last = offsets[:-1], offsets[1:] - 1
    # Fewer than three different places enclose nothing: there and back is an open line.
    closed = (points[first] == points[last]).all(axis=1) & (last - first >= 3)
    keep = np.ones(len(points), bool)
    keep[last[closed]] = False
    offsets[1:] -= np.cumsum(closed)
    return Outlines(points.take(np.flatnonzero(keep), axis=0), offsets, np.arange(len(offsets)), closed)


def _rounded(coords: NDArray[np.float64], scale: float) -> Steps:
    """Return coordinates, which are used up, as steps."""
    # What is not a number is neither above nor below.
    if not (coords.min(initial=0.0) >= -FAR and coords.max(initial=0.0) <= FAR):
        if not np.isfinite(coords).all():
            raise GeometryError("a coordinate is not finite")
        np.clip(coords, -FAR, FAR, out=coords)
    if scale != 1.0:
        coords *= scale
    return np.rint(coords, out=coords).astype(np.int64)


def to_polygons(outlines: Outlines, steps: int = 1) -> NDArray[np.object_]:
    """Return the marks as polygons, in the same unit or in one of so many steps."""
    points, rings = outlines.repeating()
    if not len(outlines):
        return np.empty(0, dtype=object)
    made = shapely.from_ragged_array(shapely.GeometryType.POLYGON, points / steps, (rings, outlines.marks))
    return np.asarray(made, dtype=object)


def to_polylines(outlines: Outlines, steps: int = 1) -> NDArray[np.object_]:
    """Return the marks as polylines, likewise; a closed one repeats its first point at its end."""
    points, rings = outlines.repeating()
    if not len(outlines):
        return np.empty(0, dtype=object)
    made = shapely.from_ragged_array(shapely.GeometryType.LINESTRING, points / steps, (rings,))
    return np.asarray(made, dtype=object)


def together(parts: Sequence[Outlines]) -> Outlines:
    """Return several sets of outlines as one, their names too; an unfinished mark is one with its rest."""
    parts = [part for part in parts if len(part)]
    if not parts:
        return nothing()
    rings, marks, names = [np.zeros(1, np.int64)], [np.zeros(1, np.int64)], list[str]()
    points, contours = 0, 0
    going_on = False
    for part in parts:
        rings.append(part.rings[1:] + points)
        # What goes on ends later than it was said to.
        if going_on:
            marks[-1] = marks[-1][:-1]
        marks.append(part.marks[1:] + contours)
        names += part.names[1 if going_on else 0 :]
        points, contours = points + len(part.points), contours + len(part.closed)
        going_on = part.unfinished
    return Outlines(
        np.concatenate([part.points for part in parts]),
        np.concatenate(rings),
        np.concatenate(marks),
        np.concatenate([part.closed for part in parts]),
        names,
        going_on,
    )


MM = float(STEPS_PER_MM)
"""The scale that brings millimetres to steps."""
