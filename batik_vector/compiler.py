"""From a recipe to an artwork: the story, told once.

Every placement is drawn, set out by its layout and brought to millimetres as sheets; the sheets are
assembled on the torus; what leaves is an :class:`~batik_vector.artwork.Artwork` in the normal form.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import shapely

from batik_vector._version import __version__
from batik_vector.artwork import Artwork, Ink, Provenance, violations
from batik_vector.errors import RecipeError, blame
from batik_vector.model import Recipe
from batik_vector.placing import place
from batik_vector.tiling import seams
from batik_vector.tiling.stack import assemble
from batik_vector.tiling.torus import to_step_grid
from batik_vector.units import STEPS_PER_MM

Progress = Callable[[str], None]


def compile_recipe(recipe: Recipe, *, progress: Progress | None = None) -> Artwork:
    """Compile a recipe to the artwork of its tile.

    Args:
        recipe: as read by :func:`~batik_vector.recipe.load_recipe`, or built in Python.
        progress: called with a word or two as each stage begins.

    Raises:
        RecipeError: naming the key at fault.
        SeamError: where no clean seam is found.
    """
    tell = progress or (lambda stage: None)
    inks = {name: Ink(name, spec.colour, spec.width, spec.overlap) for name, spec in recipe.ink.items()}
    unit = recipe.tile.unit()
    sheets = []
    spent = 0
    for number, placement in enumerate(recipe.place):
        tell(f"placing {placement.motif}")
        with blame(f"place[{number}]"):
            placed = place(placement, recipe, unit, inks, recipe.limit - spent)
        sheets += placed.sheets
        spent += placed.vertices
    tell("cutting the tile")
    cell = recipe.tile.cell()
    with blame("tile"):
        layers, borders = assemble(sheets, list(inks.values()), cell, unit.lattice, recipe.tolerance)
    if not layers:
        raise RecipeError("nothing is left to draw: every mark is covered or cut away")
    return Artwork(
        title=recipe.title,
        cell=cell,
        layers=layers,
        cloth=recipe.cloth.colour,
        tolerance=recipe.tolerance,
        borders=borders,
        provenance=Provenance(recipe.source, recipe.seed, __version__),
    )


def inspect(artwork: Artwork) -> dict[str, Any]:
    """Return the facts of an artwork and whatever is wrong with it, as plain values.

    ``violations`` lists breaks of the normal form; ``seam`` the stretches, in mm, that one edge covers
    and its opposite does not. An artwork is sound when both are empty.
    """
    cell_area = artwork.cell.width * artwork.cell.height
    breaks = []
    for layer in artwork.layers:
        for axis, low, high in seams.mismatch(to_step_grid(layer.areas), artwork.cell).tolist():
            if (layer.ink.name, axis, low, high) in artwork.borders:
                continue
            side = "left and right" if axis == 0 else "lower and upper"
            ends = {"from_mm": low / STEPS_PER_MM, "to_mm": high / STEPS_PER_MM}
            breaks.append({"ink": layer.ink.name, "edges": side, **ends})
    return {
        "title": artwork.title,
        "cell_mm": [artwork.cell.width, artwork.cell.height],
        "drop": str(artwork.cell.drop),
        "vertices": artwork.vertex_count,
        "layers": [
            {
                "ink": layer.ink.name,
                "colour": layer.ink.colour,
                "areas": len(layer.areas),
                "lines": len(layer.lines),
                "covers": round(float(shapely.area(layer.areas).sum()) / cell_area, 6),
            }
            for layer in artwork.layers
        ],
        "violations": violations(artwork),
        "seam": breaks,
    }
