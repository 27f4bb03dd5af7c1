"""A motif that is an SVG drawing: what of it is picked, and how its marks are dressed.

The geometry is read by :mod:`batik_vector.importing.drawing`; here stands what a recipe says about it.
"""

from __future__ import annotations

import functools
import os
from collections.abc import Callable, Container, Sequence
from dataclasses import field, replace
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

from batik_vector.errors import Fault, GeometryError, RecipeError
from batik_vector.fields import HIDDEN, Between, Colour, Converted, Length, Names, Says, check
from batik_vector.recipe.fills import AnyFill, Isen, Style
from batik_vector.recipe.look import Dress, Treatment
from batik_vector.values import frozen

if TYPE_CHECKING:
    import xml.etree.ElementTree as ET

    from batik_vector.geometry.sampling import Array, Geometries, Points
    from batik_vector.importing.document import Document
    from batik_vector.importing.drawing.marks import Drawing, Mark, Wanted

NO_NAMES = ""
"""Stands for all elements, and for all layers."""


@frozen(kw_only=True)
class Part(Dress):
    """A part of a drawing with its look: what a mark fills, or what its stroke covers."""

    name: Annotated[str, Says("what it is called in the file")] = ""

    count: ClassVar[int] = 1
    """It stands where the drawing has it, once."""


@frozen(kw_only=True)
class Look:
    """The look of marks; what is left out is as a wider look has it, or as it is drawn."""

    ink: Annotated[str, Says("ink they are drawn with; the placement's when left out")] = ""
    line_ink: Annotated[str, Says('ink of the line of treatment "both"')] = ""
    treatment: Annotated[
        Treatment | None,
        Says("filled, as lines, as lines of the ink's width, both, or cut out; as drawn when left out"),
    ] = None
    gap: Annotated[
        Annotated[Length, Between(0, 1000)] | None,
        Says("ground kept bare round them by cutting what lies beneath"),
    ] = None
    whole: Annotated[bool | None, Says("left out, not cut, where something above would cut them")] = None
    fill_with: Annotated[
        AnyFill | None, Says("marks that fill what is filled (isen): dots, lines, scales and more")
    ] = None

    def __post_init__(self) -> None:
        check(self)

    def over(self, wider: Look) -> Look:
        """Return this look with what it leaves out as a wider one has it."""
        return Look(
            ink=self.ink or wider.ink,
            line_ink=self.line_ink or wider.line_ink,
            treatment=wider.treatment if self.treatment is None else self.treatment,
            gap=wider.gap if self.gap is None else self.gap,
            whole=wider.whole if self.whole is None else self.whole,
            fill_with=self.fill_with or wider.fill_with,
        )


@frozen(kw_only=True)
class Dressing(Look):
    """The look of some marks of a drawing; of several that mean a mark, the later ones have the last word."""

    elements: Annotated[Names, Says("names of elements or groups, * for anything; all when left out")] = (
        NO_NAMES
    )
    layer: Annotated[Names, Says("names of layers, * for anything; all when left out")] = NO_NAMES
    colour: Annotated[Colour | None, Says("colour of the fill or stroke meant; any when left out")] = None

    def refuse_in_vain(self, marks: Sequence[Mark], key: str) -> None:
        """Raise where no mark is meant, by the key of the name or colour that none has."""
        from batik_vector.importing.drawing.names import is_like, missing

        asked = (
            ("elements", several(self.elements), [mark.called.names for mark in marks]),
            ("layer", several(self.layer), [mark.called.layers for mark in marks]),
            ("colour", (self.colour,) if self.colour else (), [(m.fill, m.stroke) for m in marks]),
        )
        for what, patterns, names in asked:
            known = list(dict.fromkeys(name for each in names for name in each if name))
            for number, pattern in enumerate(patterns):
                if not is_like(pattern, known):
                    words = missing(pattern, known, what.removesuffix("s"))
                    place = f"[{number}]" if isinstance(getattr(self, what), tuple) else ""
                    raise RecipeError([Fault(words, f"{key}.{what}{place}")])


def _drawing(value: Any) -> Any:
    """Return a drawing, or None for none."""
    if value is not None and type(value).__name__ != "Drawing":
        raise TypeError
    return value


