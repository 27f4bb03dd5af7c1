"""Larger pieces of the infinite field than one tile: repeats and bleeds, welded across every seam.

The tile is cut once; here what a seam divided is joined again, so that no edge is left where no edge was
drawn, and whole marks are placed. The vertices on a seam are the same bits on both sides, and joining moves
nothing. A field is drawn piece by piece, as a cloth is.
"""

from __future__ import annotations

from batik_vector.artwork import Artwork, Cell, DropAxis, Ink, Layer, Margins, Page, dyeing_of
from batik_vector.errors import TooLargeError
from batik_vector.geometry.outlines import Outlines, to_polygons, to_polylines, together
from batik_vector.tiling.cloth.windows import PIECE, Filling
from batik_vector.tiling.cloth.yardage import Yardage, drawn_inks
from batik_vector.tiling.torus.torus import Window
from batik_vector.tiling.welding.stack import MAX_VERTICES
from batik_vector.units import STEPS_PER_MM, to_steps


def field_page(
    artwork: Artwork, across: int = 1, up: int = 1, bleed: float = 0.0, whole_lines: bool = False
) -> Yardage:
    """Return ``across`` × ``up`` tiles in one cell as a page, their marks whole and welded.

    The cell of a tile that repeats with a drop is larger by the counts and drops by what is left of it. The
    field goes on ``bleed`` mm beyond the cell on every side; with ``whole_lines`` lines go on by half their
    breadth more, so that both halves show of those along the page's edge.

    Raises:
        TooLargeError: where the field would have more vertices than any file can hold.
    """
    tile = artwork.cell
    along, other = (across, up) if tile.axis == DropAxis.COLUMN else (up, across)
    cell = Cell(tile.columns * across, tile.rows * up, (tile.drop * along) % 1 / other, tile.axis)
    side = to_steps(bleed)
    tiles = (cell.columns + 2 * side) * (cell.rows + 2 * side) / (tile.columns * tile.rows)
    count = round(tiles * artwork.vertex_count)
    if count > MAX_VERTICES:
        raise TooLargeError(f"the field would have about {count:,} vertices: ask for fewer repeats")
    return Yardage(
        title=artwork.title,
        cell=cell,
        margins=Margins(side, side, side, side),
        bleed=side / STEPS_PER_MM,
        cloth=artwork.cloth,
        tolerance=artwork.tolerance,
        provenance=artwork.provenance,
        vertex_count=count,
        filling=Filling(tile, Window(-side, -side, cell.columns + side, cell.rows + side), piece=PIECE),
        origin=(0, 0),
        drawn=tuple(drawn_inks(artwork)),
        dyeing=artwork.dyeing,
        whole_lines=whole_lines,
    )


def repeated(artwork: Artwork, across: int, up: int) -> Artwork:
    """Return an artwork of ``across`` × ``up`` tiles in one cell; see :func:`field_page`."""
    return collected(field_page(artwork, across, up))


def with_bleed(artwork: Artwork, bleed: float) -> Artwork:
    """Return the artwork with its geometry carried ``bleed`` mm beyond the cell on every side."""
    return collected(field_page(artwork, bleed=bleed))


def collected(page: Page) -> Artwork:
    """Return a page that comes in pieces as an artwork, without its guides: for pages that fit in memory."""
    layers = []
    for number, plate in enumerate(page.plates):
        if plate.guide:
            continue
        areas, lines = together(list(page.areas(number))), together(list(page.lines(number)))
        layers.append(_made(plate.ink, areas, lines))
    kept = tuple(layer for layer in layers if len(layer.areas) or len(layer.lines))
    return Artwork(
        page.title,
        page.cell,
        kept,
        page.cloth,
        page.tolerance,
        page.bleed,
        page.provenance,
        dyeing=dyeing_of(page),
    )


def _made(ink: Ink, areas: Outlines, lines: Outlines) -> Layer:
    """Return a layer in mm from outlines in steps: the place of k steps is the float k / 1000."""
    polygons, polylines = to_polygons(areas, STEPS_PER_MM), to_polylines(lines, STEPS_PER_MM)
    return Layer(ink, polygons, polylines, tuple(areas.names), tuple(lines.names))
