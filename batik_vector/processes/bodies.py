"""What an ink covers: its areas, and its lines with the body that the ink gives them, round at the ends."""

from __future__ import annotations

import math

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Cell, Geometries, Ink, Page
from batik_vector.geometry.outlines import Outlines, to_polygons, to_polylines
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.units import STEPS_PER_MM

SAG = 0.5
"""Steps by which chords about the ends of lines may lie within their arcs."""
LEAST = 16
"""Chords of a quarter of such an arc, at least."""


def inked(page: Page, ink: Ink, areas: Outlines, lines: Outlines) -> Geometries:
    """Return what an ink covers as polygons in steps that may overlap, and reach beyond the page.

    Of a tile's lines there are also those repeats whose bodies come into the tile.
    """
    filled = oriented(to_polygons(areas)) if len(areas) else np.empty(0, dtype=object)
    if not len(lines) or not ink.width > 0:
        return filled
    radius = ink.width * STEPS_PER_MM / 2
    chords = max(LEAST, math.ceil(round(math.pi / 4 / math.acos(max(1 - SAG / radius, 0.5)), 6)))
    body = shapely.buffer(to_polylines(lines), radius, quad_segs=chords)
    bodies = oriented(polygonal(shapely.set_precision(body, 1)))
    tile = isinstance(page, Artwork) and not page.bleed
    return np.concatenate([filled, repeated_into(page.cell, bodies) if tile else bodies])


def repeated_into(cell: Cell, marks: Geometries, margin: int = 0) -> Geometries:
    """Return marks (steps) with those of their repeats that come into the cell grown by a margin."""
    if not len(marks):
        return marks
    (ax, ay), (bx, by) = cell.lattice
    left, bottom, right, top = shapely.total_bounds(marks).tolist()
    far = (
        math.ceil((max(-left, right - ax, 0) + margin) / ax),
        math.ceil((max(-bottom, top - by, 0) + margin) / by),
    )
    found = [marks]
    bounds = shapely.bounds(marks)
    for i in range(-far[0] - 1, far[0] + 2):
        for j in range(-far[1] - 2, far[1] + 3):
            x, y = i * ax + j * bx, i * ay + j * by
            if x == y == 0:
                continue
            low, high = bounds[:, :2] + (x, y), bounds[:, 2:] + (x, y)
            near = (low < (cell.columns + margin, cell.rows + margin)).all(axis=1)
            near &= (high > -margin).all(axis=1)
            if near.any():
                found.append(moved(marks[near], x, y))
    return np.concatenate(found)


def moved(marks: Geometries, right: int, up: int) -> Geometries:
    """Return marks elsewhere."""
    return np.asarray(shapely.transform(marks, lambda xy: xy + (right, up)), dtype=object)
