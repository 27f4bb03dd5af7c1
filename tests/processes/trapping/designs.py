"""Random tiles of inks that cut one another out, and their traps."""

from __future__ import annotations

from random import Random

import numpy as np
import shapely

from batik_vector import compile_recipe
from batik_vector.artwork import Artwork, Geometries, Overlap
from batik_vector.geometry.curves import Circle, Petal, Star, Superellipse
from batik_vector.machines import Machine
from batik_vector.processes.options import TrapProcess
from batik_vector.processes.trapping.choices import By, Covered
from batik_vector.recipe.model import InkSpec, Placement, Recipe
from batik_vector.recipe.motif import Element, Rosette, Treatment
from batik_vector.tiling.cloth.field import repeated
from batik_vector.tiling.symmetry.repeats import TileSpec

COLOURS = {"indigo": "#1d2f5f", "straw": "#e8d070", "soga": "#8f5a2c", "rose": "#d08090"}
LIGHTEST_FIRST = ("straw", "rose", "soga", "indigo")
REPEATS = ("grid", "half-drop", "brick", "drop 1/3", "p4", "pgg")


def random_tile(number: int) -> Artwork:
    """Return a tile of areas in four inks that meet side by side, always the same."""
    chance = Random(number)
    inks = list(COLOURS)
    chance.shuffle(inks)
    side = chance.randint(25, 40)
    places = [
        Placement(
            motif=chance.choice(inks),
            scale=chance.uniform(6, 14),
            at=(chance.uniform(-side, side), chance.uniform(-side, side)),
            turn=chance.uniform(0, 360),
        )
        for _ in range(6)
    ]
    # What cuts out alone leaves nothing to draw.
    places.append(Placement(motif="ground", scale=side / 4, at=(0, 0)))
    recipe = Recipe(
        motif={
            **{name: _motif(chance, name) for name in inks},
            "ground": Rosette(elements=(Element(curve=Circle(radius=1), name="ground", ink=inks[0]),)),
        },
        place=tuple(places),
        tile=TileSpec(size=(side, side), repeat=chance.choice(REPEATS)),
        tolerance=0.05,
        ink={name: InkSpec(colour=COLOURS[name], overlap=Overlap.KNOCKOUT) for name in inks},
    )
    return compile_recipe(recipe)


def _motif(chance: Random, ink: str) -> Rosette:
    def element(first: bool) -> Element:
        size = chance.uniform(0.4, 1.2)
        curve = chance.choice(
            [
                Circle(radius=size),
                Superellipse(a=1.0, b=chance.uniform(0.8, 3), length=size, width=size),
                Petal(n=chance.randint(2, 5), length=size),
                Star(points=chance.randint(3, 7), radius=size, inner=size * 0.5),
            ]
        )
        treatment = Treatment.AREA if first else chance.choice([Treatment.AREA, Treatment.CUT])
        return Element(
            curve=curve,
            name="part",
            count=chance.randint(1, 4),
            radius=chance.uniform(0, 1.2),
            treatment=treatment,
            ink=ink,
        )

    return Rosette(elements=tuple(element(not number) for number in range(chance.randint(1, 3))))


def trapped(tile: Artwork, width: float, by: str = "lightness", covered: str = "refuse") -> Artwork:
    """Return a tile with traps."""
    done = TrapProcess(width=width, by=By(by), covered=Covered(covered)).apply(tile, Machine())
    assert isinstance(done, Artwork)
    return done


def field(tile: Artwork) -> dict[str, shapely.Geometry]:
    """Return what each ink covers of three by three tiles, in mm, as one geometry."""
    return {layer.ink.name: shapely.union_all(layer.areas) for layer in repeated(tile, 3, 3).layers}


def thick(geometry: shapely.Geometry, breadth: float) -> Geometries:
    """Return what is left of the parts of a geometry that are broader than so many mm."""
    inner = shapely.get_parts(shapely.buffer(shapely.make_valid(geometry), -breadth / 2))
    return np.asarray(inner[~shapely.is_empty(inner)], dtype=object)
