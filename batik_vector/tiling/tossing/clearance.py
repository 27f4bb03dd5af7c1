"""How far every place of the torus is from what lies there: a grid of distances that is asked in bulk.

Packing tries hundreds of thousands of places, far more than outlines could be measured at. A mark is asked
for at points along its outline: where all of them are far enough from others, it has room. What is found so
is measured outline to outline before it stays.
"""

from __future__ import annotations

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry.sampling import Array
from batik_vector.tiling.tossing.marks import Complexes
from batik_vector.tiling.tossing.scatter import Torus

MOST_NODES, LEAST_NODES = 160_000, 10_000
"""Places of the grid, about: more are dear to keep, fewer too coarse for any mark."""

Whole = NDArray[np.int64]


class Clearance:
    """Distances on a grid over the window of a torus, in whole grid steps; negative inside of marks."""

    def __init__(self, torus: Torus, step: float, reach: float) -> None:
        """Begin with an empty torus.

        Args:
            torus: where marks come to lie.
            step: from node to node, about; within bounds on their number.
            reach: distances are not told beyond this.
        """
        window = torus.window
        step = min(max(step, math.sqrt(torus.area / MOST_NODES)), math.sqrt(torus.area / LEAST_NODES))
        self.torus, self.reach = torus, reach
        self.across, self.up = (max(1, math.ceil(side / step)) for side in (window.right, window.top))
        self.sides = window.right / self.across, window.top / self.up
        self.far = np.full((self.up + 1) * (self.across + 1), float(math.floor(reach)))
        """Of each node, row by row; the last of a row and the last row lie a period on from the first."""
        if len(torus.operations) > 1:
            # A mark that keeps clear of mirrors by half the distance keeps clear of its own images there.
            self.far = np.minimum(self.far, np.floor(_to_images(self.nodes(), torus)))

    @property
    def step(self) -> float:
        """The diagonal of a cell of the grid."""
        return math.hypot(*self.sides)

    def nodes(self) -> Complexes:
        """Return the places of the grid."""
        x, y = np.meshgrid(np.arange(self.across + 1.0), np.arange(self.up + 1.0))
        return np.asarray((x * self.sides[0] + 1j * y * self.sides[1]).ravel())

    def take(self, shapes: Geometries) -> None:
        """Lay down shapes: all that come within reach of the window, translates too."""
        if not len(shapes):
            return
        bounds = shapely.bounds(shapes)
        dx, dy = self.sides
        low = np.ceil((bounds[:, :2] - self.reach) / [dx, dy]).astype(np.int64).clip(0)
        high = np.floor((bounds[:, 2:] + self.reach) / [dx, dy]).astype(np.int64)
        high = np.minimum(high, [self.across, self.up])
        wide, tall = np.maximum(high - low + 1, 0).T
        mark = np.repeat(np.arange(len(shapes)), wide * tall)
        place = np.arange(len(mark)) - np.repeat(np.cumsum(wide * tall) - wide * tall, wide * tall)
        row, column = np.divmod(place, np.maximum(wide, 1)[mark])
        x, y = (low[mark, 0] + column), (low[mark, 1] + row)
        shapely.prepare(shapes)
        at = np.column_stack([x * dx, y * dy])
        away: Array = np.asarray(shapely.distance(shapes[mark], shapely.points(at)))
        within = np.flatnonzero(away <= 0)
        edges = shapely.boundary(shapes)
        shapely.prepare(edges)
        away[within] = -shapely.distance(edges[mark[within]], shapely.points(at[within]))
        np.minimum.at(self.far, y * (self.across + 1) + x, np.rint(away))

    def at(self, places: Complexes) -> Whole:
        """Return how far places are from what lies there, in whole steps, to about a tenth of a cell."""
        places = self.torus.within(places)
        x, y = places.real / self.sides[0], places.imag / self.sides[1]
        column = np.minimum(x.astype(np.intp), self.across - 1)
        row = np.minimum(y.astype(np.intp), self.up - 1)
        u, v = x - column, y - row
        here = row * (self.across + 1) + column
        above = here + self.across + 1
        far = self.far
        low = far[here] + u * (far[here + 1] - far[here])
        high = far[above] + u * (far[above + 1] - far[above])
        return np.asarray(np.rint(low + v * (high - low)), np.int64)


def _to_images(places: Complexes, torus: Torus) -> Array:
    """Return how far each place is from its nearest image under a symmetry of the torus."""
    a, b = (complex(*each) for each in torus.lattice)
    cross = (a.conjugate() * b).imag
    around = [i * a + j * b for i in (-1, 0, 1) for j in (-1, 0, 1)]
    least = np.full(len(places), np.inf)
    for operation in torus.operations:
        away = operation.at_complex(places) - places
        i, j = (away * b.conjugate()).imag / -cross, (away * a.conjugate()).imag / cross
        away = away - np.rint(i) * a - np.rint(j) * b
        for shift in around if not operation.is_identity else ():
            least = np.minimum(least, np.abs(away + shift))
    return least
