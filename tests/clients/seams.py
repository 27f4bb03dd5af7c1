"""Fields of tiles on which light shows where a seam is left open.

Solid black marks cross every seam of each tile, on a page without ground. Where a pixel stands well
inside such a mark, whatever is not black in it is ground that bleeds through.
"""

from __future__ import annotations

import enum
import functools
import xml.etree.ElementTree as ET
from collections.abc import Iterator

import numpy as np
import shapely
from numpy.typing import NDArray
from PIL import Image

from batik_vector.artwork import Artwork, Cell
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.export import SvgOptions, render
from batik_vector.geometry.curves import Polygon, Superellipse
from batik_vector.recipe.model import Cut, InkSpec, Placement, Recipe, TileSpec
from batik_vector.recipe.motif import Element, Rosette, Treatment
from batik_vector.tiling.cloth.field import repeated
from batik_vector.units import STEPS_PER_MM
from tests.clients.pictures import Mask
from tests.clients.renderers import Page

ACROSS = UP = 3
DPIS = (72, 96, 150, 203, 300)
NEAR = 3
"""Pixels to a former seam, and pixels of mark round a pixel, that is looked at."""
BARE = SvgOptions(cloth=False)


class Joint(enum.StrEnum):
    """How tiles are put together."""

    WELDED = "welded"
    """By :func:`~batik_vector.tiling.cloth.field.repeated`."""
    ABUTTING = "abutting"
    """The tile's own paths copied side by side, as drawing programs repeat a tile."""


def _recipe(spec: TileSpec, at: tuple[float, float], *elements: Element) -> Recipe:
    return Recipe(
        motif={"mark": Rosette(elements=elements)},
        place=(Placement(motif="mark", scale=1.0, at=at),),
        tile=spec,
        ink={"ink": InkSpec(colour="#000000", width=2.6)},
    )


def _fruit(length: float, width: float, treatment: Treatment = Treatment.AREA) -> Element:
    curve = Superellipse(a=1, b=1.08, length=length, width=width)
    return Element(curve=curve, count=4, radius=10.15, turn=45, treatment=treatment)


# Seams fall between pixels at every resolution, also where a program stretches the page to whole pixels.
RECIPES = {
    "black": _recipe(
        TileSpec(size=(10.37, 10.43)), (0, 0), Element(curve=Polygon(sides=4, radius=10.4), name="all")
    ),
    "kawung": _recipe(
        TileSpec(size=(28.71, 28.75)),
        (8.2, 4.6),
        _fruit(8.95, 4.48),
        _fruit(8.44, 4.05, Treatment.CUT),
        _fruit(7.9, 3.55),
        _fruit(2.2, 0.9, Treatment.CUT),
    ),
    "half-drop": _recipe(
        TileSpec(size=(13.13, 9.69), repeat="half-drop", cut=Cut.UNIT),
        (1.1, 0.7),
        Element(curve=Superellipse(a=1, b=1.2, length=2.7, width=1.9), count=5, radius=2.6),
    ),
    "brick": _recipe(
        TileSpec(size=(10.37, 8.57), repeat="brick", cut=Cut.UNIT),
        (0.4, 4.1),
        Element(curve=Superellipse(a=1, b=1.1, length=3.9, width=2.2), turn=20, treatment=Treatment.STROKE),
        Element(curve=Superellipse(a=1, b=1.1, length=3, width=1.5), turn=20, radius=4.6),
    ),
}


@functools.cache
def tile(name: str) -> Artwork:
    """Return a tile."""
    return compile_recipe(RECIPES[name])


@functools.cache
def field(name: str) -> Artwork:
    """Return a tile's field, welded."""
    return repeated(tile(name), ACROSS, UP)


@functools.cache
def pages(joint: Joint) -> dict[tuple[str, int], Page]:
    """Return every field put together in one way, at every resolution."""
    found = {}
    for name in RECIPES:
        cell = field(name).cell
        svg = _abutting(tile(name), cell) if joint is Joint.ABUTTING else render(field(name), "svg", BARE)
        for dpi in DPIS:
            found[name, dpi] = Page(svg, cell.width, cell.height, dpi)
    return found


def _abutting(one: Artwork, whole: Cell) -> bytes:
    """Return the SVG of a field made by moving copies of the tile's SVG."""
    space = "{http://www.w3.org/2000/svg}"
    layers = ET.fromstring(render(one, "svg", BARE)).findall(f"{space}g")
    for part in (part for layer in layers for part in layer.iter()):
        part.tag = part.tag.removeprefix(space)
        part.attrib = {key: value for key, value in part.attrib.items() if key != "id" and key[0] != "{"}
    width, height = f"{whole.width:g}", f"{whole.height:g}"
    page = {"xmlns": space[1:-1], "width": f"{width}mm", "height": f"{height}mm"}
    root = ET.Element("svg", page, viewBox=f"0 0 {width} {height}")
    for x, y in _translations(one.cell, whole):
        move = f"translate({x / STEPS_PER_MM} {(whole.rows - one.cell.rows - y) / STEPS_PER_MM})"
        ET.SubElement(root, "g", transform=move).extend(layers)
    return ET.tostring(root)


def _translations(cell: Cell, whole: Cell) -> Iterator[tuple[int, int]]:
    """Yield in grid steps where the lower left corners of the tiles lie that show in a field."""
    (ax, ay), (bx, by) = cell.lattice
    for i in range(-UP, ACROSS + 1):
        for j in range(-ACROSS, UP + 1):
            x, y = i * ax + j * bx, i * ay + j * by
            if -cell.columns < x < whole.columns and -cell.rows < y < whole.rows:
                yield x, y


@functools.cache
def inside(name: str, dpi: int) -> Mask:
    """Return which pixels of a field lie near a former seam, and wholly within a mark with those around."""
    whole, step = field(name), 25.4 / dpi
    columns, rows = (int(side // step) for side in (whole.cell.width, whole.cell.height))
    x = np.broadcast_to((np.arange(columns) + 0.5) * step, (rows, columns))
    y = whole.cell.height - np.broadcast_to(((np.arange(rows) + 0.5) * step)[:, None], (rows, columns))
    found = to_seam(x, y, tile(name).cell) <= NEAR * step
    page = shapely.box(0, 0, whole.cell.width, whole.cell.height)
    (layer,) = whole.layers
    core = shapely.buffer(shapely.intersection(shapely.union_all(layer.areas), page), -NEAR * step)
    shapely.prepare(core)
    found[found] = shapely.contains_xy(core, x[found], y[found])
    return found


def to_seam(x: NDArray[np.float64], y: NDArray[np.float64], cell: Cell) -> NDArray[np.float64]:
    """Return how far points (mm) lie from an edge of the tile that they stand in."""
    slip_y, slip_x = cell.lattice[0][1] / STEPS_PER_MM, cell.lattice[1][0] / STEPS_PER_MM
    u = (x - slip_x * np.floor(y / cell.height)) / cell.width
    v = (y - slip_y * np.floor(x / cell.width)) / cell.height
    return np.minimum(np.abs(u - np.rint(u)) * cell.width, np.abs(v - np.rint(v)) * cell.height)


def bleeding(picture: Image.Image, where: Mask) -> int:
    """Return by how many levels of 255 the worst pixel is lighter than the black mark that it lies in."""
    pixels = np.asarray(picture)[: where.shape[0], : where.shape[1]]
    return int(pixels[where].max())
