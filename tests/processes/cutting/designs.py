"""Designs to cut: everyday recipes, and shapes in shapes in shapes."""

from __future__ import annotations

import math
from dataclasses import replace
from random import Random

import numpy as np
import shapely

from batik_vector import compile_recipe
from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.errors import RecipeError
from batik_vector.recipe.loading import read_recipe
from tests.random_recipes import recipe_text

SIDE = 120.0
NESTED = "shapes in shapes"
MOST = 3000
"""Vertices of a recipe's page up to which it is cut: what a test's own checks cost grows faster."""
DEAR = frozenset({6, 24, 58, 66, 94, 105, 114, 144, 168, 172, 204, 247, 250, 271, 276, 294})
"""Recipes that take seconds to compile."""


def design(number: int) -> Artwork:
    """Return a design, always the same.

    One of three is shapes in shapes, the others are recipes; shapes in shapes too where a recipe is refused,
    leaves nothing, or takes long to compile or to cut.
    """
    if number % 3 == 2 or number in DEAR:
        return nested(number)
    try:
        page = compile_recipe(read_recipe(recipe_text(number)))
    except RecipeError:
        return nested(number)
    return page if 0 < page.vertex_count <= MOST and covered(page).area else nested(number)


def artwork(*layers: list[shapely.Polygon], width: float = 0.8) -> Artwork:
    """Return a page of areas in mm, an ink to each list."""
    inks = [Ink(f"ink{number}", "#000000", width) for number in range(len(layers))]
    made = tuple(
        Layer(ink, areas=np.array(areas, dtype=object)) for ink, areas in zip(inks, layers, strict=True)
    )
    return Artwork("design", Cell(round(SIDE * 1000), round(SIDE * 1000)), made)


def nested(number: int) -> Artwork:
    """Return shapes with holes with shapes in them, up to four deep, on a grid of places."""
    chance = Random(number)
    count = chance.randint(1, 4)
    cell = SIDE / count
    areas = [
        part
        for column in range(count)
        for row in range(count)
        for part in _within(chance, (column + 0.5) * cell, (row + 0.5) * cell, cell * 0.48, 4)
    ]
    return replace(artwork(areas), title=NESTED)


def _within(chance: Random, x: float, y: float, radius: float, depth: int) -> list[shapely.Polygon]:
    """Return a shape within a circle, and what lies within its hole."""
    outer, room = _shape(chance, x, y, radius)
    if room < 4 or depth < 2 or chance.random() < 0.2:
        return [outer]
    hole, free = _shape(chance, x, y, room * chance.uniform(0.6, 0.9))
    whole = shapely.Polygon(outer.exterior, [hole.exterior])
    if free < 3 or chance.random() < 0.3:
        return [whole]
    return [whole, *_within(chance, x, y, free * 0.85, depth - 2)]


def _shape(chance: Random, x: float, y: float, radius: float) -> tuple[shapely.Polygon, float]:
    """Return a shape about a middle, on the grid, and the radius of a circle that lies within it."""
    kind, turn = chance.choice(["circle", "blob", "polygon", "star"]), chance.uniform(0, math.tau)
    if kind == "polygon":
        corners = chance.randint(3, 8)
        angles = np.arange(corners) * math.tau / corners
        far, room = np.full(corners, radius), radius * math.cos(math.pi / corners)
    elif kind == "star":
        points, inner = chance.randint(4, 9), chance.uniform(0.5, 0.85)
        angles = np.arange(2 * points) * math.pi / points
        far = np.where(np.arange(2 * points) % 2, inner * radius, radius)
        room = inner * radius * 0.9
    else:
        count = max(24, round(radius * 12))
        angles = np.arange(count) * math.tau / count
        waves, swing = chance.randint(2, 6), 0.0 if kind == "circle" else chance.uniform(0.02, 0.12)
        far = radius * (1 - swing + swing * np.sin(waves * angles))
        room = radius * (1 - 2 * swing) * 0.95
    points_ = np.stack([x + far * np.cos(angles + turn), y + far * np.sin(angles + turn)], axis=1)
    return shapely.Polygon(np.round(points_, 3)), room


def covered(page: Artwork) -> shapely.MultiPolygon:
    """Return what a page's areas and lines cover, as they would be seen, in mm."""
    parts = [
        part
        for layer in page.layers
        for part in (*layer.areas, *shapely.buffer(layer.lines, layer.ink.width / 2, quad_segs=32))
    ]
    union = shapely.union_all(parts)
    return shapely.MultiPolygon(shapely.get_parts(union).tolist())
