"""A page of TOML becomes a :class:`~batik_vector.recipe.model.Recipe`, or every fault is told at once.

Text is read by tomllib and built into the dataclasses of :mod:`batik_vector.recipe.model`. Only where that
fails is pydantic asked what is wrong, and the line of each key looked up.
"""

from __future__ import annotations

import os
import tomllib
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from batik_vector.errors import Fault, RecipeError
from batik_vector.fields import given
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.reading.builder import UnsureError, built
from batik_vector.recipe.reading.limits import MAX_DEPTH, deep_key, odd_numbers
from batik_vector.recipe.reading.sources import MAX_TEXT, read_text

if TYPE_CHECKING:
    from batik_vector.recipe.reading.overrides import Override


def load_recipe(path: str | os.PathLike[str], overrides: Sequence[str] = ()) -> Recipe:
    """Read a recipe from its file, or from an SVG, PDF, DXF or PNG that was compiled from it.

    Args:
        path: of the file.
        overrides: values to set in it, each as ``KEY=VALUE``.

    Raises:
        RecipeError: with everything that is wrong.
    """
    given(path, str | os.PathLike, "path")
    return read_recipe(read_text(path), source=os.fspath(path), overrides=overrides)


def read_recipe(text: str, source: str = "recipe", overrides: Sequence[str] = ()) -> Recipe:
    """Read a recipe from TOML text.

    Args:
        text: the recipe.
        source: what faults call it.
        overrides: values to set in it, each as ``KEY=VALUE``.

    Raises:
        RecipeError: with everything that is wrong.
    """
    given(text, str, "text")
    given(source, str, "source")
    given(overrides, tuple[str, ...], "overrides")
    written = text = text.replace("\r\n", "\n")
    data = _tables(text, source)
    changes: list[Override] = []
    if overrides:
        from batik_vector.recipe.reading.overrides import overridden, parse_override

        changes = [parse_override(each) for each in overrides]
        text, data = overridden(text, data, changes)
    try:
        return built(Recipe, data, source=text)
    except UnsureError:
        from batik_vector.recipe.reading.validator import placed, validated

        recipe, found = validated(data)
    if recipe is None:
        raise RecipeError(placed(found, source, written, changes))
    return replace(recipe, source=text)


def located(error: RecipeError, source: str, text: str, overrides: Sequence[str] = ()) -> RecipeError:
    """Return an error of a later stage with file and line in the faults that have none yet."""
    from batik_vector.recipe.reading.validator import relocated

    return relocated(error, source, text, overrides)


def _tables(text: str, source: str) -> dict[str, Any]:
    """Return TOML text as tables, with every text too long, too deep or wrong refused."""

    def fault(words: str, line: int | None = None) -> RecipeError:
        return RecipeError([Fault(words, "", source, line)])

    if len(text) > MAX_TEXT:
        raise fault(f"{len(text):,} characters, expected at most {MAX_TEXT:,}")
    deep = deep_key(text)
    if deep is not None:
        raise fault(f"nested deeper than {MAX_DEPTH} tables", text.count("\n", 0, deep) + 1)
    try:
        data = tomllib.loads(text)
        odd = list(odd_numbers(data))
    except tomllib.TOMLDecodeError as error:
        from batik_vector.recipe.reading.validator import syntax

        words, line = syntax(str(error), text)
        raise fault(f"is no valid TOML: {words}", line) from error
    except RecursionError:
        raise fault(f"nested deeper than {MAX_DEPTH} tables") from None
    except ValueError as error:
        # An integer of thousands of digits, which Python declines to read; or a date such as 2024-02-31.
        raise fault(f"is no valid TOML: {error}") from error
    if not data:
        raise fault('is empty, expected a recipe: "batik-vector new" writes one to begin with')
    if odd:
        from batik_vector.recipe.reading.validator import odd_found, placed

        raise RecipeError(placed(odd_found(odd), source, text, []))
    return data