@frozen(kw_only=True)
class Svg(Look):
    """A drawing in SVG that stands beside the recipe; a unit is a millimetre of the drawing, y up.

    Fills are areas, strokes areas of the breadth that they are drawn with; both grow with the motif, and
    curves are sampled to the recipe's tolerance at the size at which they come to lie. A treatment draws
    outlines instead: ``line`` and ``stroke`` their course, ``area`` what they close round; ``cut`` leaves
    bare what is drawn. Elements go by their ids and by the labels of Inkscape, Affinity and Illustrator, and
    are picked by the names of their groups too. A first shape as large as the page is taken as the ground
    and left out. With ``colours`` what lies higher cuts what lies beneath, as it shows in the drawing.
    With ``batik`` all that is filled has isen, chosen by its size and depth on cloth, and the line round it
    is as broad as its ink; a ``fill_with`` of its own, or of a dress, goes before.

    Text, pictures, gradients, patterns, clips, masks and filters are refused where they are picked, each with
    the way to an outline of one colour. A compiled file carries what was picked, and compiles from itself
    alone.
    """

    file: Annotated[str, Says("the drawing, in the recipe's folder or below it")]
    elements: Annotated[Names, Says("names of elements or groups, * for anything; all when left out")] = (
        NO_NAMES
    )
    layer: Annotated[Names, Says("names of layers, * for anything; all when left out")] = NO_NAMES
    colours: Annotated[
        bool,
        Says("whether each colour is an ink: the recipe's of that colour, or else one called after it"),
    ] = False
    batik: Annotated[
        Style | None,
        Says("hand that makes it batik: isen in what is filled, outlines as broad as the ink; none if unset"),
    ] = None
    dress: Annotated[tuple[Dressing, ...], Says("looks of some of the marks")] = ()
    centre: Annotated[
        str, Says('what lies in the origin: "drawn", the middle of all that is drawn; "page"; or an element')
    ] = "drawn"
    unit: Annotated[Annotated[Length, Between(1e-3, 1e4)], Says("length in the drawing that is a unit")] = 1.0
    px_per_inch: Annotated[
        float, Between(1, 10_000), Says("what a page in px is measured by; older Illustrators count 72")
    ] = 96.0
    drawing: Annotated[Any, Converted(_drawing, "a drawing: Svg.read(path) reads one")] = field(
        default=None, metadata={HIDDEN: True}
    )
    inks: tuple[tuple[str, str], ...] = field(default=(), metadata={HIDDEN: True})

    @property
    def wanted(self) -> Wanted:
        """What is asked of the drawing."""
        from batik_vector.importing.drawing.marks import Wanted

        return Wanted(several(self.elements), several(self.layer), self.centre, self.px_per_inch)

    @classmethod
    def read(cls, path: str | os.PathLike[str], **said: Any) -> Svg:
        """Return a motif from an SVG file, for recipes that are built in Python.

        Args:
            path: of the file.
            **said: the keys of a motif in a recipe, such as ``elements``.

        Raises:
            RecipeError: with what is wrong with the file, or with a name that picks nothing.
        """
        from batik_vector.importing.document import load, parse
        from batik_vector.importing.drawing.carried import carried
        from batik_vector.importing.drawing.marks import picked

        motif = cls(file=os.path.basename(path), **said)
        document = parse(*load(path))
        kept = picked(document, motif.wanted)
        return motif.read_from(document, kept, carried(document, kept), os.path.realpath(path))

    def read_from(
        self, document: Document, kept: Container[ET.Element] | None, text: str, path: str = ""
    ) -> Svg:
        """Return the motif with its drawing.

        Args:
            document: the SVG.
            kept: its elements that matter.
            text: by which compiled files carry it.
            path: of the file, where there is one.

        Raises:
            DrawingError: where it draws what is no geometry.
            RecipeError: where a name is none of the drawing's, by its key.
        """
        from batik_vector.importing.drawing.marks import Drawing, read_drawing

        marks, notes = read_drawing(document, self.wanted, kept)
        read = replace(self, drawing=Drawing(marks, text, notes, path))
        for number, each in enumerate(self.dress):
            each.refuse_in_vain(marks, f"dress[{number}]")
        return read

    @property
    def marks(self) -> tuple[Mark, ...]:
        """What was read; nothing before that."""
        drawing: Drawing | None = self.drawing
        return drawing.marks if drawing else ()

    @property
    def size(self) -> float:
        """Half the larger side of what is drawn, in units, where a flower's would be about 1."""
        drawing: Drawing | None = self.drawing
        return max(drawing.sides) / 2 / self.unit if drawing else 1.0

    @property
    def breadth(self) -> float:
        """How broad the outlines are that are drawn, in units; 0 before they have been read."""
        drawing: Drawing | None = self.drawing
        return drawing.sides[0] / self.unit if drawing else 0.0

    def parts(self) -> tuple[Part, ...]:
        """Return the parts that are drawn, bottom first; none before the drawing has been read."""
        return tuple(part for _, part in self._parts)

    def keys(self) -> tuple[str, ...]:
        """Return the keys of the parts' tables: they have none of their own."""
        return ("",) * len(self._parts)

    @functools.cached_property
    def _parts(self) -> tuple[tuple[_Source, Part], ...]:
        return tuple(found for number, mark in enumerate(self.marks) for found in self._of(number, mark))

    def _of(self, number: int, mark: Mark) -> list[tuple[_Source, Part]]:
        """Return the parts of a mark, each with where its geometry comes from."""
        fill, stroke = (self._look(mark, colour) for colour in (mark.fill, mark.stroke))
        lined = mark.stroke and stroke.treatment in _LINED
        found = []
        if mark.fill and not (fill.treatment in _LINED and lined):
            both = fill.treatment in (*_LINED, Treatment.BOTH)
            part = replace(self._part(mark.name, fill, mark.fill), fill_with=fill.fill_with)
            if fill.treatment == Treatment.BOTH and mark.stroke and self.colours and not part.line_ink:
                part = replace(part, line_ink=stroke.ink or self._ink(mark.stroke))
            found.append((_Source(number, region=True, line=both), part))
        if mark.stroke:
            drawn = stroke.treatment in (None, Treatment.CUT)
            source = _Source(number, body=drawn, region=not (drawn or mark.fill), line=bool(lined))
            if not mark.fill and stroke.treatment == Treatment.BOTH:
                source = replace(source, line=True)
            name = f"{mark.name}.line" if found and mark.name else mark.name
            if source.body or source.region or source.line:
                found.append((source, self._part(name, stroke, mark.stroke)))
        return found[::-1] if mark.stroke_first else found

    def _look(self, mark: Mark, colour: str) -> Look:
        """Return the look of a mark's fill or stroke."""
        look: Look = self
        if self.batik is not None:
            line = Treatment.STROKE if mark.fill and mark.fill != colour else None
            look = self.over(Look(treatment=line, fill_with=Isen(style=self.batik)))
        for each in self.dress:
            meant = mark.called.meant(several(each.elements), several(each.layer))
            if meant and each.colour in (None, colour):
                look = each.over(look)
        return look

    def _part(self, name: str, look: Look, colour: str) -> Part:
        gap = 0.0 if look.gap is None and self.colours else look.gap
        ink = look.ink or (self._ink(colour) if self.colours else "")
        return Part(
            name=name,
            ink=ink,
            line_ink=look.line_ink,
            treatment=look.treatment or Treatment.AREA,
            gap=gap,
            whole=bool(look.whole),
        )

    def _ink(self, colour: str) -> str:
        return dict(self.inks).get(colour, colour)

    def colours_kept(self) -> tuple[str, ...]:
        """Return the colours that are inks of their own, in painting order."""
        if not self.colours:
            return ()
        bare = replace(self, inks=()) if self.inks else self
        named = {
            self.ink,
            self.line_ink,
            *(name for each in self.dress for name in (each.ink, each.line_ink)),
        }
        found = dict.fromkeys(
            ink
            for part in bare.parts()
            if part.treatment != Treatment.CUT
            for ink in (part.ink, part.line_ink)
            if ink and ink not in named
        )
        return tuple(found)

    def shapes(
        self, tolerance: float | Callable[[Points], Array]
    ) -> list[tuple[Part, Geometries, Geometries]]:
        """Return each part with its areas and lines, in units.

        Args:
            tolerance: in units; or a function of places, shape (n, 2) → (n,).

        Raises:
            GeometryError: where the drawing has not been read.
        """
        if self.drawing is None:
            raise GeometryError(f'the drawing "{self.file}" has not been read: Svg.read(path) reads one')
        return list(_shapes(self, tolerance)) if not callable(tolerance) else _drawn(self, tolerance)


