"""From the drawing of a tile to a recipe: the story, told once.

What a drawing paints is taken as areas in painting order; marks are taken whole on the torus and sorted into
copies of few motifs; the symmetry group that the certificate finds says which of them need to be placed. The
recipe is compiled at last, and what it draws compared with the drawing.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Cell, Geometries, Ink, Layer
from batik_vector.certificate.symmetry.finder import found_group
from batik_vector.certificate.symmetry.operations import FoundGroup
from batik_vector.drafting.asymmetric import asymmetric
from batik_vector.drafting.composing import Ground, Page, Placed, composed
from batik_vector.drafting.copies import Copies, found_copies
from batik_vector.drafting.ink_names import ink_names
from batik_vector.drafting.marks import BARE, Painted, levels, painted_areas, shown
from batik_vector.drafting.proof import Proof, compared
from batik_vector.drafting.units import Unit, units
from batik_vector.drafting.whole import Whole, made_whole
from batik_vector.errors import BatikError, GeometryError
from batik_vector.geometry.regions import polygonal
from batik_vector.importing.inks import WHITE, on_cloth
from batik_vector.importing.svg import UNTITLED, Drawn, page_notes, read_marks
from batik_vector.recipe.reading.sources import with_carried
from batik_vector.tiling.torus.torus import (
    Window,
    clip_areas,
    polygons_of,
    to_mm,
    to_step_grid,
    translate,
    translates,
)
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

Index = NDArray[np.intp]
Tell = Callable[[str], None]
Compile = Callable[[str], Artwork]
"""What makes a tile of a recipe's text."""

MOST_MARKS = 50_000
"""Marks past which a drawing is refused: a recipe of as many placements is none to work on."""
FINER = 8
"""How much more finely than the recipe asks a drawing is read, and curves are fitted to it."""


@frozen(eq=False)
class Draft:
    """A recipe that was made of a drawing, and how well it draws the same.

    ``text`` is the recipe, ``drawing`` an SVG with what of it is too long for a recipe, or nothing.
    ``group`` is the symmetry group of the drawing and ``unit`` the repeat that the recipe names. Of so many
    ``marks`` of as many kinds as there are ``motifs``, endless ones left out, so many are ``placed``.
    """

    text: str
    drawing: str
    inks: tuple[str, ...]
    group: FoundGroup
    unit: Unit
    marks: int
    motifs: int
    placed: int
    proof: Proof
    notes: tuple[str, ...] = ()

    @property
    def weight(self) -> int:
        """How long the recipe is."""
        return len(self.text) + len(self.drawing)


def drafted(
    source: str | os.PathLike[str] | bytes,
    compiled: Compile,
    repeat: str = "grid",
    tolerance: float = 0.02,
    beside: str = "",
    tell: Tell = lambda stage: None,
) -> Draft:
    """Return a recipe that draws the cloth that a drawing's page repeats to.

    Args:
        source: the path of an SVG, or its bytes.
        compiled: what makes a tile of a recipe's text, for the proof.
        repeat: how pages stand to one another: "grid", "half-drop", "brick", "drop p/q", "brick p/q".
        tolerance: mm; how far what the recipe draws may stand from the drawing.
        beside: the name of the drawing that a recipe may have beside it; without it, it has none.
        tell: called with a word or two as each stage begins.

    Raises:
        DrawingError: where the drawing cannot be read.
        GeometryError: where the repeat is none.
    """
    tell("reading")
    drawn = read_marks(source, repeat, tolerance / FINER)
    title = drawn.title
    if title == UNTITLED and not isinstance(source, bytes):
        title = Path(source).stem
    sketch = _Sketch(drawn, title, repeat, tolerance, beside, compiled, tell)
    draft = sketch.draft(sketch.painted)
    if not draft.proof.holds or draft.unit.copies < sketch.units[0].copies:
        # Where marks are stacked as no sheets can be, or are put together otherwise than the picture is
        # repeated, what is seen of each ink is drawn, side by side.
        flat = sketch.draft(sketch.flat())
        draft = min(draft, flat, key=lambda each: (not each.proof.holds, each.weight))
    if drawn.ours:
        drawn.document.note("it may carry the recipe that it was compiled from: compile it to know")
    page_notes(drawn.document, drawn.page, drawn.cell, 0.0)
    return replace(draft, notes=tuple(drawn.document.notes))


