"""Marks scattered on the torus: their outlines, their images, and the gaps between them.

Everything here is in **grid steps**, as in :mod:`batik_vector.tiling.torus.torus`, but places need not be
whole; they are complex numbers x + iy. Two marks are first compared by the circle round each and by discs
within it; outlines are measured only where these leave it open.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.nearness import boxes, nearer
from batik_vector.geometry.sampling import Array, Indices
from batik_vector.tiling.torus.torus import Lattice, Window, translate, wrapping
from batik_vector.tiling.tossing.marks import Complexes, Field, Flags, Kit, Poses


class Torus:
    """The repeat as a torus, with the symmetry under which every mark is drawn."""

    def __init__(
        self, lattice: Lattice, operations: tuple[Affine, ...] = (Affine(),), stretch: Array | None = None
    ) -> None:
        """Take the repeat.

        Args:
            lattice: the two translations.
            operations: the maps that multiply a mark, the identity first; in grid steps.
            stretch: linear map, shape (2, 2), done to a mark after it is turned, where the cloth is
                stretched to fit a machine.
        """
        self.lattice, self.operations, self.stretch = lattice, operations, stretch
        (ax, ay), (bx, by) = lattice
        self.window = Window(0, 0, ax, by)
        """The rectangle that holds every place once."""
        self.area = float(ax * by - ay * bx)
        self.growth = 1.0 if stretch is None else float(np.linalg.norm(stretch, 2))
        """By how much the stretch and the operations may lengthen a mark."""
        self.growth *= max(operation.stretch for operation in operations)

    @property
    def shortest(self) -> float:
        """Length of the shortest way round the torus, by Gauss' reduction of the lattice."""
        a, b = (complex(*vector) for vector in self.lattice)
        while True:
            if abs(a) > abs(b):
                a, b = b, a
            times = round((b * a.conjugate()).real / abs(a) ** 2)
            if not times:
                return abs(a)
            b -= times * a

    def within(self, place: Complexes) -> Complexes:
        """Return places moved into the window by whole periods, on whole steps.

        Whole steps, so that no last bit of a sine decides on another machine what fits.
        """
        place = np.rint(place.real) + 1j * np.rint(place.imag)
        (ax, ay), (bx, by) = self.lattice
        if bx == 0:
            place = place - np.floor(place.real / ax) * complex(ax, ay)
            return np.asarray(place - 1j * by * np.floor(place.imag / by))
        place = place - np.floor(place.imag / by) * complex(bx, by)
        return np.asarray(place - ax * np.floor(place.real / ax))

    def images(self, field: Field, reach: float) -> Field:
        """Return all images of marks that come within ``reach`` of the window, each with its mark's owner."""
        if not len(field):
            return field
        return self.wrapped(Field.joined([field.moved(operation) for operation in self.operations]), reach)

    def wrapped(self, field: Field, reach: float) -> Field:
        """Return all translates of marks that come within ``reach`` of the window."""
        if not len(field):
            return field
        field = field.take(~shapely.is_empty(field.shapes))
        index, shift = wrapping(field.shapes, self.lattice, self.window, reach)
        near = field.take(index)
        return near.shifted(shift, translate(near.shapes, shift))


