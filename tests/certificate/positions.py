"""Patterns of all seventeen groups for tests, from the general positions of the International Tables.

International Tables for Crystallography, volume A (2016), chapter 2.2: coordinates (x, y) are those of the
conventional cell; hexagonal axes enclose 120°. Nothing here looks at how the package makes its groups.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import cos, pi, sin, sqrt
from random import Random

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, DropAxis, Geometries, Ink, Layer

Matrix = NDArray[np.float64]

POSITIONS = {
    "p1": "x,y",
    "p2": "x,y -x,-y",
    "pm": "x,y -x,y",
    "pg": "x,y -x,y+1/2",
    "cm": "x,y -x,y x+1/2,y+1/2 -x+1/2,y+1/2",
    "pmm": "x,y -x,-y -x,y x,-y",
    "pmg": "x,y -x,-y -x+1/2,y x+1/2,-y",
    "pgg": "x,y -x,-y -x+1/2,y+1/2 x+1/2,-y+1/2",
    "cmm": "x,y -x,-y -x,y x,-y x+1/2,y+1/2 -x+1/2,-y+1/2 -x+1/2,y+1/2 x+1/2,-y+1/2",
    "p4": "x,y -x,-y -y,x y,-x",
    "p4m": "x,y -x,-y -y,x y,-x -x,y x,-y y,x -y,-x",
    "p4g": "x,y -x,-y -y,x y,-x -x+1/2,y+1/2 x+1/2,-y+1/2 y+1/2,x+1/2 -y+1/2,-x+1/2",
    "p3": "x,y -y,x-y -x+y,-x",
    "p3m1": "x,y -y,x-y -x+y,-x -y,-x -x+y,y x,x-y",
    "p31m": "x,y -y,x-y -x+y,-x y,x x-y,-y -x,-x+y",
    "p6": "x,y -y,x-y -x+y,-x -x,-y y,-x+y x-y,x",
    "p6m": "x,y -y,x-y -x+y,-x -x,-y y,-x+y x-y,x -y,-x -x+y,y x,x-y y,x x-y,-y -x,-x+y",
}
ORDERS = {"p1": 1, "p2": 2, "pm": 2, "pg": 2, "cm": 2, "pmm": 4, "pmg": 4, "pgg": 4, "cmm": 4, "p4": 4}
ORDERS |= {"p4m": 8, "p4g": 8, "p3": 3, "p3m1": 6, "p31m": 6, "p6": 6, "p6m": 12}
HEXAGONAL = ("p3", "p3m1", "p31m", "p6", "p6m")
SQUARE = ("p4", "p4m", "p4g")

RED, BLUE = Ink("red", "#8c2f2b", 0.6), Ink("blue", "#1d2f5f", 0.6)


def operations(group: str) -> list[tuple[Matrix, NDArray[np.float64]]]:
    """Return the general positions of a group as (linear part, translation part) in cell coordinates."""
    found = []
    for position in POSITIONS[group].split():
        rows, shift = [], []
        for words in position.split(","):
            half = words.endswith("+1/2")
            words = words.removesuffix("+1/2").replace("-", "+-")
            terms = [term for term in words.split("+") if term]
            rows.append([terms.count(name) - terms.count(f"-{name}") for name in "xy"])
            shift.append(0.5 if half else 0.0)
        found.append((np.array(rows, float), np.array(shift)))
    return found


@dataclass(frozen=True)
class Repeat:
    """A cell of the tile, and the conventional cell (columns, mm) of the group inside it."""

    cell: Cell
    basis: Matrix

    @property
    def cells(self) -> float:
        """Conventional cells in the tile."""
        return self.cell.width * self.cell.height / abs(float(np.linalg.det(self.basis)))


def upright(group: str, size: int = 48_000, across: int = 1, up: int = 1, stretch: float = 0.0) -> Repeat:
    """Return a rectangular repeat of ``across`` × ``up`` conventional cells (µm), hexagonal ones in pairs."""
    if group in HEXAGONAL:
        width = size / 1000
        height = round(size * sqrt(3) * (1 + stretch)) / 1000
        basis = np.array([[width, -width / 2], [0, height / 2]])
        return Repeat(Cell(size * across, round(height * 1000) * up), basis)
    height = round(size * (1 + stretch)) if group in SQUARE else round(size * 0.83)
    return Repeat(Cell(size * across, height * up), np.diag([size / 1000, height / 1000]))


def dropped(group: str, size: int = 48_000) -> Repeat:
    """Return a repeat whose tile is one primitive or conventional cell, with a drop where that can be."""
    if group in HEXAGONAL:
        half = round(size * sqrt(3) / 2)
        basis = np.array([[size / 1000, -size / 2000], [0, half / 1000]])
        return Repeat(Cell(size, half, Fraction(1, 2), DropAxis.ROW), basis)
    if group in ("cm", "cmm"):
        return Repeat(Cell(size // 2, 40_000, Fraction(1, 2)), np.diag([size / 1000, 40.0]))
    plain = upright(group, size)
    return Repeat(Cell(2 * plain.cell.columns, plain.cell.rows), plain.basis)


def blob(random: Random, reach: float, corners: int = 7) -> shapely.Polygon:
    """Return a polygon without any symmetry, no corner further from the origin than ``reach`` mm."""
    turn = random.random() * 2 * pi
    spokes = [
        (turn + 2 * pi * (k + 0.6 * random.random()) / corners, 0.3 + 0.7 * random.random())
        for k in range(corners)
    ]
    return shapely.Polygon([(reach * r * cos(t), reach * r * sin(t)) for t, r in spokes])


def orbit(shape: shapely.Geometry, group: str, repeat: Repeat, origin: tuple[float, float]) -> Geometries:
    """Return the copies of a shape (mm) under a group about an origin that meet the tile, cut to it."""
    basis, inverse = repeat.basis, np.linalg.inv(repeat.basis)
    width, height = repeat.cell.width, repeat.cell.height
    box = shapely.box(0, 0, width, height)
    corners = (np.array([(0, 0), (width, 0), (0, height), (width, height)]) - origin) @ inverse.T
    low, high = np.floor(corners.min(axis=0)) - 2, np.ceil(corners.max(axis=0)) + 2
    steps = [np.array((i, j)) for i in np.arange(low[0], high[0]) for j in np.arange(low[1], high[1])]
    copies = []
    for turn, part in operations(group):
        linear = basis @ turn @ inverse
        (a, b), (c, d) = linear.tolist()
        image = shapely.affinity.affine_transform(shape, [a, b, c, d, 0, 0])
        for step in steps:
            dx, dy = basis @ (part + step) + origin
            copies.append(shapely.affinity.translate(image, dx, dy))
    marks = np.array(copies, dtype=object)
    return shapely.get_parts(shapely.intersection(marks[shapely.intersects(marks, box)], box))


def random_tile(group: str, repeat: Repeat, seed: int, reach: float = 7.0) -> list[Layer]:
    """Return a tile of one group: in two inks, an asymmetric area each, at a random place and origin."""
    random = Random(seed)
    origin = (60 * random.random(), 60 * random.random())
    layers = []
    for ink in (RED, BLUE):
        at = repeat.basis @ (random.random(), random.random())
        shape = shapely.affinity.translate(blob(random, reach), *at)
        layers.append(Layer(ink, orbit(shape, group, repeat, origin)))
    return layers


def with_dot(layers: Sequence[Layer], at: tuple[float, float], radius: float = 0.15) -> list[Layer]:
    """Return the layers with a small dot of the first ink added, once in the tile."""
    first = layers[0]
    dot = shapely.Point(at).buffer(radius)
    areas = np.concatenate([first.areas, np.array([dot], dtype=object)])
    return [Layer(first.ink, areas, first.lines), *layers[1:]]
