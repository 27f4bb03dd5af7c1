"""Tiles to crack and to draw by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely

from batik_vector import Artwork, certify, compile_recipe
from batik_vector.artwork import Cell, Geometries, Ink, Layer
from batik_vector.errors import BatikError
from batik_vector.recipe.loading import read_recipe
from tests.random_recipes import recipe_text

COTTON = Ink("cotton", "#f4efe2", 1.2)
SOGA = Ink("soga", "#9a5a30", 1.2)
INDIGO = "#1d2f5f"


def tile(*layers: Layer, side: int = 60_000, cell: Cell | None = None) -> Artwork:
    return Artwork("Tile", cell or Cell(side, side), layers, INDIGO)


def bare(side: int = 60_000) -> Artwork:
    """Cloth that is waxed all over."""
    return tile(Layer(COTTON, np.array([shapely.box(0, 0, side / 1000, side / 1000)])), side=side)


def rings() -> Artwork:
    """Rings of 0.8 to 2 mm in one ink, and dots in another; nothing meets the tile's edges."""
    centres = shapely.points([[15, 15], [45, 15], [15, 45], [45, 45]])
    outer = shapely.buffer(centres, [12, 10, 9, 11], quad_segs=24)
    inner = shapely.buffer(centres, [11.2, 8.8, 7, 10], quad_segs=24)
    dots = shapely.buffer(shapely.points([[30, k] for k in range(6, 60, 6)]), 0.8, quad_segs=8)
    return tile(Layer(COTTON, on_grid(shapely.difference(outer, inner))), Layer(SOGA, on_grid(dots)))


def on_grid(areas: Any) -> Geometries:
    made = shapely.transform(np.asarray(areas, dtype=np.object_), lambda xy: np.rint(xy * 1000) / 1000)
    return np.asarray(shapely.orient_polygons(made), dtype=np.object_)


def steps(areas: Geometries) -> Geometries:
    return np.asarray(shapely.transform(areas, lambda xy: np.rint(xy * 1000)), dtype=np.object_)


def random_tile(number: int) -> Artwork:
    """Return the tile of a random recipe; the test is skipped where there is none, or it is not sound."""
    try:
        page = compile_recipe(read_recipe(recipe_text(number)))
    except BatikError as error:
        pytest.skip(str(error))
    if certify(page).faults:
        pytest.skip("it has faults of its own")
    return page
