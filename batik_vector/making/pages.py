"""What goes into a file: the tile set out or the cloth, as the processes of its output leave it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, BinaryIO

from batik_vector.artwork import Artwork, Page
from batik_vector.errors import Fault, GeometryError, RecipeError
from batik_vector.export import write_page
from batik_vector.machines.profile import Machine
from batik_vector.recipe.drawing import Svg
from batik_vector.recipe.model import OutputSpec, Recipe
from batik_vector.recipe.outputs import Piece
from batik_vector.units import STEPS_PER_MM

if TYPE_CHECKING:
    from batik_vector.importing.drawing.marks import Drawing


def piece_of(recipe: Recipe, output: OutputSpec) -> Piece:
    """Return what of a recipe's pattern an output shows."""
    return output.piece or (Piece.YARDAGE if recipe.yardage is not None else Piece.TILE)


def drawings_of(recipe: Recipe) -> Iterator[tuple[str, Drawing]]:
    """Yield the drawings of a recipe's motifs, with the motifs' names."""
    for name, motif in recipe.motif.items():
        if isinstance(motif, Svg) and motif.drawing is not None:
            yield name, motif.drawing


def render_output(page: Page, output: OutputSpec, sink: BinaryIO) -> Mapping[str, Any]:
    """Write a file: a cloth, or the tile repeated or carried beyond its edges as the output asks.

    What the compiler made is in the normal form, and is not asked again.

    Returns:
        What the processes that it went through have to report.
    """
    if isinstance(page, Artwork):
        page = _set_out(page, getattr(output, "repeat", (1, 1)), getattr(output, "bleed", 0.0))
    page, facts = prepared(page, output)
    write_page(page, sink, output.format, output.options, check=False)
    return facts


def prepared(page: Page, output: OutputSpec) -> tuple[Page, Mapping[str, Any]]:
    """Return a page as the processes of an output leave it, and what these have to report."""
    if not output.process:
        return page, {}
    from batik_vector.processes.travel import with_travel

    facts: dict[str, Any] = {}
    for number, process in enumerate(output.process):
        with _keyed(f"process[{number}]" if len(output.process) > 1 else "process"):
            page = done = process.apply(page, output.machine_profile or Machine())
        facts |= done.facts
    return (with_travel(done) if getattr(output, "travel", False) else page), facts


@contextmanager
def _keyed(key: str) -> Iterator[None]:
    """Give what a process finds wrong with one of its own keys as a fault of that key."""
    try:
        yield
    except GeometryError as error:
        from batik_vector.recipe.reading.faults import field_first

        name, words = field_first(str(error))
        raise RecipeError([Fault(words, f"{key}.{name}" if name else key)]) from error


def _set_out(tile: Artwork, repeat: tuple[int, int], bleed: float) -> Page:
    if repeat == (1, 1) and not bleed:
        return tile
    # Most files show the tile once, and do without all that fills a field with it.
    from batik_vector.tiling.cloth.field import field_page

    return field_page(tile, *repeat, bleed)


def size_of(page: Page, output: OutputSpec) -> list[float]:
    """Return the breadth and height of what a file shows, in mm."""
    if not isinstance(page, Artwork):
        return page_size(page)
    across, up = getattr(output, "repeat", (1, 1))
    margin = 2 * getattr(output, "bleed", 0.0)
    return [round(page.cell.width * across + margin, 3), round(page.cell.height * up + margin, 3)]


def page_size(page: Page) -> list[float]:
    """Return the breadth and height of a page with its margins, in mm."""
    margins = page.margins
    columns = page.cell.columns + margins.left + margins.right
    rows = page.cell.rows + margins.bottom + margins.top
    return [columns / STEPS_PER_MM, rows / STEPS_PER_MM]
