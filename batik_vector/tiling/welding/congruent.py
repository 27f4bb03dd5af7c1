"""Congruent areas: what is made once and set down many times.

A pattern is few shapes and many copies. Copies that stand on the grid are translates of one another to the
bit, and what happens to one of them among its neighbours (a cut, a weld, a test) happens to every other one
that has the same neighbours at the same places. So areas are held here as *copies* of *shapes*; work is asked
for by configuration, done once for each that is different, and its result set down wherever it belongs.

Coordinates are whole grid steps.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry import work
from batik_vector.geometry.congruence import alike, different, same_points
from batik_vector.geometry.outlines import Index, Outlines, Steps, of_polygons, runs, to_polygons
from batik_vector.geometry.ragged import Ragged
from batik_vector.geometry.regions import oriented
from batik_vector.tiling.torus.remembered import KEPT_VERTICES, Asked, as_array, identities, interned
from batik_vector.tiling.torus.torus import polygons_of, to_step_grid, translate
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

FEW_PAIRS = 250_000
"""Pairs of bounds that are compared one with the other: sooner done than a tree."""

SHORT = 2**31
"""Steps below which a coordinate is a number of 32 bits."""

FEW_COPIES = 500
"""Copies that are looked up one by one; more are sooner made again."""

Predicate = Callable[[Geometries, Geometries], NDArray[np.bool_]]


class Copies:
    """Copies of a stock's shapes: ``kind`` says of which, shape (n,), ``shift`` where to, shape (n, 2)."""

    # Made by the hundred in every compilation, and hence no value of the costlier sort.
    __slots__ = ("kind", "shift")

    def __init__(self, kind: Index, shift: Steps) -> None:
        self.kind, self.shift = kind, shift

    def __len__(self) -> int:
        return len(self.kind)

    def taken(self, which: Index | NDArray[np.bool_]) -> Copies:
        """Return some of the copies."""
        return Copies(self.kind[which], self.shift[which])

    def moved(self, shift: Steps) -> Copies:
        """Return the copies elsewhere; ``shift`` has shape (2,) or (n, 2)."""
        return Copies(self.kind, self.shift + shift)


@frozen(eq=False)
class Repeated:
    """Areas as copies: copy i is ``shapes[which[i]]``, a valid polygon on the grid, moved by ``shift[i]``."""

    shapes: Geometries
    which: Index
    shift: Steps

    def __len__(self) -> int:
        return len(self.which)

    def taken(self, which: Index) -> Repeated:
        """Return some of the copies."""
        return Repeated(self.shapes, self.which[which], self.shift[which])

    def reduced(self) -> Repeated:
        """Return the same copies, of shapes that are all different."""
        if not len(self.shapes):
            return self
        heads, number, corner = different(of_polygons(self.shapes))
        away = corner - corner[heads][number]
        return Repeated(self.shapes[heads], number[self.which], self.shift + away[self.which])


Areas: TypeAlias = Geometries | Repeated
"""Areas in mm: polygons, or copies on the grid."""


def polygons(areas: Areas) -> Geometries:
    """Return areas as polygons in mm."""
    if not isinstance(areas, Repeated):
        return areas
    stock = Stock()
    return stock.in_mm(stock.copies([areas])[0])


def vertex_count(areas: Areas) -> int:
    """Return how many vertices areas have."""
    if isinstance(areas, Repeated):
        return int(shapely.get_num_coordinates(areas.shapes)[areas.which].sum())
    return int(shapely.get_num_coordinates(areas).sum())


def together(parts: Sequence[Copies]) -> Copies:
    """Return several sets of copies as one."""
    if not parts:
        return Copies(np.empty(0, np.intp), np.empty((0, 2), np.int64))
    return Copies(np.concatenate([p.kind for p in parts]), np.concatenate([p.shift for p in parts]))


class SetDown(NamedTuple):
    """Copies of the polygons of results: ``each`` says for which asker, ``piece`` which polygon of all."""

    copies: Copies
    each: Index
    piece: Index


