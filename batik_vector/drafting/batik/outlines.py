"""Outlines: the edge between two cells is drawn once, in the colour of the line round the upper one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.drafting.batik.pages import Filled, Line
from batik_vector.geometry.sampling import Indices

SNAP = 0.002
"""mm: edges this near to one another are one."""
LEAST = 0.05
"""mm: shorter edges are left out; the round ends of what meets there cover them."""


def outlines(cells: Sequence[Filled]) -> list[Line]:
    """Return the outlines of all cells, each with the number of its colour, those of one colour together."""
    bounds = shapely.boundary(np.array([each.shape for each in cells], dtype=object))
    edges = shapely.get_parts(shapely.union_all(bounds, grid_size=SNAP))
    middle = shapely.line_interpolate_point(edges, 0.5, normalized=True)
    upper = np.full(len(edges), -1, np.intp)
    asked, found = shapely.STRtree(bounds).query(middle, predicate="dwithin", distance=2 * SNAP)
    np.maximum.at(upper, asked, found)
    colour: Indices = np.array([each.line for each in cells], np.intp)[upper]
    drawn: list[Line] = []
    for number in np.unique(colour[upper >= 0]).tolist():
        mine = edges[(colour == number) & (upper >= 0)]
        merged = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(mine)))
        drawn += [(line, number) for line in open_lines(merged[shapely.length(merged) >= LEAST])]
    return drawn


def open_lines(lines: Geometries) -> Geometries:
    """Return lines, rings in two halves: what a drawing closes is an area."""
    found: list[shapely.LineString] = []
    for line, closed in zip(lines, shapely.is_closed(lines), strict=True):
        points = shapely.get_coordinates(line)
        if not closed:
            found.append(line)
            continue
        half = len(points) // 2
        found += [shapely.LineString(points[: half + 1]), shapely.LineString(points[half:])]
    return np.array(found, dtype=object)
