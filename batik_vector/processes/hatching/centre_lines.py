"""Centre lines of thin areas: where a pen goes once instead of round.

Each area is cut into triangles between its sides; the line runs through the middles of the cuts. This is the
chordal axis of L. Prasad, “Morphological analysis of shapes”, CNLS Newsletter 139 (1997).
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Outlines, nothing, of_polylines
from batik_vector.geometry.sampling import Geometries

STEPS = 4
"""Vertices along the sides for each width: the more, the nearer the middles of the cuts are to the middle."""
SMOOTH = 20
"""A part of the width by which lines may be off, so that they have few points."""
BRANCH = 1.0
"""How long a branch is at least, in widths: the pen paints half a width beyond the fork all the same."""


def centre_lines(areas: Geometries, width: float) -> tuple[Outlines, Index]:
    """Return lines through areas, and which area each is of; where areas fork, one for each branch.

    Args:
        areas: valid polygons in steps, hardly broader than the pen.
        width: of the pen, in steps. Short branches are left out.
    """
    if not len(areas):
        return nothing(), np.empty(0, np.intp)
    cut, of = shapely.get_parts(
        shapely.constrained_delaunay_triangles(shapely.segmentize(areas, width / STEPS)), return_index=True
    )
    ends, piece = _through(shapely.get_coordinates(cut).reshape(-1, 4, 2)[:, :3], of)
    if not len(piece):
        return nothing(), np.empty(0, np.intp)
    segments = np.asarray(shapely.linestrings(ends), dtype=object)
    done, whose = [], []
    while len(segments):
        # What was a fork may be none without its short branches.
        first = np.flatnonzero(np.diff(piece, prepend=-1))
        number = np.repeat(np.arange(len(first)), np.diff(np.append(first, len(piece))))
        merged = shapely.line_merge(shapely.multilinestrings(segments, indices=number))
        lines, which = shapely.get_parts(merged, return_index=True)
        worth = _worth_it(lines, which, width * BRANCH)
        again = np.zeros(len(first), bool)
        again[which[~worth]] = True
        settled, drawn = ~again[which], piece[first][which]
        done.append(lines[settled])
        whose.append(drawn[settled])
        segments, piece = lines[worth & ~settled], drawn[worth & ~settled]
    found, owner = np.concatenate(done), np.concatenate(whose)
    order = np.argsort(owner, kind="stable")
    return of_polylines(shapely.simplify(found[order], width / SMOOTH)), owner[order]


def _through(corners: NDArray[np.float64], of: Index) -> tuple[NDArray[np.float64], Index]:
    """Return segments through triangles, shape (n, 2, 2), and the area each is of.

    Args:
        corners: of the triangles, shape (m, 3, 2).
        of: the area that each triangle is of, ascending.
    """
    middles = (corners + np.roll(corners, -1, axis=1)) / 2
    # Cuts are those sides whose middle two triangles of an area share.
    sides = np.column_stack([np.repeat(of, 3), middles.reshape(-1, 2)])
    order = np.lexsort(sides.T)
    same = (sides[order][1:] == sides[order][:-1]).all(axis=1)
    shared = np.zeros(len(sides), bool)
    shared[order[1:][same]] = shared[order[:-1][same]] = True
    inner = shared.reshape(-1, 3)
    count = inner.sum(axis=1)
    two, three = np.flatnonzero(count == 2), np.flatnonzero(count == 3)
    straight = middles[two][inner[two]].reshape(-1, 2, 2)
    centre = np.repeat(corners[three].sum(axis=1) / 3, 3, axis=0)
    forked = np.stack([middles[three].reshape(-1, 2), centre], axis=1)
    segments = np.concatenate([straight, forked])
    piece = np.concatenate([of[two], np.repeat(of[three], 3)])
    some = (segments[:, 0] != segments[:, 1]).any(axis=1)
    order = np.argsort(piece[some], kind="stable")
    return segments[some][order], piece[some][order]


def _worth_it(lines: Geometries, which: Index, least: float) -> NDArray[np.bool_]:
    """Return which lines are no short branches; of each area the longest at any rate."""
    length = np.rint(shapely.length(lines))
    longest = np.lexsort((-length, which))
    longest = longest[np.diff(which[longest], prepend=-1) > 0]
    ends = (
        shapely.get_coordinates(shapely.get_point(lines, 0)),
        shapely.get_coordinates(shapely.get_point(lines, -1)),
    )
    rows = np.column_stack([np.tile(which, 2), np.concatenate(ends)])
    _, number, times = np.unique(rows, axis=0, return_inverse=True, return_counts=True)
    met = times[number.reshape(2, -1)]
    branch = (met.min(axis=0) == 1) & (met.max(axis=0) > 2)
    kept = ~branch | (length >= least)
    kept[longest] = True
    return np.asarray(kept)
