"""``--set KEY=VALUE``: a recipe changed from outside, its comments kept.

A key may be cut short from the left where only one place in the recipe can be meant: ``layout.dist`` is
``place[0].layout.dist`` where one placement has a layout.
"""

from __future__ import annotations

import copy
import functools
import re
import tomllib
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from batik_vector.errors import Fault, RecipeError, unknown_name
from batik_vector.recipe.reading.faults import odd_number, shown
from batik_vector.recipe.reading.limits import MAX_DEPTH, odd_numbers
from batik_vector.recipe.reading.lines import parse_path, value_spans
from batik_vector.recipe.references import EVERY, Path, dotted
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
        change = Override(path, parsed_value(value.strip()), text)
        for _, number in odd_numbers(change.value, path):
            raise ValueError(odd_number(number))
    except ValueError as error:
        raise RecipeError([Fault(str(error), source=f"--set {_short(text)}")]) from None
    except RecursionError:
        words = f"nested deeper than {MAX_DEPTH} tables"
        raise RecipeError([Fault(words, source=f"--set {_short(text)}")]) from None
    return change


def parsed_value(value: str) -> Any:
    """Return a value as TOML reads it; what is no TOML is text."""
    try:
        table = tomllib.loads(f"v = {value}")
    except (ValueError, RecursionError):
        return value
    return table["v"] if len(table) == 1 else value


def overridden(
    text: str, data: dict[str, Any], overrides: Sequence[Override]
) -> tuple[str, dict[str, Any], list[Override]]:
    """Return a recipe's text and tables with values set, and what was set with its keys in full.

    Raises:
        RecipeError: for each path that leads nowhere.
    """
    changed = dict(data)
    faults, meant = [], []
    for override in overrides:
        try:
            each = [replace(override, path=path) for path in full_paths(changed, override.path)]
            for one in each:
                _unshare(changed, one.path)
                _put(changed, one, {})
            meant += each
        except _Astray as astray:
            faults.append(Fault(astray.words, dotted(astray.path), override.source))
    if faults:
        raise RecipeError(faults)
    return _rewritten(text, changed, meant), changed, meant


def _unshare(node: Any, path: Path) -> None:
    """Copy what a path leads through: all else stays the given tables' own, and nobody writes into it."""
    for part in path[:-1]:
        if isinstance(node, dict) and str(part) in node:
            key: Any = str(part)
        elif isinstance(node, list) and str(part).isdecimal() and int(part) < len(node):
            key = int(part)
        else:
            return
        node[key] = copy.copy(node[key])
        node = node[key]


def meant_by(data: dict[str, Any], keys: Sequence[str], asked: str) -> list[list[Path]]:
    """Return the paths that each of some keys stands for, as :func:`full_paths` does.

    Args:
        data: the recipe's tables.
        keys: as they were typed.
        asked: the option that gave them, for faults.

    Raises:
        RecipeError: for each key that leads nowhere.
    """
    found: list[list[Path]] = []
    faults = []
    for key in keys:
        try:
            found.append(full_paths(data, parse_path(key)))
        except (ValueError, _Astray) as error:
            place = dotted(error.path) if isinstance(error, _Astray) else ""
            words = error.words if isinstance(error, _Astray) else str(error)
            faults.append(Fault(words, "" if place == key else place, f"{asked} {_short(key)}"))
    if faults:
        raise RecipeError(faults)
    return found


def full_paths(tables: dict[str, Any], path: Path) -> list[Path]:
    """Return the paths that one stands for which is cut short, or which names every member of a list.

    What begins at the root, or leads nowhere, is left as it is.
    """
    if EVERY in path:
        return _each(tables, path)
    if path[0] in _roots() or path[0] in tables:
        return [_with_indices(tables, path)]
    found = [(*at, name) for at, table in _inner(tables, ()) for name in table]
    found = [each for each in found if _ends(each, path)]
    if not found and len(path) > 1:
        # What is not written yet goes into the one table that is called so.
        found = [(*at, path[-1]) for at, _ in _inner(tables, ()) if _ends(at, path[:-1])]
    if len(found) > 1:
        raise _ambiguous(path, found)
    return found or [path]


def _with_indices(tables: dict[str, Any], path: Path) -> Path:
    """Return a path with the indices of lists that have one member alone."""
    node: Any = tables
    full: list[str | int] = []
    for depth, part in enumerate(path):
        if isinstance(node, list) and isinstance(part, str) and not part.isdigit() and node:
            if len(node) > 1:
                raise _ambiguous(path, [(*full, index, *path[depth:]) for index in range(len(node))])
            full.append(0)
            node = node[0]
        full.append(part)
        known = isinstance(node, dict) and part in node
        node = node[part] if known else node[part] if _is_index(node, part) else None
    return tuple(full)