class _Sketch:
    """A drawing, and what is found out about it but once."""

    def __init__(
        self,
        drawn: Drawn,
        title: str,
        repeat: str,
        tolerance: float,
        beside: str,
        compiled: Compile,
        tell: Tell,
    ) -> None:
        self.tolerance, self.beside, self.compiled, self.tell = tolerance, beside, compiled, tell
        self.cell, self.title = drawn.cell, title
        marks, cloth = on_cloth(drawn.document, drawn.marks, drawn.cell, 0.0)
        self.cloth = cloth or WHITE
        self.painted = painted_areas(marks, self.cloth, tolerance / FINER, bare=bool(cloth))
        tell("looking at the page")
        self.seen = self._seen()
        tell("finding the group")
        layers = [
            Layer(Ink(colour, colour), areas=polygonal(seen))
            for colour, seen in zip(self.painted.colours, self.seen, strict=True)
        ]
        self.group = found_group(layers, self.cell, tolerance)
        self.units = units(self.group, self.cell, repeat)

    def _seen(self) -> list[shapely.Geometry]:
        """Return what the page shows of each ink."""
        page = shapely.box(0.0, 0.0, self.cell.width, self.cell.height)
        inside = shapely.intersection(self.painted.shapes, page)
        shapes, of = polygons_of(inside, np.arange(len(inside)))
        ink, inks = self.painted.ink[of], len(self.painted.colours)
        level = levels(shapes, ink, of, self.tolerance / FINER)[of]
        kind = level * (inks + 1) + np.where(ink == BARE, inks, ink)
        count = (int(level.max(initial=0)) + 1) * (inks + 1)
        return shown([shapes[kind == each] for each in range(count)], inks)

    def flat(self) -> Painted:
        """Return what is seen of each ink as marks of their own."""
        parts = [polygonal(seen) for seen in self.seen]
        shapes = np.concatenate([np.empty(0, dtype=object), *parts])
        ink = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
        return replace(self.painted, shapes=shapes, ink=ink, names=np.full(len(shapes), "", dtype=object))

    def draft(self, painted: Painted) -> Draft:
        """Return the recipe of some marks."""
        self.tell("taking marks whole")
        whole = made_whole(painted, self.cell, self.tolerance)
        level = _stacked(whole, self.cell, self.tolerance / FINER)
        # Where nothing is beneath it the cloth needs no cutting.
        shows = (whole.ink != BARE) | (level > 0)
        whole, level = whole.only(shows), level[shows]
        marks = whole.marks
        if len(marks) > MOST_MARKS:
            raise GeometryError(
                f"a drawing of {len(marks):,} marks is a picture and no pattern to be placed mark by mark, "
                f"expected at most {MOST_MARKS:,}"
            )
        self.tell("finding copies")
        copies = found_copies(marks.shapes, marks.ink, self.tolerance)
        mine = level[: len(marks)]
        unit, chosen = self._unit(marks, copies, mine)
        pieces = _in_unit(whole.pieces, unit.tile.unit(), self.cell)
        rest = level[len(marks) :][pieces.mark]
        page = Page(self.title, self.cloth, self.painted.colours, self.tolerance, unit, self.group)
        placed = Placed(marks, copies, mine, chosen)
        ground = Ground(pieces.shapes, whole.pieces.ink[pieces.mark], rest)
        made = composed(page, placed, ground, self.beside)
        self.tell("comparing")
        carried = with_carried(made.text, {self.beside: made.drawing} if made.drawing else {})
        proof = compared(self.compiled(carried), self.seen, self.painted.colours, self.cell, self.tolerance)
        inks = tuple(ink_names(self.painted.colours))
        return Draft(
            made.text, made.drawing, inks, self.group, unit, len(marks), len(copies.heads), len(chosen), proof
        )

    def _unit(self, marks: Painted, copies: Copies, level: Index) -> tuple[Unit, Index]:
        """Return the unit that needs the fewest marks placed, and these."""
        for unit in self.units[:-1]:
            try:
                chosen = asymmetric(unit, marks.shapes, copies, level, self.tolerance)
            except BatikError:
                continue
            if chosen is not None:
                return unit, chosen
        return self.units[-1], np.arange(len(marks))


def _stacked(whole: Whole, cell: Cell, hair: float) -> Index:
    """Return how high marks and pieces lie on the torus, shape (marks + pieces,)."""
    shapes = np.concatenate([whole.marks.shapes, whole.pieces.shapes])
    ink = whole.ink
    # Ranks without gaps, so that marks and pieces are told by them.
    rank = np.empty(len(shapes), np.intp)
    rank[np.argsort(whole.order, kind="stable")] = np.arange(len(shapes))
    which, shift = translates(
        shapely.bounds(shapes).reshape(-1, 4) * STEPS_PER_MM,
        cell.lattice,
        Window(0, 0, cell.columns, cell.rows),
    )
    there = translate(shapes[which], shift / STEPS_PER_MM)
    return levels(there, ink[which], rank[which], hair)[rank]


@frozen(eq=False)
class _Pieces:
    """Pieces in a unit, and of which mark each is."""

    shapes: Geometries
    mark: Index


def _in_unit(pieces: Painted, unit: Cell, cell: Cell) -> _Pieces:
    """Return pieces, which lie in a cell, as they lie in a unit of its pattern."""
    none = np.arange(len(pieces))
    if not len(pieces) or (unit.columns, unit.rows) == (cell.columns, cell.rows):
        return _Pieces(pieces.shapes, none)
    steps, of = polygons_of(to_step_grid(pieces.shapes), none)
    window = Window(0, 0, unit.columns, unit.rows)
    which, shift = translates(shapely.bounds(steps).reshape(-1, 4), cell.lattice, window)
    found, mark = clip_areas(translate(steps[which], shift), of[which], window)
    return _Pieces(to_mm(found), mark)
