"""What is bare of each sort of copies: worked out for one of it, among its neighbours."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import shapely

from batik_vector.geometry.congruence import alike, distinct
from batik_vector.geometry.nets.bare import Stretches, bare
from batik_vector.geometry.nets.components import components
from batik_vector.geometry.nets.meetings import Events, Rings, meetings
from batik_vector.geometry.outlines import Index, Offsets, Outlines, Steps, runs
from batik_vector.geometry.sampling import Geometries
from batik_vector.values import frozen


@frozen(eq=False)
class Copies:
    """Areas as copies: copy i is mark ``kind[i]`` of ``shapes``, moved by ``shift[i]``. None is there twice.

    ``areas`` are the shapes as polygons. ``own`` and ``other`` are pairs whose bounds meet, each both ways:
    those of copy i, from ``starts[i]`` to ``starts[i + 1]``, in an order that hangs on how they lie to it
    alone."""

    shapes: Outlines
    areas: Geometries
    kind: Index
    shift: Steps
    own: Index
    other: Index
    starts: Offsets

    @classmethod
    def of(cls, shapes: Outlines, areas: Geometries, kind: Index, shift: Steps, pairs: Index) -> Copies:
        """Sort pairs, shape (k, 2), each given once."""
        own, other = np.concatenate([pairs, pairs[:, ::-1]]).T
        if len(distinct(kind)) == len(kind):
            # Nothing is like anything else, and any order will do.
            order = np.argsort(own * len(kind) + other)
        else:
            away = shift[other] - shift[own]
            order = np.lexsort([away[:, 1], away[:, 0], kind[other], own])
        starts = np.searchsorted(own[order], np.arange(len(kind) + 1))
        return cls(shapes, areas, kind, shift, own[order], other[order], starts)

    def __len__(self) -> int:
        return len(self.kind)

    def sorts(self) -> tuple[Index, Index]:
        """Return one copy for each different surroundings, and for each copy which of those it is like."""
        if len(distinct(self.kind)) == len(self):
            return np.arange(len(self)), np.arange(len(self))
        rows = np.column_stack([self.kind[self.other], self.shift[self.other] - self.shift[self.own]])
        itself = np.column_stack([self.kind, np.zeros((len(self), 2), np.int64)])
        rows = np.insert(rows, self.starts[:-1], itself, axis=0)
        return alike(rows, self.starts + np.arange(len(self) + 1))


class Solved(NamedTuple):
    """What is bare of each sort of copies: stretches, relative to the copy; and to which neighbours it is
    tied.

    Those of sort i are ``members[ends[i]:ends[i + 1]]``, and its neighbours ``slots[slot_ends[i]:slot_ends[i
    + 1]]`` in the list of its pairs."""

    stretches: Stretches
    members: Index
    ends: Offsets
    slots: Index
    slot_ends: Offsets

    def more(self, late: Solved) -> Solved:
        """Return these sorts, and others behind them."""
        one, other = self.stretches, late.stretches
        stretches = Stretches(
            np.concatenate([one.points, other.points]),
            np.concatenate([one.offsets, one.offsets[-1] + other.offsets[1:]]),
            np.concatenate([one.end, other.end]),
            np.concatenate([one.whole, other.whole]),
            np.concatenate([one.doubtful, other.doubtful]),
        )
        return Solved(
            stretches,
            np.concatenate([self.members, late.members + len(one.whole)]),
            np.concatenate([self.ends, self.ends[-1] + late.ends[1:]]),
            np.concatenate([self.slots, late.slots]),
            np.concatenate([self.slot_ends, self.slot_ends[-1] + late.slot_ends[1:]]),
        )


def solved(copies: Copies, sorts: Index) -> Solved | None:
    """Work out what is bare of some copies; None where they meet too often."""
    number = np.full(len(copies), -1)
    number[sorts] = np.arange(len(sorts))
    there = number >= 0
    mine = np.flatnonzero(there[copies.own])
    there[copies.other[mine]] = True
    some = np.flatnonzero(there)
    place = np.cumsum(there) - 1
    kind, shift = copies.kind[some], copies.shift[some]
    rings = Rings.of(copies.shapes.taken(kind, shift))
    rank = np.empty(len(some), np.intp)
    rank[np.lexsort([kind, shift[:, 1], shift[:, 0]])] = np.arange(len(some))
    met = meetings(rings, rank)
    if met is None:
        return None
    own, other = place[copies.own[mine]], place[copies.other[mine]]
    held = _held(rings, met.events, own, other, copies.areas[kind], shift)
    outcome = bare(rings, met, number[some] >= 0, held)
    if outcome is None:
        return None
    found, whose, tied = outcome
    owner = some[whose]
    members, ends = _grouped(number[owner], len(sorts))
    moved = found.points - np.repeat(copies.shift[owner], np.diff(found.offsets), axis=0)
    stretches = Stretches(moved, found.offsets, found.end - copies.shift[owner], found.whole, found.doubtful)
    return Solved(stretches, members, ends, *_slots(copies, some[tied], number, len(sorts)))


def _slots(copies: Copies, tied: Index, number: Index, count: int) -> tuple[Index, Offsets]:
    """Return which of its neighbours each sort of copies is tied to, given pairs of copies."""
    tied = tied[number[tied[:, 0]] >= 0]
    keys = copies.own * len(copies) + copies.other
    order = np.argsort(keys)
    at = np.searchsorted(keys, tied[:, 0] * len(copies) + tied[:, 1], sorter=order)
    members, ends = _grouped(number[tied[:, 0]], count)
    return (order[at] - copies.starts[tied[:, 0]])[members], ends


def _grouped(of: Index, count: int) -> tuple[Index, Offsets]:
    """Return items by what they are of, from 0 to ``count``, and where those of each begin."""
    order = np.argsort(of, kind="stable")
    return order, np.searchsorted(of[order], np.arange(count + 1))


def _held(rings: Rings, events: Events, own: Index, other: Index, areas: Geometries, shift: Steps) -> Index:
    """Return which rings lie in areas that they do not meet: rows of a ring, and whose area it is.

    Args:
        rings, events: and where they meet.
        own, other: pairs of owners whose bounds meet, each both ways.
        areas, shift: the area of each owner, and how far it is to be moved.
    """
    marks, first = rings.outlines.marks, rings.outlines.rings[:-1]
    ring, ends = runs(marks, own)
    other = np.repeat(other, np.diff(ends))
    for column in (rings.places.x, rings.places.y):
        low, high = np.minimum.reduceat(column, first), np.maximum.reduceat(column, first)
        inside = low[ring] >= np.minimum.reduceat(low, marks[:-1])[other]
        inside &= high[ring] <= np.maximum.reduceat(high, marks[:-1])[other]
        ring, other = ring[inside], other[inside]
    meets = rings.ring[events.edge] * len(rings.outlines) + events.other
    apart = ~np.isin(ring * len(rings.outlines) + other, meets)
    ring, other = ring[apart], other[apart]
    at = rings.outlines.points[first[ring]] - shift[other]
    in_it = np.asarray(shapely.contains_xy(areas[other], at[:, 0], at[:, 1]), bool)
    return np.column_stack([ring[in_it], other[in_it]])


def labels(copies: Copies, solved: Solved, sort: Index) -> Index:
    """Return for each copy the first of those that it makes up one area with."""
    members, ends = runs(solved.slot_ends, sort)
    own = np.repeat(np.arange(len(copies)), np.diff(ends))
    other = copies.other[copies.starts[own] + solved.slots[members]]
    return components(len(copies), np.column_stack([own, other]))