def _is_index(node: Any, part: str | int) -> bool:
    return isinstance(node, list) and isinstance(part, int) and part < len(node)


def _ambiguous(path: Path, found: Sequence[Path]) -> _Astray:
    some = ", ".join(map(dotted, found[:MOST_NAMED])) + (", …" if len(found) > MOST_NAMED else "")
    every = {tuple(EVERY if isinstance(part, int) else part for part in each) for each in found}
    ways = f", or all of them as {dotted(every.pop())}" if len(every) == 1 else ""
    return _Astray(path, f"may be any of {some}: expected one of them in full{ways}")


def _each(tables: dict[str, Any], path: Path) -> list[Path]:
    """Return the paths into every member of lists, as far as the members have the tables on the way."""
    found: list[tuple[Path, Any]] = [((), tables)]
    for part in path[:-1]:
        found = [
            ((*at, key), node[key]) for at, node in found for key in _keys(node, part) if _has(node, key)
        ]
    ends = [((*at, key), _has(node, key)) for at, node in found for key in _keys(node, path[-1])]
    # Where some have the key others may be of a kind that does not know it.
    some = [each for each, written in ends if written] or [each for each, _ in ends]
    if not some:
        raise _Astray(path, "leads nowhere in this recipe: expected lists where it has [*]")
    return some


MOST_NAMED = 4
"""Keys that a message lists."""


@functools.cache
def _roots() -> frozenset[str]:
    from batik_vector.recipe.model import Recipe

    return frozenset(Recipe.__dataclass_fields__)


def _keys(node: Any, part: str | int) -> Sequence[Any]:
    """Return the keys of a node that a part of a path names, present or not."""
    if isinstance(node, list):
        return range(len(node)) if part == EVERY else [part] if isinstance(part, int) else []
    return [part] if isinstance(node, dict) and isinstance(part, str) else []


def _has(node: Any, key: Any) -> bool:
    return key < len(node) if isinstance(node, list) else key in node


def _ends(path: Path, end: Path) -> bool:
    """Return whether a path ends so; indices that the end leaves out are passed over."""
    rest = list(path)
    for part in reversed(end):
        while rest and isinstance(rest[-1], int) and not isinstance(part, int):
            rest.pop()
        if not rest or rest.pop() != part:
            return False
    return True


def _inner(node: Any, at: Path) -> Iterator[tuple[Path, dict[str, Any]]]:
    """Yield the tables within tables and lists, with their paths, but for the root."""
    members = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for name, member in members:
        if isinstance(member, dict):
            yield (*at, name), member
        yield from _inner(member, (*at, name))


TRIED = 16
"""Texts remembered with the places at which values were exchanged, and the whole read back as it was meant:
after that it is enough that each value there reads back."""

_tried: dict[tuple[str, tuple[Path, ...]], None] = {}


def _rewritten(text: str, changed: dict[str, Any], overrides: Sequence[Override]) -> str:
    """Return the text with its comments where that can be done, else the tables alone."""
    import tomlkit

    where = text, tuple(each.path for each in overrides)
    for rewrite in (_in_place, _in_document):
        try:
            written = rewrite(text, overrides)
            if written is None:
                continue
            if rewrite is _in_place and where in _tried and all(map(_reads_back, overrides)):
                return written
            if tomllib.loads(written) == changed:
                if rewrite is _in_place:
                    _tried[where] = None
                    while len(_tried) > TRIED:
                        _tried.pop(next(iter(_tried)), None)
                return written
        except (ValueError, TypeError, LookupError, AttributeError, tomlkit.exceptions.TOMLKitError):
            pass
    return tomlkit.dumps(changed)


def _in_place(text: str, overrides: Sequence[Override]) -> str | None:
    """Return the text with values exchanged where they stand, or None where one is not written yet.

    A tenth of the work of a document: a sweep reads one recipe a thousand times.
    """
    import tomlkit

    known = value_spans(text)
    if any(override.path not in known for override in overrides):
        return None
    literals = {known[each.path]: tomlkit.item(each.value).as_string() for each in overrides}
    begun = len(text)
    for (start, end), literal in sorted(literals.items(), reverse=True):
        if end > begun:
            return None
        text, begun = text[:start] + literal + text[end:], start
    return text


def _reads_back(override: Override) -> bool:
    import tomlkit

    return bool(tomllib.loads(f"v = {tomlkit.item(override.value).as_string()}") == {"v": override.value})


def _in_document(text: str, overrides: Sequence[Override]) -> str:
    """Return the text as its document, values set, is written."""
    import tomlkit

    document: Any = tomlkit.parse(text)
    for override in overrides:
        _put(document, override, tomlkit.table())
    return tomlkit.dumps(document)


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