class Stock:
    """All shapes of a tile that are different, as far as is known; it only grows.

    Args:
        remembers: whether what is made of its shapes is kept for other tiles, as long as they are few.
    """

    def __init__(self, *, remembers: bool = False) -> None:
        self.shapes: Geometries = np.empty(0, dtype=object)
        self._bounds: Steps = np.empty((0, 4), np.int64)
        self.remembers = remembers
        self._vertices = 0

    def add(self, areas: Geometries) -> Copies:
        """Take up areas as they stand, each as a shape of its own."""
        first = len(self.shapes)
        if self.remembers:
            self._vertices += int(shapely.get_num_coordinates(areas).sum())
            self.remembers = self._vertices <= KEPT_VERTICES
        if self.remembers:
            areas = interned(areas)
        self.shapes = np.concatenate([self.shapes, areas])
        self._bounds = np.vstack([self._bounds, shapely.bounds(areas).astype(np.int64).reshape(-1, 4)])
        return Copies(np.arange(first, len(self.shapes)), np.zeros((len(areas), 2), np.int64))

    def settled(self, marks: Geometries) -> tuple[Copies, Index]:
        """Bring areas in mm to the grid; return the copies and which mark each is of.

        Rounding moves a vertex by half a step at most. The few shapes that this makes invalid are mended by
        GEOS' precision reducer, and may thereby fall into several or vanish.
        """
        areas, owner = polygons_of(marks, np.arange(len(marks)))
        if not len(areas):
            return together([]), owner
        steps, torn = _without_repeats(of_polygons(areas, STEPS_PER_MM))
        heads, number, corner = different(steps)
        shapes = to_polygons(steps.taken(heads, -corner[heads]))
        bad = torn[heads] | ~shapely.is_valid(shapes)
        if bad.any():
            mended = to_step_grid(areas[heads[bad]])
            shapes[bad] = translate(mended, -corner[heads[bad]])
        down = self.set_down(shapes, number, corner)
        return down.copies, owner[down.each]

    def taken_up(self, areas: Geometries) -> Copies:
        """Take up valid polygons in grid steps, those that are alike as copies of one shape."""
        if not len(areas):
            return together([])
        if not self.remembers:
            heads, number, away = _told_apart(areas)
        else:
            areas = interned(areas)
            known = Asked[ToldApart].together("told apart", identities(areas)[:, None], (areas,))
            if known.fresh():
                known.keep([0], [_told_apart(areas)], [2 * len(areas)])
            ((heads, number, away),) = known.answers()
        return self.add(areas[heads]).taken(number).moved(away)

    def copies(self, parts: Sequence[Repeated]) -> list[Copies]:
        """Take up areas that are copies already; an array of shapes that several share is taken up once."""
        arrays = {id(part.shapes): part.shapes for part in parts}
        shapes = self.add(np.concatenate([np.empty(0, dtype=object), *arrays.values()]))
        first = dict(zip(arrays, np.cumsum([0, *map(len, arrays.values())]).tolist(), strict=False))
        return [shapes.taken(first[id(p.shapes)] + p.which).moved(p.shift) for p in parts]

    def set_down(self, results: Geometries, row: Index, shift: Steps) -> SetDown:
        """Set down the polygons of result ``row[i]`` at ``shift[i]`` for every i."""
        pieces, of = polygons_of(results, np.arange(len(results)))
        order = np.argsort(of, kind="stable")
        pieces, of = pieces[order], of[order]
        ends = np.searchsorted(of, np.arange(len(results) + 1))
        which, starts = runs(ends, row)
        each = np.repeat(np.arange(len(row)), np.diff(starts))
        return SetDown(self.add(pieces).taken(which).moved(shift[each]), each, which)

    def mapped(self, copies: Copies, make: Callable[[Geometries], Geometries]) -> SetDown:
        """Make something else of each shape, and set it down for each copy."""
        shapes, row = self.used(copies)
        return self.set_down(make(shapes), row, copies.shift)

    def used(self, copies: Copies) -> tuple[Geometries, Index]:
        """Return the shapes that copies are of, and for each copy which of those it is of."""
        there = np.zeros(len(self.shapes), bool)
        there[copies.kind] = True
        return self.shapes[there], (np.cumsum(there) - 1)[copies.kind]

    def bounds(self, copies: Copies) -> Steps:
        """Return left, lower, right and upper edge of each copy, shape (n, 4)."""
        return self._bounds[copies.kind] + np.tile(copies.shift, 2)

    def geometries(self, copies: Copies) -> Geometries:
        """Return the copies as polygons."""
        return translate(self.shapes[copies.kind], copies.shift)

    def in_mm(self, copies: Copies) -> Geometries:
        """Return the copies as polygons in mm, outer rings anticlockwise and holes clockwise."""
        if not len(copies):
            return np.empty(0, dtype=object)
        if not self.remembers or len(copies) > FEW_COPIES:
            return self._in_mm(copies)
        known = self.asked("in mm", copies)
        fresh = known.fresh()
        if fresh:
            made = self._in_mm(copies.taken(np.array(fresh)))
            known.keep(fresh, made.tolist(), shapely.get_num_coordinates(made).tolist())
        return as_array(known.answers())

    def asked(self, how: Hashable, copies: Copies) -> Asked[Any]:
        """Return what is known of something that is made of each of some copies, if the stock remembers."""
        shapes = self.shapes[copies.kind]
        return Asked(how, np.column_stack([identities(shapes), copies.shift]), (shapes,))

    def _in_mm(self, copies: Copies) -> Geometries:
        shapes, row = self.used(copies)
        flat = Ragged.of(oriented(shapes))
        assert flat.polygons is not None
        which, ends = runs(flat.polygons, row)
        members, starts = runs(flat.rings, which)
        points = flat.points[members]
        sizes = np.diff(starts[ends])
        for axis in (0, 1):
            points[:, axis] += np.repeat(copies.shift[:, axis], sizes)
        points /= STEPS_PER_MM
        made = shapely.from_ragged_array(shapely.GeometryType.POLYGON, points, (starts, ends))
        return np.asarray(made, dtype=object)

    def near(self, a: Copies, b: Copies) -> tuple[Index, Index]:
        """Return the pairs, one of ``a`` and one of ``b``, whose bounds meet.

        Raises:
            TooLargeError: where there are too many.
        """
        if not len(a) or not len(b):
            return np.empty(0, np.intp), np.empty(0, np.intp)
        if len(a) * len(b) <= FEW_PAIRS:
            mine, other = _meeting_bounds(self.bounds(a), self.bounds(b))
            work.spend_on_pairs(len(mine))
            return mine, other
        tree, asked = shapely.STRtree(_diagonals(self.bounds(b))), _diagonals(self.bounds(a))
        work.refuse_pairs(tree, asked)
        mine, other = tree.query(asked)
        work.spend_on_pairs(len(mine))
        return mine, other

    def holds(self, predicate: Predicate, a: Copies, b: Copies) -> NDArray[np.bool_]:
        """Return whether a predicate holds of a[i] and b[i]: asked once for each configuration.

        Raises:
            TooLargeError: where there are too many to ask.
        """
        heads, number = alike(np.column_stack([a.kind, b.kind, b.shift - a.shift]))
        if predicate is shapely.intersects:
            work.spend_on_asking(self.shapes, b.kind[heads])
        else:
            kinds = np.concatenate([a.kind[heads], b.kind[heads]])
            work.spend_on_asking(self.shapes, kinds, work.PER_RELATED_VERTEX)
        a, b = a.taken(heads), b.taken(heads)
        if not self.remembers:
            return self._ask(predicate, a, b)[number]
        one, other = self.shapes[a.kind], self.shapes[b.kind]
        rows = np.column_stack([identities(one), identities(other), a.shift, b.shift])
        asked = Asked[bool](predicate, rows, (one, other))

        def ask(rows: list[int]) -> list[bool]:
            fresh = np.array(rows)
            found: list[bool] = self._ask(predicate, a.taken(fresh), b.taken(fresh)).tolist()
            return found

        return np.array(asked.answers(ask), bool)[number]

    def _ask(self, predicate: Predicate, a: Copies, b: Copies) -> NDArray[np.bool_]:
        first, second = self._each(a), self._each(b)
        shapely.prepare(first)
        return np.asarray(predicate(first, second))

    def _each(self, copies: Copies) -> Geometries:
        """Return copies as polygons, those that are the same copy as one and the same."""
        heads, number = alike(np.column_stack([copies.kind, copies.shift]))
        return self.geometries(copies.taken(heads))[number]


