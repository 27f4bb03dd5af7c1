"""What goes into a file: the tile set out or the cloth, as the processes of its output leave it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any, BinaryIO, TypeAlias

from batik_vector.artwork import Artwork, Cell, Page
from batik_vector.errors import Fault, GeometryError, RecipeError
from batik_vector.export import FORMATS, swatch, write_page
from batik_vector.machines.profile import Machine
from batik_vector.processes.printing.options import SeparateProcess
from batik_vector.recipe.drawing import Svg
from batik_vector.recipe.model import OutputSpec, Recipe
from batik_vector.recipe.outputs import Piece, SwatchOutput
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.importing.drawing.marks import Drawing
    from batik_vector.processes.prepared import Prepared
    from batik_vector.processes.spec import ProcessSpec

_Asked: TypeAlias = "tuple[Page, tuple[ProcessSpec, ...], Machine]"
Done: TypeAlias = "tuple[Prepared | Artwork, Mapping[str, Any]]"
"""A page as processes leave it, and what they report."""


def piece_of(recipe: Recipe, output: OutputSpec) -> Piece:
    """Return what of a recipe's pattern an output shows."""
    return output.piece or (Piece.YARDAGE if recipe.yardage is not None else Piece.TILE)


def drawings_of(recipe: Recipe) -> Iterator[tuple[str, Drawing]]:
    """Yield the drawings of a recipe's motifs, with the motifs' names."""
    for name, motif in recipe.motif.items():
        if isinstance(motif, Svg) and motif.drawing is not None:
            yield name, motif.drawing


@frozen(eq=False)
class Part:
    """One of the files of an output: what goes into it, and what its name ends with.

    ``facts`` are what processes have had to report, where the page has been through them.
    """

    page: Page
    output: OutputSpec
    ending: str = ""
    facts: Mapping[str, Any] | None = None

    def after(self, before: Mapping[str, Any] | None) -> Part:
        """Return the part with what processes have had to report that its tile went through before."""
        return self if before is None else replace(self, facts={**before, **(self.facts or {})})


class Latest:
    """The last pages that went through processes: the next file of a recipe often asks for the same."""

    KEPT = 2
    """A tile that went through some, and what others made of the page that it was set out to."""

    def __init__(self) -> None:
        self._known: list[tuple[_Asked, Done]] = []

    def through(self, page: Page, output: OutputSpec) -> Done:
        """Return a page as the processes of an output, one at least, leave it, and what they report."""
        asked = page, output.process, output.machine_profile or Machine()
        for known, done in self._known:
            if known[0] is page and known[1:] == asked[1:]:
                return done
        done = _through(*asked)
        self._known = [*self._known, (asked, done)][-self.KEPT :]
        return done


def done_to_tile(
    tile: Artwork | None, page: Page, output: OutputSpec, latest: Latest, filled: Callable[[Artwork], Page]
) -> tuple[Page, OutputSpec, Mapping[str, Any] | None]:
    """Return a page made of its tile as the processes leave this that are done to the tile, and the rest.

    Args:
        tile: of the recipe, if it has one.
        page: the tile, or a cloth.
        output: what is asked of it.
        latest: what went through processes before.
        filled: returns the cloth that a tile fills.

    Returns:
        The page, the output with the processes that are left, and what those before them have to report.

    Raises:
        RecipeError: where a process has to be done to the tile, and there is none or it stands too late.
    """
    first = next((k for k, each in enumerate(output.process) if not each.of_tile), len(output.process))
    for number, each in enumerate(output.process[first:], first):
        if each.of_tile:
            words = f'"{each.kind}", expected before what is not done to the tile: it repeats with it'
            raise RecipeError([Fault(words, f"process[{number}].kind")])
    if not first:
        return page, output, None
    if tile is None:
        words = f'"{output.process[0].kind}" is done to the tile, and the recipe has borders alone'
        raise RecipeError([Fault(words, "process")])
    with renumbered(0, len(output.process)):
        done, facts = latest.through(tile, replace(output, process=output.process[:first]))
    assert isinstance(done, Artwork)
    made = done if page is tile else filled(done)
    return made, replace(output, process=output.process[first:]), facts


@contextmanager
def renumbered(before: int, total: int) -> Iterator[None]:
    """Give faults of some of an output's processes the keys that these have among all.

    Args:
        before: how many stand before them.
        total: how many there are.
    """
    try:
        yield
    except RecipeError as error:

        def key(found: re.Match[str]) -> str:
            return f"process[{before + int(found[1] or 0)}]" if total > 1 else "process"

        faults = [replace(each, key=_PROCESS.sub(key, each.key)) for each in error.faults]
        raise RecipeError(faults) from error


_PROCESS = re.compile(r"^process\b(?:\[(\d+)\])?")


def divided(page: Page, output: OutputSpec, latest: Latest) -> list[Part]:
    """Return the files of an output: one, unless its format divides what is too large for it.

    A process may leave several pages. What a format divides goes through its processes first, once for all
    parts.
    """
    output = output.completed()
    for number, process in enumerate(output.process):
        with _keyed(_process_key(output.process, number)):
            found = process.parts(page)
        if found:
            before, after = output.process[:number], output.process[number + 1 :]
            each = [(name, replace(output, process=(*before, own, *after))) for name, own in found]
            return [
                replace(part, ending=f"-{name}{part.ending}")
                for name, own in each
                for part in divided(page, own, latest)
            ]
    kind = FORMATS[output.format]
    if not kind.divides(output.options):
        return [Part(page, output)]
    page, facts = finished(page, output, latest)
    done, told = replace(output, process=()), facts if output.process else None
    parts = kind.parts(page, output.options)
    if not parts:
        return [Part(page, done, facts=told)]
    return [Part(page, replace(done, **own), f"-{name}", told) for name, own in parts]


