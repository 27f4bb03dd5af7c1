"""Seams kept clear: what a hand draws along the tile's edge, by chance a hair off it, lies on it instead.

The cut would leave a strip there that is a few micrometres broad, and where a corner falls on the edge itself
the outline would seem to bend at the seam. All is moved by where it lies on the torus alone, so that marks
that share a corner go on to.
"""

from __future__ import annotations

import numpy as np

from batik_vector.artwork import Cell, Geometries
from batik_vector.geometry.outlines import of_polygons, to_polygons
from batik_vector.processes.handwork.waver import folded

LEVEL = 80
"""How many times longer than it rises an edge is that runs along the tile's: the certificate asks for 115."""
HAIR = 2
"""Steps within which a short edge lies along the tile's, too."""
BESIDE = 8
"""Steps from the tile's edge past which nothing is drawn to it: spouts' ways have as much to spare."""
CLEAR = 3
"""Steps that a corner keeps from the tile's edge, if its outline goes on across it."""


def clear_of_seams(marks: Geometries, cell: Cell, step: float) -> Geometries:
    """Return marks of which no edge runs beside the tile's edge, nor has a corner on it where it crosses.

    Args:
        marks: polygons in steps, anywhere about the tile.
        cell: of the tile.
        step: how long edges are at most, about.
    """
    if not len(marks):
        return marks
    outlines = of_polygons(marks)
    points, rings = outlines.points, outlines.rings
    following = np.arange(1, len(points) + 1)
    following[rings[1:] - 1] = rings[:-1]
    preceding = np.empty_like(following)
    preceding[following] = np.arange(len(points))
    way, place = np.abs(points[following] - points), folded(points, cell)
    by = np.zeros_like(points)
    near = min(HAIR + int(step / LEVEL), BESIDE)
    for axis, side in ((0, cell.columns), (1, cell.rows)):
        off = np.where(2 * place[:, axis] > side, place[:, axis] - side, place[:, axis])
        close = np.abs(off) <= near
        along = close & close[following] & (LEVEL * way[:, axis] <= way[:, 1 - axis])
        on = along | along[preceding]
        by[:, axis] = np.where(on, -off, np.where(np.abs(off) < CLEAR, CLEAR - off, 0))
    if not by.any():
        return marks
    points = points + by
    return to_polygons(type(outlines)(points, rings, outlines.marks, outlines.closed))