ToldApart: TypeAlias = tuple[Index, Index, Steps]
"""Polygons that equal none before them, which of those each is, and by how much it lies elsewhere."""


def _told_apart(areas: Geometries) -> ToldApart:
    heads, number, corner = different(of_polygons(areas))
    away = corner - corner[heads][number]
    for each in (heads, number, away):
        each.flags.writeable = False
    return heads, number, away


def _meeting_bounds(a: Steps, b: Steps) -> tuple[Index, Index]:
    """Return the pairs of bounds, one of each, that have a point in common."""
    # Column by column, each in one piece and of short numbers: NumPy is several times as fast along them.
    short = max(np.abs(a).max(initial=0), np.abs(b).max(initial=0)) < SHORT
    kind = np.int32 if short else np.int64
    (ax, ay, ar, at), (bx, by, br, bt) = (np.ascontiguousarray(each.T, kind) for each in (a, b))
    met = ax[:, None] <= br
    for mine, other in ((ar, bx), (at, by)):
        met &= mine[:, None] >= other
    met &= ay[:, None] <= bt
    mine, other = np.divmod(np.flatnonzero(met), len(b))
    return mine, other


def _diagonals(bounds: Steps) -> Geometries:
    """Return lines that have given bounds: sooner made than boxes."""
    return np.asarray(shapely.linestrings(bounds.reshape(-1, 2, 2).astype(np.float64)), dtype=object)


def _without_repeats(steps: Outlines) -> tuple[Outlines, NDArray[np.bool_]]:
    """Drop points that repeat the one before; return also which marks have a ring that vanished thereby."""
    again = np.zeros(len(steps.points), bool)
    again[1:] = same_points(steps.points[1:], steps.points[:-1])
    again[steps.rings[:-1]] = same_points(steps.points[steps.rings[:-1]], steps.points[steps.rings[1:] - 1])
    left = np.add.reduceat(~again, steps.rings[:-1])
    thin = np.repeat(left < 3, np.diff(steps.rings))
    torn = np.logical_or.reduceat(left < 3, steps.marks[:-1])
    again &= ~thin
    if not again.any():
        return steps, torn
    rings = steps.rings - np.concatenate([[0], np.cumsum(again)])[steps.rings]
    return Outlines(steps.points[~again], rings, steps.marks, steps.closed), torn
