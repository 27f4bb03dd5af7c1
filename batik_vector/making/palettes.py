"""Palettes by the names that batik has for them, and how a recipe takes the colours of one.

The names say which baths a cloth has seen: *kelengan* indigo alone, *bangbangan* red alone, *bang biru* red
and blue, *tiga negeri* ("three lands") red, blue and soga brown. The colours are ours, for the screen.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from batik_vector.errors import Fault, RecipeError, unknown_name
from batik_vector.making.variants import Axis
from batik_vector.recipe.drawing import Svg
from batik_vector.recipe.model import InkSpec, Recipe

PALETTES: Mapping[str, tuple[str, ...]] = {
    "kelengan": ("#f4efe2", "#9fb9d8", "#5a7fb5", "#1d2f5f", "#111a38"),
    "bangbangan": ("#f6ecd9", "#e3a98f", "#b5362c", "#7a1d1c", "#431214"),
    "bang-biru": ("#f5eedd", "#e08e76", "#b3302b", "#2c4a86", "#151f45"),
    "bang-biru-ijo": ("#f6efdd", "#e7b84f", "#c0392f", "#2f6a57", "#1c3158"),
    "tiga-negeri": ("#f3e7cf", "#c9965a", "#a8322b", "#27467e", "#1f1a22"),
    "sogan": ("#f2e4c6", "#c99a5b", "#8a5628", "#4a2b18", "#161a2c"),
    "lasem": ("#f7efe0", "#d98d7f", "#a5242b", "#5c1622", "#22182a"),
    "ijo": ("#f3f0df", "#a9c29a", "#5c8f6a", "#2d5a4a", "#14302b"),
    "mangosteen": ("#f4ece4", "#cbb3cf", "#8a5a92", "#4b2a5c", "#21152e"),
    "charcoal": ("#f5f2ec", "#bdb6ac", "#7d766e", "#3d3833", "#181614"),
}
"""Five colours each, the lightest first."""


def lightness(colour: str) -> float:
    """Return the relative luminance of a colour ``#rrggbb``. WCAG 2.1."""
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def recoloured(recipe: Recipe, palette: str) -> tuple[str, ...]:
    """Return what is set in a recipe so that it has the colours of a palette, as ``KEY=VALUE``.

    What is light stays light: the recipe's colours take those of the palette in the order of their lightness,
    spread over its whole range; equal colours stay equal. Drawings that keep their colours find their inks by
    them as before.
    """
    old = [recipe.cloth.colour, *(ink.colour for ink in recipe.ink.values())]
    ranked = sorted(set(old), key=lambda colour: (-lightness(colour), colour))
    colours = PALETTES[palette]
    last = max(len(ranked) - 1, 1)
    taken = {colour: colours[round(place * (len(colours) - 1) / last)] for place, colour in enumerate(ranked)}
    changes = [f'cloth.colour="{taken[recipe.cloth.colour]}"']
    kept = {
        colour for motif in recipe.motif.values() if isinstance(motif, Svg) for colour in motif.colours_kept()
    }
    for name, ink in recipe.ink.items():
        key = f"ink.{_quoted(name)}"
        if name in kept and ink == InkSpec(colour=name):
            # The recipe says nothing of it: it was made of a colour in a drawing, and goes by that.
            changes.append(f'{key}={{colour="{taken[ink.colour]}"}}')
            continue
        changes.append(f'{key}.colour="{taken[ink.colour]}"')
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
    wanted = list(PALETTES) if "all" in names else list(dict.fromkeys(names))
    for name in wanted:
        if name not in PALETTES:
            raise RecipeError(unknown_name(name, list(PALETTES), "palette"))
    return Axis("palette", tuple(wanted), changes=tuple(recoloured(recipe, name) for name in wanted))
