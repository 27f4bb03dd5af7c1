"""How a recipe takes the colours of a palette, or of one of its colourways."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import replace

from batik_vector.errors import Fault, RecipeError, unknown_name
from batik_vector.making.jobs import Job
from batik_vector.making.variants import Axis
from batik_vector.recipe.colourways import PALETTES, printed_by_itself, stays
from batik_vector.recipe.drawing import Svg
from batik_vector.recipe.loading import located, read_recipe
from batik_vector.recipe.model import InkSpec, Recipe
from batik_vector.recipe.reading.sources import scheme_of, stem_of


def lightness(colour: str) -> float:
    """Return the relative luminance of a colour ``#rrggbb``. WCAG 2.1."""
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def recoloured(recipe: Recipe, palette: str) -> tuple[str, ...]:
    """Return what is set in a recipe so that it has the colours of a palette, as ``KEY=VALUE``.

    What is light stays light: the recipe's colours take those of the palette in the order of their lightness,
    spread over its whole range; equal colours stay equal.
    """
    old = [recipe.cloth.colour, *(ink.colour for ink in recipe.ink.values())]
    ranked = sorted(set(old), key=lambda colour: (-lightness(colour), colour))
    colours = PALETTES[palette]
    last = max(len(ranked) - 1, 1)
    taken = {colour: colours[round(place * (len(colours) - 1) / last)] for place, colour in enumerate(ranked)}
    return _set(
        recipe, taken[recipe.cloth.colour], {name: taken[ink.colour] for name, ink in recipe.ink.items()}
    )


def in_colourway(recipe: Recipe, name: str) -> tuple[str, ...]:
    """Return what is set in a recipe so that it has the colours of a colourway of its own, likewise."""
    spec = recipe.colourway[name]
    given = recoloured(recipe, spec.palette) if spec.palette else ()
    own = _set(recipe, spec.cloth, spec.ink)
    taken = {each.partition("=")[0]: each for each in (*given, *own)}
    return tuple(taken.values())


def _set(recipe: Recipe, cloth: str | None, inks: Mapping[str, str]) -> tuple[str, ...]:
    """Return what gives cloth and inks other colours; drawings that keep theirs find their inks as before."""
    changes = [] if cloth is None else [f'cloth.colour="{cloth}"']
    kept = {
        colour for motif in recipe.motif.values() if isinstance(motif, Svg) for colour in motif.colours_kept()
    }
    for name, colour in inks.items():
        key, ink = f"ink.{_quoted(name)}", recipe.ink[name]
        if name in kept and ink == InkSpec(colour=name):
            # The recipe says nothing of it: it was made of a colour in a drawing, and goes by that.
            changes.append(f'{key}={{colour="{colour}"}}')
            continue
        changes.append(f'{key}.colour="{colour}"')
        if ink.drawn is None and ink.colour in kept and name != ink.colour:
            changes.append(f'{key}.drawn="{ink.colour}"')
    return tuple(changes)


def _quoted(name: str) -> str:
    from batik_vector.recipe.references import dotted

    return dotted((name,))


def palette_axis(recipe: Recipe, names: Sequence[str]) -> Axis:
    """Return the axis that varies the palette.

    Raises:
        RecipeError: where a name is none ("all" stands for all of them), or baths give the colours.
    """
    if recipe.bath:
        words = "baths give this recipe its colours, and no palette can: vary theirs, as --vary"
        raise RecipeError([Fault(f'{words} \'bath[0].colour="#27407a","#7a1d1c"\'', "bath")])
    for name in printed_by_itself(recipe.ink):
        raise RecipeError([Fault(f"palettes are for the screen, and {stays(name)}", f"ink.{_quoted(name)}")])
    wanted = list(PALETTES) if "all" in names else list(dict.fromkeys(names))
    for name in wanted:
        if name not in PALETTES:
            raise RecipeError(unknown_name(name, list(PALETTES), "palette"))
    return Axis("palette", tuple(wanted), changes=tuple(recoloured(recipe, name) for name in wanted))


def colourway_axis(recipe: Recipe, names: Sequence[str]) -> Axis:
    """Return the axis that varies the colourway.

    Raises:
        RecipeError: where the recipe has none of a name ("all" stands for all of them).
    """
    wanted = colourways_of(recipe, names)
    return Axis("colourway", wanted, changes=tuple(in_colourway(recipe, name) for name in wanted))


def colourways_of(recipe: Recipe, names: Sequence[str]) -> tuple[str, ...]:
    """Return the names of colourways that a call asks for.

    Raises:
        RecipeError: where the recipe has none of a name ("all" stands for all of them).
    """
    if not recipe.colourway:
        words = "the recipe has none: expected [colourway.NAME] tables with colours of cloth and inks"
        raise RecipeError([Fault(words, "colourway")])
    wanted = tuple(recipe.colourway) if "all" in names else tuple(dict.fromkeys(names))
    for name in wanted:
        if name not in recipe.colourway:
            raise RecipeError([Fault(unknown_name(name, list(recipe.colourway), "colourway"))])
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
