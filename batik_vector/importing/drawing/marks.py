"""The marks that a motif takes from an SVG: outlines, paints and pens in the drawing's millimetres, y up.

What has no one colour or no outline is refused, with the way out of it.
"""

from __future__ import annotations

import functools
import xml.etree.ElementTree as ET
from collections.abc import Container, Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np
import shapely

from batik_vector.errors import Fault, RecipeError
from batik_vector.geometry.paths.matrix import Matrix
from batik_vector.geometry.paths.outline import CONTROL, Outline, bounds_of, joined
from batik_vector.importing.clip_paths import FRAME_SLACK, Clip
from batik_vector.importing.document import Document, DrawingError, named
from batik_vector.importing.drawing.names import Called, Named, called, own_name, refuse_too_many
from batik_vector.importing.gradients import Gradient
from batik_vector.importing.inks import is_cloth
from batik_vector.importing.page import MM_PER_PX, Page, page_of
from batik_vector.importing.painting import Paint
from batik_vector.importing.pens import Pen
from batik_vector.importing.scene import Shape
from batik_vector.importing.transforms import PX_PER_INCH
from batik_vector.importing.walk import TILE_NOTES, Walker
from batik_vector.values import frozen

DRAWN, PAGE = "drawn", "page"
"""What may lie in the origin, beside a named element: the middle of all that is drawn, or of the page."""
WINDOW_PX = 1000.0
"""Sides of the window in which a drawing without a size is looked at."""
_GRADIENT = (
    "is painted with a gradient, and an ink has one colour; give it a flat one (Inkscape: Fill and Stroke → "
    "Flat color)"
)
_PATTERN = "is filled with a pattern; make it objects first (Inkscape: Object → Pattern → Pattern to Objects)"
_CLIPPED = "is clipped; cut it first (Inkscape: Object → Clip → Release Clip, then Path → Intersection)"


@frozen
class Wanted:
    """What a recipe asks of a drawing.

    ``elements`` and ``layers`` are names, with ``*`` for anything; nothing picks all. ``centre`` says what
    lies in the origin, ``px_per_inch`` how a page in px is measured.
    """

    elements: tuple[str, ...] = ()
    layers: tuple[str, ...] = ()
    centre: str = DRAWN
    px_per_inch: float = 96.0


@frozen(eq=False)
class Mark:
    """Something painted: its ``outline`` in mm, y up, and how it is filled and stroked.

    ``fill`` and ``stroke`` are ``#rrggbb`` or nothing; ``width`` is the stroke's, in mm. Where ``lean`` is
    given, the pen is distorted by that map; ``stroke_first`` says that the stroke lies under the fill.
    """

    name: str
    called: Called
    outline: Outline
    fill: str
    evenodd: bool
    stroke: str
    width: float
    pen: Pen
    lean: Matrix | None = None
    stroke_first: bool = False


class Drawing:
    """What was picked of an SVG, bottom first; ``text`` is the SVG that a compiled file carries.

    Drawings of equal texts are equal. ``notes`` tell people what was taken for something else, ``path`` is
    the file that was read, or nothing.
    """

    def __init__(self, marks: Sequence[Mark], text: str, notes: Sequence[str] = (), path: str = "") -> None:
        self.marks = tuple(marks)
        self.text = text
        self.notes = tuple(notes)
        self.path = path

    def __eq__(self, other: object) -> bool:
        return self.text == other.text if isinstance(other, Drawing) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.text)

    def __repr__(self) -> str:
        return f"Drawing of {len(self.marks)} marks"

    @functools.cached_property
    def sides(self) -> tuple[float, float]:
        """Breadth and height, in mm, of the box that holds the outlines."""
        left, low, right, high = bounds_of(joined([mark.outline for mark in self.marks]))
        return right - left, high - low

    def colours(self) -> tuple[str, ...]:
        """Return the colours of fills and strokes, in painting order."""
        found: dict[str, None] = {}
        for mark in self.marks:
            paints = (mark.fill, mark.stroke)
            found.update(dict.fromkeys(paints[::-1] if mark.stroke_first else paints))
        found.pop("", None)
        return tuple(found)


