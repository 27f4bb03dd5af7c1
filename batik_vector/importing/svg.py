"""A tile that any program drew, as an artwork: read from an SVG's geometry.

    read_tile("leaves.svg", "half-drop")

The page is one tile. Its sides come to whole micrometres, and with them, by as little, all that lies on it.
Marks are what the file draws, not the normal form: they may overlap and reach beyond the page, which cuts
them off in print as on the screen.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from batik_vector.artwork import Artwork, Cell, DropAxis, RawArtwork
from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.geometry.paths.matrix import Matrix, inverse_of, times
from batik_vector.geometry.paths.outline import CONTROL, CURVE, Outline, joined
from batik_vector.importing.bodies import bodies_on_rim
from batik_vector.importing.clips import clipped
from batik_vector.importing.document import Document, DrawingError, children, load, local, parse
from batik_vector.importing.inks import Marks, is_cloth, layers_of, painted
from batik_vector.importing.page import Page
from batik_vector.importing.painting import Bodies
from batik_vector.importing.polylines import Lines, flattened
from batik_vector.importing.scene import Shape
from batik_vector.importing.tilings import drawn
from batik_vector.importing.transforms import PX_PER_INCH
from batik_vector.tiling.symmetry.repeats import parse_repeat
from batik_vector.units import STEPS_PER_MM, format_mm
from batik_vector.values import frozen

TOLERANCE_MM = 0.005
ROUNDED_MM = 1e-6
"""What a page may be off whole micrometres without a word about it."""
WHOLE_MM = 0.02
"""How far a page in px may be off whole millimetres that it was meant to have."""
OTHER_PX_PER_INCH = 72
"""What older programs count; CSS counts 96."""
UNTITLED = "Untitled"
"""What a drawing is called that has no title."""
NAMESPACE = b"urn:x-batik-vector:provenance"
"""Ours, as :mod:`batik_vector.export.provenance` writes it."""


@frozen(eq=False)
class Reading:
    """A tile and how it was read.

    ``page`` is the size in mm that the file gives, before its sides came to whole micrometres. ``notes``
    say, for people, what was guessed, taken for something else or passed over. ``ours`` tells whether the
    file says that this program wrote it, ``curved`` whether it draws any curves. ``bodies`` are what it
    paints along the edges of its page, and ``unmeasured`` says what no certificate can answer for. ``onto``
    leads from the artwork's mm to the user units of the file's root, None where its page is not the tile.
    ``nodes`` are those of the paths that it draws, the cloth's left out.
    """

    artwork: Artwork
    page: tuple[float, float]
    notes: tuple[str, ...]
    ours: bool
    curved: bool
    bodies: Bodies
    unmeasured: tuple[str, ...] = ()
    onto: Matrix | None = None
    nodes: int = 0


@frozen(eq=False)
class Drawn:
    """All that a drawing paints, uncut, in mm on the page as a cell; ``ours`` as of :class:`Reading`."""

    document: Document
    page: Page
    cell: Cell
    marks: Marks
    ours: bool

    @property
    def title(self) -> str:
        """What the drawing is called."""
        return _title(self.document)


def read_tile(
    source: str | os.PathLike[str] | bytes, repeat: str = "grid", tolerance: float = TOLERANCE_MM
) -> Artwork:
    """Return the tile that an SVG draws on its page.

    Args:
        source: the path of the file, or its bytes.
        repeat: how tiles stand to one another: "grid", "half-drop", "brick", "drop p/q", "brick p/q".
        tolerance: mm; how far a polyline may stand from the curve that the file draws.

    Raises:
        DrawingError: where the file is no tile, or draws what is no geometry.
        GeometryError: where the repeat is none.
    """
    return read_svg(source, repeat, tolerance).artwork


def read_svg(
    source: str | os.PathLike[str] | bytes,
    repeat: str = "grid",
    tolerance: float = TOLERANCE_MM,
    bleed: float = 0.0,
) -> Reading:
    """Return the tile that an SVG draws, and how it was read; see :func:`read_tile`.

    Args:
        source: the path of the file, or its bytes.
        repeat: how tiles stand to one another.
        tolerance: mm.
        bleed: mm; how far the page reaches beyond the tile on every side.
    """
    found = read_marks(source, repeat, tolerance, bleed)
    document, page, cell, marks = found.document, found.page, found.cell, found.marks
    bodies = bodies_on_rim(marks, cell, tolerance)
    layers, cloth = layers_of(document, marks, cell, bleed, found.ours)
    page_notes(document, page, cell, bleed)
    artwork = RawArtwork(_title(document), cell, layers, cloth, tolerance, bleed)
    curved = any((shape.outline.kinds == CURVE).any() for shape in marks.shapes)
    notes, unmeasured = tuple(document.notes), tuple(document.unmeasured)
    onto = inverse_of(times(_flip(page, cell, bleed), page.matrix)) if page.whole else None
    size = (page.width, page.height)
    nodes = sum(int((s.outline.kinds != CONTROL).sum()) for s in marks.shapes if not is_cloth(s.label))
    return Reading(artwork, size, notes, found.ours, curved, bodies, unmeasured, onto, nodes)


def read_marks(
    source: str | os.PathLike[str] | bytes,
    repeat: str = "grid",
    tolerance: float = TOLERANCE_MM,
    bleed: float = 0.0,
) -> Drawn:
    """Return all that an SVG draws, uncut; arguments and errors as those of :func:`read_svg`."""
    drop, axis = parse_repeat(repeat)
    if not tolerance > 0:
        raise GeometryError(f"tolerance = {tolerance:g}, expected more than 0 mm")
    data, name = load(source)
    document = parse(data, name)
    page, shapes = drawn(document)
    cell = _cell(document, page, drop, axis, bleed)
    if not shapes:
        raise document.fault("nothing is drawn: no shape has a fill or a stroke that shows")
    try:
        marks = _marks(shapes, page, cell, tolerance, bleed)
    except TooLargeError as error:
        raise document.fault(str(error)) from error
    return Drawn(document, page, cell, marks, NAMESPACE in data)


def _cell(document: Document, page: Page, drop: Fraction, axis: DropAxis, bleed: float) -> Cell:
    """Return the page without its bleed as a cell: its sides in whole steps on which the drop lands."""
    sides = [(side - 2 * bleed) * STEPS_PER_MM for side in (page.width, page.height)]
    unit = [1, drop.denominator] if axis == DropAxis.COLUMN else [drop.denominator, 1]
    columns, rows = (round(side / each) * each for side, each in zip(sides, unit, strict=True))
    if columns < 1 or rows < 1:
        raise document.fault("is smaller than its bleed", document.root)
    return Cell(columns, rows, drop, axis)


def _flip(page: Page, cell: Cell, bleed: float) -> Matrix:
    """Return the map from a page's mm, y down, to those of its cell, y up."""
    across, up = cell.width / (page.width - 2 * bleed), cell.height / (page.height - 2 * bleed)
    return across, 0.0, 0.0, -up, -bleed * across, (page.height - bleed) * up


