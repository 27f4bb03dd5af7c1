"""What shows at former seams: of a welded field nothing, in any program; of tiles laid side by side much."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Artwork
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.export import PngOptions, render
from batik_vector.recipe.model import Recipe, TileSpec
from batik_vector.tiling.cloth.field import repeated
from tests.clients.pictures import RIM, load
from tests.clients.renderers import IN_PYTHON, PROGRAMS, Renderer
from tests.clients.seams import DPIS, RECIPES, Joint, bleeding, inside, pages

Pixels = NDArray[np.int16]

UNSEEN = 1
"""Levels of 255: what a renderer may round."""
PLAIN = 25
"""Levels of 255 by which ground shows between abutting tiles at least: a tenth."""
FEW = 100
"""Pixels that must be looked at, or else nothing is shown."""
RENDERERS = [
    *(pytest.param(draw, id=name) for name, draw in IN_PYTHON.items()),
    *(pytest.param(draw, id=name, marks=pytest.mark.clients) for name, draw in PROGRAMS.items()),
]


def bled(draw: Renderer, joint: Joint, folder: Path) -> dict[tuple[str, int], int]:
    """Return how much ground shows along the former seams of every field, at every resolution."""
    asked = pages(joint)
    pictures = draw(list(asked.values()), folder)
    return {key: bleeding(picture, inside(*key)) for key, picture in zip(asked, pictures, strict=True)}


@pytest.mark.parametrize("draw", RENDERERS)
def test_nothing_bleeds_through_a_welded_field(draw: Renderer, tmp_path: Path) -> None:
    found = bled(draw, Joint.WELDED, tmp_path)
    assert {key: levels for key, levels in found.items() if levels > UNSEEN} == {}


@pytest.mark.parametrize("draw", RENDERERS)
def test_abutting_tiles_bleed_at_every_resolution(draw: Renderer, tmp_path: Path) -> None:
    found = bled(draw, Joint.ABUTTING, tmp_path)
    assert {key: levels for key, levels in found.items() if levels < PLAIN} == {}


@pytest.mark.parametrize("draw", RENDERERS)
def test_a_black_field_is_black_to_its_rim(draw: Renderer, tmp_path: Path) -> None:
    asked = [page for (name, _), page in pages(Joint.WELDED).items() if name == "black"]
    for picture in draw(asked, tmp_path):
        assert np.asarray(picture)[RIM:-RIM, RIM:-RIM].max() <= UNSEEN


@pytest.mark.parametrize("dpi", DPIS)
@pytest.mark.parametrize("name", RECIPES)
def test_marks_cross_the_seams(name: str, dpi: int) -> None:
    assert inside(name, dpi).sum() > FEW


TILES = {
    "kawung": TileSpec(size=(30.48, 30.48)),
    "half-drop": TileSpec(size=(10.16, 15.24), repeat="drop 1/3"),
    "brick": TileSpec(size=(10.16, 12.7), repeat="brick 1/3"),
}
"""Half of each tile is a whole number of pixels, and no step of its own lattice."""
DPI = 100.0
FINER = 8
"""Cairo reads 15 lines in a row of pixels: an edge moved by a micrometre may change a pixel by a line."""


@pytest.fixture(params=TILES)
def recipe(request: pytest.FixtureRequest) -> Recipe:
    name: str = request.param
    return replace(RECIPES[name], tile=TILES[name])


def preview(artwork: Artwork, finer: int = 1) -> Pixels:
    picture = load(render(artwork, "png", PngOptions(dpi=DPI * finer))).reduce(finer)
    return np.asarray(picture, np.int16)


def rolled(pixels: Pixels) -> Pixels:
    """Return a picture of a tile moved half a tile on."""
    rows, columns = pixels.shape[:2]
    assert rows % 2 == columns % 2 == 0
    return np.roll(pixels, (rows // 2, columns // 2), (0, 1))


def half_on(recipe: Recipe) -> Recipe:
    """Return a recipe with everything placed half a tile on."""
    cell = recipe.tiling.cell()
    places = [
        replace(place, at=(place.at[0] + cell.width / 2, place.at[1] + cell.height / 2))
        for place in recipe.place
        if place.at
    ]
    return replace(recipe, place=tuple(places))


def test_a_rolled_preview_is_the_field_cut_half_a_tile_on(recipe: Recipe) -> None:
    tile = compile_recipe(recipe)
    picture = rolled(preview(tile))
    rows, columns = picture.shape[:2]
    field = preview(repeated(tile, 2, 2))[rows // 2 :, columns // 2 :][:rows, :columns]
    assert np.abs(picture - field).max() <= UNSEEN


def test_a_rolled_preview_is_the_design_placed_half_a_tile_on(recipe: Recipe) -> None:
    picture = rolled(preview(compile_recipe(recipe), FINER))
    assert np.abs(picture - preview(compile_recipe(half_on(recipe)), FINER)).max() <= UNSEEN


def test_a_mark_missing_on_one_side_of_a_seam_is_told(recipe: Recipe) -> None:
    tile = compile_recipe(recipe)
    layer = tile.layers[-1]
    areas = layer.areas[shapely.bounds(layer.areas)[:, 0] > 0]
    assert len(areas) < len(layer.areas)
    poorer = replace(tile, layers=(*tile.layers[:-1], replace(layer, areas=areas, area_names=())))
    picture = rolled(preview(poorer, FINER))
    assert np.abs(picture - preview(compile_recipe(half_on(recipe)), FINER)).max() > 100
