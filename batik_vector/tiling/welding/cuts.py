"""Cutting: what lies higher, and the gap round it, is taken out of what lies beneath.

Each mark is cut by the cutters that touch it, once for all marks that lie alike among the same cutters.
Coordinates are whole grid steps.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry.congruence import alike
from batik_vector.geometry.nets.components import components
from batik_vector.geometry.outlines import Index, Offsets, Steps
from batik_vector.tiling.torus import overlay
from batik_vector.tiling.torus.remembered import Asked, identities, interned
from batik_vector.tiling.torus.torus import Lattice, Window, reduced, translate, translates
from batik_vector.tiling.welding.congruent import Copies, Stock
from batik_vector.tiling.welding.sheets import Laid, joined
from batik_vector.tiling.welding.weld import unions
from batik_vector.values import frozen

CUT_SHARE = 0.05
"""What a cutter's vertex costs in a cut, of what it costs in a union: most lie far from the mark."""


def cut(stock: Stock, marks: Laid, cutters: Laid, lattice: Lattice) -> Laid:
    """Return what cutters in higher sheets leave of marks, in the order of the marks.

    Marks and cutters repeat on the lattice. Whatever meets is cut where it lies, across all seams.
    """
    given = marks
    cutters, marks = _beside(stock, given, cutters, lattice)
    mark, cutter = _above(stock, marks, cutters)
    met = stock.holds(shapely.intersects, marks.copies.taken(mark), cutters.copies.taken(cutter))
    mark, cutter = mark[met], cutter[met]
    if not len(mark):
        return given
    which, away, number, corner = _away(stock, marks, cutters, mark, cutter)
    asked = np.column_stack([marks.copies.kind[which], number, corner - marks.copies.shift[which]])
    heads, row = alike(asked)
    taken, there = away[asked[heads, 1]], asked[heads, 2:]
    # A mark stays where it is: what is cut alike must be rounded alike, in every tile and cloth.
    cut_marks = stock.shapes[asked[heads, 0]]
    known = None
    if stock.remembers:
        taken = interned(taken)
        rows = np.column_stack([identities(cut_marks), identities(taken), there])
        known = Asked[overlay.Made]("less", rows, (cut_marks, taken))
    left = overlay.less(cut_marks, taken, lambda rows: translate(taken[rows], there[rows]), known)
    down = stock.set_down(left, row, given.copies.shift[which])
    whole = np.ones(len(marks.sheet), bool)
    whole[which] = False
    order = np.argsort(np.concatenate([np.flatnonzero(whole), which[down.each]]), kind="stable")
    return joined([given.taken(whole), Laid(down.copies, marks.sheet[which[down.each]])]).taken(order)


def touched(stock: Stock, marks: Laid, cutters: Laid, lattice: Lattice) -> NDArray[np.bool_]:
    """Return which marks a cutter in a higher sheet would cut into."""
    cutters, marks = _beside(stock, marks, cutters, lattice)
    mark, cutter = _above(stock, marks, cutters)
    a, b = marks.copies.taken(mark), cutters.copies.taken(cutter)
    into = stock.holds(_cuts_into, a, b)
    found = np.zeros(len(marks.sheet), bool)
    found[mark[into]] = True
    return found


def _cuts_into(marks: Geometries, cutters: Geometries) -> NDArray[np.bool_]:
    return np.asarray(shapely.relate_pattern(marks, cutters, "T********"))


def _beside(stock: Stock, marks: Laid, cutters: Laid, lattice: Lattice) -> tuple[Laid, Laid]:
    """Return all cutters that may meet marks, and the marks, each brought to the cell at the origin."""
    if not len(marks.sheet) or not len(cutters.sheet):
        return cutters, marks
    bounds = stock.bounds(marks.copies)
    home = reduced(bounds[:, :2], lattice) - bounds[:, :2]
    marks = Laid(marks.copies.moved(home), marks.sheet)
    bounds = bounds + np.tile(home, 2)
    window = Window(*bounds[:, :2].min(axis=0).tolist(), *bounds[:, 2:].max(axis=0).tolist())
    which, shift = translates(stock.bounds(cutters.copies), lattice, window)
    return Laid(cutters.copies.taken(which).moved(shift), cutters.sheet[which]), marks


