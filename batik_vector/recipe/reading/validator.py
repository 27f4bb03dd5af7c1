"""The long way from tables to a recipe, for recipes that are wrong: pydantic says what, and their text where.

Nothing of this is imported for a recipe that is right.
"""

from __future__ import annotations

import functools
import json
import re
import tomllib
from collections.abc import Hashable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar, cast

from batik_vector.errors import Fault, RecipeError
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.reading.faults import Found, field_first, found_in, keyed, odd_number, unknown_keys
from batik_vector.recipe.reading.field_types import Hint
from batik_vector.recipe.reading.lines import Lines
from batik_vector.recipe.reading.overrides import Override, overridden, parse_override
from batik_vector.recipe.references import Path, dotted, unknown_references

if TYPE_CHECKING:
    from pydantic import TypeAdapter


Kind = TypeVar("Kind")


@functools.cache
def _adapter(kind: Any) -> TypeAdapter[Any]:
    from pydantic import TypeAdapter

    return TypeAdapter(kind)


def validated(data: dict[str, Any], kind: type[Kind]) -> tuple[Kind | None, list[Found]]:
    """Return tables as pydantic reads them, a recipe's or a machine's, or what it finds wrong."""
    from pydantic import ValidationError

    found = unknown_keys(data, Hint(kind))
    # As JSON, whose strict mode takes lists for tuples and names for enums, but never text for numbers.
    # Dates, which no key expects, become what no key accepts.
    text = json.dumps(data, default=lambda date: {"date": str(date)})
    try:
        read: Kind = _adapter(cast(Hashable, kind)).validate_json(text)
    except ValidationError as error:
        errors = error.errors(include_url=False)
        found += found_in(errors, data, kind)
        if kind is Recipe and any(each["loc"] for each in errors):
            found += [Found(path, fault) for path, fault in unknown_references(data)]
        return None, found
    return (None if found else read), found


def relocated(error: RecipeError, source: str, text: str, overrides: Sequence[str]) -> RecipeError:
    """Return an error of a later stage with file and line in the faults that have none yet."""
    lines = Lines(text)
    found = []
    for fault in error.faults:
        path = keyed(fault.key) if not fault.source else ()
        name, rest = field_first(fault.message)
        if path and name and (*path, *name.split(".")) in lines:
            path = (*path, *name.split("."))
            fault = Fault(rest, dotted(path))
        found.append(Found(path, fault))
    return RecipeError(placed(found, source, text, _in_full(text, overrides)))


def _in_full(text: str, overrides: Sequence[str]) -> list[Override]:
    """Return what was set in a recipe, its keys in full."""
    changes = [parse_override(each) for each in overrides]
    return overridden(text, tomllib.loads(text), changes)[2] if changes else []


def odd_found(numbers: Sequence[tuple[Path, int]]) -> list[Found]:
    """Return the numbers that are too large as faults."""
    return [Found(path, Fault(odd_number(number), dotted(path))) for path, number in numbers]


def placed(found: Sequence[Found], source: str, text: str, changes: Sequence[Override]) -> list[Fault]:
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


def syntax(words: str, text: str) -> tuple[str, int | None]:
    """Return what tomllib says in our words, and the line of it."""
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
