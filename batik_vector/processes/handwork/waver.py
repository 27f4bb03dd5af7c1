"""Waver: a smooth shift of every place, drawn by chance, that repeats with the cell.

Bumps (cubic B-splines) stand on a net that closes round the torus, each pushed by chance. A sum of bumps is a
mean of their pushes, so how much neighbouring places part is bounded by how much neighbouring bumps do: below
1 no two places fall on one another, and whatever lies side by side stays so. There is nothing but plus, minus
and times in it, and every place is looked up by its twin in the cell: all machines and both sides of a seam
get the same.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from batik_vector.artwork import Cell
from batik_vector.geometry.outlines import Steps
from batik_vector.geometry.sampling import Array
from batik_vector.values import frozen


@frozen
class Wave:
    """One size of bumps: ``reach`` is how far apart they stand, ``push`` the most that one does, in steps."""

    reach: float
    push: float


@frozen(eq=False)
class Waver:
    """A shift of every place of the torus, or any other values that vary smoothly over it.

    ``nets`` are the pushes of bumps for each wave, shape (k, up, across) for values of k numbers.
    """

    cell: Cell
    nets: tuple[Array, ...]

    @classmethod
    def drawn(cls, cell: Cell, waves: Sequence[Wave], seed: Sequence[int], numbers: int = 2) -> Waver:
        """Return one drawn by chance: the same seed, the same everywhere."""
        dice = np.random.default_rng(list(seed))
        (ax, ay), (bx, by) = cell.lattice
        nets = []
        for wave in waves:
            across = max(1, round(max(ax, bx) / wave.reach))
            up = max(1, round(max(ay, by) / wave.reach))
            nets.append((2 * dice.random((numbers, up, across)) - 1) * wave.push)
        return cls(cell, tuple(nets))

    def at(self, points: Steps) -> Array:
        """Return the values at places in whole steps, shape (n, k)."""
        u, v = _shares(points, self.cell)
        total = np.zeros((len(points), len(self.nets[0]) if self.nets else 2))
        for net in self.nets:
            _, up, across = net.shape
            columns, right = _weights(u, across)
            rows, over = _weights(v, up)
            for row, one in zip(rows, over, strict=True):
                for column, other in zip(columns, right, strict=True):
                    total += (net[:, row, column] * (one * other)).T
        return total

    def moved(self, points: Steps) -> Steps:
        """Return places as they are shifted, on whole steps."""
        return points + np.floor(self.at(points) + 0.5).astype(np.int64)

    @property
    def strain(self) -> float:
        """By how much at most two places part or close up, over how far apart they are."""
        (ax, ay), (bx, by) = self.cell.lattice
        area = ax * by - ay * bx
        found = 0.0
        for net in self.nets:
            _, up, across = net.shape
            u = across * _longest(np.roll(net, -1, axis=2) - net)
            v = up * _longest(np.roll(net, -1, axis=1) - net)
            # How the shares in the two translations change along x and along y.
            x = (u * abs(by) + v * abs(ay)) / area
            y = (u * abs(bx) + v * abs(ax)) / area
            found += float(np.sqrt(x * x + y * y))
        return found

    def eased(self, most: float) -> Waver:
        """Return the same with so little push that its strain is at most so much."""
        strain = self.strain
        if strain <= most:
            return self
        return Waver(self.cell, tuple(net * (most / strain) for net in self.nets))


def _longest(pushes: Array) -> float:
    squares = np.zeros(pushes.shape[1:])
    for each in pushes:
        squares += each * each
    return float(np.sqrt(squares.max()))


def _shares(points: Steps, cell: Cell) -> tuple[Array, Array]:
    """Return where places lie in the cell, as shares of its two translations, each in [0, 1)."""
    (ax, ay), (bx, by) = cell.lattice
    x, y = folded(points, cell).T
    if bx == 0:
        return x / ax, (y - x * ay / ax) / by % 1.0
    return (x - y * bx / by) / ax % 1.0, y / by


def folded(points: Steps, cell: Cell) -> Steps:
    """Return the twins of places within the cell: what lies whole times round the torus away has the same."""
    (ax, ay), (bx, by) = cell.lattice
    x, y = points[:, 0], points[:, 1]
    if bx == 0:
        return np.stack([x % ax, (y - x // ax * ay) % by], axis=1)
    return np.stack([(x - y // by * bx) % ax, y % by], axis=1)


def _weights(share: Array, count: int) -> tuple[list[Steps], list[Array]]:
    """Return the four bumps of a row of so many that reach a place, and what each counts there."""
    place = share * count
    first = np.floor(place)
    t = place - first
    s = 1.0 - t
    number = first.astype(np.int64)
    bumps = [(number + k) % count for k in (-1, 0, 1, 2)]
    weights = [
        s * s * s / 6,
        (4 - 3 * t * t * (1 + s)) / 6,
        (4 - 3 * s * s * (1 + t)) / 6,
        t * t * t / 6,
    ]
    return bumps, weights
