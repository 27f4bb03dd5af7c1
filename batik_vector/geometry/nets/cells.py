"""Edges sorted into the square cells of a grid: those that may meet share a cell.

Coordinates are whole grid steps.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index
from batik_vector.values import frozen

Column: TypeAlias = NDArray[np.int64]
Mask: TypeAlias = NDArray[np.bool_]
Small: TypeAlias = NDArray[np.int32]
"""Half as broad: what is looked through a million times over is mostly waited for."""

ROOM = 2
"""Steps by which bounds are larger than their edges, so that what is nearly as near as twice that
shares a cell."""

BREADTH = 1.5
"""How many times a cell is as broad as an edge in the mean, or up to twice that: narrower ones
hold edges more often, and broader ones more edges."""

CELLS, ENTRIES, PAIRS = 4, 8, 12
"""How many cells, entries in them and pairs of entries there may be for each edge: past that edges are too
unlike, or meet too often, for cells to be of use."""

SPARE = 1 << 16
"""So many more of each are nothing."""

WIDEST = 1 << 31
"""Steps: all lies within less."""


@frozen(eq=False)
class Places:
    """Edges: where each begins, and by how much it leads on; and whose it is. All of shape (n,)."""

    x: Column
    y: Column
    dx: Column
    dy: Column
    owner: Index

    def __len__(self) -> int:
        return len(self.x)


@frozen(eq=False)
class Cells:
    """Which edges lie in which cell.

    ``left``, ``low``, ``right`` and ``high`` are the bounds of each edge. ``cell`` and ``edge`` are entries:
    an edge is in as many cells as its bounds reach, of ``count`` in rows of ``columns`` which are 2 to the
    power ``bits`` broad."""

    left: Small
    low: Small
    right: Small
    high: Small
    owner: Small
    cell: Small
    edge: Small
    bits: int
    columns: int
    count: int

    @classmethod
    def of(cls, places: Places) -> Cells | None:
        """Sort edges into cells; None where they are too unlike, or lie too far apart."""
        n = len(places)
        wide, tall = np.abs(places.dx), np.abs(places.dy)
        left, low = np.minimum(places.x, places.x + places.dx), np.minimum(places.y, places.y + places.dy)
        left -= left.min() - ROOM
        low -= low.min() - ROOM
        far, up = int((left + wide).max()) + ROOM, int((low + tall).max()) + ROOM
        if max(far, up) >= WIDEST:
            return None
        mean = int(np.maximum(wide, tall).sum()) // n + 2 * ROOM
        bits = int(BREADTH * mean).bit_length()
        while ((far >> bits) + 1) * ((up >> bits) + 1) > CELLS * n + SPARE:
            bits += 1
        columns = (far >> bits) + 1
        count = columns * ((up >> bits) + 1)
        left, low = (left - ROOM).astype(np.int32), (low - ROOM).astype(np.int32)
        right, high = left + (wide + 2 * ROOM).astype(np.int32), low + (tall + 2 * ROOM).astype(np.int32)
        first_column, first_row = left >> bits, low >> bits
        across, up_ = (right >> bits) - first_column + 1, (high >> bits) - first_row + 1
        counts = across * up_
        if int(counts.sum(dtype=np.int64)) > ENTRIES * n + SPARE:
            return None
        first = first_row * np.int32(columns) + first_column
        more = np.flatnonzero(counts > 1).astype(np.int32)
        extra = counts[more] - 1
        edge = np.repeat(more, extra)
        ends = np.cumsum(extra, dtype=np.int32)
        place = np.arange(1, len(edge) + 1, dtype=np.int32) - np.repeat(ends - extra, extra)
        row, column = np.divmod(place, across[edge])
        cell = np.concatenate([first, first[edge] + row * np.int32(columns) + column])
        edges = np.concatenate([np.arange(n, dtype=np.int32), edge])
        owner = places.owner.astype(np.int32)
        return cls(left, low, right, high, owner, cell, edges, bits, columns, count)

    def shared(self) -> Cells:
        """Return what lies in cells that several owners share."""
        seen = np.full(self.count, -1, np.int32)
        owner = self.owner[self.edge]
        seen[self.cell] = owner
        foreign = seen[self.cell] != owner
        several = np.zeros(self.count, bool)
        several[self.cell[foreign]] = True
        return self._only(several[self.cell])

    def beside(self, some: Mask) -> Cells:
        """Return what lies in the cells of some edges."""
        there = np.zeros(self.count, bool)
        there[self.cell[some[self.edge]]] = True
        return self._only(there[self.cell])

    def _only(self, which: Mask) -> Cells:
        """Return some entries, by cells and in each by edges."""
        key = np.sort((self.cell[which].astype(np.int64) << 32) | self.edge[which])
        return replace(self, cell=(key >> 32).astype(np.int32), edge=key.astype(np.int32))

    def pairs(self) -> tuple[Index, Index] | None:
        """Return the pairs of edges of two owners whose bounds meet, each once, of sorted entries.

        None where there are too many to look at.
        """
        cell, owner = self.cell, self.owner[self.edge]
        stop = _ends(cell[1:] != cell[:-1])
        # Edges of one owner follow one another.
        own = _ends((cell[1:] != cell[:-1]) | (owner[1:] != owner[:-1]))
        return self._met(own, stop - own, once=True)

    def pairs_within(self, some: Mask) -> tuple[Index, Index] | None:
        """Return the pairs of some edges with others of their owner whose bounds meet, at times repeated.

        Those that follow one another are left out.
        """
        cell, owner = self.cell, self.owner[self.edge]
        breaks = (cell[1:] != cell[:-1]) | (owner[1:] != owner[:-1])
        stop, start = _ends(breaks), len(cell) - _ends(breaks[::-1])[::-1]
        return self._met(start, np.where(some[self.edge], stop - start, 0), once=False)

    def _met(self, first: Index, counts: Index, *, once: bool) -> tuple[Index, Index] | None:
        """Return the pairs whose bounds meet of entries with so many others, from the first of these on."""
        total = int(counts.sum())
        if total > PAIRS * len(self.owner) + SPARE:
            return None
        one = np.repeat(np.arange(len(counts), dtype=np.int32), counts)
        other = np.arange(total, dtype=np.int32)
        other += np.repeat((first - np.cumsum(counts) + counts).astype(np.int32), counts)
        if not once:
            apart = np.flatnonzero(np.abs(self.edge[one] - self.edge[other]) > 1)
            one, other = one[apart], other[apart]
        # Entries of one cell lie side by side, and are read sooner than what they are of.
        for lower, upper in ((self.left, self.right), (self.low, self.high)):
            begin, end = lower[self.edge], upper[self.edge]
            met = np.flatnonzero((begin[one] <= end[other]) & (begin[other] <= end[one]))
            one, other = one[met], other[met]
        e, f, cell = self.edge[one], self.edge[other], self.cell[one]
        if once:
            column = np.maximum(self.left[e], self.left[f]) >> self.bits
            row = np.maximum(self.low[e], self.low[f]) >> self.bits
            here = np.flatnonzero(row * np.int32(self.columns) + column == cell)
            e, f = e[here], f[here]
        return e.astype(np.intp), f.astype(np.intp)


def _ends(breaks: Mask) -> Index:
    """Return for each item where its run ends, given between which neighbours there is a break."""
    ends = np.flatnonzero(np.append(breaks, True)) + 1
    return np.repeat(ends, np.diff(ends, prepend=0))
