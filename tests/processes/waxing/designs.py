"""Random designs in four colours of two baths: curves and lines, and shapes that meet on the grid."""

from __future__ import annotations

from random import Random

import numpy as np
import shapely

from batik_vector import compile_recipe
from batik_vector.artwork import Artwork, Bath, Cell, Dyeing, Ink, Layer, Overlap
from batik_vector.errors import RecipeError
from batik_vector.geometry.curves import Circle, Petal, Star, Superellipse
from batik_vector.recipe.dyeing import BathSpec
from batik_vector.recipe.model import InkSpec, Placement, Recipe
from batik_vector.recipe.motif import Element, Rosette, Treatment
from batik_vector.tiling.symmetry.repeats import TileSpec

SEEN = {"white": frozenset[str](), "blue": frozenset({"indigo"}), "brown": frozenset({"soga"})}
BOTH = frozenset({"indigo", "soga"})
BATHS = (BathSpec(name="indigo", colour="#2b4a8b"), BathSpec(name="soga", colour="#9a6233"))
REPEATS = ("grid", "half-drop", "brick", "drop 1/3", "p4", "pgg")


def drawn(number: int) -> Artwork:
    """Return a design of curves and lines that cross one another and the seam, always the same."""
    chance = Random(number)
    inks = list(SEEN)
    chance.shuffle(inks)
    overlaps = [chance.choice(list(Overlap)) for _ in inks]
    side = chance.randint(30, 50)
    recipe = Recipe(
        motif={name: _motif(chance, name) for name in inks},
        place=tuple(
            Placement(
                motif=name,
                scale=chance.uniform(6, 14),
                at=(chance.uniform(-side, side), chance.uniform(-side, side)),
                turn=chance.uniform(0, 360),
                gap=chance.choice([None, None, 0.7]),
            )
            for name in inks
        ),
        tile=TileSpec(size=(side, side), repeat=chance.choice(REPEATS)),
        tolerance=0.2,
        bath=BATHS,
        ink={
            name: InkSpec(width=chance.uniform(0.4, 3), overlap=overlap, baths=tuple(SEEN[name]))
            for name, overlap in zip(inks, overlaps, strict=True)
        },
    )
    try:
        return compile_recipe(recipe)
    except RecipeError:
        # Gaps and cuts may leave nothing: another design then.
        return drawn(number + 100_003)


def _motif(chance: Random, ink: str) -> Rosette:
    def element(first: bool) -> Element:
        size = chance.uniform(0.3, 1.2)
        curve = chance.choice(
            [
                Circle(radius=size),
                Superellipse(
                    a=1.0, b=chance.uniform(0.8, 3), length=size, width=size * chance.uniform(0.3, 1)
                ),
                Petal(n=chance.randint(2, 5), length=size),
                Star(points=chance.randint(3, 7), radius=size, inner=size * 0.5),
            ]
        )
        return Element(
            curve=curve,
            name="part",
            count=chance.randint(1, 4),
            radius=chance.uniform(0, 1.2),
            treatment=Treatment.AREA if first else chance.choice(treatments),
            ink=ink,
        )

    treatments = [Treatment.AREA, Treatment.LINE, Treatment.LINE, Treatment.CUT]
    return Rosette(elements=tuple(element(not number) for number in range(chance.randint(1, 3))))


def meeting(number: int) -> Artwork:
    """Return a design of shapes with sides in eight directions, whose crossings are all on the grid."""
    chance = Random(number)
    width, height = (2000 * chance.randint(15, 30) for _ in range(2))
    box = shapely.box(0, 0, width, height)
    inks = list(SEEN)
    chance.shuffle(inks)
    layers = []
    for name in inks:
        shapes = [_octagon(chance, width, height) for _ in range(chance.randint(1, 6))]
        moved = [
            shapely.affinity.translate(each, x, y)
            for each in shapes
            for x in (-width, 0, width)
            for y in (-height, 0, height)
        ]
        union = shapely.intersection(shapely.union_all(moved), box)
        areas = [each for each in shapely.get_parts(union) if each.geom_type == "Polygon"]
        mm = shapely.transform(shapely.orient_polygons(np.array(areas, dtype=object)), lambda xy: xy / 1000)
        layers.append(Layer(Ink(name, "#808080"), areas=mm))
    dyeing = Dyeing(tuple(Bath(each.name, each.colour) for each in BATHS), "#f4efe2", BOTH, SEEN)
    return Artwork("design", Cell(width, height), tuple(layers), dyeing=dyeing)


def _octagon(chance: Random, width: int, height: int) -> shapely.Polygon:
    """Return a rectangle with its corners cut off at 45°, on even steps."""
    w, h = (2 * chance.randint(1000, side // 4) for side in (width, height))
    cut = 2 * chance.randint(0, min(w, h) // 4 - 1)
    x, y = 2 * chance.randint(0, width // 2), 2 * chance.randint(0, height // 2)
    corners = [(cut, 0), (w - cut, 0), (w, cut), (w, h - cut), (w - cut, h), (cut, h), (0, h - cut), (0, cut)]
    return shapely.Polygon([(x + a, y + b) for a, b in corners])
