"""From a plain drawing to batik, the story told once: cells, their colours, their isen, what is written."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.drafting.batik.cells import Cell, Cells, cells_of
from batik_vector.drafting.batik.hands import HANDS, Colours, Hand, is_grey
from batik_vector.drafting.batik.outlines import open_lines, outlines
from batik_vector.drafting.batik.pages import Filled, Sketch, drawing, recipe
from batik_vector.errors import Fault, GeometryError, UnknownNameError
from batik_vector.geometry.fills.insets import Parts, inset, whole
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.paths.outline import bounds_of, joined
from batik_vector.geometry.regions import oriented
from batik_vector.importing.document import DrawingError, load, parse
from batik_vector.importing.drawing.marks import Mark, Wanted, picked, read_drawing
from batik_vector.recipe.fills import Fill, Room, Sisik, Style
from batik_vector.recipe.fills.base import Angled
from batik_vector.recipe.fills.isen import RULES, chosen, measured
from batik_vector.recipe.fills.marks import Rows
from batik_vector.recipe.palettes import PALETTES
from batik_vector.values import frozen

WIDTH = 120.0
"""mm on cloth that a motif's larger side has unless it is told otherwise."""
CLOSEST = 3.5
"""mm of ground between a motif and its next copy, at least."""
SPARE, FEW, ROUGH = 0.2, 4, 0.05
"""mm of margin more, and the least marks, that a fill must have room for; mm to which that is tried."""
STEP = 1.0
"""mm by which copies are moved towards one another."""
ROWS_CLOSE = 40.0
"""mm of the repeat from which rows of dots surely close on it; on less the dots are tossed."""


@frozen(eq=False)
class Batik:
    """A recipe's text and the drawing that stands beside it.

    ``cells`` counts what is to be filled, ``filled`` those of them that have isen; ``colours`` are the words
    for the colours that cells have, ``notes`` what people are told of the drawing.
    """

    text: str
    drawing: str
    cells: int
    filled: int
    lines: int
    colours: tuple[str, ...]
    notes: tuple[str, ...] = ()


def batified(
    source: str | os.PathLike[str] | bytes,
    style: str = "solo",
    palette: str = "",
    width: float | None = None,
    name: str = "",
    beside: str = "motif.svg",
) -> Batik:
    """Return a drawing as batik.

    Args:
        source: the path of an SVG, or its bytes.
        style: "solo", "pesisir" or "miao".
        palette: whose colours it takes; the style's own where none is named.
        width: mm on cloth that the motif is broad; without it the larger side is 120 mm.
        name: of the motif; the file's without it.
        beside: what the drawing beside the recipe is called.

    Raises:
        DrawingError: where the drawing cannot be read, or closes round nothing.
        UnknownNameError: where there is no such style or palette.
    """
    if style not in {each.value for each in Style}:
        raise UnknownNameError(style, [each.value for each in Style], "style")
    hand = HANDS[Style(style)]
    if (palette or hand.palette) not in PALETTES:
        raise UnknownNameError(palette, list(PALETTES), "palette")
    data, called = load(source)
    document = parse(data, called)
    marks, notes = read_drawing(document, Wanted(), picked(document, Wanted()))
    left, low, right, high = bounds_of(joined([mark.outline for mark in marks]))
    sides = right - left, high - low
    side = sides[0] if width is not None and sides[0] else max(sides)
    if not side:
        raise DrawingError([Fault("all that is drawn lies in one point", "", called)])
    try:
        cells = cells_of(marks, (width or WIDTH) / side)
    except GeometryError as error:
        raise DrawingError([Fault(str(error), "", called)]) from None
    colours = Colours(PALETTES[palette or hand.palette], hand)
    filled = _filled(cells, Style(style), colours, _is_coloured(marks))
    title = name or (Path(called).stem if not isinstance(source, bytes) else "motif")
    motif, filled, lines = _centred(filled, cells.lines)
    drawn = [*outlines(filled), *((line, colours.line) for line in open_lines(lines))]
    tile = _tile(motif)
    sketch = Sketch(title, Style(style), colours, filled, drawn, tile, _ground(hand, motif, tile), beside)
    words = dict.fromkeys(colours.palette.words[each.ink] for each in filled)
    return Batik(
        recipe(sketch),
        drawing(sketch),
        len(filled),
        sum(each.fill is not None for each in filled),
        len(lines),
        tuple(words),
        tuple(notes),
    )


def _is_coloured(marks: list[Mark]) -> bool:
    """Whether colours mean something: there are several, or one with a hue."""
    found = {mark.fill for mark in marks if mark.fill}
    return len(found) > 1 or any(not is_grey(each) for each in found)


def _filled(cells: Cells, style: Style, colours: Colours, coloured: bool) -> list[Filled]:
    """Return the cells with their colours and isen."""
    inks = _inks(cells.cells, colours, coloured)
    shapes = np.array([cell.shape for cell in cells.cells], dtype=object)
    inner = _beside_lines(inset(whole(shapes), colours.hand.canting / 2), cells.lines, colours.hand.canting)
    fills = _isen(inner, len(shapes), style)
    return [
        Filled(cell.shape, cell.name, ink, colours.line_round(ink), fill, colours.isen_on(ink))
        for cell, ink, fill in zip(cells.cells, inks, fills, strict=True)
    ]


def _beside_lines(parts: Parts, lines: Geometries, width: float) -> Parts:
    """Return what lines that lie over cells leave of their insides: isen are set down beside them alone."""
    if not len(lines) or not len(parts.shapes):
        return parts
    bodies = shapely.union_all(shapely.buffer(lines, width / 2))
    shapes, of = shapely.get_parts(shapely.difference(parts.shapes, bodies), return_index=True)
    there = shapely.area(shapes) > 0
    return Parts(oriented(shapes[there]), parts.region[of[there]])


