"""Sheets: what openings leave of a tile, part by part, and how its parts hang together round the torus."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import shapely

from batik_vector.artwork import Cell
from batik_vector.geometry.outlines import Index, Steps
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.geometry.sampling import Geometries, Points
from batik_vector.processes.stencilling.clusters import Clusters, Gain
from batik_vector.values import frozen


@frozen
class Torus:
    """The lattice on which a tile repeats, in steps."""

    cell: Cell

    @property
    def basis(self) -> tuple[Gain, Gain]:
        """The two translations."""
        return self.cell.lattice

    def at(self, gains: Steps) -> Steps:
        """Return how far repeats lie from the tile, shape (n, 2)."""
        return gains @ np.array(self.basis, np.int64)

    def home(self, points: Points) -> tuple[Points, Steps]:
        """Return places within the tile for places anywhere, and the repeats in which these lie.

        Args:
            points: shape (n, 2), in steps.
        """
        (ax, ay), (bx, by) = self.basis
        if ay:
            first = np.floor(points[:, 0] / ax)
            second = np.floor((points[:, 1] - first * ay) / by)
        else:
            second = np.floor(points[:, 1] / by)
            first = np.floor((points[:, 0] - second * bx) / ax)
        gains = np.stack([first, second], axis=1).astype(np.int64)
        return points - self.at(gains), gains

    def nearest(self, ways: Points) -> tuple[Points, Steps]:
        """Return the shortest of the ways that differ by repeats, and the repeats taken off, shape (n, 2)."""
        middle = np.array([self.cell.columns, self.cell.rows]) / 2
        inside, gains = self.home(ways + middle)
        best, taken = inside - middle, gains
        for step in ((0, 1), (1, 0), (1, 1), (1, -1), (0, -1), (-1, 0), (-1, -1), (-1, 1)):
            move = np.array(step, np.int64)
            other = inside - middle - self.at(move[None])
            nearer = (other**2).sum(axis=1) < (best**2).sum(axis=1) - 1e-9
            best = np.where(nearer[:, None], other, best)
            taken = np.where(nearer[:, None], gains + move, taken)
        return best, taken

    def around(self, bounds: Points, low: Points, high: Points) -> tuple[Index, Steps]:
        """Return which of some bounds, and by which repeats moved, come into a window.

        Args:
            bounds: shape (n, 4), in steps.
            low: the window's lower left corner.
            high: its upper right one.
        """
        (ax, _), (_, by) = self.basis
        size = np.abs(bounds).max(initial=0.0) + np.abs([low, high]).max()
        reach = [int(size // each) + 2 for each in (max(ax, 1), max(by, 1))]
        reach = [
            min(each, 2 + int((high - low).max() * 2 // side))
            for each, side in zip(reach, (ax, by), strict=True)
        ]
        steps = [np.arange(-each, each + 1) for each in reach]
        gains = np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, 2).astype(np.int64)
        shift = self.at(gains)
        meets = (
            (bounds[:, None, 0] + shift[:, 0] <= high[0])
            & (bounds[:, None, 2] + shift[:, 0] >= low[0])
            & (bounds[:, None, 1] + shift[:, 1] <= high[1])
            & (bounds[:, None, 3] + shift[:, 1] >= low[1])
        )
        which, copy = np.nonzero(meets)
        return which, gains[copy]


@frozen(eq=False)
class Sheet:
    """What openings leave of a tile, or other polygons in it.

    ``parts`` are the polygons of the sheet within the tile, outer rings anticlockwise, in steps; ``joints``
    say which of them go on in which across the tile's edges, and how many repeats away: (one, other, gain).
    """

    torus: Torus
    parts: Geometries
    joints: tuple[tuple[int, int, Gain], ...]
    seams: Steps
    """Stretches of the tile's edges along which parts end: (part, axis, value, from, to), shape (n, 5)."""

    @cached_property
    def clusters(self) -> Clusters:
        """The parts as they hang together."""
        found = Clusters(len(self.parts))
        for one, other, gain in self.joints:
            found.join(one, other, gain)
        return found


