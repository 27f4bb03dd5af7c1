"""Spans: gaps measured as bridges of some breadth would span them, from sheet to sheet.

Five lines across the breadth of a bridge are followed from its middle both ways: where they meet the sheet
first, how deep it is behind, and whether all of them come from and to the same pieces.
"""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.geometry.outlines import Index
from batik_vector.geometry.sampling import Array, Points
from batik_vector.processes.stencilling.contours import Field
from batik_vector.processes.stencilling.gaps import Gaps
from batik_vector.values import frozen

ACROSS = np.array([-0.5, -0.25, 0.0, 0.25, 0.5])
"""Where the lines run, in breadths of the bridge."""
BEHIND = 0.25
"""Breadths of sheet that have to lie behind either end of a bridge."""
SLANT = 1.5
"""Breadths by which the sides of a bridge may differ at one end: it is no tip that it joins."""
THIN = 1.0
"""What a breadth of sheet costs, in breadths of bridge, that is lacking behind an end where it is thinner
than the bridge is broad: bridges keep away from thin necks."""
OBLIQUE = 0.5
"""What it costs that the sides of a bridge are of uneven length: bridges keep away from corners."""
SAME = 2.0
"""Steps within which crossings count as one: contours meet there."""


@frozen(eq=False)
class Spans:
    """Bridges of one breadth that would do, in steps: from ``low`` to ``high`` along ``way`` from ``middle``.

    ``one`` is the piece at the low end and ``other`` that at the high one. ``cost`` is the length with what
    speaks against the place, in steps.
    """

    middle: Points
    way: Points
    low: Array
    high: Array
    cost: Array
    one: Index
    other: Index

    def __len__(self) -> int:
        return len(self.middle)

    def taken(self, which: Index) -> Spans:
        """Return some of them."""
        return Spans(
            self.middle[which],
            self.way[which],
            self.low[which],
            self.high[which],
            self.cost[which],
            self.one[which],
            self.other[which],
        )


def spanned(gaps: Gaps, field: Field, piece: Index, breadth: float) -> Spans:
    """Return the bridges that would span gaps; those are left out that would not hold at both ends.

    Args:
        gaps: where bridges may stand.
        field: the contours as chains, and
        piece: the piece of each.
        breadth: of the bridges, in steps.
    """
    count, lines = len(gaps), len(ACROSS)
    far = gaps.length + 4 * breadth
    normal = np.stack([-gaps.way[:, 1], gaps.way[:, 0]], axis=1)
    starts = gaps.middle[:, None, :] + ACROSS[:, None] * breadth * normal[:, None, :]
    reach = (far[:, None] * gaps.way)[:, None, :]
    ends = np.stack([starts - reach, starts + reach], axis=2).reshape(-1, 2, 2)
    at, line, chain = _crossings(ends, starts.reshape(-1, 2), np.repeat(gaps.way, lines, axis=0), field)
    ahead = _met(at, line, piece[chain], count * lines)
    back = _met(-at, line, piece[chain], count * lines)
    shape = count, lines
    high, on_high, deep_high = (ahead[0].reshape(shape), ahead[1].reshape(shape), ahead[2].reshape(shape))
    low, on_low, deep_low = (back[0].reshape(shape), back[1].reshape(shape), back[2].reshape(shape))
    top, bottom = high.max(axis=1, initial=0), low.max(axis=1, initial=0)
    one, other = on_low[:, 0], on_high[:, 0]
    sound = (on_low == one[:, None]).all(axis=1) & (on_high == other[:, None]).all(axis=1)
    sound &= (one >= 0) & (other >= 0) & (one != other)
    room_high = (high + deep_high - top[:, None]).min(axis=1, initial=np.inf)
    room_low = (low + deep_low - bottom[:, None]).min(axis=1, initial=np.inf)
    sound &= (room_high >= BEHIND * breadth) & (room_low >= BEHIND * breadth)
    slant_high, slant_low = np.ptp(high, axis=1), np.ptp(low, axis=1)
    sound &= (slant_high <= SLANT * breadth) & (slant_low <= SLANT * breadth)
    lacking = np.clip(breadth - room_high, 0, None) + np.clip(breadth - room_low, 0, None)
    cost = top + bottom + OBLIQUE * (slant_high + slant_low) + THIN * lacking
    found = Spans(gaps.middle, gaps.way, -bottom, top, cost, one, other)
    return found.taken(np.flatnonzero(sound))


def _crossings(ends: Array, starts: Points, ways: Points, field: Field) -> tuple[Array, Index, Index]:
    """Return where lines cross contours, as the way from their starts, with the line and the chain."""
    made = np.asarray(shapely.linestrings(ends), dtype=object)
    line, chain = field.tree.query(made, predicate="intersects")
    met = shapely.intersection(made[line], field.chains[chain])
    places, row = shapely.get_coordinates(met, return_index=True)
    line, chain = line[row], chain[row]
    at = ((places - starts[line]) * ways[line]).sum(axis=1)
    return at, line, chain


def _met(at: Array, line: Index, piece: Index, count: int) -> tuple[Array, Index, Array]:
    """Return the first crossing ahead of each line, the piece there (-1 for none), and how deep it is."""
    ahead = np.flatnonzero(at > 0)
    ahead = ahead[np.lexsort([at[ahead], line[ahead]])]
    at, line, piece = at[ahead], line[ahead], piece[ahead]
    first = np.append(True, line[1:] != line[:-1])[: len(line)]
    number = np.flatnonzero(first)
    found, of, deep = np.full(count, np.inf), np.full(count, -1, np.intp), np.full(count, np.inf)
    found[line[number]], of[line[number]] = at[number], piece[number]
    behind = at > found[line] + SAME
    behind_at = np.where(behind, at, np.inf)
    if len(number):
        second = np.minimum.reduceat(behind_at, number)
        deep[line[number]] = second - at[number]
    return np.where(np.isinf(found), 0.0, found), of, deep
