"""A recipe in the colours of a palette: what is light stays light, or its baths are the palette's dyes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from batik_vector.artwork.dyeing import Bath, Dyeing
from batik_vector.errors import Fault, RecipeError, unknown_name
from batik_vector.recipe.colourways import printed_by_itself, stays
from batik_vector.recipe.drawing import Svg
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.palettes import PALETTES, Palette, spread
from batik_vector.recipe.references import dotted
from batik_vector.values import frozen


@frozen
class Colours:
    """The colours that a recipe takes: of its cloth, of inks by name, of baths in their order.

    ``undyed`` is the cloth's colour before the first bath; empty where the recipe has no baths.
    """

    cloth: str
    inks: Mapping[str, str]
    baths: tuple[str, ...] = ()
    undyed: str = ""


def taken_colours(recipe: Recipe, name: str) -> Colours:
    """Return the colours that a recipe takes of a palette.

    Raises:
        RecipeError: where there is no such palette, where an ink has a colour in print, which would stay, or
            where the recipe has more baths than the palette.
    """
    if name not in PALETTES:
        raise RecipeError([Fault(unknown_name(name, list(PALETTES), "palette"))])
    for ink in printed_by_itself(recipe.ink):
        raise RecipeError([Fault(f"palettes are for the screen, and {stays(ink)}", dotted(("ink", ink)))])
    palette = PALETTES[name]
    if recipe.bath:
        return _dyed(recipe, palette)
    taken = spread([recipe.cloth.colour, *(ink.colour for ink in recipe.ink.values())], palette)
    return Colours(taken[recipe.cloth.colour], {each: taken[ink.colour] for each, ink in recipe.ink.items()})


def _dyed(recipe: Recipe, palette: Palette) -> Colours:
    """Return the colours of a recipe whose baths are a palette's, in the order of dyeing."""
    count = len(recipe.bath)
    if count > len(palette.baths):
        enough = [name for name, each in PALETTES.items() if len(each.baths) >= count]
        has = f"{len(palette.baths)} baths" if len(palette.baths) > 1 else "one bath"
        words = f"the palette {palette.name} has {has if palette.baths else 'no baths'}, the recipe {count}"
        raise RecipeError([Fault(f"{words}: expected one of {', '.join(enough) or 'fewer baths'}", "bath")])
    dyes = tuple(colour for _, colour in palette.baths[:count])
    known = tuple(Bath(bath.name, colour) for bath, colour in zip(recipe.bath, dyes, strict=True))
    undyed = palette.colours[0]
    plan = Dyeing(known, undyed, frozenset(), {})
    ground = [bath.name for bath in recipe.bath] if recipe.cloth.baths is None else recipe.cloth.baths
    inks = {name: plan.colour(frozenset(ink.baths or ())) for name, ink in recipe.ink.items()}
    return Colours(plan.colour(frozenset(ground)), inks, dyes, undyed)


def in_palette(recipe: Recipe, name: str) -> Recipe:
    """Return a recipe in the colours of a palette; see :func:`taken_colours`.

    In its colours already it stays as it is.
    """
    taken = taken_colours(recipe, name)
    kept = kept_colours(recipe)
    inks = {
        each: replace(
            ink,
            colour=taken.inks[each],
            drawn=ink.colour if ink.drawn is None and ink.colour in kept - {each} else ink.drawn,
        )
        for each, ink in recipe.ink.items()
    }
    cloth = replace(recipe.cloth, colour=taken.cloth)
    if not recipe.bath:
        return replace(recipe, ink=inks, cloth=cloth)
    baths = tuple(replace(bath, colour=dye) for bath, dye in zip(recipe.bath, taken.baths, strict=True))
    return replace(recipe, ink=inks, cloth=replace(cloth, undyed=taken.undyed), bath=baths)


def kept_colours(recipe: Recipe) -> set[str]:
    """Return the colours that drawings of a recipe keep, each an ink."""
    return {
        colour for motif in recipe.motif.values() if isinstance(motif, Svg) for colour in motif.colours_kept()
    }
