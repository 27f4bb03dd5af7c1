"""What is reported of what a job made, in plain values, and what its readers are warned of."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import shapely

from batik_vector.artwork import Artwork, Layer, Page
from batik_vector.export.png_chunks import per_metre
from batik_vector.making.pages import drawings_of, page_size, piece_of
from batik_vector.recipe.model import OutputSpec, Recipe
from batik_vector.recipe.outputs import PdfOutput, Piece, PngOutput, TiffOutput
from batik_vector.tiling.symmetry.machine_fit import pixel_advice
from batik_vector.units import format_mm

if TYPE_CHECKING:
    from batik_vector.tiling.cloth.yardage import Yardage


def facts_of(tile: Artwork | None, cloth: Yardage | None) -> dict[str, Any]:
    """Return what a report says of a tile and of the cloth that it fills, either of which may be missing."""
    facts: dict[str, Any] = {}
    page: Page | None = tile or cloth
    if page is not None:
        facts = {
            "title": page.title,
            "cell_mm": [page.cell.width, page.cell.height],
            "vertices": page.vertex_count,
            "layers": [],
        }
    if tile is not None:
        facts |= {"layers": [_layer(layer) for layer in tile.layers], **tile.facts}
    if cloth is not None:
        facts["yardage"] = {
            "size_mm": [cloth.cell.width, cloth.cell.height],
            "page_mm": page_size(cloth),
            "vertices_about": cloth.vertex_count,
            "inks": [plate.ink.name for plate in cloth.plates if not plate.guide],
            **cloth.facts,
        }
    return facts


def _layer(layer: Layer) -> dict[str, Any]:
    vertices = sum(int(shapely.get_num_coordinates(marks).sum()) for marks in (layer.areas, layer.lines))
    return {
        "ink": layer.ink.name,
        "colour": layer.ink.colour,
        "areas": len(layer.areas),
        "lines": len(layer.lines),
        "vertices": vertices,
    }


def warnings(recipe: Recipe, artwork: Artwork) -> list[str]:
    """Return what the recipe names and the artwork does not show, and tiles of broken pixels."""
    used = {name for _, placement in recipe.placements() for name in placement.motifs}
    drawn = {layer.ink.name for layer in artwork.layers}
    found = [f'motif "{name}" is placed nowhere' for name in recipe.motif if name not in used]
    found += [f'motif "{name}": {note}' for name, each in drawings_of(recipe) for note in each.notes]
    if not recipe.border:
        found += [f'ink "{name}" draws nothing' for name in recipe.ink if name not in drawn]
    for number, output in enumerate(recipe.output):
        # A picture of several repeats is a preview, and no tile to print from.
        tile = piece_of(recipe, output) == Piece.TILE
        picture = isinstance(output, PngOutput) and not output.options.bilevel
        if isinstance(output, PngOutput) and picture and tile and output.repeat == (1, 1):
            advice = pixel_advice(artwork.cell, output.dpi)
            found += [f"output[{number}]: {advice}"] if advice else []
    return found


def page_warnings(path: Path, output: OutputSpec, page: Page) -> list[str]:
    """Return what readers of a file may take wrongly."""
    if isinstance(output, TiffOutput) or (isinstance(output, PngOutput) and output.options.bilevel):
        return [f"{path.name}: {words}" for words in _plate_warnings(output, page)]
    if not isinstance(output, PdfOutput):
        return []
    from batik_vector.export.pdf.document import units_per_user_unit
    from batik_vector.export.pdf.separations import reckoned

    found = []
    if (unit := units_per_user_unit(page, output.options)) > 1:
        found.append(
            f"{path.name}: over 5.08 m long, and so in units of {unit} points (UserUnit): a program that "
            f'passes this over shows it {unit} times too small; pages = "tile" divides it over several'
        )
    if names := reckoned(page, output.options):
        inks = ", ".join(f'"{name}"' for name in names)
        found.append(
            f"{path.name}: CMYK of ink {inks} is reckoned from the colour on screen, by no press: "
            "cmyk = [...] of an ink gives its own"
        )
    return found


def _plate_warnings(output: TiffOutput | PngOutput, page: Page) -> Iterator[str]:
    """Yield what of a plate's pixels is not whole: those of a repeat, and those of a metre in a PNG."""
    if isinstance(page, Artwork) and (advice := pixel_advice(page.cell, output.dpi)):
        yield advice
    if isinstance(output, PngOutput) and (exact := output.dpi / 0.0254) != (whole := per_metre(output.dpi)):
        off = abs(exact / whole - 1) * page.cell.width
        if off >= 0.0005:
            yield (
                f"PNG counts whole pixels in a metre, {whole:,} for {output.dpi:g} dpi: by them the width is "
                f"{format_mm(round(off, 3))} mm off; TIFF says it exactly"
            )