def render_output(page: Page, output: OutputSpec, sink: BinaryIO, latest: Latest) -> Mapping[str, Any]:
    """Write a file: a cloth, or the tile repeated or carried beyond its edges as the output asks.

    What the compiler made is in the normal form, and is not asked again.

    Returns:
        What the processes that it went through have to report.
    """
    page, facts = finished(page, output, latest)
    write_page(page, sink, output.format, output.options, check=False)
    return facts


def finished(page: Page, output: OutputSpec, latest: Latest) -> tuple[Page, Mapping[str, Any]]:
    """Return a page as an output shows it and its processes leave it, and what these have to report."""
    if isinstance(page, Artwork) and _separates(output):
        # The plate of the tile is set out, so that lines come as areas with both halves at its edges.
        names = [layer.ink.name for layer in page.layers]
        done, facts = prepared(page, output, latest)
        if isinstance(done, Artwork):
            return _set_out(done, output, names), facts
    if isinstance(page, Artwork):
        page = _set_out(page, output)
    elif getattr(output, "marks", False):
        page = _marked(page)
    return prepared(page, output, latest)


def prepared(page: Page, output: OutputSpec, latest: Latest | None = None) -> tuple[Page, Mapping[str, Any]]:
    """Return a page as the processes of an output leave it, and what these have to report."""
    if not output.process:
        return page, {}
    done, facts = (latest or Latest()).through(page, output)
    if not getattr(output, "travel", False) or isinstance(done, Artwork):
        return done, facts
    from batik_vector.processes.travel import with_travel

    return with_travel(done), facts


def _through(page: Page, processes: Sequence[ProcessSpec], machine: Machine) -> Done:
    facts: dict[str, Any] = {}
    for number, process in enumerate(processes):
        with _keyed(_process_key(processes, number)):
            page = done = process.apply(page, machine)
        facts |= done.facts
    return done, facts


def _process_key(processes: Sequence[ProcessSpec], number: int) -> str:
    """Return the key of one of several processes, or of the one there is."""
    return f"process[{number}]" if len(processes) > 1 else "process"


@contextmanager
def _keyed(key: str) -> Iterator[None]:
    """Give what a process finds wrong with one of its own keys as a fault of that key."""
    try:
        yield
    except GeometryError as error:
        from batik_vector.recipe.reading.faults import field_first

        name, words = field_first(str(error))
        raise RecipeError([Fault(words, f"{key}.{name}" if name else key)]) from error


def _extent(tile: Artwork, output: OutputSpec) -> tuple[tuple[int, int], float]:
    """Return how many tiles across and up an output shows, and how far (mm) they go on beyond."""
    if isinstance(output, SwatchOutput):
        return swatch.repeats(tile.cell), swatch.overscan(tile.cell)
    return getattr(output, "repeat", (1, 1)), getattr(output, "bleed", 0.0)


def _separates(output: OutputSpec) -> bool:
    return bool(output.process) and isinstance(output.process[-1], SeparateProcess)


def _set_out(tile: Artwork, output: OutputSpec, names: Sequence[str] = ()) -> Page:
    """Return a tile as an output shows it; ``names`` are of all inks, where it is the plate of one."""
    (across, up), bleed = _extent(tile, output)
    marks = getattr(output, "marks", False)
    # What a machine is to follow is not drawn twice.
    whole = getattr(output, "wraps", False) and not output.process
    whole = whole and any(len(layer.lines) for layer in tile.layers)
    if across == up == 1 and not (bleed or marks or whole):
        return tile
    # Most files show the tile once, and do without all that fills a field with it.
    from batik_vector.tiling.cloth.field import field_page

    page = field_page(tile, across, up, bleed, whole)
    return _marked(page, names) if marks else page


def _marked(page: Page, names: Sequence[str] = ()) -> Page:
    from batik_vector.tiling.cloth.print_marks import with_print_marks
    from batik_vector.tiling.cloth.yardage import Yardage

    return with_print_marks(page, names) if isinstance(page, Yardage) else page


def size_of(page: Page, output: OutputSpec) -> list[float]:
    """Return the breadth and height of what a file shows, in mm."""
    marks = getattr(output, "marks", False)
    if not isinstance(page, Artwork):
        return page_size(_marked(page) if marks else page)
    (across, up), bleed = _extent(page, output)
    width, height = page.cell.width * across, page.cell.height * up
    if marks:
        from batik_vector.tiling.cloth.print_marks import marked_margins

        field = Cell(page.cell.columns * across, page.cell.rows * up)
        margins = marked_margins(field, bleed, page.title, [each.ink.name for each in page.layers])
        beside, below = margins.left + margins.right, margins.bottom + margins.top
        return [round(width + beside / STEPS_PER_MM, 3), round(height + below / STEPS_PER_MM, 3)]
    if isinstance(output, SwatchOutput):
        # Of a swatch it is what repeats that one asks for.
        return [round(width, 3), round(height, 3)]
    return [round(width + 2 * bleed, 3), round(height + 2 * bleed, 3)]


def page_size(page: Page) -> list[float]:
    """Return the breadth and height of a page with its margins, in mm."""
    margins = page.margins
    columns = page.cell.columns + margins.left + margins.right
    rows = page.cell.rows + margins.bottom + margins.top
    return [columns / STEPS_PER_MM, rows / STEPS_PER_MM]
