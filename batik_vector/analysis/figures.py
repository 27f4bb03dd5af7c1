"""Figures of a whole drawing: what its inks cover, how broad its lines are, of how many nodes it is made."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from batik_vector.analysis.marks import ROUND_ENDS, joined, sound
from batik_vector.artwork import Cell, Geometries, Layer

LINE_LIKE = 8.0
"""How many times its breadth an area is long that was drawn as a line."""


def coverage(layers: Sequence[Layer], cell: Cell) -> tuple[float, dict[str, float]]:
    """Return the share of the page that is covered by all inks together, and by each by its name."""
    page = shapely.box(0, 0, cell.width, cell.height)
    inks: dict[str, list[Geometries]] = {}
    for layer in layers:
        bodies = shapely.buffer(
            np.asarray(layer.lines, dtype=object), layer.ink.width / 2, quad_segs=ROUND_ENDS
        )
        inks.setdefault(layer.ink.name, []).append(np.concatenate([sound(layer.areas), sound(bodies)]))
    welded = {name: joined(np.concatenate(parts)) for name, parts in inks.items()}
    every = joined(np.concatenate(list(welded.values()))) if welded else np.empty(0, dtype=object)
    size = cell.width * cell.height
    return _on(every, page) / size, {name: _on(areas, page) / size for name, areas in welded.items()}


def _on(areas: Geometries, page: shapely.Polygon) -> float:
    if not len(areas):
        return 0.0
    low_x, low_y, high_x, high_y = shapely.bounds(areas).T
    _, _, width, height = page.bounds
    cut = (low_x < 0) | (low_y < 0) | (high_x > width) | (high_y > height)
    return float(shapely.area(areas[~cut]).sum() + shapely.area(shapely.intersection(areas[cut], page)).sum())


def line_widths(layers: Sequence[Layer]) -> tuple[float, float] | None:
    """Return the least and the greatest breadth (mm) of lines, and of areas drawn as lines; None without any.

    Of an area of even breadth w and length l area and perimeter tell both: A = l·w, P = 2l + 2w.
    """
    found = [np.full(len(layer.lines), layer.ink.width) for layer in layers]
    areas = np.concatenate([sound(layer.areas) for layer in layers]) if layers else np.empty(0, dtype=object)
    area, around = shapely.area(areas), shapely.length(areas)
    breadth = (around - np.sqrt(np.maximum(around**2 - 16 * area, 0.0))) / 4
    line = (breadth > 0) & (area >= LINE_LIKE * breadth**2)
    every = np.concatenate([*found, breadth[line]])
    return (float(every.min()), float(every.max())) if len(every) else None


def nodes(layers: Sequence[Layer]) -> int:
    """Return the vertices of all areas and lines, the end of a ring not counted once more."""
    count = 0
    for layer in layers:
        rings = shapely.get_rings(layer.areas) if len(layer.areas) else layer.areas
        count += int((shapely.get_num_coordinates(rings) - 1).sum()) if len(rings) else 0
        closed = shapely.is_closed(layer.lines)
        count += int((shapely.get_num_coordinates(layer.lines) - closed).sum())
    return count
