"""The asymmetric part of a pattern: of marks that a repeat makes out of one another, one of each."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.drafting.copies import Copies, same
from batik_vector.drafting.units import Unit
from batik_vector.geometry.nets.components import components
from batik_vector.tiling.torus.torus import translate

Index = NDArray[np.intp]
Floats = NDArray[np.float64]

MOST_IMAGES = 400_000
"""Images of marks past which a repeat is not looked into."""
FURTHER = 2.0
"""How many tolerances an image may be off a mark: both may be."""


def asymmetric(
    unit: Unit, shapes: Geometries, copies: Copies, level: Index, tolerance: float
) -> Index | None:
    """Return marks of which a unit makes all others, and no more; None where it makes others than there are.

    Args:
        unit: the repeat.
        shapes: the marks, in mm.
        copies: the marks as copies of few.
        level: of each; the images of a mark lie as high as it does.
        tolerance: mm.
    """
    operations = unit.orbit.operations
    if not len(shapes):
        return np.empty(0, np.intp)
    if len(shapes) * len(operations) > MOST_IMAGES:
        return None
    centres = shapely.get_coordinates(shapely.centroid(shapes))
    field = _Field(centres, unit.periods, FURTHER * tolerance)
    pairs = []
    for operation in operations:
        image = operation.at(centres)
        asked, found, shift = field.near(image)
        alike = (copies.kind[asked] == copies.kind[found]) & (level[asked] == level[found])
        asked, found, shift = asked[alike], found[alike], shift[alike]
        drawn = translate(operation.apply(shapes[asked]), shift)
        right = same(drawn, shapes[found], tolerance)
        asked, found = asked[right], found[right]
        if len(np.unique(asked)) < len(shapes):
            return None
        pairs.append(np.column_stack([asked, found]))
    label = components(len(shapes), np.concatenate(pairs))
    # Of each lot the one nearest to the lower left corner.
    order = np.lexsort([centres.sum(axis=1).round(6), label])
    first = np.append(True, label[order][1:] != label[order][:-1])
    chosen: Index = np.asarray(order[first], np.intp)
    return np.sort(chosen)


class _Field:
    """Places on a torus."""

    def __init__(self, places: Floats, periods: Floats, reach: float) -> None:
        self.places, self.periods, self.reach = places, periods, reach
        self.home = self._reduced(places)
        around = np.array([(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)], float) @ periods.T
        places = (self.home[:, None] + around[None]).reshape(-1, 2)
        self.tree = shapely.STRtree(np.asarray(shapely.points(places), dtype=object))

    def _reduced(self, places: Floats) -> Floats:
        share = np.linalg.solve(self.periods, places.T).T
        return np.asarray(places - np.floor(share) @ self.periods.T)

    def near(self, places: Floats) -> tuple[Index, Index, Floats]:
        """Return the pairs of places and own ones that are the same: (place, own one, shift to it)."""
        home = self._reduced(places)
        asked, found = self.tree.query(shapely.points(home), predicate="dwithin", distance=self.reach)
        found = found // 9
        way = self.places[found] - places[asked]
        whole = np.rint(np.linalg.solve(self.periods, way.T)).T
        return asked, found, whole @ self.periods.T
