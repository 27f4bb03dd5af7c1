"""Strokes on a lattice: lines of equal steps in four or six directions, welded without a single overlay.

Such lines meet in points of the lattice and nowhere else, and keep clear of one another by at least the
lattice's height. So the outline of their welded body is known from which steps leave each point: it is the
walk round them, at each point on to the next step anticlockwise. Every step is taken once each way, and all
corners that are alike are worked out once.
"""

from __future__ import annotations

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.lsystems.contours import around
from batik_vector.geometry.lsystems.turtle import Complex
from batik_vector.geometry.nesting import rings_of, with_holes
from batik_vector.geometry.sampling import Geometries, Indices
from batik_vector.values import frozen

ON = 1e-6
"""Share of a step by which points may miss the lattice: rounding, over millions of steps."""

SLACK = 0.98
"""Share of what is free between two lines that their bodies may fill."""

SPARSE = 16
"""Cells of the lattice's box for each point, from which on the points are numbered and not the cells."""

Whole = NDArray[np.int64]
AXES = {4: 1j, 6: 0.5 + 0.5j * math.sqrt(3)}
"""The second axis of each lattice, of which the first is 1: the lattices by their number of directions."""


def on_lattice(points: Complex, offsets: Indices, width: float, tolerance: float) -> Geometries | None:
    """Return the welded bodies of strands, or None where they lie on no lattice or touch one another.

    Args:
        points: of all strands.
        offsets: where each strand begins, and the end.
        width: breadth of every stroke.
        tolerance: how far a chord may stand off a round end.
    """
    leaves = np.ones(len(points), bool)
    leaves[offsets[1:] - 1] = False
    ends = np.flatnonzero(leaves)
    if not len(ends) or points[ends[0]] == points[ends[0] + 1]:
        return None
    first = complex(points[ends[0] + 1] - points[ends[0]])
    placed = (points - points[0]) / first
    for sides in AXES:
        # A walk round the inside of a corner needs as much of a step at each of its ends.
        free = min(math.sin(2 * math.pi / sides), 1 / math.tan(math.pi / sides))
        if width / abs(first) > SLACK * free:
            continue
        cells = _cells(placed, ends, sides)
        if cells is not None:
            lattice = _Lattice(sides, complex(points[0]), first, *cells, ends)
            single = len(offsets) == 2 and lattice.visits_once()
            corners, arrive, leave, sizes = lattice.path() if single else lattice.walks()
            return lattice.outlined(corners, arrive, leave, sizes, width / 2, tolerance)
    return None


def _cells(placed: Complex, ends: Indices, sides: int) -> tuple[Whole, Whole, Whole] | None:
    """Return the places of points along both axes and the ways of steps, or None where they are none."""
    axis = AXES[sides]
    b = placed.imag / axis.imag
    a = placed.real - b * axis.real if axis.real else placed.real
    i, j = np.rint(a), np.rint(b)
    if max(float(np.abs(a - i).max()), float(np.abs(b - j).max())) > ON:
        return None
    i, j = i.astype(np.int64), j.astype(np.int64)
    di, dj = i[ends + 1] - i[ends], j[ends + 1] - j[ends]
    if max(int(np.abs(di).max()), int(np.abs(dj).max())) > 1:
        return None
    known = np.full(9, -1, np.int64)
    for number, (x, y) in enumerate(_steps(sides)):
        known[3 * (x + 1) + y + 1] = number
    way: Whole = known[3 * (di + 1) + dj + 1]
    return (i, j, way) if int(way.min()) >= 0 else None


def _steps(sides: int) -> list[tuple[int, int]]:
    """Return the steps of each direction along both axes, anticlockwise."""
    half = [(1, 0), (0, 1)] if sides == 4 else [(1, 0), (0, 1), (-1, 1)]
    return half + [(-x, -y) for x, y in half]


