"""Rows that follow the midrib of regions, as the veins of a bent leaf do: the direction field of a motif.

The midrib of a region is the parabola that lies nearest to all of its places, seen along its axis. Places are
told by their foot on it and their distance from it: there rows are straight, and bent they keep apart.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import shapely

from batik_vector.geometry.fills.insets import Parts
from batik_vector.geometry.fills.rows import Runs, lattice, runs
from batik_vector.geometry.sampling import Array, Geometries, Indices

COLUMNS = 24
"""Places along a region's axis, about, by which its midrib is found."""

FEW = 12
"""Places of a region that are too few to tell how it bends."""

STEEPEST, TIGHTEST = 0.5, 0.5
"""Slope against the axis up to which a midrib bends, and curvature as a share of what would bring its rows
together at the edge."""

STEPS = 6
"""Newton's steps to a foot, or to a place along a row: each doubles the digits."""

BENDS = 32
"""Stretches of a bent line."""


class Midribs(NamedTuple):
    """The midribs of regions: where each begins, its direction, its length, and y = a + bx + cx² along it."""

    root: Array
    ahead: Array
    length: Array
    bend: Array

    def straight(self, points: Array, of: Indices) -> Array:
        """Return points of regions, shape (n, 2), as the x of their feet and the distance from the midrib."""
        away, ahead = points - self.root[of], self.ahead[of]
        x = (away * ahead).sum(axis=1)
        y = away[:, 1] * ahead[:, 0] - away[:, 0] * ahead[:, 1]
        a, b, c = self.bend[of].T
        foot = x
        for _ in range(STEPS):
            slope, high = b + 2 * c * foot, a + foot * (b + c * foot) - y
            foot = foot - (foot - x + high * slope) / np.maximum(1 + slope**2 + 2 * c * high, 0.1)
        slope, high = b + 2 * c * foot, a + foot * (b + c * foot) - y
        return np.column_stack([foot, ((foot - x) * slope - high) / np.sqrt(1 + slope**2)])

    def bent(self, points: Array, of: Indices) -> Array:
        """Return where points lie that are told as above."""
        foot, aside = points.T
        a, b, c = self.bend[of].T
        slope = b + 2 * c * foot
        away = aside / np.sqrt(1 + slope**2)
        x, y = foot - slope * away, a + foot * (b + c * foot) + away
        ahead = self.ahead[of]
        left = np.column_stack([-ahead[:, 1], ahead[:, 0]])
        return np.asarray(self.root[of] + x[:, None] * ahead + y[:, None] * left)

    def turns(self, points: Array, of: Indices) -> Array:
        """Return the directions of rows, in radians, at points told as above."""
        ahead, (_, b, c) = self.ahead[of], self.bend[of].T
        return np.asarray(np.arctan2(ahead[:, 1], ahead[:, 0]) + np.arctan(b + 2 * c * points[:, 0]))

    def run(self, points: Array, of: Indices) -> Array:
        """Return how long rows are up to points told as above, from the middle of the midrib."""
        return self._run(points[:, 0], points[:, 1], of) - self._run(self.length[of] / 2, points[:, 1], of)

    def along(self, run: Array, aside: Array, of: Indices) -> Array:
        """Return the points, told as above, at which rows aside from midribs are so long."""
        _, b, c = self.bend[of].T
        foot = self.length[of] / 2 + run
        for _ in range(STEPS):
            slope = b + 2 * c * foot
            pace = np.sqrt(1 + slope**2) - 2 * c * aside / (1 + slope**2)
            there = self.run(np.column_stack([foot, aside]), of)
            foot = foot - (there - run) / np.maximum(pace, 0.1)
        return np.column_stack([foot, aside])

    def _run(self, foot: Array, aside: Array, of: Indices) -> Array:
        """Return the length of a row, up to a number that hangs on the region alone.

        That of a curve beside another is shorter by as much as it stands aside, times the turn.
        """
        _, b, c = self.bend[of].T
        slope = b + 2 * c * foot
        root = np.sqrt(1 + slope**2)
        flat = np.abs(c) * np.maximum(self.length[of], 1e-9) < 1e-9
        bent = (slope * root + np.arcsinh(slope)) / np.where(flat, 1.0, 4 * c)
        return np.asarray(np.where(flat, foot * root, bent) - aside * np.arctan(slope))


