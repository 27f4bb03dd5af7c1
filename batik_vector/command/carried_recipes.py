"""What a file of ours promises by the recipe that it carries, and whether what it draws keeps to it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Cell, DropAxis, Geometries, Layer, Margins, Page
from batik_vector.export.ids import Ids
from batik_vector.export.palette import xml_label
from batik_vector.geometry.outlines import to_polygons, to_polylines, together
from batik_vector.importing.svg import Reading
from batik_vector.machines import Machine
from batik_vector.making.pages import Latest, finished
from batik_vector.processes.spec import ProcessSpec
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.outputs import SvgOutput
from batik_vector.tiling.cloth.field import repeated, with_bleed
from batik_vector.units import STEPS_PER_MM, format_mm
from batik_vector.values import frozen

SIZE_MM = 1e-3
"""How far a page may be off the promised size."""


@frozen(eq=False)
class Promise:
    """What the recipe in a file makes of its page.

    ``artwork`` is what the recipe draws: its tile, or the field of tiles that the page shows; ``repeat`` is
    how that repeats. ``broken`` says where the page is not the one promised.
    """

    recipe: Recipe
    artwork: Artwork
    repeat: str = "grid"
    broken: tuple[str, ...] = ()

    def known(self, reading: Reading) -> Artwork:
        """Return what was read with what the recipe knows of it: inks, borders on the seam, curves."""
        drawn = reading.artwork
        ids, known = Ids(), {}
        ids.one("cloth", "cloth")
        for layer in self.artwork.layers:
            # A program that leaves out the labels of layers may keep their ids.
            known[ids.one(layer.ink.name, "ink")] = layer.ink
        known |= {xml_label(layer.ink.name): layer.ink for layer in self.artwork.layers}
        layers = []
        for layer in drawn.layers:
            ink = known.get(layer.ink.name)
            if ink is not None:
                layer = replace(layer, ink=replace(layer.ink, name=ink.name, overlap=ink.overlap))
            layers.append(layer)
        return replace(
            drawn,
            title=self.artwork.title,
            layers=tuple(layers),
            borders=frozenset() if self.broken else self.artwork.borders,
            # Curves are fitted to the polylines of the recipe, and come back as polylines once more.
            tolerance=self.artwork.tolerance * (2 if reading.curved else 1),
        )


def promised(recipe: Recipe, tile: Artwork, reading: Reading) -> tuple[Promise, bool]:
    """Return what a recipe promises of a page that was read, and whether the page can be measured as a tile.

    Args:
        recipe: in the file.
        tile: what it compiles to.
        reading: the file.
    """
    for across, up in _repeats(recipe):
        page = (tile.cell.width * across, tile.cell.height * up)
        if np.allclose(page, reading.page, rtol=0, atol=SIZE_MM):
            field = _field(tile, across, up)
            return Promise(recipe, field, _repeat(field.cell)), True
    marked = _marked(recipe, tile, reading)
    return (marked, False) if marked else (_broken(recipe, tile, reading), True)


def promised_prepared(
    recipe: Recipe, tile: Artwork, reading: Reading, processes: Sequence[ProcessSpec]
) -> tuple[Promise, bool]:
    """Return what a recipe promises of a page that went through processes, and whether it is a tile still.

    Args:
        recipe, tile, reading: as for :func:`promised`.
        processes: what the file says that it went through.

    Raises:
        GeometryError: where a process cannot be done.
    """
    rest, whole = list(processes), tile
    while rest and rest[0].of_tile:
        done = rest.pop(0).apply(tile, Machine())
        assert isinstance(done, Artwork)
        tile = done
    for across, up in _repeats(recipe):
        field = _field(tile, across, up)
        page: Page = field
        for process in rest:
            page = process.apply(page, Machine())
        shown = _strokes(page) if rest else field
        if np.allclose((shown.cell.width, shown.cell.height), reading.page, rtol=0, atol=SIZE_MM):
            kept = page.margins == Margins() and all(each.keeps_tile for each in processes)
            if kept and rest:
                shown = replace(shown, cell=page.cell, borders=getattr(page, "borders", field.borders))
            return Promise(recipe, shown, _repeat(shown.cell)), kept
    return _marked(recipe, whole, reading, processes) or _broken(recipe, tile, reading), False


def _marked(
    recipe: Recipe, tile: Artwork, reading: Reading, processes: Sequence[ProcessSpec] = ()
) -> Promise | None:
    """Return what a recipe promises of a page with marks for the printer round it, if it has one so large."""
    for output in recipe.output:
        if isinstance(output, SvgOutput) and output.marks:
            asked = replace(output, process=tuple(processes))
            shown = _strokes(finished(tile, asked, Latest())[0])
            if np.allclose((shown.cell.width, shown.cell.height), reading.page, rtol=0, atol=SIZE_MM):
                return Promise(recipe, shown)
    return None


def _strokes(page: Page) -> Artwork:
    """Return what a page draws with its corner at the origin, by tools or plates."""
    margins = page.margins
    columns = margins.left + page.cell.columns + margins.right
    rows = margins.bottom + page.cell.rows + margins.top
    layers = []
    for number, plate in enumerate(page.plates):
        if plate.guide or not (plate.areas or plate.lines):
            continue
        areas, strokes = (
            together([each.moved(margins.left, margins.bottom) for each in pieces])
            for pieces in (page.areas(number), page.lines(number))
        )
        layers.append(Layer(plate.ink, to_polygons(areas, STEPS_PER_MM), to_polylines(strokes, STEPS_PER_MM)))
    return Artwork(page.title, Cell(columns, rows), tuple(layers), page.cloth, page.tolerance)


def _repeats(recipe: Recipe) -> list[tuple[int, int]]:
    """Return how many tiles the SVGs of a recipe may show."""
    return sorted(
        {(1, 1)} | {getattr(each, "repeat", (1, 1)) for each in recipe.output if each.format == "svg"}
    )


def _field(tile: Artwork, across: int, up: int) -> Artwork:
    return tile if (across, up) == (1, 1) else _with_borders(repeated(tile, across, up), tile)


def _broken(recipe: Recipe, tile: Artwork, reading: Reading) -> Promise:
    """Return the promise that a page of another size breaks."""
    sizes = (" × ".join(map(format_mm, size)) for size in (reading.page, (tile.cell.width, tile.cell.height)))
    broken = "the page is {} mm, and the recipe in it promises {} mm".format(*sizes)
    # The drop of a page of another size need not land on the grid.
    return Promise(recipe, tile, _repeat(tile.cell), (broken,))


def bled(promise: Promise, page: tuple[float, float]) -> Promise | None:
    """Return what a promise is if its page is larger than the cell by a bleed, or None where it is not."""
    cell = promise.artwork.cell
    margin, other = page[0] - cell.width, page[1] - cell.height
    if margin < 2 * SIZE_MM or abs(margin - other) > SIZE_MM:
        return None
    artwork = with_bleed(promise.artwork, round(margin / 2, 3))
    return replace(promise, artwork=replace(artwork, borders=promise.artwork.borders), broken=())


def _repeat(cell: Cell) -> str:
    """Return how a cell repeats in the words of a recipe."""
    if cell.drop == 0:
        return "grid"
    return f"{'drop' if cell.axis == DropAxis.COLUMN else 'brick'} {cell.drop}"


def _with_borders(field: Artwork, tile: Artwork) -> Artwork:
    """Return a field of tiles with those borders along its seam that are borders of the tile."""
    cell, (_, slip_y), (slip_x, _) = tile.cell, *tile.cell.lattice
    found = set()
    for ink, axis, low, high in tile.borders:
        step, length, slip = (
            (cell.rows, field.cell.rows, slip_x) if axis == 0 else (cell.columns, field.cell.columns, slip_y)
        )
        other = cell.columns if axis == 0 else cell.rows
        for number in range(length // step):
            # A neighbour that has dropped has its edges elsewhere.
            if Fraction(number * slip, other).denominator == 1:
                found.add((ink, axis, low + number * step, high + number * step))
    return replace(field, borders=frozenset(found))


def differences(drawn: Artwork, promise: Artwork) -> list[str]:
    """Return in words where a drawing is not what its recipe draws, beyond the tolerance of curves."""
    words = []
    mine = {layer.ink.name: layer for layer in drawn.layers}
    theirs = {layer.ink.name: layer for layer in promise.layers}
    words += [f'the recipe draws "{name}", the file does not' for name in theirs if name not in mine]
    words += [f'the file draws "{name}", the recipe does not' for name in mine if name not in theirs]
    slack = drawn.tolerance + promise.tolerance
    for name in mine:
        if name in theirs:
            words += [f"{name}: {each}" for each in _apart(mine[name], theirs[name], slack)]
    if drawn.cloth != promise.cloth and drawn.cloth != "#ffffff":
        words.append(f"the cloth is {drawn.cloth} in the file, {promise.cloth} in the recipe")
    return words


def _apart(mine: Layer, theirs: Layer, slack: float) -> list[str]:
    words = []
    if mine.ink.colour != theirs.ink.colour:
        words.append(f"is {mine.ink.colour} in the file, {theirs.ink.colour} in the recipe")
    if not _same(mine.areas, theirs.areas):
        odd = _odd(mine.areas, theirs.areas, slack)
        if odd:
            words.append(f"the file and the recipe differ in {odd:,.3g} mm²")
    if not _same(mine.lines, theirs.lines):
        lines = [shapely.union_all(each.lines) for each in (mine, theirs)]
        near = shapely.buffer(lines, slack, quad_segs=2)
        odd = shapely.length(shapely.difference(lines, near[::-1])).sum()
        if odd > slack:
            words.append(f"the lines of the file and of the recipe differ over {odd:,.3g} mm")
    return words


def _odd(mine: Geometries, theirs: Geometries, slack: float) -> float:
    """Return the area (mm²) in which marks differ, slits as thin as the curves' tolerance left out."""
    if len(mine) == len(theirs):
        # Our own files keep the order of marks, and mark against mark is far less work.
        odd = _thick(shapely.symmetric_difference(mine, theirs), slack)
        if not odd:
            return 0.0
    whole = shapely.symmetric_difference(shapely.union_all(mine), shapely.union_all(theirs))
    return _thick(np.array([whole], dtype=object), slack)


def _thick(marks: Geometries, slack: float) -> float:
    parts = shapely.get_parts(marks)
    areas, lengths = shapely.area(parts), shapely.length(parts)
    # Twice the area by the length of its outline is the mean breadth of what is long and thin.
    return float(areas[2 * areas > slack * lengths].sum())


def _same(one: Geometries, other: Geometries) -> bool:
    """Whether two sets of marks are the same to the bit, in any order."""
    places = [np.unique(shapely.get_coordinates(marks), axis=0) for marks in (one, other)]
    length = [float(shapely.length(marks).sum()) for marks in (one, other)]
    return np.array_equal(places[0], places[1]) and math.isclose(*length, rel_tol=1e-9)
