"""What batify writes: a recipe to be edited, and the drawing beside it, a path of its own for each cell.

Paths are called after their ink and their isen (``soga-cecek-3``), so that one table of the recipe dresses
all that are alike; what the drawing called them stays as their label, and goes too.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import MISSING, fields
from typing import TypeAlias
from xml.sax.saxutils import escape, quoteattr

import numpy as np
import shapely

from batik_vector.drafting.batik.cells import FINE
from batik_vector.drafting.batik.hands import Colours
from batik_vector.drafting.path_data import number, path_data
from batik_vector.geometry.maps.affine import Affine
from batik_vector.importing.document import INKSCAPE
from batik_vector.recipe.fills import Fill, Style
from batik_vector.recipe.references import quoted
from batik_vector.values import frozen

EDGE = 10.0
"""mm of the page round what is drawn."""
PLAIN = "plain"
"""Isen of a cell that has none."""
LINE = "line"
"""What lines are called."""


@frozen(eq=False)
class Filled:
    """A cell with its dress: its fill, and numbers of its colour, of the line's round it and the isen's."""

    shape: shapely.Polygon
    name: str
    ink: int
    line: int
    fill: Fill | None
    isen: int


Line: TypeAlias = tuple[shapely.LineString, int]
"""A line that is drawn, with the number of its colour."""


@frozen(eq=False)
class Sketch:
    """All that is to be written.

    ``tile`` is the half-drop unit in mm, ``ground`` what fills the ground, None where sprigs are strewn on
    it, and ``beside`` the drawing's file.
    """

    title: str
    style: Style
    colours: Colours
    cells: list[Filled]
    lines: list[Line]
    tile: tuple[float, float]
    ground: Fill | None
    beside: str

    def word(self, number: int) -> str:
        """Return the word for a colour."""
        return self.colours.palette.words[number]

    def inks(self) -> list[int]:
        """Return the colours that are inks, in painting order: dark ones first, the line's last."""
        used = {each.ink for each in self.cells} | {each.line for each in self.cells}
        used |= {each.isen for each in self.cells if each.fill} | {self.colours.line, self.sprinkled}
        used -= {self.colours.ground}
        return sorted(used, key=lambda each: (each == self.colours.line, -each))

    @property
    def sprinkled(self) -> int:
        """The colour of the ground's isen: the one next to the line's that cells use too."""
        others = [each for each in self.colours.cells if each != self.colours.line]
        used = {each.ink for each in self.cells}
        return next((each for each in others if each in used), others[0])

    def isen(self) -> dict[Fill | None, str]:
        """Return the word for each fill: its kind, and a figure where there are several of a kind."""
        words: dict[Fill | None, str] = {None: PLAIN}
        for each in self.cells:
            if each.fill is not None and each.fill not in words:
                kind = each.fill.kind.replace("-", "")
                count = sum(word.rstrip("0123456789") == kind for word in words.values())
                words[each.fill] = kind if not count else f"{kind}{count + 1}"
        return words


def drawing(sketch: Sketch) -> str:
    """Return the SVG: the page's middle is the motif's, a unit is a millimetre on cloth."""
    return "\n".join([*_paths(sketch), ""])


def _paths(sketch: Sketch) -> Iterator[str]:
    shapes = np.array([each.shape for each in sketch.cells], dtype=object)
    lines = np.array([line for line, _ in sketch.lines], dtype=object)
    left, low, right, high = shapely.total_bounds(np.concatenate([shapes, lines])).tolist()
    size = [number(np.ceil(side) + 2 * EDGE) for side in (right - left, high - low)]
    corner = Affine(1, 0, 0, -1, float(size[0]) / 2, float(size[1]) / 2)
    outlines = [[each] for each in corner.apply(shapes)] + [[each] for each in corner.apply(lines)]
    data = path_data([np.array(each, dtype=object) for each in outlines], FINE / 2)
    palette, canting = sketch.colours.palette, number(sketch.colours.hand.canting)
    pen = f'stroke-width="{canting}" stroke-linecap="round" stroke-linejoin="round"'
    yield f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="{INKSCAPE}"'
    yield f'  width="{size[0]}mm" height="{size[1]}mm" viewBox="0 0 {size[0]} {size[1]}">'
    yield f"<title>{escape(sketch.title)}</title>"
    yield '<g id="cloth" inkscape:groupmode="layer" inkscape:label="cloth">'
    yield f'<rect width="{size[0]}" height="{size[1]}" fill="{palette.colours[sketch.colours.ground]}"/>'
    yield "</g>"
    yield f'<g id="motif" inkscape:groupmode="layer" inkscape:label="motif" {pen}>'
    words, count = sketch.isen(), dict[str, int]()
    for each, path in zip(sketch.cells, data, strict=False):
        kind = f"{sketch.word(each.ink)}-{words[each.fill]}"
        count[kind] = count.get(kind, 0) + 1
        label = f" inkscape:label={quoteattr(each.name)}" if each.name else ""
        yield f'<path id="{kind}-{count[kind]}"{label} fill="{palette.colours[each.ink]}"\n  d="{path}"/>'
    drawn = zip(sketch.lines, data[len(sketch.cells) :], strict=True)
    for place, ((_, colour), path) in enumerate(drawn, start=1):
        stroke = f'fill="none" stroke="{palette.colours[colour]}"'
        yield f'<path id="{LINE}-{place}" {stroke}\n  d="{path}"/>'
    yield "</g>"
    yield "</svg>"


