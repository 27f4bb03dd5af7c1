"""Tabs: gaps in a cut by which a part still hangs in its sheet."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines, together
from batik_vector.processes.cutting.arclength import Ways, along, around, reached, turns

SHIFTS = 32
"""Places that are tried for the tabs of a contour, which stay evenly spaced: those off corners are taken."""


def tabbed(strokes: Outlines, counts: Index, gap: int, corner: float) -> Outlines:
    """Return strokes of which closed ones are cut in pieces, gaps left between; names stay.

    The gaps of a contour are evenly spaced, and lie where fewest corners fall in them.

    Args:
        strokes: one ring or polyline to a mark, in order.
        counts: shape (n,), how many gaps each stroke is to have; 0 leaves it as it is, as open ones must be.
        gap: how long each is, in parts of a step; shorter than what lies between two of them.
        corner: from how many radians on a bend is a corner.
    """
    counts = np.where(strokes.closed, counts, 0)
    if not counts.any():
        return strokes
    whole = around(strokes)
    first = _first_gaps(strokes, counts, gap, corner, whole)
    which = np.repeat(np.arange(len(strokes)), counts)
    number = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    begin = first[which] + number * whole[which] // counts[which] + gap
    end = first[which] + (number + 1) * whole[which] // counts[which]
    over = np.where(begin >= whole[which], whole[which], 0)
    pieces = along(strokes, which, begin - over, end - over)
    rest = np.flatnonzero(counts == 0)
    both, owner = together([strokes.taken(rest), pieces]), np.concatenate([rest, which])
    sequence = np.argsort(owner, kind="stable")
    names = [strokes.names[each] for each in owner[sequence].tolist()] if len(strokes.names) else ()
    return replace(both.taken(sequence), names=names)


def _first_gaps(strokes: Outlines, counts: Index, gap: int, corner: float, whole: Ways) -> NDArray[np.int64]:
    """Return where the first gap of each contour begins: where fewest corners fall into gaps."""
    reach = reached(strokes)
    bent = np.abs(turns(strokes)) >= corner
    first = np.zeros(len(strokes), np.int64)
    for number in np.flatnonzero(counts).tolist():
        begin, stop = strokes.rings[number], strokes.rings[number + 1]
        spacing = int(whole[number]) / int(counts[number])
        corners = (reach[begin:stop] - reach[begin])[bent[begin:stop]]
        shift = np.arange(SHIFTS) * spacing // SHIFTS
        # Half a spacing on from the start: what is begun holds, and what is ended.
        shift = np.roll(shift, -(SHIFTS // 2))
        within = (corners[None, :] - shift[:, None]) % spacing <= gap
        first[number] = int(shift[np.argmin(within.sum(axis=1))])
    return first
