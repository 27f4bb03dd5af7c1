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

LONGEST, WIDEST = 1 << 24, 1 << 30
"""Steps: no edge is longer, and all lies within less, some 16 m and 1 km."""

BLOCK = 1 << 17
"""Pairs that are looked at in one go: as many as a processor holds beside it."""


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
        far, up = (int(np.ptp(each)) + 2 * LONGEST for each in (places.x, places.y))
        dx, dy = places.dx.astype(np.int32), places.dy.astype(np.int32)
        wide, tall = np.abs(dx), np.abs(dy)
        if max(far, up) >= WIDEST or max(int(wide.max()), int(tall.max())) > LONGEST:
            return None
        left, low = ((each - each.min()).astype(np.int32) for each in (places.x, places.y))
        left += np.minimum(dx, 0) + np.int32(LONGEST)
        low += np.minimum(dy, 0) + np.int32(LONGEST)
        left -= left.min()
        low -= low.min()
        right, high = left + wide + np.int32(2 * ROOM), low + tall + np.int32(2 * ROOM)
        far, up = int(right.max()), int(high.max())
        mean = int(np.maximum(wide, tall).sum(dtype=np.int64)) // n + 2 * ROOM
        bits = int(BREADTH * mean).bit_length()
        while ((far >> bits) + 1) * ((up >> bits) + 1) > CELLS * n + SPARE:
            bits += 1
        columns = (far >> bits) + 1
        count = columns * ((up >> bits) + 1)
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
        bounds = tuple(each[self.edge] for each in (self.left, self.right, self.low, self.high))
        found = [np.empty((2, 0), np.int32)]
        totals = np.cumsum(counts)
        stops = np.searchsorted(totals, np.arange(BLOCK, total + BLOCK, BLOCK), side="right")
        start = 0
        for stop in stops.tolist():
            # One entry with more pairs than a block holds is a block by itself.
            stop = min(max(stop, start + 1), len(counts))
            found.append(self._of_block(start, first[start:stop], counts[start:stop], bounds, once=once))
            start = stop
            if start == len(counts):
                break
        e, f = np.concatenate(found, axis=1)
        return e.astype(np.intp), f.astype(np.intp)

    def _of_block(
        self, start: int, first: Index, counts: Index, bounds: tuple[Small, ...], *, once: bool
    ) -> NDArray[np.int32]:
        """Do the work of :meth:`_met` for some entries from ``start`` on; ``bounds`` are those of each."""
        left, right, low, high = bounds
        total = int(counts.sum())
        one = np.repeat(np.arange(start, start + len(counts), dtype=np.int32), counts)
        other = np.arange(total, dtype=np.int32)
        other += np.repeat((first - np.cumsum(counts) + counts).astype(np.int32), counts)
        if not once:
            apart = np.flatnonzero(np.abs(self.edge[one] - self.edge[other]) > 1)
            one, other = one[apart], other[apart]
        # Entries of one cell lie side by side, and are read sooner than what they are of.
        for begin, end in ((left, right), (low, high)):
            met = np.flatnonzero((begin[one] <= end[other]) & (begin[other] <= end[one]))
            one, other = one[met], other[met]
        if once:
            column = np.maximum(left[one], left[other]) >> self.bits
            row = np.maximum(low[one], low[other]) >> self.bits
            here = np.flatnonzero(row * np.int32(self.columns) + column == self.cell[one])
            one, other = one[here], other[here]
        return np.stack([self.edge[one], self.edge[other]])


def _ends(breaks: Mask) -> Index:
    """Return for each item where its run ends, given between which neighbours there is a break."""
    ends = np.flatnonzero(np.append(breaks, True)) + 1
    return np.repeat(ends, np.diff(ends, prepend=0))
