"""TOML text becomes tables, and tables become values, or every fault is told at once."""

from __future__ import annotations

import tomllib
from typing import Any, TypeVar

from batik_vector.errors import Fault, RecipeError
from batik_vector.recipe.reading.builder import UnsureError, built
from batik_vector.recipe.reading.limits import MAX_DEPTH, deep_key, odd_numbers
from batik_vector.recipe.reading.sources import MAX_TEXT

Kind = TypeVar("Kind")


def values_of(kind: type[Kind], data: dict[str, Any], source: str, text: str = "") -> Kind:
    """Return tables as a value of a kind.

    Args:
        kind: a dataclass.
        data: the tables.
        source: what faults call them.
        text: the TOML they were read from, for the lines of faults.

    Raises:
        RecipeError: with everything that is wrong.
    """
    try:
        return built(kind, data)
    except UnsureError:
        from batik_vector.recipe.reading.validator import placed, validated

        read, found = validated(data, kind)
        if read is None:
            raise RecipeError(placed(found, source, text, [])) from None
        return read


def tables_of(text: str, source: str, empty: str) -> dict[str, Any]:
    """Return TOML text as tables, with every text too long, too deep or wrong refused.

    Args:
        text: the TOML.
        source: what faults call it.
        empty: what was expected of a text that says nothing.

    Raises:
        RecipeError: with the line of what is wrong.
    """

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
        raise fault(f"is empty, expected {empty}")
    if odd:
        from batik_vector.recipe.reading.validator import odd_found, placed

        raise RecipeError(placed(odd_found(odd), source, text, []))
    return data
