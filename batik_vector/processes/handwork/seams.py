"""Seams kept clear: what a hand draws along the tile's edge, by chance a hair off it, lies on it instead.

The cut would leave a strip there that is a few micrometres broad, and where a corner falls on the edge itself
the outline would seem to bend at the seam. All is moved by where it lies on the torus alone, so that marks
that share a corner go on to.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeAlias

import numpy as np

from batik_vector.artwork import Cell, Geometries
from batik_vector.geometry.outlines import Steps, of_polygons, to_polygons
from batik_vector.geometry.sampling import Indices
from batik_vector.processes.handwork.waver import folded

LEVEL = 80
"""How many times longer than it rises an edge is that runs along the tile's: the certificate asks for 115."""
HAIR = 2
"""Steps within which a short edge lies along the tile's, too."""
BESIDE = 8
"""Steps from the tile's edge past which nothing is drawn to it: spouts' ways have as much to spare."""
CLEAR = 3
"""Steps that a corner keeps from the tile's edge, if its outline goes on across it."""


Held: TypeAlias = tuple[Indices, Indices]
"""Places on the torus that are drawn to the left and right edge of the tile, and to the lower and upper."""


def held_to_seams(marks: Geometries, cell: Cell, step: float) -> Held:
    """Return the places of corners of edges that run beside the tile's: they are to lie on it.

    Args:
        marks: polygons in steps, anywhere about the tile.
        cell: of the tile.
        step: how long edges are at most, about.
    """
    outlines = of_polygons(marks)
    points, rings = outlines.points, outlines.rings
    following = np.arange(1, len(points) + 1)
    following[rings[1:] - 1] = rings[:-1]
    way, place = np.abs(points[following] - points), folded(points, cell)
    found = []
    for axis, off in enumerate(_off(place, cell)):
        close = np.abs(off) <= min(HAIR + int(step / LEVEL), BESIDE)
        along = close & close[following] & (LEVEL * way[:, axis] <= way[:, 1 - axis])
        found.append(
            np.unique(_codes(place[np.concatenate([np.flatnonzero(along), following[along]])], cell))
        )
    return found[0], found[1]


def clear_of_seams(marks: Geometries, cell: Cell, held: Held) -> Geometries:
    """Return marks of which no edge runs beside the tile's edge, nor has a corner on it where it crosses.

    Args:
        marks: polygons in steps, anywhere about the tile.
        cell: of the tile.
        held: places that are to lie on the edge, of all marks that may share corners with these.
    """
    if not len(marks):
        return marks
    outlines = of_polygons(marks)
    place = folded(outlines.points, cell)
    codes, by = _codes(place, cell), np.zeros_like(outlines.points)
    for axis, off in enumerate(_off(place, cell)):
        by[:, axis] = np.where(
            np.isin(codes, held[axis]), -off, np.where(np.abs(off) < CLEAR, CLEAR - off, 0)
        )
    if not by.any():
        return marks
    return to_polygons(replace(outlines, points=outlines.points + by))


def _off(place: Steps, cell: Cell) -> list[Indices]:
    """Return how far places are off the nearest of the tile's edges across, and of those up."""
    sides = (cell.columns, cell.rows)
    return [
        np.where(2 * place[:, axis] > side, place[:, axis] - side, place[:, axis])
        for axis, side in enumerate(sides)
    ]


def _codes(place: Steps, cell: Cell) -> Indices:
    """Return a number for each place in the tile."""
    return np.asarray(place[:, 0] * (cell.rows + 1) + place[:, 1])
