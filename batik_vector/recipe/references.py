"""Names that one part of a recipe uses for another: every one of them must exist.

The same walk reads a recipe as a file's plain tables and as the dataclasses it becomes.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Any, TypeAlias

from batik_vector.errors import Fault, shortened, unknown_name
from batik_vector.values import defaults

Path: TypeAlias = tuple[str | int, ...]
"""Keys and indices from the root of a recipe."""

EVERY = "*"
"""The index of all members of a list, as people write it: ``place[*].width``."""

INK_KEYS = ("ink", "line_ink")
PLACES = ("place", "corner_place")
"""Keys of a border that hold placements."""
_NUMBERS = frozenset({bool, int, float, type(None)})
_BARE = frozenset("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-")


def dotted(path: Path) -> str:
    """Return a path as people write it: ``("place", 1, "width")`` → ``place[1].width``."""
    text = ""
    for part in path:
        if isinstance(part, int):
            text += f"[{part}]"
        elif part == EVERY:
            text += "[*]"
        else:
            bare = part and _BARE.issuperset(part)
            text += ("." if text else "") + (shortened(part) if bare else quoted(shortened(part)))
    return text


def quoted(text: str) -> str:
    """Return a text as TOML writes it, on one line."""

    def spelled(c: str) -> str:
        if c in '"\\':
            return f"\\{c}"
        if c.isprintable():
            return c
        return f"\\u{ord(c):04X}" if ord(c) < 0x10000 else f"\\U{ord(c):08X}"

    return '"' + "".join(map(spelled, text)) + '"'


def children(node: Any) -> Iterator[tuple[str | int, Any]]:
    """Yield what a table, a list or a dataclass holds."""
    if isinstance(node, dict):
        yield from node.items()
    elif isinstance(node, list | tuple):
        yield from enumerate(node)
    elif dataclasses.is_dataclass(node) and not isinstance(node, type):
        for name in defaults(node):
            yield name, getattr(node, name)


def child(node: Any, key: str) -> Any:
    """Return one thing that a table or a dataclass holds, or None."""
    return node.get(key) if isinstance(node, dict) else getattr(node, key, None)


def ink_names(node: Any, path: Path = ()) -> Iterator[tuple[Path, str]]:
    """Yield every ink that is named anywhere in a node, and where."""
    for key, value in children(node):
        if isinstance(value, str):
            if key in INK_KEYS and value:
                yield (*path, key), value
        elif type(value) not in _NUMBERS:
            yield from ink_names(value, (*path, key))


def places(recipe: Any) -> Iterator[tuple[Path, Any]]:
    """Yield every placement of a recipe and its borders, and where it stands."""
    for number, place in _listed(child(recipe, "place")):
        yield ("place", number), place
    for number, border in _listed(child(recipe, "border")):
        for key in PLACES:
            for index, place in _listed(child(border, key)):
                yield ("border", number, key, index), place


def _listed(node: Any) -> Iterator[tuple[str | int, Any]]:
    return children(node) if isinstance(node, list | tuple) else iter(())


def unknown_references(recipe: Any) -> list[tuple[Path, Fault]]:
    """Return what names a motif or an ink that the recipe does not have."""
    motifs, inks = child(recipe, "motif"), child(recipe, "ink")
    found: list[tuple[Path, Fault]] = []

    def look(path: Path, name: str, known: Any, what: str) -> None:
        if isinstance(known, dict) and known and name not in known:
            found.append((path, Fault(unknown_name(name, list(known), what), dotted(path))))

    if inks is None:
        inks = {"ink": None}
    for path, name in ink_names(motifs, ("motif",)):
        look(path, name, inks, "ink")
    for number, border in _listed(child(recipe, "border")):
        for path, name in ink_names(child(border, "rails"), ("border", number, "rails")):
            look(path, name, inks, "ink")
    for place_path, place in places(recipe):
        for path, name in ink_names(child(place, "fill_with"), (*place_path, "fill_with")):
            look(path, name, inks, "ink")
        for key, known in (("motif", motifs), ("ink", inks)):
            written = child(place, key)
            several = isinstance(written, list | tuple)
            for name in written if several else [written]:
                if isinstance(name, str) and (name or (key == "motif" and several)):
                    look((*place_path, key), name, known, key)
    return found
