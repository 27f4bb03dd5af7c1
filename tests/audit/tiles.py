"""Tiles to be audited: a clean one, and faults to plant into it."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import shapely
from shapely import affinity
from shapely.geometry.base import BaseGeometry

from batik_vector.artwork import Cell, Ink, Layer, RawArtwork
from batik_vector.machines import Limits, Machine, Twice

WIDTH, HEIGHT = 120.0, 100.0

MACHINE = Machine(
    limits=Limits(
        narrowest_line=1.0,
        narrowest_gap=0.6,
        smallest_hole=1.0,
        sliver=0.1,
        closed=True,
        twice=Twice.ALL,
    )
)


def tile(
    areas: Sequence[BaseGeometry],
    lines: Sequence[BaseGeometry] = (),
    *,
    width: float = 2.0,
    drop: Fraction = Fraction(0),
    tolerance: float = 0.01,
) -> RawArtwork:
    """Return a tile of one ink, of marks on the 1 µm grid that may reach over its edges once."""
    cell = Cell(round(WIDTH * 1000), round(HEIGHT * 1000), drop)
    (ax, ay), (bx, by) = cell.lattice
    moves = [((i * ax + j * bx) / 1000, (i * ay + j * by) / 1000) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    page = shapely.box(0, 0, WIDTH, HEIGHT)

    def shown(marks: Sequence[BaseGeometry]) -> list[BaseGeometry]:
        moved = [affinity.translate(each, *move) for each in marks for move in moves]
        return [part for each in moved for part in shapely.get_parts(page & each) if not part.is_empty]

    inked = shapely.union_all(shown(areas)) if areas else shapely.GeometryCollection()
    kept = [part for part in shapely.get_parts(inked) if part.area > 0]
    strokes = [part for part in shown(lines) if part.length > 0]
    layer = Layer(Ink("wax", "#f4efe2", width), _array(kept), _array(strokes))
    return RawArtwork("A tile", cell, (layer,), tolerance=tolerance)


def _array(marks: Sequence[BaseGeometry]) -> np.ndarray[tuple[int], np.dtype[np.object_]]:
    found = np.empty(len(marks), dtype=object)
    found[:] = marks
    return found


def petal(x: float, y: float, length: float, breadth: float, turn: float = 0.0) -> BaseGeometry:
    """Return a petal with two tips: what two circles share."""
    radius = (length**2 / breadth + breadth) / 4
    away = radius - breadth / 2
    one, other = (shapely.Point(0, side * away).buffer(radius, 128) for side in (-1, 1))
    return affinity.translate(affinity.rotate(one & other, turn, (0, 0)), x, y)