def recipe(sketch: Sketch) -> str:
    """Return the recipe as a page of TOML."""
    return "\n".join([*_head(sketch), *_motif(sketch), *_strewn(sketch), *_places(sketch), ""])


def _head(sketch: Sketch) -> Iterator[str]:
    hand, palette = sketch.colours.hand, sketch.colours.palette
    filled = sum(each.fill is not None for each in sketch.cells)
    yield f"# {sketch.title}: a drawing made batik in the hand of {hand.about}."
    yield f"# Of {len(sketch.cells)} cells {filled} are filled with isen; colours are those of the palette"
    yield f'# "{palette.name}".'
    yield "#"
    yield '# To vary it: "fill_with" of a dress fills all that it names. A further dress, elements = "wing",'
    yield "# is for what the drawing calls so, or for one path by its id. The outlines are in"
    yield f"# {sketch.beside}, for any program; --colourway madura tries other colours."
    yield ""
    yield f"title = {quoted(sketch.title)}"
    yield ""
    yield "[cloth]"
    ground = sketch.colours.ground
    yield f'colour = "{palette.colours[ground]}"            # {sketch.word(ground)}'
    for place, each in enumerate(sketch.inks()):
        drawn, width = f'drawn  = "{palette.colours[each]}"', f'width  = "{number(hand.canting)} mm"'
        yield ""
        yield f"[ink.{quoted_key(sketch.word(each))}]"
        yield f'colour = "{palette.colours[each]}"'
        yield drawn if place else f"{drawn}            # its colour in the drawing"
        yield width if place else f"{width}             # of the canting that draws outlines (klowong)"


def quoted_key(word: str) -> str:
    """Return a key of TOML."""
    return word if word.replace("-", "").replace("_", "").isalnum() and word.isascii() else quoted(word)


def _motif(sketch: Sketch) -> Iterator[str]:
    words = sketch.isen()
    yield ""
    yield "[motif.batik]"
    yield 'kind    = "svg"'
    yield f"file    = {quoted(sketch.beside)}"
    yield "colours = true                # every colour of the drawing is an ink"
    yield ""
    yield "[[motif.batik.dress]]         # outlines, as broad as the ink says at any size"
    yield f'elements  = "{LINE}-*"'
    yield 'treatment = "stroke"'
    classes: dict[tuple[Fill, int], dict[int, None]] = {}
    for each in sketch.cells:
        if each.fill is not None:
            classes.setdefault((each.fill, each.isen), {}).setdefault(each.ink)
    for (fill, isen), inks in classes.items():
        yield ""
        yield "[[motif.batik.dress]]"
        yield f"elements  = {_listed([f'{sketch.word(ink)}-{words[fill]}-*' for ink in inks])}"
        ink = "" if isen == sketch.colours.ground else sketch.word(isen)
        yield f"fill_with = {_spelled(fill, ink)}"


def _listed(names: list[str]) -> str:
    return quoted(names[0]) if len(names) == 1 else f"[{', '.join(map(quoted, names))}]"


def _spelled(fill: Fill, ink: str) -> str:
    """Return a fill as a recipe has it: its lengths, and what is not as it is anyway."""
    parts = [f"kind = {quoted(fill.kind)}"]
    parts += [f"ink = {quoted(ink)}"] if ink else []
    for each in fields(fill):
        value = getattr(fill, each.name)
        lengths = each.name in ("spacing", "width", "margin", "length")
        if each.name == "ink" or (value == each.default is not MISSING and not lengths):
            continue
        if isinstance(value, str):
            parts.append(f"{each.name} = {quoted(str(value))}")
        elif lengths:
            parts.append(f'{each.name} = "{number(value)} mm"')
        else:
            parts.append(f"{each.name} = {number(value)}")
    return f"{{ {', '.join(parts)} }}"


_STREWN = (
    (
        "sprinkle",
        '{ curve = { kind = "superellipse", a = 1.0, b = 1.35, length = 1.5, width = 0.6 }, count = 3, '
        "radius = 1.9, turn = -64, arc = 192, INK },",
        '{ curve = { kind = "circle", radius = 0.45 }, radius = -0.6, INK },',
    ),
    ("cecek", '{ curve = { kind = "circle", radius = 0.55 }, INK },'),
)
"""What is strewn on a ground, in mm: sprigs, and dots between them."""


def _strewn(sketch: Sketch) -> Iterator[str]:
    if sketch.ground is not None:
        return
    ink = f"ink = {quoted(sketch.word(sketch.sprinkled))}"
    for name, *elements in _STREWN:
        yield ""
        yield f"[motif.{name}]"
        yield 'kind = "rosette"'
        yield "elements = ["
        yield from (f"  {each.replace('INK', ink)}" for each in elements)
        yield "]"


def _places(sketch: Sketch) -> Iterator[str]:
    across, up = sketch.tile
    yield ""
    yield "[[place]]"
    yield 'motif = "batik"'
    yield 'scale = "1 mm"                # as large as it is drawn'
    yield ""
    yield "[[place]]                     # what is left of the ground, filled round it"
    if sketch.ground is None:
        yield 'motif  = ["sprinkle", "cecek"]'
        yield 'scale  = "1 mm"'
        yield 'layout = { kind = "toss", distance = "1.5 mm", clear = "all", weights = [1, 2] }'
    else:
        yield 'layout    = { kind = "ground" }'
        yield f"fill_with = {_spelled(sketch.ground, sketch.word(sketch.sprinkled))}"
    yield ""
    yield "[tile]"
    yield f'size   = ["{number(across)} mm", "{number(up)} mm"]'
    yield 'repeat = "half-drop"'
