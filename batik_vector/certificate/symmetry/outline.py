"""The outline of a pattern on its torus: what is drawn, without the edges at which the tile was cut.

Two kinds of edges are kept for every ink: the boundary of what its areas cover, directed so that the
covered side lies on the left, and its centre lines. A boundary that runs along a seam and has ink on both
sides is none and is left out, so that a pattern has the same outline wherever its tile was cut.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell, Geometries, Layer
from batik_vector.geometry.congruence import distinct
from batik_vector.geometry.regions import oriented
from batik_vector.tiling.torus import overlay, seams
from batik_vector.tiling.torus.torus import (
    Steps,
    Window,
    clip_areas,
    clip_lines,
    lines_of,
    polygons_of,
    to_step_grid,
)
from batik_vector.tiling.welding.weld import welded
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

Points = NDArray[np.float64]
Indices = NDArray[np.intp]

SNAP_STEPS = 5
"""Grid steps within which an edge of a tile drawn elsewhere counts as lying on the seam: files that keep
two or three decimals of a point or a pixel miss it by that much."""

SMOOTH_STEPS = 2.0
"""Grid steps by which an outline may be simplified: rounding leaves kinks of this size."""


@frozen(eq=False)
class Edges:
    """Straight edges in mm: ``begin`` and ``end`` of shape (n, 2), ``kind`` of shape (n,).

    The kind of an edge is twice the number of its ink, and one more for a centre line.
    """

    begin: Points
    end: Points
    kind: Indices

    def __len__(self) -> int:
        return len(self.kind)


@frozen(eq=False)
class Outline:
    """What is drawn on the torus: ``edges`` of everything, and ``rings`` that close round the areas.

    The rings run along the cuts of the tile too; they serve to fill. ``inks`` are the names, by number.
    """

    edges: Edges
    rings: Edges
    inks: tuple[str, ...]


def outline(layers: Sequence[Layer], cell: Cell) -> Outline:
    """Return the outline of the tile's layers, which need not be in the normal form.

    What reaches beyond the cell is cut away, as it would be in print; overlapping areas of an ink are one.
    """
    inks = tuple(dict.fromkeys(layer.ink.name for layer in layers))
    edges: list[Edges] = []
    rings: list[Edges] = []
    for number, ink in enumerate(inks):
        mine = [layer for layer in layers if layer.ink.name == ink]
        areas = _areas(_finite([layer.areas for layer in mine]), cell)
        if len(areas):
            rings.append(_closed(areas, 2 * number))
            edges.append(_bare(areas, cell, 2 * number))
        lines = _lines(_finite([layer.lines for layer in mine]), cell)
        if len(lines):
            edges.append(_chained(*_ragged(lines), 2 * number + 1))
    return Outline(together(edges), together(rings), inks)


def _finite(parts: Sequence[Geometries]) -> Geometries:
    marks = np.concatenate([np.asarray(part, dtype=object) for part in parts])
    return marks[np.isfinite(shapely.bounds(marks)).all(axis=1)] if len(marks) else marks


def together(parts: Sequence[Edges]) -> Edges:
    """Join edges, and leave out those of no length."""
    if not parts:
        return Edges(np.empty((0, 2)), np.empty((0, 2)), np.empty(0, np.intp))
    begin = np.concatenate([part.begin for part in parts])
    end = np.concatenate([part.end for part in parts])
    long = (begin != end).any(axis=1)
    return Edges(begin[long], end[long], np.concatenate([part.kind for part in parts])[long])


def _areas(marks: Geometries, cell: Cell) -> Geometries:
    """Return what areas (mm) cover of the cell as disjoint polygons on whole grid steps."""
    if not len(marks):
        return marks
    areas, _ = polygons_of(to_step_grid(marks), np.zeros(len(marks), np.intp))
    areas = _on_seam(areas, cell)
    areas, _ = clip_areas(areas, np.zeros(len(areas), np.intp), _window(cell))
    areas, _ = welded(areas)
    return oriented(areas) if len(areas) else areas


def _on_seam(areas: Geometries, cell: Cell) -> Geometries:
    """Move vertices that miss an edge of the cell by very little onto it."""

    def snap(xy: Points) -> Points:
        for axis, far in ((0, cell.columns), (1, cell.rows)):
            for value in (0, far):
                xy[np.abs(xy[:, axis] - value) <= SNAP_STEPS, axis] = value
        return xy

    if not len(areas):
        return areas
    low_x, low_y, high_x, high_y = shapely.bounds(areas).T
    near = (low_x <= SNAP_STEPS) | (low_y <= SNAP_STEPS)
    near |= (high_x >= cell.columns - SNAP_STEPS) | (high_y >= cell.rows - SNAP_STEPS)
    moved = np.asarray(shapely.transform(areas[near], snap), dtype=object)
    moved = overlay.valid(moved)
    pieces, _ = polygons_of(moved, np.zeros(len(moved), np.intp))
    return np.concatenate([areas[~near], pieces])


def _lines(marks: Geometries, cell: Cell) -> Geometries:
    if not len(marks):
        return marks
    lines, names = lines_of(to_step_grid(marks), np.zeros(len(marks), np.intp))
    return clip_lines(lines, names, _window(cell))[0]


def _window(cell: Cell) -> Window:
    return Window(0, 0, cell.columns, cell.rows)


def _ragged(lines: Geometries) -> tuple[Points, Indices]:
    """Return the vertices of polylines and, for each of them, the number of its polyline."""
    coords, owner = shapely.get_coordinates(lines, return_index=True)
    return coords, owner


def _closed(areas: Geometries, kind: int) -> Edges:
    coords, ring = _ragged(shapely.get_rings(areas))
    same = ring[1:] == ring[:-1]
    begin, end = coords[:-1][same] / STEPS_PER_MM, coords[1:][same] / STEPS_PER_MM
    return Edges(begin, end, np.full(len(begin), kind, np.intp))


def _bare(areas: Geometries, cell: Cell, kind: int) -> Edges:
    """Return the boundary of areas on the torus: without what lies along a seam and has its twin there."""
    coords, ring = _ragged(shapely.get_rings(areas))
    along = np.zeros(len(coords) - 1, bool)
    for axis, far in ((0, cell.columns), (1, cell.rows)):
        for value in (0, far):
            on = coords[:, axis] == value
            along |= on[1:] & on[:-1]
    keep = (ring[1:] == ring[:-1]) & ~along
    first = keep & ~np.r_[False, keep[:-1]]
    run = np.cumsum(first) - 1
    # The vertices of a run are the beginnings of its edges and the end of its last.
    last = keep & ~np.r_[keep[1:], False]
    at = np.concatenate([np.flatnonzero(keep), np.flatnonzero(last) + 1])
    owner = np.concatenate([run[keep], run[last]])
    order = np.lexsort([at, owner])
    return together([_chained(coords[at[order]], owner[order], kind), _one_sided(areas, cell, kind)])


def _chained(coords: Points, owner: Indices, kind: int) -> Edges:
    """Return the edges of polylines, without kinks that rounding may have made."""
    if not len(coords):
        return together([])
    lines = shapely.linestrings(coords, indices=owner)
    coords, owner = _ragged(np.asarray(shapely.simplify(lines, SMOOTH_STEPS, preserve_topology=False)))
    same = owner[1:] == owner[:-1]
    begin, end = coords[:-1][same] / STEPS_PER_MM, coords[1:][same] / STEPS_PER_MM
    return Edges(begin, end, np.full(len(begin), kind, np.intp))


def simplified(edges: Edges, tolerance: float) -> Edges:
    """Return edges within a tolerance (mm) of those given; marks that are smaller than it are left out."""
    if not len(edges):
        return edges
    runs = (edges.begin[1:] != edges.end[:-1]).any(axis=1) | (edges.kind[1:] != edges.kind[:-1])
    run = np.concatenate([[0], np.cumsum(runs)])
    first = np.flatnonzero(np.concatenate([[True], runs]))
    at = np.concatenate([2 * np.arange(len(edges)) + 1, 2 * first])
    owner = np.concatenate([run, run[first]])
    order = np.argsort(at, kind="stable")
    coords = np.concatenate([edges.end, edges.begin[first]])[order]
    lines = shapely.linestrings(coords, indices=owner[order])
    coords, owner = _ragged(np.asarray(shapely.simplify(lines, tolerance, preserve_topology=False)))
    same = owner[1:] == owner[:-1]
    return together([Edges(coords[:-1][same], coords[1:][same], edges.kind[first][owner[1:][same]])])


def _one_sided(areas: Geometries, cell: Cell, kind: int) -> Edges:
    """Return the boundary that runs along a seam: what one edge of the cell covers and its twin does not."""
    found: list[Steps] = []
    for axis, near, far, shift in seams.opposite_edges(cell):
        length = cell.rows if axis == 0 else cell.columns
        here = seams.border(areas, axis, near)
        there = seams.rolled(seams.border(areas, axis, far), -shift, length)
        cuts = distinct(np.concatenate([here.ravel(), there.ravel()]))
        odd = np.column_stack([cuts[:-1], cuts[1:]])
        middle = odd.mean(axis=1)
        inner = seams.inside(middle, here)
        lone = inner != seams.inside(middle, there)
        odd, inner = odd[lone], inner[lone]
        # What is covered lies on the left: along x = 0 the covered side x > 0 is left of the way down.
        forward = inner != (axis == 0)
        ends = np.where(forward[:, None], odd, odd[:, ::-1])
        rows = np.full((len(odd), 4), near, np.int64)
        rows[:, 1 - axis], rows[:, 3 - axis] = ends[:, 0], ends[:, 1]
        found.append(rows)
    both = np.vstack(found) / STEPS_PER_MM
    return Edges(both[:, :2], both[:, 2:], np.full(len(both), kind, np.intp))
