"""Regions drawn in: where the middle of a pen may go so that its ink stays inside.

Rings are drawn in by their edges, all at once; where that is not enough, as where a region parts in two, its
whole polygon is drawn in by ``buffer``. A curve that is set off by itself tears at corners. At a corner that
points inwards the true outline is an arc; drawn as arcs, outlines would have twice as many points each time.
Here such corners stay corners, and sharper ones are cut off.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Offsets, Outlines, runs
from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.hatching.inward import BEYOND, Floats, Moved, moved_in, round_one_place
from batik_vector.values import frozen


@frozen(eq=False)
class Regions:
    """Areas in steps, as floats, what is inside to the left of every ring; and the mark that each belongs to.

    Ring i has the points ``rings[i]`` to ``rings[i + 1]``, region j the rings ``parts[j]`` to
    ``parts[j + 1]``, its outer ring first.
    """

    x: Floats
    y: Floats
    rings: Offsets
    parts: Offsets
    marks: Index

    @staticmethod
    def of(areas: Outlines) -> Regions:
        """Return areas as regions, each a mark."""
        x, y = (np.ascontiguousarray(each, np.float64) for each in areas.points.T)
        return _turned(x, y, areas.rings, areas.marks, np.arange(len(areas)))

    @staticmethod
    def of_polygons(polygons: Geometries, marks: Index) -> Regions:
        """Return polygons as regions."""
        if not len(polygons):
            return Regions.of(_NOTHING)
        _, points, offsets = shapely.to_ragged_array(polygons)
        rings, parts = (np.asarray(each, np.int64) for each in offsets)
        kept = np.ones(len(points), bool)
        kept[rings[1:] - 1] = False
        x, y = (np.ascontiguousarray(each) for each in points[kept].T)
        return _turned(x, y, rings - np.arange(len(rings)), parts, marks)

    def __len__(self) -> int:
        return len(self.marks)

    def taken(self, which: Index) -> Regions:
        """Return some of them."""
        rings, parts = runs(self.parts, which)
        points, ends = runs(self.rings, rings)
        return Regions(self.x[points], self.y[points], ends, parts, self.marks[which])

    def polygons(self) -> Geometries:
        """Return them as polygons."""
        if not len(self):
            return np.empty(0, dtype=object)
        # Each ring ends with its first point once more.
        points = np.column_stack([self.x, self.y])
        points = np.insert(points, self.rings[1:], points[self.rings[:-1]], axis=0)
        ends = self.rings + np.arange(len(self.rings))
        made = shapely.from_ragged_array(shapely.GeometryType.POLYGON, points, (ends, self.parts))
        return np.asarray(made, dtype=object)

    def outlines(self) -> Outlines:
        """Return them on the grid."""
        points = np.empty((len(self.x), 2), np.int64)
        points[:, 0], points[:, 1] = np.rint(self.x), np.rint(self.y)
        return Outlines(points, self.rings, self.parts, np.ones(len(self.rings) - 1, bool))

    def drawn_in(self, distance: float, part: float = 0.0) -> Drawn:
        """Return what lies so many steps within, in pieces.

        Args:
            distance: in steps.
            part: of the distance, after which is told where corners passed.
        """
        if distance <= 0 or not len(self):
            return Drawn(self, np.arange(len(self)), np.full(len(self.x), -1), None)
        moved = moved_in(self.x, self.y, self.rings, distance, part)
        whole = np.logical_and.reduceat(moved.whole, self.parts[:-1])
        points, ends = runs(moved.rings, _rings_of(self.parts, whole, moved.whole))
        parts = np.concatenate([[0], np.cumsum(np.diff(self.parts)[whole])])
        found = Regions(moved.x[points], moved.y[points], ends, parts, self.marks[whole])
        number = np.flatnonzero(whole)
        sound = found.sound()
        if not sound.all():
            points = points[found.points(np.flatnonzero(sound))]
            found, number = found.taken(np.flatnonzero(sound)), number[sound]
        asked = np.ones(len(self), bool)
        asked[number] = False
        left = np.flatnonzero(asked)
        left = left[~self.taken(left)._come_to_nothing(distance)]
        drawn = Drawn(found, number, points, moved)
        return drawn.with_others(*self.taken(left)._buffered(distance), left) if len(left) else drawn

    def points(self, which: Index) -> Index:
        """Return the points of some of them."""
        rings, _ = runs(self.parts, which)
        return runs(self.rings, rings)[0]

    def sound(self) -> NDArray[np.bool_]:
        """Return which regions have no ring that crosses itself or another."""
        if not len(self):
            return np.empty(0, bool)
        simple = round_one_place(self.x, self.y, self.rings)[self.parts[:-1]] & (np.diff(self.parts) == 1)
        asked = np.flatnonzero(~simple)
        if len(asked):
            simple[asked] = shapely.is_valid(self.taken(asked).polygons())
        return np.asarray(simple)

    def _come_to_nothing(self, distance: float) -> NDArray[np.bool_]:
        """Return which regions have no room for a round pen of such a radius at a glance."""
        if not len(self):
            return np.empty(0, bool)
        first = self.rings[:-1]
        breadth = [
            np.maximum.reduceat(each, first) - np.minimum.reduceat(each, first) for each in (self.x, self.y)
        ]
        small = np.minimum(*breadth) <= 2 * distance
        small |= _doubled_areas(self.x, self.y, self.rings) <= 2 * np.pi * distance * distance
        return np.asarray(small[self.parts[:-1]])

    def _buffered(self, distance: float) -> tuple[Regions, Index]:
        """Return what lies so many steps within each region in pieces, and which region each is of."""
        left = shapely.buffer(self.polygons(), -distance, join_style="mitre", mitre_limit=BEYOND)
        pieces, of = shapely.get_parts(left, return_index=True)
        whole = ~shapely.is_empty(pieces)
        return Regions.of_polygons(pieces[whole], self.marks[of[whole]]), of[whole]


@frozen(eq=False)
class Drawn:
    """Regions drawn in, and which of the regions before each is a piece of, ascending.

    Of each point ``corner`` has which of the corners ``moved`` it is; -1 in pieces that were not drawn in
    edge by edge. A region that was has a single piece.
    """

    regions: Regions
    parents: Index
    corner: Index
    moved: Moved | None

    def with_others(self, others: Regions, of: Index, parents: Index) -> Drawn:
        """Return the same with pieces drawn in otherwise: ``of`` which of ``parents`` each is."""
        regions = _both(self.regions, others)
        parents = np.concatenate([self.parents, parents[of]])
        order = np.argsort(parents, kind="stable")
        corner = np.concatenate([self.corner, np.full(len(others.x), -1)])
        return Drawn(regions.taken(order), parents[order], corner[regions.points(order)], self.moved)

    def own(self) -> NDArray[np.bool_]:
        """Return which pieces were drawn in edge by edge."""
        first = self.regions.rings[self.regions.parts[:-1]]
        return np.asarray(self.corner[first] >= 0)


_NOTHING = Outlines(
    np.empty((0, 2), np.int64), np.zeros(1, np.int64), np.zeros(1, np.int64), np.empty(0, bool)
)


def _rings_of(parts: Offsets, whole: NDArray[np.bool_], kept: NDArray[np.bool_]) -> Index:
    """Return the rings of whole regions, by their numbers among the kept ones."""
    number = np.cumsum(kept) - 1
    found: Index = number[np.repeat(whole, np.diff(parts))]
    return found


def _both(a: Regions, b: Regions) -> Regions:
    return Regions(
        np.concatenate([a.x, b.x]),
        np.concatenate([a.y, b.y]),
        np.concatenate([a.rings, b.rings[1:] + len(a.x)]),
        np.concatenate([a.parts, b.parts[1:] + len(a.rings) - 1]),
        np.concatenate([a.marks, b.marks]),
    )


def _doubled_areas(x: Floats, y: Floats, rings: Offsets) -> Floats:
    """Return twice the area in each ring, less than nothing where it lies to the right."""
    first, last = rings[:-1], rings[1:] - 1
    origin_x, origin_y = (np.repeat(each[first], np.diff(rings)) for each in (x, y))
    # Numbers stay small near each ring's own beginning.
    x, y = x - origin_x, y - origin_y
    cross = np.empty_like(x)
    cross[:-1] = x[:-1] * y[1:] - y[:-1] * x[1:]
    cross[last] = x[last] * y[first] - y[last] * x[first]
    return np.asarray(np.add.reduceat(cross, first))


def _turned(x: Floats, y: Floats, rings: Offsets, parts: Offsets, marks: Index) -> Regions:
    """Return regions of rings, each turned so that what is inside lies to its left."""
    if len(rings) > 1:
        holes = np.ones(len(rings) - 1, bool)
        holes[parts[:-1]] = False
        wrong = np.repeat((_doubled_areas(x, y, rings) < 0) != holes, np.diff(rings))
        if wrong.any():
            own = np.arange(len(x))
            back = np.repeat(rings[:-1] + rings[1:] - 1, np.diff(rings)) - own
            own = np.where(wrong, back, own)
            x, y = x[own], y[own]
    return Regions(x, y, rings, parts, marks)