def midribs(regions: Geometries) -> Midribs:
    """Return the midribs of regions; their axis is the longer side of their narrowest rectangle."""
    root, ahead, length, breadth = axes(regions)
    flat = Midribs(root, ahead, length, np.zeros((len(regions), 3)))
    unit = np.column_stack([length, np.maximum(breadth, 1e-9)]) / [COLUMNS, COLUMNS / 2]
    points, of = shapely.get_coordinates(regions, return_index=True)
    squared = shapely.set_coordinates(regions.copy(), flat.straight(points, of) / unit[of])
    places, part = lattice(Parts(squared, np.arange(len(regions))), 0.0, 1.0, 1.0, 0.0)
    x, y = places[:, 0] / COLUMNS, places[:, 1]
    power = [np.bincount(part, x**k, len(regions)) for k in range(5)]
    aside = [np.bincount(part, y * x**k, len(regions)) for k in range(3)]
    square = np.array([[power[i + j] for j in range(3)] for i in range(3)]).transpose(2, 0, 1)
    few = (power[0] < FEW) | (np.linalg.det(square) < 1e-9)
    square[few] = np.eye(3)
    bend = np.linalg.solve(square, np.stack(aside, axis=1)[..., None])[..., 0]
    bend[few] = 0.0
    bend *= unit[:, 1:] / length[:, None] ** np.arange(3)
    steep = np.maximum(np.abs(bend[:, 1]), np.abs(bend[:, 1] + 2 * bend[:, 2] * length)) / STEEPEST
    tight = np.abs(2 * bend[:, 2]) * breadth / TIGHTEST
    bend /= np.maximum(np.maximum(steep, tight), 1.0)[:, None]
    return flat._replace(bend=bend)


def axes(regions: Geometries) -> tuple[Array, Array, Array, Array]:
    """Return where midribs begin, their directions and lengths, and how far regions reach aside."""
    boxes = shapely.get_coordinates(shapely.minimum_rotated_rectangle(regions)).reshape(-1, 5, 2)
    one, two = boxes[:, 1] - boxes[:, 0], boxes[:, 2] - boxes[:, 1]
    sides: Array = np.hypot(*np.stack([one, two], axis=-1).swapaxes(0, 1))
    longer = sides[:, 0] >= sides[:, 1]
    along = np.where(longer[:, None], one, two)
    length, breadth = sides.max(axis=1), sides.min(axis=1)
    ahead: Array = along / length[:, None]
    # A motif points along +x, or up.
    back = (ahead[:, 0] < -1e-9) | ((np.abs(ahead[:, 0]) <= 1e-9) & (ahead[:, 1] < 0))
    ahead[back] *= -1
    middle: Array = boxes[:, :4].mean(axis=1)
    return middle - ahead * length[:, None] / 2, ahead, length, breadth


def straightened(within: Parts, ribs: Midribs, step: float) -> Parts:
    """Return parts as they lie along the midribs of their regions, with no edge longer than ``step``."""
    fine = np.asarray(shapely.segmentize(within.shapes, step), dtype=object)
    points, of = shapely.get_coordinates(fine, return_index=True)
    moved = shapely.set_coordinates(fine, ribs.straight(points, within.region[of]))
    return Parts(np.asarray(moved, dtype=object), within.region)


def bent_lines(found: Runs, begin: Array, end: Array, within: Parts, ribs: Midribs) -> Geometries:
    """Return runs of straightened parts, told by their ends, as lines that follow the midribs."""
    share = np.linspace(0, 1, BENDS + 1)
    points = begin[:, None] + share[None, :, None] * (end - begin)[:, None]
    of = np.repeat(within.region[found.part], BENDS + 1)
    lines = ribs.bent(points.reshape(-1, 2), of).reshape(-1, BENDS + 1, 2)
    return np.asarray(shapely.linestrings(lines), dtype=object)


def spots(straight: Parts, ribs: Midribs, spacing: float) -> tuple[Array, Indices]:
    """Return places in rows along midribs, told as feet and distances, and the region of each.

    Rows are a spacing apart, and so are places in a row, every other row by half of it on.
    """
    found = runs(straight, 0.0, spacing)
    of, aside = straight.region[found.part], found.row * spacing
    low = ribs.run(np.column_stack([found.begin, aside]), of)
    high = ribs.run(np.column_stack([found.end, aside]), of)
    moved = (found.row % 2) / 2
    first = np.ceil(low / spacing - moved).astype(np.int64)
    count = np.maximum(np.floor(high / spacing - moved).astype(np.int64) - first + 1, 0)
    row = np.repeat(np.arange(len(of)), count)
    number = first[row] + np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
    run, beside = (np.asarray(each, np.float64) for each in ((number + moved[row]) * spacing, aside[row]))
    return ribs.along(run, beside, of[row]), of[row]
