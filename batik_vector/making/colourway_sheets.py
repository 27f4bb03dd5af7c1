"""The colourway sheet: a page with the tile of a recipe in several colourways, and their colours."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from batik_vector.artwork import Artwork
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.making.jobs import Job
from batik_vector.making.palettes import colourways_of, jobs_in_colourways
from batik_vector.making.sheets import Entry, Plan, pages, plan
from batik_vector.making.thumbnails import thumbnail
from batik_vector.recipe.colourways import ALL
from batik_vector.recipe.model import Recipe

AS_WRITTEN = "as written"
"""What the recipe's own colours are called."""
MOST_INKS = 8
"""Inks whose colours stand below a picture."""


def colourway_sheet(job: Job, names: Sequence[str], paper: str = "A4") -> tuple[Iterator[str], Plan]:
    """Return the pages of a sheet as SVG, and their layout: the recipe as it is written, then each colourway.

    The tile is compiled once: colours alone differ.

    Args:
        job: whose recipe is drawn.
        names: of its colourways, or of palettes; "all" stands for all of its own.
        paper: a name of :data:`~batik_vector.making.sheets.PAPERS`.

    Raises:
        RecipeError: where there is no such colourway or paper, or the recipe is wrong.
    """
    wanted = [] if tuple(names) == (ALL,) and not job.recipe.colourway else colourways_of(job.recipe, names)
    jobs = jobs_in_colourways([job], wanted) if wanted else []
    recipes = {AS_WRITTEN: job.recipe} | {name: each.recipe for name, each in zip(wanted, jobs, strict=True)}
    tile = compile_recipe(job.recipe)
    captions = {name: _caption(name, recipe) for name, recipe in recipes.items()}
    lines = max(map(len, captions.values()))
    layout = plan(len(recipes), tile.cell.height / tile.cell.width, lines, paper)
    entries = (Entry(thumbnail(_coloured(tile, recipe)), captions[name]) for name, recipe in recipes.items())
    several = f"{len(recipes)} colourways" if len(recipes) > 1 else "one colourway"
    size = f"{tile.cell.width:g} × {tile.cell.height:g} mm"
    return pages(entries, len(recipes), layout, job.recipe.title, [f"{several}; repeat {size}"]), layout


def _caption(name: str, recipe: Recipe) -> tuple[str, ...]:
    inks = [f"{ink} {spec.colour}" for ink, spec in recipe.ink.items()]
    more = [f"and {len(inks) - MOST_INKS} inks more"] if len(inks) > MOST_INKS else []
    return (name, f"cloth {recipe.cloth.colour}", *inks[:MOST_INKS], *more)


def _coloured(tile: Artwork, recipe: Recipe) -> Artwork:
    """Return a tile in the colours of a recipe that has the same inks."""
    layers = tuple(
        replace(layer, ink=replace(layer.ink, colour=recipe.ink[layer.ink.name].colour))
        for layer in tile.layers
    )
    return replace(tile, layers=layers, cloth=recipe.cloth.colour)
