"""Caps: the copper or wooden stamps that print a plate's wax, with pins by which prints are set side by side.

A repeat that is larger than a stamp is divided over several of one size. A pin stands at each corner, where
that of the stamp beside it, or of the print before, comes to stand too: its dot shows where to set the next.
In a drop repeat corners of the next column fall on a stamp's sides, and have pins there.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Cell, Geometries, Ink, Layer
from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import Steps
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

PINS, COLOUR = "pins", "#b0402c"
ROUND = 16
"""Chords of a quarter of a pin."""


@frozen
class Grid:
    """How a repeat is divided: where stamps begin and end from left to right and from below, in steps."""

    x: tuple[int, ...]
    y: tuple[int, ...]

    def __len__(self) -> int:
        return (len(self.x) - 1) * (len(self.y) - 1)

    def window(self, number: int) -> tuple[int, int, int, int]:
        """Return left, bottom, right and top of a stamp, counted from 1 row by row from the lower left."""
        row, column = divmod(number - 1, len(self.x) - 1)
        return self.x[column], self.y[row], self.x[column + 1], self.y[row + 1]


def grid_of(cell: Cell, most: tuple[float, float]) -> Grid:
    """Return how a repeat is divided over stamps of one size that are no larger than told, in mm."""
    sides = zip((cell.columns, cell.rows), most, strict=True)
    x, y = (_cuts(steps, math.ceil(steps / (side * STEPS_PER_MM))) for steps, side in sides)
    return Grid(x, y)


def _cuts(length: int, count: int) -> tuple[int, ...]:
    return tuple((2 * k * length + count) // (2 * count) for k in range(count + 1))


def stamp(page: Artwork, grid: Grid, number: int, pin: float) -> Artwork:
    """Return what one stamp prints, its lower left corner at the origin, and its pins in a layer above.

    Args:
        page: the plate.
        grid: how it is divided.
        number: which stamp.
        pin: diameter of a pin, in mm.

    Raises:
        GeometryError: where there is no such stamp.
    """
    if number > len(grid):
        raise GeometryError(f"cap_number = {number}, expected at most {len(grid)}: the repeat takes no more")
    left, bottom, right, top = grid.window(number)
    layers = [
        replace(layer, areas=areas, area_names=())
        for layer in page.layers
        if len(areas := _within(layer.areas, grid.window(number)))
    ]
    pins = Layer(Ink(PINS, COLOUR), _pins(_corners(page.cell, grid), grid.window(number), pin))
    # Half of a pin is outside.
    return replace(
        page,
        cell=Cell(right - left, top - bottom),
        layers=(*layers, pins),
        bleed=math.ceil(pin / 2 * STEPS_PER_MM) / STEPS_PER_MM,
        borders=frozenset(),
    )


def _within(areas: Geometries, window: tuple[int, int, int, int]) -> Geometries:
    """Return what of areas (mm) lies in a window (steps), moved to the origin; cut alike on both sides."""
    left, bottom, _, _ = window
    steps = shapely.transform(areas, lambda xy: np.rint(xy * STEPS_PER_MM))
    inside = shapely.transform(
        polygonal(shapely.intersection(steps, shapely.box(*window))), lambda xy: np.floor(xy + 0.5)
    )
    sound = polygonal(shapely.set_precision(inside, 1))
    moved = shapely.transform(sound, lambda xy: (xy - (left, bottom)) / STEPS_PER_MM)
    return oriented(np.asarray(moved, dtype=object))


def _corners(cell: Cell, grid: Grid) -> Steps:
    """Return the corners of all stamps in a repeat and those around it, shape (n, 2)."""
    own = np.array([(x, y) for x in grid.x for y in grid.y], np.int64)
    a, b = np.array(cell.lattice, np.int64)
    around = [own + i * a + j * b for i in (-1, 0, 1) for j in (-2, -1, 0, 1, 2)]
    return np.unique(np.concatenate(around), axis=0)


def _pins(corners: Steps, window: tuple[int, int, int, int], pin: float) -> Geometries:
    """Return the pins of a stamp: dots at the corners that lie on its sides."""
    left, bottom, right, top = window
    x, y = corners.T
    inside = (x >= left) & (x <= right) & (y >= bottom) & (y <= top)
    places = corners[inside] - (left, bottom)
    dots = [_dot(place, pin) for place in places.tolist()]
    return oriented(np.array(dots, dtype=object))


def _dot(place: Sequence[int], pin: float) -> shapely.Geometry:
    middle = shapely.Point(*place)
    dot = shapely.buffer(middle, pin / 2 * STEPS_PER_MM, quad_segs=ROUND)
    return shapely.transform(dot, lambda xy: np.rint(xy) / STEPS_PER_MM)
