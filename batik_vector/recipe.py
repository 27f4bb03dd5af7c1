"""Recipes: a page of TOML becomes a :class:`~batik_vector.model.Recipe`, or every fault is told at once.

Text is read by tomllib and built into the dataclasses of :mod:`batik_vector.model`. Only where that fails
is pydantic asked what is wrong, and the line of each key looked up.
"""

from __future__ import annotations

import functools
import json
import os
import re
import tomllib
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from batik_vector.errors import Fault, RecipeError
from batik_vector.model import Recipe
from batik_vector.reading.faults import (
    MAX_DEPTH,
    Found,
    field_first,
    found_in,
    keyed,
    odd_numbers,
    unknown_keys,
)
from batik_vector.reading.files import MAX_TEXT, read_text
from batik_vector.reading.hints import Hint
from batik_vector.reading.lines import Lines
from batik_vector.reading.overrides import Override, overridden, parse_override
from batik_vector.reading.quick import UnsureError, built
from batik_vector.references import Path, dotted, unknown_references

if TYPE_CHECKING:
    from pydantic import TypeAdapter

_DEEP_KEY = re.compile(
    r"(?<![\w-])(?:(?:[\w-]++|\"[^\"\n]*\"|'[^'\n]*')[ \t]*\.[ \t]*){%d}" % MAX_DEPTH  # noqa: UP031
)


def load_recipe(path: str | os.PathLike[str], overrides: Sequence[str] = ()) -> Recipe:
    """Read a recipe from its file, or from an SVG, PDF, DXF or PNG that was compiled from it.

    Args:
        path: of the file.
        overrides: values to set in it, each as ``KEY=VALUE``.

    Raises:
        RecipeError: with everything that is wrong.
    """
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
    written = text = text.replace("\r\n", "\n")
    data = _tables(text, source)
    changes = [parse_override(each) for each in overrides]
    if changes:
        text, data = overridden(text, data, changes)
    recipe, found = _checked(data)
    if recipe is None:
        raise RecipeError(_placed(found, source, written, changes))
    return replace(recipe, source=text)


def located(error: RecipeError, source: str, text: str, overrides: Sequence[str] = ()) -> RecipeError:
    """Return an error of a later stage with file and line in the faults that have none yet."""
    lines = Lines(text)
    found = []
    for fault in error.faults:
        path = keyed(fault.key) if not fault.source else ()
        name, rest = field_first(fault.message)
        if path and (*path, name) in lines:
            path = (*path, name)
            fault = Fault(rest, dotted(path))
        found.append(Found(path, fault))
    return RecipeError(_placed(found, source, text, [parse_override(each) for each in overrides]))


def _tables(text: str, source: str) -> dict[str, Any]:
    """Return TOML text as tables, with every text too long, too deep or wrong refused."""

    def fault(words: str, line: int | None = None) -> RecipeError:
        return RecipeError([Fault(words, "", source, line)])

    if len(text) > MAX_TEXT:
        raise fault(f"{len(text):,} characters, expected at most {MAX_TEXT:,}")
    deep = _DEEP_KEY.search(text)
    if deep:
        raise fault(f"nested deeper than {MAX_DEPTH} tables", text.count("\n", 0, deep.start()) + 1)
    try:
        data = tomllib.loads(text)
        odd = list(odd_numbers(data))
    except tomllib.TOMLDecodeError as error:
        words, line = _syntax(str(error), text)
        raise fault(f"is no valid TOML: {words}", line) from error
    except RecursionError:
        raise fault(f"nested deeper than {MAX_DEPTH} tables") from None
    except ValueError as error:
        # An integer of thousands of digits, which Python declines to read; or a date such as 2024-02-31.
        raise fault(f"is no valid TOML: {error}") from error
    if not data:
        raise fault('is empty, expected a recipe: "batik-vector new" writes one to begin with')
    if odd:
        raise RecipeError(_placed(odd, source, text, []))
    return data


def _syntax(words: str, text: str) -> tuple[str, int | None]:
    """Return what tomllib says, its line apart."""
    found = re.search(r" \(at (?:line (\d+), column (\d+)|end of document)\)$", words)
    if found is None:
        return words, None
    line = int(found[1]) if found[1] else text.count("\n") + (not text.endswith("\n"))
    words = words[: found.start()]
    if words.startswith(("Cannot overwrite", "Cannot declare", "Cannot mutate")):
        words = "this key or table is there already"
    if words == "Invalid initial character for a key part" and text.split("\n")[line - 1].rstrip()[-1:] in (
        "{",
        ",",
    ):
        words = "an inline table { … } must stay on one line"
    column = f" (column {found[2]})" if found[2] else " (at the end of the file)"
    return words[:1].lower() + words[1:] + column, line


@functools.cache
def _adapter() -> TypeAdapter[Recipe]:
    from pydantic import TypeAdapter

    return TypeAdapter(Recipe)


def _checked(data: dict[str, Any]) -> tuple[Recipe | None, list[Found]]:
    """Return the recipe, or what is wrong with it."""
    try:
        return built(Recipe, data), []
    except UnsureError:
        return _validated(data)


def _validated(data: dict[str, Any]) -> tuple[Recipe | None, list[Found]]:
    """Return the recipe as pydantic reads it, or what it finds wrong."""
    from pydantic import ValidationError

    found = unknown_keys(data, Hint(Recipe))
    # As JSON, whose strict mode takes lists for tuples and names for enums, but never text for numbers.
    # Dates, which no key expects, become what no key accepts.
    text = json.dumps(data, default=lambda date: {"date": str(date)})
    try:
        recipe = _adapter().validate_json(text)
    except ValidationError as error:
        errors = error.errors(include_url=False)
        found += found_in(errors, data, Recipe)
        if any(each["loc"] for each in errors):
            found += [Found(path, fault) for path, fault in unknown_references(data)]
        return None, found
    return (None if found else recipe), found


def _placed(found: Sequence[Found], source: str, text: str, changes: Sequence[Override]) -> list[Fault]:
    """Return faults with their places, in the order of their lines."""
    lines = Lines(text)
    faults = []
    for each in found:
        fault = each.fault
        if not fault.source:
            change = _cause(each.path, lines, changes)
            line = None if change else lines.line(each.path)
            fault = replace(fault, source=change.source if change else source, line=line)
        faults.append(fault)
    return sorted(faults, key=lambda fault: fault.line or 0)


def _cause(path: Path, lines: Lines, changes: Sequence[Override]) -> Override | None:
    """Return the change that a fault at a path comes from."""
    here = [str(part) for part in path]
    for change in reversed(changes):
        there = [str(part) for part in change.path]
        if here[: len(there)] == there or (path and path not in lines and there[: len(here)] == here):
            return change
    return None