def _marks(shapes: list[Shape], page: Page, cell: Cell, tolerance: float, bleed: float) -> Marks:
    """Return what shapes paint in mm, y up, the cell's lower left corner at (0, 0)."""
    flip = _flip(page, cell, bleed)

    def flatten(outline: Outline) -> Lines:
        return flattened(outline.moved(flip), cell.width, cell.height, tolerance)

    outline = joined([shape.outline for shape in shapes])
    counts = np.array([len(shape.outline.closed) for shape in shapes], np.intp)
    marks = painted([shape.under(flip) for shape in shapes], flatten(outline), counts, outline.closed)
    return clipped(marks, flatten, tolerance)


def page_notes(document: Document, page: Page, cell: Cell, bleed: float) -> None:
    """Note what was guessed of the page's size, and what makes it doubtful."""
    if page.guessed:
        document.note(page.guessed)
    given = [side - 2 * bleed for side in (page.width, page.height)]
    if max(abs(given[0] - cell.width), abs(given[1] - cell.height)) > ROUNDED_MM:
        there = " × ".join(f"{side:.6f}".rstrip("0").rstrip(".") for side in given)
        whole = f"{format_mm(cell.width)} × {format_mm(cell.height)}"
        document.note(f"a page of {there} mm comes to {whole} mm in whole µm, and the drawing with it")
    sizes = [(document.root.get(side) or "0").strip() for side in ("width", "height")]
    pixels = any(size[-1:].isdigit() or size.endswith("px") for size in sizes)
    if pixels and "Illustrator" in document.generator:
        document.note("Illustrator counts 72 px to the inch, SVG 96: make sure that this is the size meant")
    elif pixels and not document.generator and not page.guessed:
        at_72 = [side * PX_PER_INCH / OTHER_PX_PER_INCH for side in given]
        if _roundness(at_72) > _roundness(given):
            there = " × ".join(format_mm(round(side)) for side in at_72)
            document.note(f"at 72 px to the inch the page would be {there} mm: check that 96 is meant")


def _roundness(sides: Sequence[float]) -> int:
    """Return how round sides (mm) are: 10 where they are whole centimetres, 1 for millimetres, or else 0."""
    for step in (10, 1):
        if all(side > step / 2 and abs(side - round(side / step) * step) <= WHOLE_MM for side in sides):
            return step
    return 0


def _title(document: Document) -> str:
    for child in children(document.root):
        if local(child) == "title":
            return " ".join("".join(child.itertext()).split())[:200] or UNTITLED
    return UNTITLED


__all__ = ["DrawingError", "Reading", "read_svg", "read_tile"]
