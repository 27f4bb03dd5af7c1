"""``--set KEY=VALUE``: a recipe changed from outside, its comments kept."""

from __future__ import annotations

import copy
import re
import tomllib
from collections.abc import Sequence
from typing import Any

from batik_vector.errors import Fault, RecipeError, unknown_name
from batik_vector.recipe.reading.faults import odd_number, shown
from batik_vector.recipe.reading.limits import MAX_DEPTH, odd_numbers
from batik_vector.recipe.reading.lines import parse_path
from batik_vector.recipe.references import Path, dotted
from batik_vector.values import frozen

NAMED = ("motif", "ink")
"""Tables whose keys are names that the recipe chose."""


@frozen
class Override:
    """One value to set. ``text`` is how it was asked for."""

    path: Path
    value: Any
    text: str

    @property
    def source(self) -> str:
        """Where a fault of it is said to stand."""
        return f"--set {_short(self.text)}"


def _short(text: str) -> str:
    line = "".join(each if each.isprintable() else "\ufffd" for each in text[:80])
    return line if len(text) <= 80 else f"{line}…"


def parse_override(text: str) -> Override:
    """Return what ``KEY=VALUE`` asks for; a value that is no TOML is text.

    Raises:
        RecipeError: where there is no key, or no value.
    """
    key, equals, value = text.partition("=")
    try:
        if not equals or not value.strip():
            raise ValueError("expected KEY=VALUE, such as motif.flower.petal.count=12")
        path = parse_path(key.strip())
        change = Override(path, _parsed(value.strip()), text)
        for _, number in odd_numbers(change.value, path):
            raise ValueError(odd_number(number))
    except ValueError as error:
        raise RecipeError([Fault(str(error), source=f"--set {_short(text)}")]) from None
    except RecursionError:
        words = f"nested deeper than {MAX_DEPTH} tables"
        raise RecipeError([Fault(words, source=f"--set {_short(text)}")]) from None
    return change


def _parsed(value: str) -> Any:
    try:
        table = tomllib.loads(f"v = {value}")
    except (ValueError, RecursionError):
        return value
    return table["v"] if len(table) == 1 else value


def overridden(text: str, data: dict[str, Any], overrides: Sequence[Override]) -> tuple[str, dict[str, Any]]:
    """Return a recipe's text and tables with values set.

    Raises:
        RecipeError: for each path that leads nowhere.
    """
    changed = copy.deepcopy(data)
    faults = []
    for override in overrides:
        try:
            _put(changed, override, {})
        except _Astray as astray:
            faults.append(Fault(astray.words, dotted(astray.path), override.source))
    if faults:
        raise RecipeError(faults)
    return _rewritten(text, changed, overrides), changed


def _rewritten(text: str, changed: dict[str, Any], overrides: Sequence[Override]) -> str:
    """Return the text with its comments where that can be done, else the tables alone."""
    import tomlkit

    try:
        document: Any = tomlkit.parse(text)
        for override in overrides:
            _put(document, override, tomlkit.table())
        written = tomlkit.dumps(document)
        if tomllib.loads(written) == changed:
            return written
    except (ValueError, TypeError, LookupError, AttributeError, tomlkit.exceptions.TOMLKitError):
        pass
    return tomlkit.dumps(changed)


class _Astray(Exception):  # noqa: N818
    def __init__(self, path: Path, words: str) -> None:
        super().__init__(words)
        self.path, self.words = path, words


def _put(node: Any, override: Override, empty: Any) -> None:
    """Set a value in nested tables, making those that are missing."""
    path = override.path
    for depth, part in enumerate(path[:-1]):
        node = _step(node, path[: depth + 1], part, copy.deepcopy(empty))
    last = path[-1]
    if isinstance(node, list):
        node[_index(node, path)] = copy.deepcopy(override.value)
    elif isinstance(node, dict):
        node[str(last)] = copy.deepcopy(override.value)
    else:
        raise _Astray(path[:-1], f"{shown(node)}, expected a table")


def _step(node: Any, path: Path, part: str | int, empty: Any) -> Any:
    if isinstance(node, list):
        return node[_index(node, path)]
    if not isinstance(node, dict):
        raise _Astray(path[:-1], f"{shown(node)}, expected a table")
    key = str(part)
    if key not in node:
        if len(path) == 2 and path[0] in NAMED and node:
            words = unknown_name(key, list(node), str(path[0]))
            if "did you mean" in words:
                raise _Astray(path, words)
        node[key] = empty
    return node[key]


def _index(node: list[Any], path: Path) -> int:
    part = path[-1]
    index = part if isinstance(part, int) else int(part) if re.fullmatch("[0-9]{1,9}", part) else -1
    if not 0 <= index < len(node):
        numbers = (
            f"expected 0 to {len(node) - 1}" if len(node) > 1 else "expected 0" if node else "it is empty"
        )
        raise _Astray(path, f"no such place in the list: {numbers}")
    return index
