"""Copies of marks, set down in bulk: congruent ones are made once and, where they can be, exact on the grid.

The map of a copy is taken apart into a linear map that is done once for all copies of one size and shape, and
an isometry that carries what it makes to its place. Copies whose isometries differ by a translation, or by a
quarter turn or a mirror along an axis as well, are rounded to the grid once and then carried by whole steps:
they are images of one another to the bit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.coincidence import edges
from batik_vector.geometry.congruence import alike
from batik_vector.geometry.maps.affine import SIMILAR, Affine
from batik_vector.geometry.maps.affines import ONE, Affines
from batik_vector.geometry.ragged import Ragged
from batik_vector.geometry.sampling import Array, Geometries, Indices, Points
from batik_vector.tiling.torus.torus import polygons_of, to_step_grid
from batik_vector.tiling.welding.congruent import Repeated
from batik_vector.units import GRID_MM, STEPS_PER_MM, nearest_steps
from batik_vector.values import frozen

NEAR = 1e-6
"""In grid steps: how far floats may put what lies on one place."""

MEETING = 2.5 * GRID_MM
"""How near edges in mm lie that are one edge: each may be moved by a step."""

MOST_NEIGHBOURS = 24
"""Ways to lie beside one another that are looked at before copies are taken to meet."""


KEPT_SPREADS, KEPT_MAPS = 32, 2_000
"""How many sets of copies are remembered, sorted, and how many copies they may be of."""


class Landed(NamedTuple):
    """Copies on the grid, in any order: ``copy`` and ``mark`` as of :class:`Images`."""

    areas: Repeated
    copy: Indices
    mark: Indices


class Images(NamedTuple):
    """Copies of marks, in any order: ``copy`` says which copy each is of, and ``mark`` of which mark."""

    geometries: Geometries
    copy: Indices
    mark: Indices


@frozen(eq=False)
class Group:
    """Copies of one shape on the grid.

    Attributes:
        turn: isometry of mm that is done before the shape is rounded.
        carriers: in whole grid steps: a symmetry of the grid, and a translation.
        numbers: which copies these are.
    """

    turn: Affine
    carriers: Affines
    numbers: Indices

    def landed(self, areas: Geometries) -> Landed:
        """Return the copies of polygons (mm) as such: the polygons are brought to the grid once."""
        outlines, points, mark = self._on_grid(areas)
        heads, turn = alike(self.carriers.linear.astype(np.int64))
        turned = self.carriers.taken(heads)
        places = Affines.of([each.linear for each in turned]).at(points) + 0.0
        shapes = outlines.images(places, turned.determinants < 0)
        which = (turn[:, None] * len(mark) + np.arange(len(mark))).ravel()
        shift = np.repeat(self.carriers.shifts.astype(np.int64), len(mark), axis=0)
        return Landed(
            Repeated(shapes, which, shift),
            np.repeat(self.numbers, len(mark)),
            np.tile(mark, len(self.numbers)),
        )

    def images(self, marks: Geometries) -> Images:
        """Return the copies of marks in mm, each coordinate the float k / 1000."""
        outlines, points, mark = self._on_grid(marks)
        # + 0.0, lest a turn leave a zero with a sign.
        places = (self.carriers.at(points) + 0.0) / STEPS_PER_MM
        return _numbered(outlines.images(places, self.carriers.determinants < 0), self.numbers, mark)

    def _on_grid(self, marks: Geometries) -> tuple[Ragged, Array, Indices]:
        """Return marks turned and rounded: as arrays, with their points, and which mark each is of."""
        mark = np.arange(len(marks))
        if areal := shapely.get_dimensions(marks[0]) == 2:
            marks, mark = polygons_of(marks, mark)
        outlines = Ragged.of(marks)
        points = nearest_steps(Affines.of([self.turn]).at(outlines.points))
        shapes = outlines.images(points, np.array([self.turn.determinant < 0]))
        if areal and not shapely.is_valid(shapes).all():
            shapes, mark = polygons_of(to_step_grid(self.turn.apply(marks)), mark)
        outlines = Ragged.of(shapes)
        return outlines, outlines.points, mark


@frozen(eq=False)
class Spread:
    """Copies that are congruent.

    Attributes:
        first: brings the motif to its size, in mm. Several maps make all copies at once, as they are.
        carriers: isometries of mm that set down what ``first`` makes.
        numbers: which copies these are.
        groups: the same copies on the grid; none where hardly two of them are alike.
    """

    first: Affines
    carriers: Affines
    numbers: Indices
    groups: tuple[Group, ...] = ()

    @property
    def is_done(self) -> bool:
        """Whether ``first`` has brought everything to its place."""
        return self.carriers is ONE

    def landed(self, areas: Geometries) -> Landed | None:
        """Return the copies of polygons that ``first`` has brought to their size; None without groups."""
        return landed([group.landed(areas) for group in self.groups]) if self.groups else None

    def images(self, marks: Geometries) -> Images:
        """Return the copies of marks, polygons or lines, which ``first`` has brought to their size."""
        if self.groups and len(marks):
            return joined([group.images(marks) for group in self.groups])
        return _numbered(self.carriers.apply(marks), self.numbers, np.arange(len(marks)))


_known: dict[tuple[Affines, bool], list[Spread]] = {}
"""Who turns one knob seldom moves the copies. What hangs on their marks is not here."""


def _numbered(geometries: Geometries, numbers: Indices, mark: Indices) -> Images:
    return Images(geometries, np.repeat(numbers, len(mark)), np.tile(mark, len(numbers)))


def landed(parts: Sequence[Landed]) -> Landed:
    """Return several sets of copies as one."""
    if len(parts) == 1:
        return parts[0]
    first = np.cumsum([0, *(len(part.areas.shapes) for part in parts[:-1])])
    return Landed(
        Repeated(
            np.concatenate([part.areas.shapes for part in parts]),
            np.concatenate([part.areas.which + at for part, at in zip(parts, first, strict=True)]),
            np.concatenate([part.areas.shift for part in parts]),
        ),
        np.concatenate([part.copy for part in parts]),
        np.concatenate([part.mark for part in parts]),
    )


def joined(parts: Sequence[Images]) -> Images:
    """Return several sets of images as one."""
    if len(parts) == 1:
        return parts[0]
    return Images(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))


def spreads(maps: Affines, marks: Callable[[], Sequence[Geometries]] | None = None) -> list[Spread]:
    """Sort copies by their size and shape.

    Args:
        maps: from motif units to mm on cloth.
        marks: returns the marks of the motif, where copies may be moved by part of a grid step to lie on
            whole ones. That is not done where they meet along edges, which it would open.

    Returns:
        Every copy in one of them. Where most differ in size or shape, one that holds all as they are.
    """
    if len(maps) > KEPT_MAPS:
        return _spreads(maps, marks)
    key = maps, marks is not None
    found = _known.get(key)
    if found is None:
        asked = False

        def looked_at() -> Sequence[Geometries]:
            nonlocal asked
            asked = True
            return [] if marks is None else marks()

        found = _spreads(maps, None if marks is None else looked_at)
        if not asked:
            _known[key] = found
            while len(_known) > KEPT_SPREADS:
                _known.pop(next(iter(_known)), None)
    return found


def _spreads(maps: Affines, marks: Callable[[], Sequence[Geometries]] | None) -> list[Spread]:
    """Do the work of :func:`spreads`."""
    size = np.zeros(len(maps), np.intp) if maps.are_translates else alike(_gram(maps))[1]
    count = int(size.max()) + 1
    if len(maps) == 1 or 2 * count > len(maps):
        return [Spread(maps, ONE, np.zeros(1, np.intp))]
    found = []
    for label in range(count):
        numbers = np.flatnonzero(size == label)
        own = maps.taken(numbers)
        carriers, first = _isometries(own), Affines.of([own[0].linear])
        # Of several sizes none is moved: those of one might meet those of another.
        moved = _moved(carriers, own[0].linear, marks) if marks is not None and count == 1 else carriers
        groups = _groups(moved, numbers)
        found.append(Spread(first, moved if groups else carriers, numbers, groups))
    return found


def _moved(carriers: Affines, first: Affine, marks: Callable[[], Sequence[Geometries]]) -> Affines:
    """Return copies moved onto whole grid steps, where that makes more of them alike."""
    phase = _phase(carriers)
    if (np.abs(phase - phase[0]) < 2 * NEAR).all():
        # All by as much: they lie to one another as before.
        move = -phase[:1] + (phase[:1] > 0.5)
        return carriers if carriers.are_translates or not move.any() else carriers.moved(move / STEPS_PER_MM)
    if _meet(np.concatenate([first.apply(part) for part in marks()]), carriers):
        return carriers
    steps = carriers.shifts * STEPS_PER_MM
    return carriers.moved((np.rint(steps) - steps) / STEPS_PER_MM)


def _isometries(maps: Affines) -> Affines:
    """Return what follows the linear part of the first of congruent maps to make each; exact on the grid."""
    if maps.are_translates:
        return Affines.translations(maps.shifts)
    turns = maps @ maps[0].linear.inverse()
    whole = np.rint(turns.linear)
    near = np.asarray((np.abs(turns.linear - whole) < SIMILAR).all(axis=1))
    return Affines(np.hstack([np.where(near[:, None], whole, turns.linear), maps.shifts]))


def _phase(carriers: Affines) -> Array:
    """Return by how much of a grid step each copy lies off a whole one, shape (n, 2)."""
    steps = carriers.shifts * STEPS_PER_MM
    phase = steps - np.floor(steps + NEAR)
    return np.where(np.abs(phase) < 2 * NEAR, 0.0, phase)


def _kinds(carriers: Affines, phase: Array) -> Indices:
    """Return a number for each copy, the same for those that the grid rounds alike.

    Those are translates by whole steps and, of copies on whole steps, images under its symmetries as well.
    """
    if carriers.are_translates and (np.abs(phase - phase[0]) < 2 * NEAR).all():
        return np.zeros(len(carriers), np.intp)
    a, _, c, _ = carriers.linear.T
    mirrored = carriers.determinants < 0
    z = a + 1j * c
    on_steps = ~phase.any(axis=1)
    # Quarter turns leave the fourth power alone, and the mirrors of the grid make it its conjugate.
    z = np.where(on_steps, np.where(mirrored, z.conj(), z) ** 4, z)
    rows = [_cells(part, 100 * SIMILAR) for part in (z.real, z.imag)]
    rows += [_cells(part, NEAR) for part in phase.T]
    return alike(np.column_stack([*rows, on_steps, mirrored & ~on_steps]))[1]


def _groups(carriers: Affines, numbers: Indices) -> tuple[Group, ...]:
    """Return copies on the grid, as they lie; none where most are different."""
    phase = _phase(carriers)
    kind = _kinds(carriers, phase)
    count = int(kind.max()) + 1
    if 2 * count > len(kind):
        return ()
    found = []
    for label in range(count):
        own = np.flatnonzero(kind == label)
        off = phase[own[0]]
        turn = carriers[int(own[0])].linear
        whole = np.rint((carriers.taken(own) @ turn.inverse()).linear)
        steps = np.rint(carriers.shifts[own] * STEPS_PER_MM - off)
        turn = Affine.translation(off / STEPS_PER_MM) @ turn
        found.append(Group(turn, Affines(np.hstack([whole, steps])), numbers[own]))
    return tuple(found)


def _meet(marks: Geometries, carriers: Affines) -> bool:
    """Whether copies of marks (mm) may meet along edges, or where lines end.

    Every way in which two neighbours lie to one another is looked at once.
    """
    points = shapely.get_coordinates(marks)
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    reach = 2 * float(np.hypot(*(points - centre).T).max()) + MEETING
    places = np.asarray(shapely.points(carriers.at(centre[None])[:, 0]), dtype=object)
    one, other = shapely.STRtree(places).query(places, predicate="dwithin", distance=reach)
    pairs = one < other
    one, other = one[pairs], other[pairs]
    if not len(one):
        return False
    apart = _cells(carriers.shifts[other] - carriers.shifts[one], MEETING)
    turns = _cells(carriers.linear, 100 * SIMILAR)
    rows = np.hstack([turns[one], turns[other], apart])
    first, _ = alike(rows)
    return len(first) > MOST_NEIGHBOURS or any(
        _share_an_edge(*(carriers.taken(i).apply(marks) for i in (one[k : k + 1], other[k : k + 1])))
        for k in first.tolist()
    )


def _share_an_edge(one: Geometries, other: Geometries) -> bool:
    """Whether edges of two drawings run along one another, or a line of one ends on the other."""
    found = []
    for mine, its in ((one, other), (other, one)):
        tree = shapely.STRtree(edges(its))
        ends = shapely.get_parts(shapely.boundary(mine[shapely.get_dimensions(mine) == 1]))
        if len(tree.query(ends, predicate="dwithin", distance=MEETING)[0]):
            return True
        vertices = shapely.get_coordinates(mine)
        found.append(vertices[tree.query(shapely.points(vertices), predicate="dwithin", distance=MEETING)[0]])
    # Edges that run along one another do so between two vertices; those that cross may do so near one.
    there: Points = np.concatenate(found)
    return bool(len(there)) and float(np.ptp(there, axis=0).max()) > 8 * MEETING


def _gram(maps: Affines) -> NDArray[np.int64]:
    """Return numbers that are equal where two linear maps differ by an isometry that follows them."""
    a, b, c, d = maps.linear.T
    gram = np.column_stack([a * a + c * c, a * b + c * d, b * b + d * d])
    return _cells(gram, 10 * SIMILAR * float(np.abs(gram).max()))


def _cells(values: Array, size: float) -> NDArray[np.int64]:
    """Return in which cell of a size each value lies; 0, halves and thirds lie off the edges of cells."""
    return np.floor(values / size + 0.382).astype(np.int64)
