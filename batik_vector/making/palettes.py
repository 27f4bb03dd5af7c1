"""How a recipe takes the colours of a palette, or of one of its colourways."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import replace

from batik_vector.errors import Fault, RecipeError, unknown_name
from batik_vector.making.jobs import Job
from batik_vector.making.variants import Axis
from batik_vector.recipe.colourways import ALL
from batik_vector.recipe.loading import located, read_recipe
from batik_vector.recipe.model import InkSpec, Recipe
from batik_vector.recipe.palettes import PALETTES
from batik_vector.recipe.reading.sources import scheme_of, stem_of
from batik_vector.recipe.recolouring import kept_colours, taken_colours


def recoloured(recipe: Recipe, palette: str) -> tuple[str, ...]:
    """Return what is set in a recipe so that it has the colours of a palette, as ``KEY=VALUE``.

    What is light stays light: the recipe's colours take those of the palette in the order of their lightness,
    spread over its whole range; equal colours stay equal. The baths of a recipe become the palette's.

    Raises:
        RecipeError: where the palette cannot give them.
    """
    taken = taken_colours(recipe, palette)
    more = [f'bath[{number}].colour="{dye}"' for number, dye in enumerate(taken.baths)]
    if taken.undyed:
        more.append(f'cloth.undyed="{taken.undyed}"')
    return (*_set(recipe, taken.cloth, taken.inks), *more)


def in_colourway(recipe: Recipe, name: str) -> tuple[str, ...]:
    """Return what is set in a recipe so that it has the colours of one of its colourways, or a palette."""
    if name not in recipe.colourway:
        return recoloured(recipe, name)
    spec = recipe.colourway[name]
    given = recoloured(recipe, spec.palette) if spec.palette else ()
    own = _set(recipe, spec.cloth, spec.ink)
    taken = {each.partition("=")[0]: each for each in (*given, *own)}
    return tuple(taken.values())


def _set(recipe: Recipe, cloth: str | None, inks: Mapping[str, str]) -> tuple[str, ...]:
    """Return what gives cloth and inks other colours; drawings that keep theirs find their inks as before."""
    changes = [] if cloth is None else [f'cloth.colour="{cloth}"']
    if recipe.palette:
        # It has been taken, and must not be taken once more.
        changes.insert(0, 'palette=""')
        changes += [] if cloth else [f'cloth.colour="{recipe.cloth.colour}"']
        inks = {name: ink.colour for name, ink in recipe.ink.items()} | dict(inks)
    kept = kept_colours(recipe)
    for name, colour in inks.items():
        key, ink = f"ink.{_quoted(name)}", recipe.ink[name]
        if name in kept and replace(ink, colour=name, drawn=None) == InkSpec(colour=name):
            # The recipe says nothing of it: it was made of a colour in a drawing, and goes by that.
            changes.append(f'{key}={{colour="{colour}"}}')
            continue
        changes.append(f'{key}.colour="{colour}"')
        drawn = ink.colour if ink.drawn is None and ink.colour in kept and name != ink.colour else None
        if drawn or (recipe.palette and ink.drawn):
            changes.append(f'{key}.drawn="{drawn or ink.drawn}"')
    return tuple(changes)


def _quoted(name: str) -> str:
    from batik_vector.recipe.references import dotted

    return dotted((name,))


def palette_axis(recipe: Recipe, names: Sequence[str]) -> Axis:
    """Return the axis that varies the palette.

    Raises:
        RecipeError: where a name is none ("all" stands for all of them), or baths give the colours.
    """
    wanted = list(PALETTES) if "all" in names else list(dict.fromkeys(names))
    for name in wanted:
        if name not in PALETTES:
            raise RecipeError(unknown_name(name, list(PALETTES), "palette"))
    return Axis("palette", tuple(wanted), changes=tuple(recoloured(recipe, name) for name in wanted))


def colourway_axis(recipe: Recipe, names: Sequence[str]) -> Axis:
    """Return the axis that varies the colourway.

    Raises:
        RecipeError: where there is none of a name ("all" stands for all of the recipe's own).
    """
    wanted = colourways_of(recipe, names)
    return Axis("colourway", wanted, changes=tuple(in_colourway(recipe, name) for name in wanted))


def colourways_of(recipe: Recipe, names: Sequence[str]) -> tuple[str, ...]:
    """Return the names of colourways, the recipe's own or palettes, that a call asks for.

    Raises:
        RecipeError: where there is none of a name ("all" stands for all of the recipe's own).
    """
    if ALL in names and not recipe.colourway:
        words = "the recipe has none: expected [colourway.NAME] tables with colours of cloth and inks"
        raise RecipeError([Fault(f"{words}, or names of palettes: batik-vector palettes", "colourway")])
    own = tuple(recipe.colourway) if ALL in names else ()
    wanted = tuple(dict.fromkeys((*own, *(name for name in names if name != ALL))))
    known = [*recipe.colourway, *PALETTES]
    for name in wanted:
        if name not in known:
            raise RecipeError([Fault(unknown_name(name, known, "colourway"))])
    return wanted


def jobs_in_colourways(jobs: Sequence[Job], names: Sequence[str]) -> list[Job]:
    """Return each job once for each of some colourways, whose name is added to its files'.

    Raises:
        RecipeError: where a recipe has none of a name; see :func:`colourways_of`.
    """
    found = []
    for job in jobs:
        try:
            wanted = colourways_of(job.recipe, names)
        except RecipeError as error:
            raise located(error, job.source, job.recipe.source) from None
        for name in wanted:
            changes = in_colourway(job.recipe, name)
            folder = None if scheme_of(job.source)[0] else os.path.dirname(job.source) or "."
            # The text is there, and standard input is read once.
            recipe = read_recipe(job.recipe.source, job.source, changes, folder)
            stem = f"{job.stem or stem_of(job.source)}-{name}"
            found.append(replace(job, recipe=recipe, overrides=(*job.overrides, *changes), stem=stem))
    return found