def sheet_of(openings: Geometries, cell: Cell) -> Sheet:
    """Return what openings leave of a tile.

    Args:
        openings: polygons in steps within the tile; they touch one another in points at most.
        cell: the tile.
    """
    box = shapely.box(0, 0, cell.columns, cell.rows)
    whole = shapely.difference(box, shapely.union_all(openings)) if len(openings) else box
    return hanging(polygonal(np.array([whole], dtype=object)), cell)


def hanging(parts: Geometries, cell: Cell) -> Sheet:
    """Return polygons within a tile, in steps, as they hang together round it."""
    torus = Torus(cell)
    parts = oriented(parts)
    joints, seams = list[tuple[int, int, Gain]](), []
    for axis in (0, 1):
        found, ends = _across(parts, torus, axis)
        joints += found
        seams.append(ends)
    return Sheet(torus, parts, tuple(dict.fromkeys(joints)), np.concatenate(seams))


def _across(parts: Geometries, torus: Torus, axis: int) -> tuple[list[tuple[int, int, Gain]], Steps]:
    """Return the joints across the edges where a coordinate is 0 or the tile's size, and where none are."""
    cell = torus.cell
    size, long = (cell.columns, cell.rows) if axis == 0 else (cell.rows, cell.columns)
    slip = torus.basis[axis][1 - axis]
    near, far = _stretches(parts, axis, 0), _stretches(parts, axis, size)
    joints, near_met, far_met = [], [], []
    # What lies at the far edge lies at the near one of the next repeat, which may be slipped along it.
    for more in (-1, 0, 1, 2):
        moved = far.copy()
        moved[:, 1:] += more * long - slip
        for p, q, low, high in _common(near, moved):
            gain = (1, -more) if axis == 0 else (-more, 1)
            joints.append((int(far[q, 0]), int(near[p, 0]), gain))
            near_met.append((near[p, 0], low, high))
            far_met.append((far[q, 0], low - more * long + slip, high - more * long + slip))
    rest = [
        np.array([(part, axis, value, low, high) for part, low, high in _left(each, met)], np.int64).reshape(
            -1, 5
        )
        for each, met, value in ((near, near_met, 0), (far, far_met, size))
    ]
    return joints, np.concatenate(rest)


def _stretches(parts: Geometries, axis: int, value: int) -> Steps:
    """Return where parts lie along an edge of the tile: (part, from, to), shape (n, 3)."""
    rings, owner = shapely.get_rings(parts, return_index=True)
    coords, ring = shapely.get_coordinates(rings, return_index=True)
    on = coords[:, axis] == value
    edge = on[1:] & on[:-1] & (ring[1:] == ring[:-1])
    along = np.sort(np.stack([coords[:-1, 1 - axis][edge], coords[1:, 1 - axis][edge]], axis=1), axis=1)
    found = np.column_stack([owner[ring[:-1][edge]], along]).astype(np.int64).reshape(-1, 3)
    return found[np.argsort(found[:, 1], kind="stable")]


def _common(one: Steps, other: Steps) -> list[tuple[int, int, int, int]]:
    """Return the stretches that two rows of disjoint, ascending stretches share: (row, row, from, to)."""
    found = []
    p = q = 0
    while p < len(one) and q < len(other):
        low, high = max(one[p, 1], other[q, 1]), min(one[p, 2], other[q, 2])
        if low < high:
            found.append((p, q, int(low), int(high)))
        if one[p, 2] < other[q, 2]:
            p += 1
        else:
            q += 1
    return found


def _left(stretches: Steps, met: list[tuple[int, int, int]]) -> list[tuple[int, int, int]]:
    """Return what is left of stretches without those that have met another."""
    gone: dict[int, list[tuple[int, int]]] = {}
    for part, low, high in met:
        gone.setdefault(int(part), []).append((int(low), int(high)))
    found = []
    for part, low, high in stretches.tolist():
        at = low
        for first, last in sorted(each for each in gone.get(part, ()) if each[0] >= low and each[1] <= high):
            if first > at:
                found.append((part, at, first))
            at = max(at, last)
        if at < high:
            found.append((part, at, high))
    return found