def read_drawing(
    document: Document, wanted: Wanted, kept: Container[ET.Element] | None
) -> tuple[list[Mark], list[str]]:
    """Return what a motif takes from a drawing, bottom first, and what is to be told about it.

    Args:
        document: read; it is left as it is.
        wanted: by the motif.
        kept: the elements that matter, as :func:`picked` returns them.

    Raises:
        DrawingError: where that is no geometry.
        RecipeError: where a name is none of the drawing's, by its key.
    """
    document = replace(document, notes=[], faults={}, unmeasured=[])
    page = _page(document, wanted)
    walker = Walker(document, page, kept)
    shapes = walker.walk()
    found = [(shape, called(shape.trail)) for shape in shapes]
    chosen = [(shape, how) for shape, how in found if how.meant(wanted.elements, wanted.layers)]
    if not (wanted.elements or wanted.layers):
        chosen = _without_ground(document, chosen, page)
    if not chosen:
        raise document.fault("nothing is drawn: no shape that was picked has a fill or a stroke that shows")
    for shape, _ in chosen:
        _refuse(document, shape)
    document.settle()
    x, y = _centre(document, wanted, [shape for shape, _ in chosen], walker)
    marks = [_mark(shape, how, (1.0, 0.0, 0.0, -1.0, -x, y)) for shape, how in chosen]
    return marks, _notes(document, [shape for shape, _ in chosen])


def picked(document: Document, wanted: Wanted) -> set[ET.Element] | None:
    """Return the elements that matter to a motif, all round them among them; None where all do.

    Raises:
        DrawingError: where it has far too many marks.
        RecipeError: for each name that picks nothing, by its key.
    """
    refuse_too_many(document)
    if not (wanted.elements or wanted.layers):
        return None
    names = Named(document)
    missed = [*names.missed("elements", wanted.elements), *names.missed("layer", wanted.layers)]
    if missed:
        raise RecipeError(missed)
    kept = names.picked(wanted.elements, wanted.layers)
    if not kept:
        raise RecipeError([Fault("none of the elements lies in the layer", "elements")])
    if wanted.centre not in (DRAWN, PAGE):
        kept |= names.around(names.one(wanted.centre, "centre"))
    return kept


def _page(document: Document, wanted: Wanted) -> Page:
    """Return the page; of a drawing that says no size, a window with its units as px."""
    try:
        return page_of(document, wanted.px_per_inch)
    except DrawingError:
        if document.root.get("viewBox") or wanted.centre == PAGE:
            raise
        if any((document.root.get(side) or "").strip()[-1:].isalpha() for side in ("width", "height")):
            raise
    scale = MM_PER_PX * PX_PER_INCH / wanted.px_per_inch
    side = WINDOW_PX * scale
    return Page(side, side, (scale, 0.0, 0.0, scale, 0.0, 0.0), (WINDOW_PX, WINDOW_PX))


Chosen: TypeAlias = list[tuple[Shape, Called]]


def _without_ground(document: Document, shapes: Chosen, page: Page) -> Chosen:
    """Leave out the cloth: what lies in a layer of that name, or else a first shape that holds the page."""
    left = [each for each in shapes if not any(is_cloth(layer) for layer in each[1].layers)]
    if len(left) == len(shapes) and len(left) > 1:
        first = left[0][0]
        if first.fill and not first.stroke and not first.clips and _holds(first.outline, page):
            document.note("the first shape is as large as the page: taken as the ground, and left out")
            left.pop(0)
    return left


