"""Linking: stretches that go on across the seam, or past where an outline begins, as one.

A trap that is made of a stretch in one piece goes smoothly across the seam. What comes back moved by a repeat
has no end on the endless cloth: it is drawn once, and a piece more, so that it goes on in its own repeat.
"""

from __future__ import annotations

from collections import Counter

import numpy as np
import shapely

from batik_vector.artwork import Cell
from batik_vector.geometry.outlines import Steps
from batik_vector.geometry.sampling import Geometries


def linked(lines: Geometries, cell: Cell | None) -> Geometries:
    """Return polylines in steps, those joined that go on in one another and in nothing else.

    Args:
        lines: each in the direction of its outline.
        cell: of a tile, on which places that differ by a repeat are one.
    """
    open_ = np.flatnonzero(~shapely.is_closed(lines))
    if not len(open_):
        return lines
    pieces = [np.rint(shapely.get_coordinates(each)).astype(np.int64) for each in lines[open_]]
    starts = _home(np.array([each[0] for each in pieces]), cell)
    ends = _home(np.array([each[-1] for each in pieces]), cell)
    once = Counter(starts), Counter(ends)
    number = {place: k for k, place in enumerate(starts)}
    after = [number[each] if once[0][each] == once[1][each] == 1 else -1 for each in ends]
    made = [shapely.linestrings(each.astype(float)) for each in _followed(pieces, after)]
    kept = np.delete(lines, open_)
    return np.concatenate([kept, np.array([*made, None], dtype=object)[:-1]])


def _home(points: Steps, cell: Cell | None) -> list[tuple[int, int]]:
    """Return points, or on a tile the places on the torus that they are."""
    if cell is not None:
        (ax, ay), (bx, by) = cell.lattice
        if bx == 0:
            right = points[:, 0] // ax
            points = points - np.outer(right, (ax, ay))
            points = points - np.outer(points[:, 1] // by, (0, by))
        else:
            up = points[:, 1] // by
            points = points - np.outer(up, (bx, by))
            points = points - np.outer(points[:, 0] // ax, (ax, 0))
    return [(x, y) for x, y in points.tolist()]


def _followed(pieces: list[Steps], after: list[int]) -> list[Steps]:
    """Return pieces put together, each chain from its first piece on."""
    before = set(after)
    firsts = [k for k in range(len(pieces)) if k not in before]
    left = set(range(len(pieces)))
    found = []
    for first in [*firsts, *range(len(pieces))]:
        if first not in left:
            continue
        chain, shift, at = [pieces[first]], np.zeros(2, np.int64), first
        left.remove(first)
        while after[at] in left:
            shift = shift + pieces[at][-1] - pieces[after[at]][0]
            at = after[at]
            left.remove(at)
            chain.append(pieces[at][1:] + shift)
        if after[at] == first and (chain[-1][-1] != chain[0][0]).any():
            chain.append(pieces[first][1:] + shift + pieces[at][-1] - pieces[first][0])
        found.append(np.concatenate(chain))
    return found
