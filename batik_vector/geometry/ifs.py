"""Iterated function systems: Hutchinson's union S ← ⋃ F_i(S), a given number of times, without chance.

Where every map is affine on each of its branches nothing is built at all: :meth:`Ifs.affine_images`
composes the copies, :func:`distinct` leaves one of every set that would draw the same.
Otherwise :meth:`Ifs.areas` and :meth:`Ifs.lines` carry the marks through, level by level.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated

import numpy as np

from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.fields import Between, Says, check
from batik_vector.geometry.coincidence import distinct, drawn_once
from batik_vector.geometry.maps.affine import IDENTITY, SIMILAR, Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.geometry.maps.flame import STRETCH_CAP, FlameMap
from batik_vector.geometry.maps.images.result import Images, Tolerance
from batik_vector.geometry.sampling import REFINE_SHARE, Array, Geometries, Indices, Points
from batik_vector.values import frozen

__all__ = ["MAX_COPIES", "MAX_PATHS", "Ifs", "distinct"]

MAX_COPIES = 100_000
"""Copies kept at any level. A cloth of them has long been a grey haze."""

MAX_MARKS = 1_000_000
"""Marks at any level, where copies are built and not only composed."""

STRETCH_PATHS = 64
"""Copies followed at once for the stretch at a point: all of the paper's, at four branches up to level 3."""

MAX_PATHS = 10**9
"""Copies counted with their repetitions. Repetitions are merged level by level, so this can be large;
it stops what would only find out after minutes that it does not fit."""


@frozen
class Ifs:
    """Maps applied together, ``level`` times: S ← ⋃ F_i(S).

    Hutchinson, "Fractals and self similarity", 1981; Tian et al. 2019, Eq. 1.
    """

    maps: tuple[FlameMap, ...]
    level: Annotated[int, Between(0, 100_000), Says("how often the maps are applied")] = 1

    def __post_init__(self) -> None:
        check(self)
        if not self.maps:
            raise GeometryError("an iterated function system needs at least one map")

    def image_count(self) -> int:
        """Return how many copies there are, before those that coincide are merged."""
        return int(sum(each.branches for each in self.maps) ** self.level)

    def affine_images(self) -> Affines | None:
        """Return every copy as an affine map, each distinct one once, or None where a map bends.

        The order is that of the innermost map first, and never changes.

        Raises:
            TooLargeError: with the estimate, before anything is built.
        """
        steps: list[Affine] = []
        for each in self.maps:
            branches = each.affine_branches()
            if branches is None:
                return None
            steps += branches
        self._refuse_too_many(self.image_count(), MAX_PATHS)
        table, found = Affines.of(steps), Affines.of([IDENTITY])
        for _ in range(self.level):
            self._refuse_too_many(len(found) * len(table), MAX_COPIES * 64)
            found = _once(table.after(found))
            self._refuse_too_many(len(found), MAX_COPIES)
        return found

    def areas(self, polygons: Geometries, tolerance: float) -> tuple[Geometries, Indices]:
        """Return the copies of polygons, drawn once where they coincide, and the polygon each comes from.

        Args:
            polygons: valid polygons, shape (n,).
            tolerance: how far an edge may stand from the exact image of the given edges.

        Raises:
            TooLargeError: with the estimate, before anything is built.
            TornRingError: where a map cannot carry a region: see
                :func:`~batik_vector.geometry.maps.images.areas.area_images`.
        """
        from batik_vector.geometry.maps.images.areas import area_images

        return self._carried(polygons, tolerance, area_images)

    def lines(self, lines: Geometries, tolerance: float) -> tuple[Geometries, Indices]:
        """Return the copies of polylines: as :meth:`areas`."""
        from batik_vector.geometry.maps.images.lines import line_images

        return self._carried(lines, tolerance, line_images)

    def stretch(self, points: Points, levels: int | None = None) -> Array:
        """Return the largest magnification of lengths at each point, shape (n,), over all copies.

        Sample a curve to tolerance / stretch before it is carried. Where there are more than
        ``STRETCH_PATHS`` copies, the steepest so far are followed at each level.
        """
        at, factor = points[None, :, :], np.ones((1, len(points)))
        for rest in reversed(range(self.level if levels is None else levels)):
            flat = at.reshape(-1, 2)
            steep = [each.stretch(flat).reshape(factor.shape) * factor for each in self.maps]
            if not rest:
                # Where the last images lie is nobody's business, and all branches stretch alike.
                factor = np.concatenate(steep)
                break
            found = [image.reshape(at.shape) for each in self.maps for image in each.every(flat)]
            at = np.concatenate(found)
            factor = np.concatenate(
                [each for each, flame in zip(steep, self.maps, strict=True) for _ in range(flame.branches)]
            )
            if len(at) > STRETCH_PATHS:
                order = np.argpartition(-factor, STRETCH_PATHS, axis=0)[:STRETCH_PATHS]
                at = np.take_along_axis(at, order[:, :, None], axis=0)
                factor = np.take_along_axis(factor, order, axis=0)
        return np.asarray(np.minimum(factor.max(axis=0), STRETCH_CAP))

    def _carried(
        self,
        marks: Geometries,
        tolerance: float,
        carry: Callable[[FlameMap, Geometries, Tolerance], Images],
    ) -> tuple[Geometries, Indices]:
        marks = np.asarray(marks, dtype=object)
        source = np.arange(len(marks), dtype=np.intp)
        self._refuse_too_many(self.image_count(), MAX_PATHS)
        step = sum(each.branches for each in self.maps)
        # What the levels before the last may spend together.
        early = min(REFINE_SHARE, 0.25 / max(self.level, 1))
        for level in range(1, self.level + 1):
            self._refuse_too_many(len(marks) * step, MAX_MARKS)
            rest = self.level - level
            allowed: Tolerance = tolerance * (1 - early * (self.level - 1))
            if rest:
                allowed = self._early_tolerance(tolerance * early, rest)
            images = [carry(each, marks, allowed) for each in self.maps]
            marks = np.concatenate([each.geometries for each in images])
            source = source[np.concatenate([each.source for each in images])]
            once = drawn_once(marks, 2 * tolerance * (early if rest else 1))
            marks, source = marks[once], source[once]
        return marks, source

    def _early_tolerance(self, tolerance: float, rest: int) -> Callable[[Points], Array]:
        """Return, place by place, what an error may be that the levels to come will magnify."""
        return lambda points: np.asarray(tolerance / np.maximum(self.stretch(points, rest), 1e-3))

    def _refuse_too_many(self, count: int, limit: int) -> None:
        if count > limit:
            raise TooLargeError(
                f"level {self.level} makes {_about(self.image_count())} copies, more than fit: lower it"
            )


def _about(count: int) -> str:
    """Return a large number as people say it."""
    if count < 10**6:
        return f"{count:,}"
    # The logarithm of an int of any length; its digits might take minutes.
    return f"about 10^{math.floor(math.log10(count))}"


def _once(maps: Affines) -> Affines:
    """Return the maps that differ from every earlier one by more than rounding, in their order."""
    scale = np.abs(maps.rows).max(axis=0)
    scale[:4], scale[4:] = scale[:4].max(), scale[4:].max()
    # The odd offset keeps the values that occur (0, halves, thirds) off the edges of the cells.
    cells = np.floor(maps.rows / (np.where(scale > 0, scale, 1.0) * SIMILAR) + 0.382)
    _, first = np.unique(cells, axis=0, return_index=True)
    return maps.taken(np.sort(first))
