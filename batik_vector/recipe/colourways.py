"""Colourways: other colours for the inks and the cloth of a recipe, by name; and palettes that batik has.

The names of palettes say which baths a cloth has seen: *kelengan* indigo alone, *bangbangan* red alone,
*bang biru* red and blue, *tiga negeri* ("three lands") red, blue and soga brown. The colours are ours, for
the screen.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import field
from typing import Annotated, Any

from batik_vector.errors import Fault, unknown_name
from batik_vector.fields import Colour, Says, check
from batik_vector.recipe.outputs import parse_file_word
from batik_vector.recipe.references import dotted
from batik_vector.values import frozen

ALL = "all"

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


@frozen(kw_only=True)
class ColourwaySpec:
    """Other colours for the recipe, written under its name: `--colourway NAME`."""

    palette: Annotated[
        str, Says("palette from which all colours are taken by lightness, such as sogan; none if unset")
    ] = ""
    cloth: Annotated[Colour | None, Says("colour of the cloth on screen; as it is if unset")] = None
    ink: Annotated[dict[str, Colour], Says("colours of inks on screen, by name; others stay")] = field(
        default_factory=dict
    )

    def __post_init__(self) -> None:
        check(self)


def faults_of(
    colourways: Mapping[str, ColourwaySpec], inks: Mapping[str, Any], dyed: bool
) -> Iterator[Fault]:
    """Yield what is wrong with the colourways of a recipe.

    Args:
        colourways: by name.
        inks: those of the recipe, as the recipe says them.
        dyed: whether baths give the recipe its colours.
    """
    for name, spec in colourways.items():
        key = dotted(("colourway", name))
        try:
            parse_file_word(name)
        except ValueError as error:
            yield Fault(str(error), key)
        if name in ("", ALL):
            yield Fault("expected another name: all stands for every one of them", key)
        if dyed:
            yield Fault("baths give this recipe its colours, and no colourway can", key)
            continue
        if spec == ColourwaySpec():
            yield Fault("expected a palette, or colours of the cloth or of inks", key)
        if spec.palette and spec.palette not in PALETTES:
            yield Fault(unknown_name(spec.palette, list(PALETTES), "palette"), f"{key}.palette")
        if spec.palette:
            for ink in printed_by_itself(inks):
                yield Fault(f"gives inks colours on screen, and {stays(ink)}", f"{key}.palette")
        yield from _of_inks(key, spec.ink, inks)


def _of_inks(key: str, colours: Collection[str], inks: Mapping[str, Any]) -> Iterator[Fault]:
    for ink in colours:
        if ink not in inks:
            yield Fault(unknown_name(ink, list(inks), "ink"), f"{key}.{dotted(('ink', ink))}")
        elif ink in printed_by_itself(inks):
            yield Fault(f"is the colour on screen, and {stays(ink)}", f"{key}.{dotted(('ink', ink))}")


def printed_by_itself(inks: Mapping[str, Any]) -> list[str]:
    """Return the inks whose colour in print is said beside that on screen: another one there leaves it."""
    return [name for name, ink in inks.items() if ink.cmyk or ink.lab]


def stays(ink: str) -> str:
    """Return in words what an ink's own colour in print does."""
    return f"the cmyk or lab of ink {ink} in print would stay: leave it out"
