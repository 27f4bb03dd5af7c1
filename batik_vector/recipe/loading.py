"""A page of TOML becomes a :class:`~batik_vector.recipe.model.Recipe`, or every fault is told at once.

Text is read by tomllib and built into the dataclasses of :mod:`batik_vector.recipe.model`. Only where that
fails is pydantic asked what is wrong, and the line of each key looked up.
"""

from __future__ import annotations

import os
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from batik_vector.errors import Fault, RecipeError
from batik_vector.fields import given
from batik_vector.recipe.drawing import Svg
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.reading.builder import UnsureError, built
from batik_vector.recipe.reading.limits import MAX_DEPTH, deep_key, odd_numbers
from batik_vector.recipe.reading.sources import MAX_TEXT, parted, read_text, scheme_of, with_carried

if TYPE_CHECKING:
    from batik_vector.recipe.reading.overrides import Override


def load_recipe(path: str | os.PathLike[str], overrides: Sequence[str] = ()) -> Recipe:
    """Read a recipe from its file, from an SVG, PDF, DXF or PNG that was compiled from it, or the library.

    Args:
        path: of the file; or ``library:NAME``, or ``library:NAME@3`` for one of its versions.
        overrides: values to set in it, each as ``KEY=VALUE``.

    Raises:
        RecipeError: with everything that is wrong.
        LibraryError: where the library has no such pattern, or cannot be read.
    """
    given(path, str | os.PathLike, "path")
    source = os.fspath(path)
    folder = None if scheme_of(source)[0] else os.path.dirname(source) or "."
    return read_recipe(read_text(path), source=source, overrides=overrides, folder=folder)


def read_recipe(
    text: str,
    source: str = "recipe",
    overrides: Sequence[str] = (),
    folder: str | os.PathLike[str] | None = None,
    drawings: Mapping[str, str] | None = None,
) -> Recipe:
    """Read a recipe from TOML text.

    Args:
        text: the recipe.
        source: what faults call it.
        overrides: values to set in it, each as ``KEY=VALUE``.
        folder: where the drawings stand that it names; without it those alone are known that it carries.
        drawings: SVGs by the names of their files, for the recipe to carry; see :attr:`Recipe.drawing`.

    Raises:
        RecipeError: with everything that is wrong.
    """
    given(text, str, "text")
    given(source, str, "source")
    given(overrides, tuple[str, ...], "overrides")
    given(folder, str | os.PathLike | None, "folder")
    given(drawings, Mapping[str, str] | None, "drawings")
    text, carried = parted(text.replace("\r\n", "\n"))
    carried |= drawings or {}
    written = text
    data = _tables(text, source)
    changes: list[Override] = []
    if overrides:
        from batik_vector.recipe.reading.overrides import overridden, parse_override

        changes = [parse_override(each) for each in overrides]
        text, data = overridden(text, data, changes)
    if carried and isinstance(data.setdefault("drawing", {}), dict):
        data["drawing"] = carried | data["drawing"]
        text = with_carried(text, carried)
    try:
        recipe = built(Recipe, data, source=text)
    except UnsureError:
        from batik_vector.recipe.reading.validator import placed, validated

        found_recipe, found = validated(data)
        if found_recipe is None:
            raise RecipeError(placed(found, source, written, changes)) from None
        recipe = replace(found_recipe, source=text)
    return _drawn(recipe, folder, source, written, overrides)


def _drawn(
    recipe: Recipe,
    folder: str | os.PathLike[str] | None,
    source: str,
    written: str,
    overrides: Sequence[str],
) -> Recipe:
    """Return a recipe with the drawings that it names."""
    if not any(isinstance(motif, Svg) for motif in recipe.motif.values()):
        return recipe
    from batik_vector.recipe.reading.drawings import with_drawings

    try:
        return with_drawings(recipe, None if folder is None else os.fspath(folder))
    except RecipeError as error:
        raise located(error, source, written, overrides) from error


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
