"""What remains of areas when some of their outlines are done, and the whole put together again.

A mark with an outline that is not done goes on without the holes that are: nothing that is left to do comes
near them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines, Steps, of_polygons, runs, to_polygons, together
from batik_vector.geometry.sampling import Geometries
from batik_vector.values import frozen


@frozen(eq=False)
class Remaining:
    """Areas of an ink of which something is left to do: ``mark`` has the number of each, and ``holes`` those
    of the rings that it goes on without.
    """

    whole: Outlines
    areas: Outlines
    mark: Index
    holes: Index

    def with_all(self, areas: Geometries, stand_for: Index) -> tuple[Geometries, tuple[str, ...]]:
        """Return all areas of the ink again, in steps, and their names.

        Args:
            areas: what has become of those that remained.
            stand_for: in the place of which of them each stands; their number, if of none.
        """
        names, count = self.whole.names, len(self.whole)
        done = np.delete(np.arange(count), self.mark)
        parts = [self.whole.taken(done), self._holed(of_polygons(areas), areas)]
        place = np.concatenate([done, np.append(self.mark, count)[stand_for]])
        order = np.argsort(place, kind="stable")
        made = to_polygons(together(parts).taken(order))
        # What goes on across the seam alone has the name of no area here.
        named = [*names, names[0] if names else ""]
        return made, tuple(named[each] for each in place[order].tolist()) if names else ()

    def _holed(self, outlines: Outlines, areas: Geometries) -> Outlines:
        """Return areas with the holes that they went on without."""
        if not len(self.holes):
            return outlines
        inside = self.whole.points[self.whole.rings[self.holes]]
        hole, owner = shapely.STRtree(areas).query(
            shapely.points(inside.astype(float)), predicate="intersects"
        )
        members, ends = runs(self.whole.rings, self.holes[hole])
        points = np.concatenate([outlines.points, self.whole.points[members]])
        rings = np.concatenate([outlines.rings, len(outlines.points) + ends[1:]])
        of = np.concatenate([np.repeat(np.arange(len(outlines)), np.diff(outlines.marks)), owner])
        order = np.argsort(of, kind="stable")
        members, ends = runs(rings, order)
        marks = np.concatenate([[0], np.cumsum(np.bincount(of, minlength=len(outlines)))])
        return Outlines(points[members], ends, marks, np.ones(len(order), bool))


def remaining(outlines: Outlines, done: NDArray[np.bool_], names: Sequence[str]) -> Remaining:
    """Return what is left to do of an ink's areas.

    Args:
        outlines: all of them.
        done: which of their rings are.
        names: of the areas.
    """
    of = np.repeat(np.arange(len(outlines)), np.diff(outlines.marks))
    outer = np.zeros(len(of), bool)
    outer[outlines.marks[:-1]] = True
    open_ = np.bincount(of[~done], minlength=len(outlines)) > 0
    holes = np.flatnonzero(done & ~outer & open_[of])
    mark = np.flatnonzero(open_)
    holes = holes[~_around(outlines, holes, mark)]
    kept = open_[of]
    kept[holes] = False
    rings = np.flatnonzero(kept)
    members, ends = runs(outlines.rings, rings)
    marks = np.concatenate([[0], np.cumsum(np.bincount(of[rings], minlength=len(outlines))[mark])])
    left = Outlines(outlines.points[members], ends, marks, np.ones(len(rings), bool))
    return Remaining(replace(outlines, names=tuple(names)), left, mark, holes)


def _around(outlines: Outlines, holes: Index, mark: Index) -> NDArray[np.bool_]:
    """Return which holes may have one of some areas in them: those must stay, or they would cover it."""
    found = np.zeros(len(holes), bool)
    if len(holes):
        members, ends = runs(outlines.rings, holes)
        boxes = _boxes(_bounds(outlines.points[members], ends[:-1]))
        tree = shapely.STRtree(_boxes(outlines.bounds()[mark]))
        found[tree.query(boxes, predicate="contains")[0]] = True
    return found


def _bounds(points: Steps, first: Index) -> Steps:
    return np.hstack([edge.reduceat(points, first, axis=0) for edge in (np.minimum, np.maximum)])


def _boxes(bounds: Steps) -> Geometries:
    return np.asarray(shapely.box(*bounds.T), dtype=object)