def _inks(cells: tuple[Cell, ...], colours: Colours, coloured: bool) -> list[int]:
    """Return the colour of each cell: the nearest, or where it has none, in turn by size."""
    covers: dict[str, float] = {}
    for cell in cells if coloured else ():
        if cell.colour:
            covers[cell.colour] = covers.get(cell.colour, 0.0) + cell.shape.area
    known = colours.matched(sorted(covers, key=lambda colour: (-covers[colour], colour)))
    sizes: dict[int, int] = {}
    inks = []
    for cell in cells:
        if cell.colour in known:
            inks.append(known[cell.colour])
            continue
        # What is alike in size is alike in colour.
        size = round(float(np.log2(cell.shape.area)) * 2)
        inks.append(colours.uncoloured(sizes.setdefault(size, len(sizes))))
    return inks


def _isen(inner: Parts, count: int, style: Style) -> list[Fill | None]:
    """Return what fills each of ``count`` cells, whose insides are given; None where nothing has room."""
    found: list[Fill | None] = [None] * count
    if not len(inner.shapes):
        return found
    # The deepest part of a cell says what fills it.
    depth, _ = measured(inner)
    order = np.lexsort((-depth, inner.region))
    first = order[np.append(True, np.diff(inner.region[order]) != 0)]
    choice = chosen(style, inner.taken(first))
    rules = RULES[style]
    for number, rule in enumerate(rules):
        for place, fill in enumerate(rule.fills):
            mine = inner.region[first[(choice.rule == number) & (choice.fill == place)]].tolist()
            # Where it has no room, what a later rule has may have: the finest at last.
            for each in (fill, *(other.fills[place % len(other.fills)] for other in rules[number + 1 :])):
                mine = [cell for cell in mine if found[cell] is None]
                for cell in _with_room(each, inner.taken(np.isin(inner.region, mine))):
                    found[cell] = each
    return found


def _with_room(fill: Fill, parts: Parts) -> list[int]:
    """Return the cells in which a fill has room for some marks, and a little to spare."""
    if not len(parts.shapes):
        return []
    spare = replace(fill, margin=fill.margin + SPARE)
    count = int(parts.region.max()) + 1
    least = np.full(count, np.iinfo(np.intp).max)
    # Rows that hang on the place are tried at two.
    for share in (0.0, 0.45) if isinstance(fill, Angled) else (0.0,):
        move = Affine.translation((share * fill.spacing, share * fill.spacing))
        there = Parts(move.apply(parts.shapes), parts.region)
        _, region = spare.lay(Room(there, np.zeros((count, 2)), 1, ROUGH, 0))
        least = np.minimum(least, np.bincount(region, minlength=count))
    enough = FEW if fill.whole or isinstance(fill, Sisik) else 1
    return [cell for cell in np.unique(parts.region).tolist() if least[cell] >= enough]


def _centred(filled: list[Filled], lines: Geometries) -> tuple[shapely.Geometry, list[Filled], Geometries]:
    """Return all that is drawn as one, and cells and lines, with the middle of their box in the origin."""
    every = [*(each.shape for each in filled), *lines]
    left, low, right, high = shapely.total_bounds(np.array(every, dtype=object))
    home = Affine.translation((-(left + right) / 2, -(low + high) / 2))
    shapes = home.apply(np.array([each.shape for each in filled], dtype=object))
    moved = home.apply(lines) if len(lines) else lines
    outline = shapely.union_all(np.concatenate([shapes, moved]))
    return outline, [replace(each, shape=s) for each, s in zip(filled, shapes, strict=True)], moved


def _tile(motif: shapely.Geometry) -> tuple[float, float]:
    """Return a half-drop unit in mm in which copies lie as close as their outlines allow."""
    motif = shapely.simplify(motif, STEP / 4)
    left, low, right, high = shapely.bounds(motif).tolist()
    height = _closest(motif, high - low, lambda side: [(0.0, side)])
    across = _closest(
        motif, right - left, lambda side: [(side, height / 2), (side, -height / 2), (2 * side, 0.0)]
    )
    return across, height


def _ground(hand: Hand, motif: shapely.Geometry, tile: tuple[float, float]) -> Fill | None:
    """Return what fills the ground of a half-drop unit; None where sprigs are strewn, or it has no room."""
    fill = hand.round_it
    if fill is None:
        return None
    if min(tile) < ROWS_CLOSE:
        fill = replace(fill, follow=Rows.SCATTER, angle=0.0)
    across, up = tile
    taken = shapely.buffer(motif, hand.canting / 2 + fill.margin + fill.width / 2 + SPARE)
    shifts = [(i * across, (j + i / 2) * up) for i in (-1, 0, 1) for j in (-2, -1, 0, 1, 2)]
    copies = np.concatenate([Affine.translation(move).apply(np.array([taken])) for move in shifts])
    unit = shapely.box(-across / 2, -up / 2, across / 2, up / 2)
    left = shapely.area(shapely.difference(unit, shapely.union_all(copies)))
    return fill if left >= FEW * fill.spacing**2 else None


def _closest(
    motif: shapely.Geometry, side: float, shifts: Callable[[float], list[tuple[float, float]]]
) -> float:
    """Return the least whole period, in mm, at which copies keep their distance, from ``side`` downwards."""
    least = float(np.ceil(side + CLOSEST))
    # Even heights: half of them is the drop.
    least += least % 2
    while least > max(side / 2, 10.0):
        nearer = least - 2 * STEP
        copies = [Affine.translation(move).apply(np.array([motif], dtype=object)) for move in shifts(nearer)]
        if shapely.distance(motif, np.concatenate(copies)).min() < CLOSEST:
            break
        least = nearer
    return least