_LINED = (Treatment.LINE, Treatment.STROKE)


@frozen
class _Source:
    """Where the geometry of a part comes from: what its mark fills, its stroke's body, its lines."""

    mark: int
    region: bool = False
    body: bool = False
    line: bool = False


def several(names: str | tuple[str, ...]) -> tuple[str, ...]:
    """Return a name or several as several; no name is none."""
    return names if isinstance(names, tuple) else (names,) if names else ()


@functools.lru_cache(maxsize=8)
def _shapes(motif: Svg, tolerance: float) -> tuple[tuple[Part, Geometries, Geometries], ...]:
    """Return the shapes of a motif. Kept: who turns one knob draws the rest again."""
    found = _drawn(motif, tolerance)
    for _, *marks in found:
        for each in marks:
            each.flags.writeable = False
    return tuple(found)


def _drawn(
    motif: Svg, tolerance: float | Callable[[Points], Array]
) -> list[tuple[Part, Geometries, Geometries]]:
    import numpy as np

    from batik_vector.geometry.maps.affine import Affine
    from batik_vector.importing.drawing.shapes import Shapes

    unit, bare = motif.unit, np.empty(0, dtype=object)
    if callable(tolerance):
        share = tolerance

        def in_mm(points: Points) -> Array:
            return share(points / unit) * unit

        shapes = Shapes(motif.marks, in_mm)
    else:
        shapes = Shapes(motif.marks, tolerance * unit)
    sources = [source for source, _ in motif._parts]
    asked = {
        what: sorted({source.mark for source in sources if getattr(source, what)})
        for what in ("region", "body", "line")
    }
    taken = {"region": shapes.regions, "body": shapes.bodies, "line": shapes.lines}
    down = Affine.scale(1 / unit)
    made: dict[str, dict[int, Geometries]] = {}
    for what, numbers in asked.items():
        marks, owner = taken[what](numbers) if numbers else (bare, np.empty(0, np.intp))
        marks = marks if unit == 1.0 else down.apply(marks)
        ends = np.searchsorted(owner, np.arange(len(motif.marks) + 1))
        made[what] = {number: marks[ends[number] : ends[number + 1]] for number in numbers}
    found = []
    for source, part in motif._parts:
        region, body, line = (
            made[what][source.mark] if getattr(source, what) else bare for what in ("region", "body", "line")
        )
        areas = np.concatenate([region, body]) if len(body) else region
        found.append((part, areas, line))
    return found
