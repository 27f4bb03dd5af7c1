"""One motif as an SVG, to be edited in a drawing program and read again as a motif of kind "svg".

The page's middle is the motif's centre, so many millimetres of it are a unit of the motif. Every element is
one path of its name, all of its copies together: apart they would cut one another.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from xml.sax.saxutils import escape, quoteattr

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.drafting.path_data import number, path_data
from batik_vector.errors import GeometryError, UnknownNameError
from batik_vector.export.ids import Ids
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.regions import FillRule
from batik_vector.importing.document import INKSCAPE
from batik_vector.recipe.figures import Figure, draw, size_of
from batik_vector.recipe.look import Dress, Treatment
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.references import quoted
from batik_vector.values import frozen

FINE_MM = 0.001
"""How far outlines may stand from true curves, on a page of some 100 mm."""
ROUGH = 2e-3
"""Tolerance of a first drawing, as a share of the motif's size."""
PAGE_MM = 100.0
"""About how large the page is."""
MARGIN = 1.1
LINE_SHARE = 0.01
"""Breadth of lines that have none of their own, as a share of the page."""
_BARE = re.compile(r"[A-Za-z0-9_-]+")
LINED = (Treatment.LINE, Treatment.STROKE)


@frozen(eq=False)
class MotifDrawing:
    """A drawing of a motif: the SVG, the millimetres of it that a unit of the motif is, and the elements'
    looks."""

    svg: str
    unit: float
    looks: tuple[tuple[str, Dress], ...]

    def table(self, motif: str, file: str) -> str:
        """Return the tables by which a recipe reads the drawing as that motif again."""
        key = motif if _BARE.fullmatch(motif) else quoted(motif)
        lines = [
            f"[motif.{key}]",
            'kind = "svg"',
            f"file = {quoted(file)}",
            'centre = "page"',
            f'unit = "{number(self.unit)} mm"',
        ]
        for name, look in self.looks:
            said = list(_said(look))
            if said:
                lines += [f"[[motif.{key}.dress]]", f"elements = {quoted(name)}", *said]
        return "\n".join(lines)


def _said(look: Dress) -> Iterator[str]:
    """Yield what a recipe has to say of an element's look."""
    if look.ink:
        yield f"ink = {quoted(look.ink)}"
    if look.line_ink:
        yield f"line_ink = {quoted(look.line_ink)}"
    if look.treatment != Treatment.AREA:
        yield f'treatment = "{look.treatment.value}"'
    if look.gap is not None:
        yield f'gap = "{number(look.gap)} mm"'
    if look.whole:
        yield "whole = true"


def motif_drawing(recipe: Recipe, motif: str) -> MotifDrawing:
    """Return a drawing of one of a recipe's motifs.

    Raises:
        UnknownNameError: where it has none of that name.
    """
    if motif not in recipe.motif:
        raise UnknownNameError(motif, list(recipe.motif), "motif")
    known = recipe.motif[motif]
    rough = draw(known, size_of(known) * ROUGH)
    reach = max(map(_reach, rough), default=0.0)
    if not reach > 0:
        raise GeometryError(f'motif "{motif}" draws nothing')
    unit = _round(PAGE_MM / (2 * MARGIN * reach))
    writer = _Writer(recipe, motif, unit, 2 * MARGIN * reach * unit)
    figures = draw(known, FINE_MM / unit)
    return MotifDrawing(writer.drawn(figures), unit, tuple(writer.looks))


def _reach(figure: Figure) -> float:
    """Return how far a figure reaches from the motif's centre, along x or y."""
    xy = shapely.get_coordinates(np.concatenate([figure.areas, figure.lines]))
    return float(np.abs(xy).max(initial=0.0))


def _round(value: float) -> float:
    """Return the nearest of 1, 2 and 5, and their tenfolds, that is not more."""
    power = math.floor(math.log10(value))
    return max(step * 10.0**power for step in (1, 2, 5) if step * 10.0**power <= value * (1 + 1e-9))


class _Writer:
    """Writes the figures of a motif."""

    def __init__(self, recipe: Recipe, motif: str, unit: float, side: float) -> None:
        self.recipe, self.motif, self.unit, self.side = recipe, motif, unit, side
        self.looks: list[tuple[str, Dress]] = []
        self._ids = Ids()
        self._down = Affine(unit, 0.0, 0.0, -unit, side / 2, side / 2)
        # What the motif is drawn with where it says nothing: as it is first placed.
        places = [place for _, place in recipe.placements() if motif in place.motifs]
        self._ink = next((place.ink for place in places if place.ink), next(iter(recipe.ink), ""))

    def drawn(self, figures: Sequence[Figure]) -> str:
        """Return the SVG."""
        return "\n".join([*self._lines(figures), ""])

    def _lines(self, figures: Sequence[Figure]) -> Iterator[str]:
        side = number(self.side)
        yield '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="' + INKSCAPE + '"'
        yield f'  width="{side}mm" height="{side}mm" viewBox="0 0 {side} {side}">'
        yield f"<title>{escape(self.motif)}</title>"
        unit = number(self.unit)
        yield f"<desc>The page's middle is the motif's centre, and {unit} mm are a unit of it.</desc>"
        yield '<g id="cloth" inkscape:groupmode="layer" inkscape:label="cloth">'
        yield f'<rect width="{side}" height="{side}" fill="{self.recipe.cloth.colour}"/>'
        yield "</g>"
        yield f'<g id="motif" inkscape:groupmode="layer" inkscape:label={quoteattr(self.motif)}>'
        self._ids.one("cloth", "layer")
        self._ids.one("motif", "layer")
        for figure in figures:
            name = self._ids.one(figure.element.name or "element", "element")
            self.looks.append((name, figure.element))
            marks, how = self._marks(figure)
            label = quoteattr(figure.element.name or name)
            (data,) = path_data([self._down.apply(marks)], FINE_MM)
            yield f'<path id="{name}" inkscape:label={label} {how}'
            yield f'  d="{data}"/>'
        yield "</g>"
        yield "</svg>"

    def _marks(self, figure: Figure) -> tuple[Geometries, str]:
        """Return the outlines of an element, and how they are painted: all copies together, as one sheet."""
        look = figure.element
        ink = self.recipe.ink.get(look.ink or self._ink)
        fill = ink.colour if ink else "#000000"
        pen = self.recipe.ink.get(look.line_ink) or ink
        stroke = pen.colour if pen else fill
        breadth = f'stroke-width="{number(LINE_SHARE * self.side)}"'
        line = f'stroke="{stroke}" {breadth} stroke-linecap="round" stroke-linejoin="round"'
        if look.treatment in LINED:
            marks, how = figure.lines, f'fill="none" {line}'
        elif look.treatment == Treatment.BOTH:
            rule = ' fill-rule="evenodd"' if getattr(look, "fill", None) == FillRule.EVENODD else ""
            marks, how = figure.lines, f'fill="{fill}"{rule} {line}'
        else:
            cut = look.treatment == Treatment.CUT
            marks, how = figure.areas, f'fill="{self.recipe.cloth.colour if cut else fill}"'
        return marks, how