class Scatter:
    """Marks on a torus, kept clear of one another and of what lies there already."""

    def __init__(self, torus: Torus, kit: Kit, largest: float, taken: Field) -> None:
        """Begin with an empty torus.

        Args:
            torus: where they lie.
            kit: what they are.
            largest: factor from the kit's size to the largest that occurs.
            taken: what they keep clear of: all of it but translates.
        """
        self.torus, self.kit = torus, kit
        self.taken = taken.nobody()
        self.poses = Poses.none()
        self.field = Field.of(np.empty(0, dtype=object))
        """The marks, one of each, owned by themselves in their order."""
        self.largest = float(kit.reach.max()) * largest * torus.growth
        self.there = self.field
        """All that lies near the window: every image of every mark, and what was taken, owned by -1."""
        self._tree = shapely.STRtree(self.there.shapes)

    def __len__(self) -> int:
        return len(self.poses)

    def marks(self, poses: Poses) -> Field:
        """Return marks as they lie on the cloth, owned by their numbers."""
        return self.kit.marks(poses, self.torus.stretch)

    def set(self, poses: Poses, field: Field, reach: float) -> None:
        """Let these be the marks that lie on the torus; gaps up to ``reach`` will be asked for."""
        self.poses, self.field = poses, field
        images = self.torus.images(field.owned(np.arange(len(field))), self.largest + reach)
        self.there = Field.joined([images, self.torus.wrapped(self.taken, self.largest + reach)])
        self._tree = shapely.STRtree(self.there.shapes)

    def add(self, poses: Poses, marks: Field, reach: float) -> None:
        """Let further marks lie on the torus; ``reach`` is that of the last :meth:`set`."""
        self.poses = self.poses.joined(poses)
        more = marks.owned(len(self.field) + np.arange(len(marks)))
        self.field = Field.joined([self.field, more])
        self.there = Field.joined([self.there, self.torus.images(more, self.largest + reach)])
        self._tree = shapely.STRtree(self.there.shapes)

    def gaps(self, marks: Field, reach: float, own: Indices) -> tuple[Indices, Array, Indices]:
        """Return the gaps between marks and what lies within ``reach`` of them.

        Args:
            marks: to be, in the window.
            reach: longer gaps are left out; at most that of :meth:`set`.
            own: for each the mark it stands for, whose present place does not count.

        Returns:
            Which of the marks, how far (0 where they overlap), and the number of the mark that is there; -1
            for what was taken. The images of a mark under the symmetry come with its own number.
        """
        i, j = self._others(boxes(marks.shapes, reach), marks, reach, own)
        gap = shapely.distance(marks.shapes[i], self.there.shapes[j])
        return self._with_own(marks, reach, own, (i, gap, j))

    def rough_gaps(self, poses: Poses, reach: float, own: Indices) -> tuple[Indices, Array, Indices]:
        """Return gaps as :meth:`gaps` does, from disc to disc within marks: sooner, and a little too far."""
        marks = self.kit.undrawn(poses, self.torus.stretch)
        i, j = self._others(_round(marks, reach), marks, reach, own)
        known = np.isfinite(self.there.radii[j, 0])
        if self._images_meet(reach) or not known.all():
            marks = self.marks(poses)
        gap = np.empty(len(i))
        gap[known] = np.maximum(marks.discs_apart(i[known], self.there, j[known]), 0)
        gap[~known] = shapely.distance(marks.shapes[i[~known]], self.there.shapes[j[~known]])
        return self._with_own(marks, reach, own, (i, gap, j))

    def _others(self, boxes: Geometries, marks: Field, reach: float, own: Indices) -> tuple[Indices, Indices]:
        """Return which of some marks have which others there within reach, as their circles tell."""
        i, j = self._tree.query(boxes)
        other = self.there.owners[j] != own[i]
        i, j = i[other], j[other]
        near = marks.apart(i, self.there, j) <= reach
        return i[near], j[near]

    def _with_own(
        self, marks: Field, reach: float, own: Indices, others: tuple[Indices, Array, Indices]
    ) -> tuple[Indices, Array, Indices]:
        """Return gaps to others, and those of each mark to its own images, as :meth:`gaps` does."""
        i, gap, j = others
        mine, images = self.own_images(marks, reach)
        gap = np.concatenate([gap, shapely.distance(marks.shapes[mine], images)])
        which = np.concatenate([i, mine])
        near = gap <= reach
        return which[near], gap[near], np.concatenate([self.there.owners[j], own[mine]])[near]

    def fitting(self, poses: Poses, distance: float, kin: float) -> tuple[Indices, Field]:
        """Return which poses keep clear of everything, and the marks so: see :meth:`clear`.

        Most that do not are told by their discs, and their outlines are never drawn.
        """
        undrawn = self.kit.undrawn(poses, self.torus.stretch)
        i, j = self._tree.query(_round(undrawn, kin))
        free = np.flatnonzero(self._by_discs(undrawn, i, j, distance, kin)[0])
        marks = self.marks(poses.take(free))
        clear = self.clear(marks, distance, kin)
        return free[clear], marks.take(clear)

    def clear(self, marks: Field, distance: float, kin: float) -> Flags:
        """Return which marks keep clear of everything, their own images included.

        Args:
            marks: to be.
            distance: to be kept from all.
            kin: to be kept from marks of the same motif; no less than ``distance``.
        """
        i, j = self._tree.query(boxes(marks.shapes, kin))
        free, i, j, least = self._by_discs(marks, i, j, distance, kin)
        # What is there is asked of again and again.
        free[i[nearer(self.there.shapes[j], marks.shapes[i], least)]] = False
        mine, images = self.own_images(marks, kin)
        free[mine[nearer(marks.shapes[mine], images, kin)]] = False
        return free

    def _by_discs(
        self, marks: Field, i: Indices, j: Indices, distance: float, kin: float
    ) -> tuple[Flags, Indices, Indices, Array]:
        """Return which marks are clear as far as their discs tell, and the pairs that these leave open.

        Pairs come with the distance that they are to keep.
        """
        free = np.ones(len(marks), bool)
        least = np.where(marks.kinds[i] == self.there.kinds[j], kin, distance)
        open_ = marks.apart(i, self.there, j) <= least
        # The largest discs alone rule out most.
        for apart in (marks.hearts_apart, marks.discs_apart):
            i, j, least = i[open_], j[open_], least[open_]
            free[i[apart(i, self.there, j) < least]] = False
            open_ = free[i]
        return free, i[open_], j[open_], least[open_]

    def own_images(self, marks: Field, reach: float) -> tuple[Indices, Geometries]:
        """Return the images of each mark, itself left out, whose boxes come within reach of it."""
        if not self._images_meet(reach):
            return np.empty(0, np.intp), np.empty(0, dtype=object)
        images = self.torus.images(marks.owned(np.arange(len(marks))), self.largest + reach)
        there, here = shapely.bounds(images.shapes), shapely.bounds(marks.shapes)[images.owners]
        near = (
            (there[:, :2] <= here[:, 2:] + reach).all(axis=1)
            & (there[:, 2:] >= here[:, :2] - reach).all(axis=1)
            & (there != here).any(axis=1)
        )
        return images.owners[near], images.shapes[near]

    def _images_meet(self, reach: float) -> bool:
        """Return whether any mark may come within reach of its own images."""
        return len(self.torus.operations) > 1 or 2 * self.largest + reach >= self.torus.shortest

    def compatible(self, marks: Field, distance: float, kin: float) -> Indices:
        """Return which marks can all be set down, each going before those that come after it."""
        count = len(marks)
        images = self.torus.images(marks.owned(np.arange(count)), self.largest + kin)
        i, j = shapely.STRtree(images.shapes).query(boxes(marks.shapes, kin))
        least = np.where(marks.kinds[i] == images.kinds[j], kin, distance)
        near = (images.owners[j] != i) & (marks.apart(i, images, j) <= least)
        i, j, least = i[near], j[near], least[near]
        hit = marks.discs_apart(i, images, j) < least
        hit[~hit] = nearer(marks.shapes[i[~hit]], images.shapes[j[~hit]], least[~hit])
        a, b = i[hit], images.owners[j[hit]]
        taken, out = np.zeros(count, bool), np.zeros(count, bool)
        while not (taken | out).all():
            open_ = ~(taken | out)
            live = open_[a] & open_[b]
            a, b = a[live], b[live]
            earliest = np.full(count, count)
            np.minimum.at(earliest, a, b)
            np.minimum.at(earliest, b, a)
            taken |= open_ & (np.arange(count) < earliest)
            out[b[taken[a]]] = True
            out[a[taken[b]]] = True
        return np.flatnonzero(taken)


def _round(marks: Field, reach: float) -> Geometries:
    """Return lines across the squares round the circles of marks, and further by reach: a tree sees those."""
    by = (1 + 1j) * (marks.reach + reach)
    ends = np.column_stack([marks.middles - by, marks.middles + by])
    return np.asarray(shapely.linestrings(np.stack([ends.real, ends.imag], axis=-1)), dtype=object)


def in_steps(operations: Sequence[Affine], per_mm: float) -> tuple[Affine, ...]:
    """Return maps of millimetres as maps of grid steps."""
    return tuple(Affine(m.a, m.b, m.c, m.d, m.e * per_mm, m.f * per_mm) for m in operations)
