"""Colourways: other colours for the inks and the cloth of a recipe, by name."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import field
from typing import Annotated, Any

from batik_vector.errors import Fault, unknown_name
from batik_vector.fields import Colour, Says, check
from batik_vector.recipe.outputs import parse_file_word
from batik_vector.recipe.palettes import PALETTES
from batik_vector.recipe.references import dotted
from batik_vector.values import frozen

ALL = "all"


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
        if dyed and (spec.cloth or spec.ink):
            words = "baths give this recipe its colours: expected a palette alone, with dyes for them"
            yield Fault(words, key)
            continue
        if spec == ColourwaySpec():
            yield Fault("expected a palette, or colours of the cloth or of inks", key)
        yield from wrong_palette(spec.palette, inks, f"{key}.palette")
        yield from _of_inks(key, spec.ink, inks)


def wrong_palette(name: str, inks: Mapping[str, Any], key: str) -> Iterator[Fault]:
    """Yield what is wrong with the name of a palette that stands at a key; no name is none."""
    if not name:
        return
    if name not in PALETTES:
        yield Fault(unknown_name(name, list(PALETTES), "palette"), key)
    for ink in printed_by_itself(inks):
        yield Fault(f"gives inks colours on screen, and {stays(ink)}", key)


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
