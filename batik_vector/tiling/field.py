"""Larger pieces of the infinite field than one tile: repeats and bleeds, welded across every seam.

The tile is cut once; here its pieces are set side by side and what a seam divided is joined again, so
that no edge is left where no edge was drawn. The vertices on a seam are the same bits on both sides,
and joining moves nothing.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Cell, DropAxis, Geometries, Layer, Overlap
from batik_vector.errors import TooLargeError
from batik_vector.geometry.regions import oriented
from batik_vector.tiling.once import drawn_once
from batik_vector.tiling.stack import MAX_VERTICES
from batik_vector.tiling.torus import Lattice, Window, clip_areas, clip_lines, to_mm, wrap
from batik_vector.tiling.weld import meeting, united, welded
from batik_vector.units import STEPS_PER_MM, to_steps


def repeated(artwork: Artwork, across: int, up: int) -> Artwork:
    """Return an artwork of ``across`` × ``up`` tiles in one cell, their marks whole and welded.

    The cell of a tile that repeats with a drop is larger by the counts and drops by what is left of it.
    """
    tile = artwork.cell
    along, other = (across, up) if tile.axis == DropAxis.COLUMN else (up, across)
    cell = Cell(tile.columns * across, tile.rows * up, (tile.drop * along) % 1 / other, tile.axis)
    return _field(artwork, cell, 0)


def with_bleed(artwork: Artwork, bleed: float) -> Artwork:
    """Return the artwork with its geometry carried ``bleed`` mm beyond the cell on every side."""
    return replace(_field(artwork, artwork.cell, to_steps(bleed)), bleed=to_steps(bleed) / STEPS_PER_MM)


def _field(artwork: Artwork, cell: Cell, bleed: int) -> Artwork:
    tiles = (cell.columns + 2 * bleed) * (cell.rows + 2 * bleed) / (artwork.cell.columns * artwork.cell.rows)
    if tiles * artwork.vertex_count > MAX_VERTICES:
        count = int(tiles * artwork.vertex_count)
        raise TooLargeError(f"the field would have about {count:,} vertices: ask for fewer repeats")
    window = Window(-bleed, -bleed, cell.columns + bleed, cell.rows + bleed)
    return replace(artwork, cell=cell, layers=_layers(artwork, window), borders=frozenset())


def _layers(artwork: Artwork, window: Window) -> tuple[Layer, ...]:
    return tuple(_layer(layer, artwork.cell, window) for layer in artwork.layers)


def _layer(layer: Layer, cell: Cell, window: Window) -> Layer:
    # By name and not by mark: the two halves of a line that a seam cut are two marks of one name.
    area_names, area_codes = np.unique(np.array(layer.area_names, dtype=str), return_inverse=True)
    line_names, line_codes = np.unique(np.array(layer.line_names, dtype=str), return_inverse=True)
    whole = layer.ink.overlap != Overlap.OVERLAY
    areas, area_codes = _welded(*_spread(layer.areas, area_codes, cell.lattice, window), cell, whole)
    areas, area_codes = clip_areas(areas, area_codes, window)
    lines, line_codes = _joined(*_spread(layer.lines, line_codes, cell.lattice, window), cell)
    # Cutting elsewhere may bring lines together that ran a hair apart.
    lines, line_codes = drawn_once(*clip_lines(lines, line_codes, window))
    return Layer(
        layer.ink,
        to_mm(oriented(areas)) if len(areas) else areas,
        to_mm(lines),
        tuple(area_names[area_codes].tolist()),
        tuple(line_names[line_codes].tolist()),
    )


def _spread(
    marks: Geometries, names: NDArray[np.intp], lattice: Lattice, window: Window
) -> tuple[Geometries, NDArray[np.intp]]:
    steps = shapely.transform(marks, lambda xy: np.rint(xy * STEPS_PER_MM)) if len(marks) else marks
    return wrap(np.asarray(steps, dtype=object), names, lattice, window)


def _on_seam(marks: Geometries, cell: Cell) -> NDArray[np.bool_]:
    """Return which marks reach an edge of the translate of the cell that they lie in.

    Only bounds are asked: a mark inside its tile cannot touch another tile's.
    """
    x0, y0, x1, y1 = shapely.bounds(marks).T
    (_, slip_y), (slip_x, _) = cell.lattice
    x, y = (x0 + x1) / 2, (y0 + y1) / 2
    if slip_x:
        row = np.floor(y / cell.rows)
        column = np.floor((x - row * slip_x) / cell.columns)
    else:
        column = np.floor(x / cell.columns)
        row = np.floor((y - column * slip_y) / cell.rows)
    left, low = column * cell.columns + row * slip_x, row * cell.rows + column * slip_y
    return np.asarray(
        (x0 <= left) | (y0 <= low) | (x1 >= left + cell.columns) | (y1 >= low + cell.rows), dtype=bool
    )


def _welded(
    areas: Geometries, names: NDArray[np.intp], cell: Cell, whole: bool
) -> tuple[Geometries, NDArray[np.intp]]:
    """Join areas that a seam divided: all that meet there, or the halves of one mark only.

    Areas of an ink that is not ``whole`` may lie over one another, and stay the marks they are.
    """
    if len(areas) < 2:
        return areas, names
    edge = np.flatnonzero(_on_seam(areas, cell))
    if len(edge) < 2:
        return areas, names
    joined, first = welded(areas[edge]) if whole else united(areas[edge], _halves(areas[edge], names[edge]))
    alone = np.ones(len(areas), bool)
    alone[edge] = False
    return np.concatenate([areas[alone], joined]), np.concatenate([names[alone], names[edge][first]])


def _halves(areas: Geometries, names: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return the pairs that are one mark cut by a seam: what they share ends in vertices of both."""
    pairs = meeting(areas)
    a, b = pairs.T
    pairs = pairs[(names[a] == names[b]) & shapely.relate_pattern(areas[a], areas[b], "F***1****")]
    a, b = pairs.T
    ends = shapely.boundary(shapely.line_merge(shapely.intersection(areas[a], areas[b])))
    corners = shapely.extract_unique_points(areas)
    return np.asarray(pairs[shapely.covers(corners[a], ends) & shapely.covers(corners[b], ends)])


def _joined(lines: Geometries, names: NDArray[np.intp], cell: Cell) -> tuple[Geometries, NDArray[np.intp]]:
    """Join lines that a seam cut, name by name."""
    if len(lines) < 2:
        return lines, names
    edge = _on_seam(lines, cell)
    parts, part_names = [lines[~edge]], [names[~edge]]
    for name in np.unique(names[edge]):
        mine = lines[edge & (names == name)]
        whole = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(mine)))
        parts.append(whole)
        part_names.append(np.full(len(whole), name, np.intp))
    return np.concatenate(parts), np.concatenate(part_names)