@frozen(eq=False)
class _Lattice:
    """Lines on a lattice: i and j of their points; from which of them steps leave, and which ways."""

    sides: int
    origin: complex
    unit: complex
    i: Whole
    j: Whole
    way: Whole
    ends: Indices

    def at(self, i: Whole, j: Whole) -> Complex:
        """Return lattice points where the strands have them."""
        return np.asarray(self.origin + self.unit * (i + AXES[self.sides] * j))

    def visits_once(self) -> bool:
        """Whether a single strand comes to no point twice."""
        keys, cells = self._keys()
        if cells > SPARSE * len(keys):
            return len(np.unique(keys)) == len(keys)
        return int(np.count_nonzero(np.bincount(keys, minlength=cells))) == len(keys)

    def _keys(self) -> tuple[Whole, int]:
        across, up = (int(np.ptp(each)) + 1 for each in (self.i, self.j))
        return np.asarray((self.i - self.i.min()) * up + (self.j - self.j.min())), across * up

    def path(self) -> tuple[Complex, Whole, Whole, Indices]:
        """Return the corners of the walk along a single strand and back, and the ways before and behind."""
        way, back = self.way, (self.way + self.sides // 2) % self.sides
        arrive = np.concatenate([way, back[::-1]])
        corners = self.at(self.i, self.j)
        return (
            np.concatenate([corners[1:], corners[-2::-1]]),
            arrive,
            np.roll(arrive, -1),
            np.array([len(arrive)]),
        )

    def walks(self) -> tuple[Complex, Whole, Whole, Indices]:
        """Return the corners of all walks, ring by ring, and how many corners each ring has."""
        keys, cells = self._keys()
        if cells > SPARSE * len(keys):
            _, keys = np.unique(keys, return_inverse=True)
            cells = int(keys.max()) + 1
        start, end = keys[self.ends], keys[self.ends + 1]
        left = np.zeros(cells, np.uint8)
        half = self.sides // 2
        for number in range(self.sides):
            left[start[self.way == number]] |= 1 << number
            left[end[self.way == (number + half) % self.sides]] |= 1 << number
        place = np.zeros((cells, 2), np.int64)
        place[keys] = np.column_stack([self.i, self.j])
        node, way = np.nonzero(left[:, None] & (1 << np.arange(self.sides)))
        number_of = np.zeros(cells * self.sides, np.int64)
        number_of[node * self.sides + way] = np.arange(len(node))
        known = np.zeros(cells * self.sides, np.int64)
        known[start * self.sides + self.way] = end
        known[end * self.sides + (self.way + half) % self.sides] = start
        target = known[node * self.sides + way]
        behind = _next_way(self.sides)[left[target], (way + half) % self.sides]
        order, sizes = rings_of(number_of[target * self.sides + behind])
        corners = self.at(*place[target[order]].T)
        return corners, way[order], behind[order], sizes

    def outlined(
        self, corners: Complex, arrive: Whole, leave: Whole, sizes: Indices, radius: float, tolerance: float
    ) -> Geometries:
        """Return the bodies that walks go round."""
        turn = (leave - arrive) % self.sides
        # Every kind of corner once.
        kind = arrive * self.sides + turn
        each = np.arange(self.sides**2)
        direction = self.unit / abs(self.unit) * np.exp(2j * math.pi * each / self.sides)
        arrives, leaves = direction[each // self.sides], direction[(each // self.sides + each) % self.sides]
        offset, owner = around(
            np.zeros(len(each), complex), arrives, leaves, np.full(len(each), radius), tolerance
        )
        count = np.bincount(owner, minlength=len(each))
        begin = np.cumsum(count) - count
        mine = count[kind]
        after = np.cumsum(mine)
        # Complex numbers go through memory half as often as pairs.
        which = np.repeat(begin[kind] - (after - mine), mine)
        which += np.arange(len(which))
        outline = np.repeat(corners, mine)
        outline += (offset[:, 0] + 1j * offset[:, 1])[which]
        xy = outline.view(np.float64).reshape(-1, 2)
        if len(sizes) == 1:
            return np.array([shapely.polygons(shapely.linearrings(xy))], dtype=object)
        ends = after[np.cumsum(sizes) - 1]
        ring = np.repeat(np.arange(len(sizes)), np.diff(np.append(0, ends)))
        return with_holes(np.asarray(shapely.linearrings(xy, indices=ring), dtype=object))


def _next_way(sides: int) -> Whole:
    """Return for the directions that leave a point, as bits, and one of them the next one anticlockwise."""
    table = np.zeros((1 << sides, sides), np.int64)
    for left in range(1 << sides):
        for way in range(sides):
            ways = ((way + turn) % sides for turn in range(1, sides + 1))
            table[left, way] = next((each for each in ways if left >> each & 1), way)
    return table