def _holds(outline: Outline, page: Page) -> bool:
    """Whether an outline, of curves or not, is a rectangle that holds the page."""
    x0, y0, x1, y1 = bounds_of(outline)
    slack = FRAME_SLACK * max(page.width, page.height)
    inside = max(x0, y0) <= slack and x1 >= page.width - slack and y1 >= page.height - slack
    corners = outline.points[outline.kinds != CONTROL]
    if not inside or len(outline.closed) != 1 or len(corners) < 4:
        return False
    return bool(shapely.Polygon(corners).area >= (1 - FRAME_SLACK) * (x1 - x0) * (y1 - y0))


def _refuse(document: Document, shape: Shape) -> None:
    """Keep a fault where what is painted has no one colour, or is not all that its outline says."""
    element = shape.trail[-1]
    if shape.tiling is not None:
        document.refuse(element, _PATTERN)
    if any(not _cuts_nothing(clip, shape) for clip in shape.clips):
        document.refuse(element, _CLIPPED)
    for ink, look in zip((shape.fill, shape.stroke), shape.looks, strict=True):
        if ink and (look is None or look.ramp is not None) and not _is_flat(look):
            document.refuse(element, _GRADIENT)


def _is_flat(look: Paint | None) -> bool:
    """Whether a gradient has one colour from end to end, as swatches of Inkscape have."""
    ramp = look.ramp if look else None
    return isinstance(ramp, Gradient) and bool((ramp.colours == ramp.colours[0]).all())


def _cuts_nothing(clip: Clip, shape: Shape) -> bool:
    """Whether a clip is a mere frame, of straight sides and convex, round all that a shape paints."""
    points = clip.outline.points
    if len(clip.parts) != 1 or clip.parts[0].within or clip.parts[0].subpaths != 1 or len(points) < 3:
        return False
    frame = shapely.Polygon(points)
    hull = frame.convex_hull
    if not frame.is_valid or frame.area < (1 - FRAME_SLACK) * hull.area:
        return False
    reach = shape.width / 2 * max(shape.pen.limit, 1.5) if shape.stroke else 0.0
    slack = FRAME_SLACK * float(np.ptp(shape.outline.points, axis=0).max())
    room = hull.buffer(slack - reach, join_style="mitre")
    return bool(room.covers(shapely.MultiPoint(shape.outline.points)))


def _centre(
    document: Document, wanted: Wanted, shapes: Sequence[Shape], walker: Walker
) -> tuple[float, float]:
    """Return what comes to lie in the origin, in mm on the page, y down."""
    if wanted.centre == PAGE:
        return walker.page.width / 2, walker.page.height / 2
    if wanted.centre == DRAWN:
        x0, y0, x1, y1 = bounds_of(joined([shape.outline for shape in shapes]))
        return (x0 + x1) / 2, (y0 + y1) / 2
    element = Named(document).one(wanted.centre, "centre")
    box = walker.reach(element)
    if box is None:
        raise RecipeError([Fault(f'"{wanted.centre}": {named(element)} draws nothing', "centre")])
    return box[0] + box[2] / 2, box[1] + box[3] / 2


def _mark(shape: Shape, how: Called, onto: Matrix) -> Mark:
    lean = shape.lean
    if lean is not None:
        a, b, c, d, e, f = lean
        lean = a, -b, -c, d, e, f
    return Mark(
        own_name(shape.trail),
        how,
        shape.outline.moved(onto),
        shape.fill,
        shape.rule == "evenodd",
        shape.stroke,
        shape.width if shape.stroke else 0.0,
        shape.pen,
        lean if shape.stroke else None,
        shape.stroke_first,
    )


def _notes(document: Document, shapes: Sequence[Shape]) -> list[str]:
    """Return what people are told: without what the reader of tiles tells of seams."""
    notes = [each for each in document.notes if each not in TILE_NOTES]
    for shape in shapes:
        for ink, look in zip((shape.fill, shape.stroke), shape.looks, strict=True):
            if ink and look is not None and not look.solid and look.ramp is None:
                return [*notes, "what is half transparent is taken as solid"]
    return [*notes, *document.unmeasured]
