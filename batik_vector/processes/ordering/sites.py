"""Where strokes may begin and end, and which of these places lie near one another."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Steps
from batik_vector.processes.ordering.distances import Column
from batik_vector.processes.ordering.neighbours import NOBODY, Pairs, neighbours
from batik_vector.values import frozen


@frozen(eq=False)
class Sites:
    """Places at which strokes may begin and end: the ends 2i and 2i + 1 are those of stroke i.

    ``round`` says whose two ends are one place, as of a closed stroke, and ``group`` which strokes follow one
    another, counted from 0.
    """

    x: Column
    y: Column
    round: NDArray[np.bool_]
    group: Index

    @staticmethod
    def of(ends: Steps, group: Index) -> Sites:
        """Return places given as rows, shape (2n, 2), of n strokes in their groups."""
        x, y = ends[:, 0].astype(float), ends[:, 1].astype(float)
        return Sites(x, y, (x[0::2] == x[1::2]) & (y[0::2] == y[1::2]), group)

    def near(self, count: int) -> Pairs:
        """Return each place with so many near it, about; a closed stroke by the first of its ends."""
        once = np.ones(len(self.x), bool)
        once[1::2] = ~self.round
        some = np.flatnonzero(once)
        return self.pairs(some, some ^ 1, count)

    def pairs(self, some: Index, apart: Index, count: int) -> Pairs:
        """Return some ends with so many near each of them, about.

        Args:
            some: ends, which rise.
            apart: an end that is no neighbour of each.
            count: how many.
        """
        rank = np.full(len(self.x), NOBODY, np.intp)
        rank[some] = np.arange(len(some))
        found = neighbours(self.x[some], self.y[some], self.group[some >> 1], rank[apart], count)
        return Pairs(some[found.one], some[found.two], found.apart)
