"""Orbits: all images of a motif under a group of symmetries, each drawn once.

An orbit is what is left of a symmetry group once its translations are taken out: finitely many maps,
beside the translations modulo which two images count as the same.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.geometry.coincidence import distinct
from batik_vector.geometry.maps.affine import IDENTITY, Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.geometry.sampling import Array, Indices
from batik_vector.tiling.torus import overlay
from batik_vector.tiling.torus.torus import Window, lines_of, polygons_of, to_mm, wrap
from batik_vector.tiling.welding.stack import MAX_REPEATS, MAX_VERTICES
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

Shift = tuple[float, float]

LAP = 4.0
"""Grid steps by which pieces lap over an edge that runs aslant and is no mirror: pieces that meet there have
no vertices in common, and rounded to the grid would leave slits. It is the tenth part of a hair."""

NEAR = 1e-6
"""In grid steps: how far floats may put what lies on a half step beside it."""

LEVEL = 1e-9
"""Slope up to which floats may turn an edge that runs along an axis."""

TOUCH_MM = 1e-6
"""How far apart floats may put one place."""

NEVER = 10**12
"""Grid steps to the next repeat where there is none: a thousand kilometres."""


@frozen
class Region:
    """A convex piece of the cloth whose images under an orbit cover all of it once.

    Attributes:
        corners: in grid steps, anticlockwise.
        mirrored: for each edge, from its corner to the next, whether it is a mirror.
    """

    corners: tuple[Shift, ...]
    mirrored: tuple[bool, ...]

    def lapped(self, operation: Affine) -> tuple[bool, ...]:
        """Return over which edges pieces lap that an operation carries to their place.

        Where the image of an edge runs along an axis, all that meets there is rounded to one line: a lap
        would stand over it as a strip of ink.
        """
        corners = operation.at(np.array(self.corners))
        along = np.abs(np.roll(corners, -1, axis=0) - corners)
        aslant = along.min(axis=1) > LEVEL * along.max(axis=1)
        return tuple((aslant & ~np.array(self.mirrored, bool)).tolist())

    def shape(self, lapped: tuple[bool, ...]) -> shapely.Polygon:
        """Return what marks are cut to, in grid steps, that lap over some of the edges."""
        if not any(lapped):
            return shapely.Polygon(self.corners)
        corners = np.array(self.corners)
        along = np.roll(corners, -1, axis=0) - corners
        outward = np.column_stack([along[:, 1], -along[:, 0]]) / np.hypot(*along.T)[:, None]
        reach = (outward * corners).sum(axis=1) + np.where(lapped, LAP, 0.0)
        # Each corner is where its edge and the one before it meet, once they are moved.
        pairs = np.stack([np.roll(outward, 1, axis=0), outward], axis=1)
        moved = np.linalg.solve(pairs, np.stack([np.roll(reach, 1), reach], axis=1)[:, :, None])
        return shapely.Polygon(moved[:, :, 0])


@frozen
class Orbit:
    """The images of whatever is placed, in mm on cloth.

    Attributes:
        operations: one of every class of maps that translations join, the identity first. They are
            isometries, seen through the stretch of the cloth where there is one.
        periods: the translations modulo which images count as the same: none, one (frieze) or two
            (wallpaper); the first or the second parallel to its axis.
        base: brings what is placed onto the cloth before any operation: the move of the origin, the
            stretch that fits a machine.
        region: what of the cloth the operations spread over all of it; what is placed is then wrapped by
            the periods and cut to it first. None spreads marks whole.
        middle: where what names no place is placed, before ``base``; the middle of the unit when None.
    """

    operations: tuple[Affine, ...] = (IDENTITY,)
    periods: tuple[Shift, ...] = ()
    base: Affine = IDENTITY
    region: Region | None = None
    middle: Shift | None = None

    @property
    def is_trivial(self) -> bool:
        """Whether nothing is multiplied nor cut."""
        return len(self.operations) == 1 and self.region is None

    def images(self, copies: Sequence[Affine], motif: Sequence[Geometries], tolerance: float) -> Affines:
        """Return all images of copies, those that draw what an earlier one draws left out.

        Args:
            copies: maps from motif units to mm on cloth.
            motif: its geometries, one array for each thing that must come to lie on itself.
            tolerance: in motif units: how far its edges may stand from the true curves.
        """
        images = self.multiplied(copies)
        if not motif or not any(len(part) for part in motif):
            return images
        hull = shapely.convex_hull(shapely.geometrycollections(np.concatenate(list(motif))))
        centre = shapely.get_coordinates(shapely.centroid(hull))[0]
        return distinct(brought_together(images, centre, self.periods), motif, tolerance)

    def multiplied(self, copies: Sequence[Affine]) -> Affines:
        """Return all images of copies, the copies running fastest."""
        return Affines.of(self.operations).after(Affines.of(copies))

    def turns_at(self, copy: Affine) -> int:
        """Return how many turns of the orbit, no turn among them, leave the origin of a copy where it is."""
        images = self.multiplied([copy])
        away = images.shifts - images.shifts[:1]
        if self.periods:
            basis = np.array(self.periods, float)
            away = away - np.rint(away @ np.linalg.pinv(basis)) @ basis
        same = np.sign(images.determinants) == np.sign(images.determinants[0])
        return int((same & (np.hypot(*away.T) < TOUCH_MM)).sum())

    def mirrored(self, marks: Geometries, crumb: float = 0.0) -> Geometries:
        """Return marks (mm) wrapped by the periods, cut to the region, and all images of the pieces.

        Pieces on two sides of a mirror have the same vertices on it: they weld without a slit. Of lines that
        are cut no pieces shorter than ``crumb`` (mm) are kept.

        Raises:
            TooLargeError: with the estimate, where a mark reaches over too many repeats.
        """
        if self.region is None or not len(marks):
            return marks
        steps = np.asarray(shapely.transform(marks, lambda xy: xy * STEPS_PER_MM), dtype=object)
        low_x, low_y, high_x, high_y = self.region.shape((True,) * len(self.region.corners)).bounds
        window = Window(math.floor(low_x), math.floor(low_y), math.ceil(high_x), math.ceil(high_y))
        self._refuse_too_many(steps, window)
        there = wrap(steps, np.arange(len(steps)), self._lattice(), window)
        maps = [_on_steps(operation) for operation in self.operations]
        laps = [self.region.lapped(each) for each in maps]
        if any(self.region.mirrored):
            # Pieces on two sides of a mirror have the same vertices where a lap ends on it: all lap alike.
            laps = [tuple(map(any, zip(*laps, strict=True)))] * len(maps)
        pieces = {
            lapped: _within(*there, self.region.shape(lapped), crumb * STEPS_PER_MM)
            for lapped in dict.fromkeys(laps)
        }
        images = [each.apply(pieces[lapped]) for each, lapped in zip(maps, laps, strict=True)]
        return to_mm(_on_grid(np.concatenate(images)))

    def _refuse_too_many(self, marks: Geometries, window: Window) -> None:
        """Raise before so many translates are made that they would not fit in memory."""
        low_x, low_y, high_x, high_y = shapely.bounds(marks).T
        across, up = high_x - low_x + window.right - window.left, high_y - low_y + window.top - window.bottom
        (ax, _), (_, by) = self._lattice()
        # The stand-in for a missing period is so long that it counts as one repeat.
        repeats = np.maximum(across / abs(ax), 1.0) * np.maximum(up / abs(by), 1.0)
        total = float((repeats * shapely.get_num_coordinates(marks)).sum()) * len(self.operations)
        if repeats.max() > MAX_REPEATS or total > MAX_VERTICES:
            raise TooLargeError(
                f"a mark reaches over about {repeats.max():,.0f} repeats, each of them cut and multiplied by "
                f"{len(self.operations)}: expected a larger tile or smaller marks"
            )

    def _lattice(self) -> tuple[tuple[int, int], tuple[int, int]]:
        """Return the periods in grid steps, with others so far apart that they never meet."""
        steps = [(round(x * STEPS_PER_MM), round(y * STEPS_PER_MM)) for x, y in self.periods]
        if len(steps) == 2:
            return steps[0], steps[1]
        if not steps:
            return (NEVER, 0), (0, NEVER)
        if steps[0][1]:
            raise GeometryError("a single period runs along the x axis")
        return steps[0], (0, NEVER)


TRIVIAL = Orbit()
"""What is placed is drawn where it is placed, and nowhere else."""


def brought_together(images: Sequence[Affine], centre: Array, periods: Sequence[Shift]) -> Affines:
    """Return images moved by whole periods so that those equal modulo the periods lie together.

    Args:
        images: maps of a motif.
        centre: a point of the motif, shape (2,): where it comes to lie decides the move.
        periods: none, one or two independent translations.
    """
    maps = Affines.of(images)
    if not periods or not len(maps):
        return maps
    basis = np.array(periods, float)
    places = maps.at(centre[None])[:, 0]
    shares = places @ np.linalg.pinv(basis)
    whole = np.column_stack([np.floor(share - _cut(share)) for share in shares.T])
    return Affines.translations(-(whole @ basis)) @ maps


def _cut(shares: Array) -> float:
    """Return where to cut the circle of period 1: in the middle of the widest gap between places on it.

    Cut anywhere else, two places that differ by rounding alone might fall on two sides of the cut.
    """
    around = np.sort(shares % 1.0)
    gaps = np.diff(np.append(around, around[0] + 1.0))
    at = int(gaps.argmax())
    return float(around[at] + gaps[at] / 2)


def _within(marks: Geometries, names: Indices, shape: shapely.Polygon, crumb: float) -> Geometries:
    """Return the pieces of marks inside a convex shape, in floats; those of one name that meet are joined.

    Pieces of lines shorter than ``crumb`` are left out.

    A mark as large as the repeat comes in by several translates: joined here it is multiplied once, and has
    fewer edges that all but coincide along the mirrors.
    """
    shapely.prepare(shape)
    whole = shapely.contains_properly(shape, marks)
    areal = shapely.get_dimensions(marks) == 2
    pieces, of = polygons_of(
        shapely.intersection(overlay.valid(marks[areal & ~whole]), shape), names[areal & ~whole]
    )
    run = shapely.intersection(marks[~areal & ~whole], shape)
    lines, _ = lines_of(run, np.zeros(len(run), np.intp))
    lines = lines[shapely.length(lines) > crumb]
    several = np.bincount(of)[of] > 1 if len(of) else np.zeros(0, bool)
    if several.any():
        order = np.argsort(of[several], kind="stable")
        _, number = np.unique(of[several][order], return_inverse=True)
        groups = np.asarray(shapely.geometrycollections(pieces[several][order], indices=number), dtype=object)
        joined = np.asarray(shapely.union_all(groups[:, None], axis=1), dtype=object)
        parts, _ = polygons_of(joined, np.zeros(len(joined), np.intp))
        pieces = np.concatenate([pieces[~several], parts])
    return np.concatenate([marks[whole], pieces, lines])


def _on_steps(operation: Affine) -> Affine:
    """Return a map of millimetres as one of grid steps; shifts by eighths of a step are exact."""
    e, f = operation.e * STEPS_PER_MM, operation.f * STEPS_PER_MM
    near = [round(8 * each) / 8 if abs(round(8 * each) / 8 - each) < NEAR else each for each in (e, f)]
    return Affine(operation.a, operation.b, operation.c, operation.d, near[0], near[1])


def _on_grid(marks: Geometries) -> Geometries:
    """Round marks given in grid steps to whole ones; leave out what that makes vanish."""
    rounded = np.asarray(shapely.transform(marks, _rounded), dtype=object)
    sound = shapely.is_valid(rounded)
    if not sound.all():
        torn = overlay.mended(marks[~sound])
        mended, _ = polygons_of(torn, np.zeros(len(torn), np.intp))
        rounded = np.concatenate([rounded[sound], mended])
    return np.asarray(shapely.remove_repeated_points(rounded[shapely.length(rounded) > 0]), dtype=object)


def _rounded(steps: Array) -> Array:
    """Return whole grid steps.

    What lies on a half step, but for an error of floats, is rounded up: to even would round places a period
    apart differently.
    """
    eighths = np.rint(8 * steps) / 8
    return np.asarray(np.floor(np.where(np.abs(steps - eighths) < NEAR, eighths, steps) + 0.5))
