"""How deep a recipe may lie and how large its numbers may be: what every reader looks at first."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from batik_vector.recipe.references import Path

MAX_DEPTH = 64
"""Tables within tables. The deepest recipe has about eight."""


def odd_numbers(value: Any, path: Path = ()) -> Iterator[tuple[Path, int]]:
    """Yield the whole numbers that TOML's 64 bits do not hold, and where they stand.

    Raises:
        RecursionError: where tables lie too deep in one another.
    """
    if len(path) > MAX_DEPTH:
        raise RecursionError
    if isinstance(value, dict):
        for key, inner in value.items():
            if type(inner) is not str:
                yield from odd_numbers(inner, (*path, key))
    elif isinstance(value, list):
        for index, inner in enumerate(value):
            if type(inner) is not str:
                yield from odd_numbers(inner, (*path, index))
    elif isinstance(value, int) and value.bit_length() > 64:
        yield path, value


def deep_key(text: str) -> int | None:
    """Return where in a TOML text a key of more than ``MAX_DEPTH`` parts begins, or None."""
    # Only a text with as many dots can have one.
    if text.count(".") < MAX_DEPTH:
        return None
    part = r"(?:[\w-]++|\"[^\"\n]*+\"|'[^'\n]*+')[ \t]*+\.[ \t]*+"
    found = re.search(rf"(?<![\w-])(?:{part}){{{MAX_DEPTH}}}", text)
    return found.start() if found else None