def _above(stock: Stock, marks: Laid, cutters: Laid) -> tuple[Index, Index]:
    """Return the pairs of a mark and a cutter above it whose bounds meet."""
    mark, cutter = stock.near(marks.copies, cutters.copies)
    above = cutters.sheet[cutter] > marks.sheet[mark]
    return mark[above], cutter[above]


def _away(
    stock: Stock, marks: Laid, cutters: Laid, mark: Index, cutter: Index
) -> tuple[Index, Geometries, Index, Steps]:
    """Return what is taken away: (which marks are cut, unions, which of these from each mark, and where).

    A mark needs the union of the cutters that touch it. Where marks of a level share cutters it may be
    less work to unite all that hang together once, for all of them: what has fewer vertices is done.
    """
    which, number = np.unique(mark, return_inverse=True)
    # Marks of two sheets with no cutters between may share.
    level = np.searchsorted(np.unique(cutters.sheet, return_index=True)[0], marks.sheet[mark], side="right")
    label = _hanging_together(level, cutter, number.ravel(), len(which))
    own = _Sets.of(stock, cutters.copies, number.ravel(), cutter)
    shared = _Sets.of(stock, cutters.copies, label[number.ravel()], cutter)
    group = np.searchsorted(shared.owner, label)
    place = marks.copies.kind[which], marks.copies.shift[which]
    mine = own.work(*place, np.arange(len(which)), shared.same[group], len(shared.owner))
    ours = shared.work(*place, group, shared.same[group], len(shared.owner))
    shares = (ours < mine)[shared.same[group]]
    same = np.where(shares, shared.same[group] + len(own.owner), own.same)
    corner = np.where(shares[:, None], shared.corner[group], own.corner)
    needed, row = np.unique(same, return_inverse=True)
    split = np.searchsorted(needed, len(own.owner))
    parts = [own.united(stock, needed[:split]), shared.united(stock, needed[split:] - len(own.owner))]
    return which, np.concatenate(parts), row.ravel(), corner


def _hanging_together(level: Index, cutter: Index, mark: Index, count: int) -> Index:
    """Return for each mark the first that shared cutters connect it with, within its level."""
    _, node = alike(np.column_stack([level, cutter]))
    pairs = np.column_stack([mark, count + node])
    return components(int(pairs.max()) + 1, pairs)[:count]


@frozen(eq=False)
class _Sets:
    """Sets of cutters: rows (kind, x, y) relative to each set's corner, and which sets are alike.

    ``owner`` says whose each set is, ``same`` the first set that equals it, ``size`` its vertices.
    """

    owner: Index
    rows: Steps
    ends: Offsets
    corner: Steps
    same: Index
    size: Index

    @classmethod
    def of(cls, stock: Stock, cutters: Copies, owner: Index, cutter: Index) -> _Sets:
        """Gather the cutters of each owner; those that coincide cut as one."""
        kind, shift = cutters.kind[cutter], cutters.shift[cutter]
        order = np.lexsort([shift[:, 1], shift[:, 0], kind, owner])
        rows = np.column_stack([owner, kind, shift])[order]
        rows = rows[np.r_[True, (rows[1:] != rows[:-1]).any(axis=1)]]
        owners, starts = np.unique(rows[:, 0], return_index=True)
        corner = np.minimum.reduceat(rows[:, 2:], starts, axis=0)
        ends = np.append(starts, len(rows))
        rows[:, 2:] -= np.repeat(corner, np.diff(ends), axis=0)
        size = np.add.reduceat(shapely.get_num_coordinates(stock.shapes[rows[:, 1]]), starts)
        heads, number = alike(rows[:, 1:], ends)
        return cls(owners, rows[:, 1:], ends, corner, heads[number], size)

    def work(
        self, kind: Index, shift: Steps, which: Index, account: Index, count: int
    ) -> NDArray[np.float64]:
        """Return what cutting marks (kind, shift) by sets ``which`` costs, to ``count`` accounts.

        What is alike is counted once, in vertices that go through a union.
        """
        sets, first = np.unique(self.same[which], return_index=True)
        several = np.diff(self.ends)[sets] > 1
        unions = np.bincount(account[first], self.size[sets] * several, count)
        asked = np.column_stack([kind, self.same[which], shift - self.corner[which]])
        heads, _ = alike(asked)
        return unions + CUT_SHARE * np.bincount(account[heads], self.size[which[heads]], count)

    def united(self, stock: Stock, which: Index) -> Geometries:
        """Return the unions of some of the sets."""
        return unions(stock, self.rows, self.ends, which)
