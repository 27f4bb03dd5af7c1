"""Larger pieces of the infinite field than one tile: repeats and bleeds, welded across every seam.

The tile is cut once; here what a seam divided is joined again, so that no edge is left where no edge was
drawn, and whole marks are placed. The vertices on a seam are the same bits on both sides, and joining moves
nothing.
"""

from __future__ import annotations

from dataclasses import replace

from batik_vector.artwork import Artwork, Cell, DropAxis, Ink, Layer, Overlap, Page
from batik_vector.errors import TooLargeError
from batik_vector.geometry.outlines import (
    MM,
    Outlines,
    of_polygons,
    of_polylines,
    to_polygons,
    to_polylines,
    together,
)
from batik_vector.tiling.cloth.filling import filled_areas, filled_lines
from batik_vector.tiling.cloth.whole_marks import Unrolled, unrolled_areas, unrolled_lines
from batik_vector.tiling.cloth.windows import Filling
from batik_vector.tiling.torus.torus import Window, to_mm
from batik_vector.tiling.welding.stack import MAX_VERTICES
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
    layers = tuple(_layer(layer, artwork.cell, window) for layer in artwork.layers)
    return replace(artwork, cell=cell, layers=layers, borders=frozenset())


def _layer(layer: Layer, cell: Cell, window: Window) -> Layer:
    filling = Filling(cell, window, piece=MAX_VERTICES)
    areas = together(list(filled_areas(unrolled(layer, cell), filling, welds(layer.ink))))
    lines = together(list(filled_lines(unrolled(layer, cell, lines=True), filling)))
    return _made(layer.ink, areas, lines)


def collected(page: Page) -> Artwork:
    """Return a page that comes in pieces as an artwork, without its guides: for pages that fit in memory."""
    layers = []
    for number, plate in enumerate(page.plates):
        if plate.guide:
            continue
        areas, lines = together(list(page.areas(number))), together(list(page.lines(number)))
        layers.append(_made(plate.ink, areas, lines))
    kept = tuple(layer for layer in layers if len(layer.areas) or len(layer.lines))
    return Artwork(page.title, page.cell, kept, page.cloth, page.tolerance, page.bleed, page.provenance)


def _made(ink: Ink, areas: Outlines, lines: Outlines) -> Layer:
    """Return a layer in mm from outlines in steps."""
    return Layer(
        ink, to_mm(to_polygons(areas)), to_mm(to_polylines(lines)), tuple(areas.names), tuple(lines.names)
    )


def welds(ink: Ink) -> bool:
    """Return whether marks of an ink that meet are one; those of an overlay stay single."""
    return ink.overlap != Overlap.OVERLAY


def unrolled(layer: Layer, cell: Cell, lines: bool = False) -> Unrolled:
    """Return the areas of a layer, or its lines, off the torus."""
    if lines:
        return unrolled_lines(replace(of_polylines(layer.lines, MM), names=layer.line_names), cell)
    areas = replace(of_polygons(layer.areas, MM), names=layer.area_names)
    return unrolled_areas(areas, cell, welds(layer.ink))
