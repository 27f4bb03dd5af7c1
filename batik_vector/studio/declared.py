"""What the recipe's declarations say of a place in it: its type, bounds, help, and what it is by default."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from batik_vector.fields import parse_colour
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.reading.field_types import Hint, Member, chosen, members, taken_apart
from batik_vector.recipe.references import Path
from batik_vector.units import parse_length
from batik_vector.values import frozen

MISSING = object()
"""Stands for what is not said, and has no default."""


@frozen(eq=False)
class Place:
    """A place in a recipe.

    Args:
        hint: its type, with bounds and help.
        default: what it is where nothing is said; ``MISSING`` where something must be.
        said: what the recipe says there, or ``MISSING``.
    """

    hint: Hint
    default: Any
    said: Any


def root(tables: Mapping[str, Any]) -> Place:
    """Return the place of a whole recipe."""
    return Place(taken_apart(Recipe), MISSING, tables)


def place_at(tables: Mapping[str, Any], path: Path) -> Place | None:
    """Return the place that a path leads to, or None where the declarations know none."""
    place = root(tables)
    for part in path:
        found = inner(place, part)
        if found is None:
            return None
        place = found
    return place


def inner(place: Place, part: str | int) -> Place | None:
    """Return the place of a member: a key of a table, or one of a list."""
    hint, said = place.hint, place.said
    given = said[part] if _has(said, part) else MISSING
    cls = class_of(place)
    if cls is not None:
        member = members(cls).get(str(part))
        if member is None:
            return None
        return Place(member.hint, default_of(place, cls, str(part), member), given)
    if isinstance(part, int) and hint.alone and isinstance(said, dict):
        given = said if part == 0 else MISSING
    item = hint.items[part] if isinstance(part, int) and part < len(hint.items) else hint.item
    if item is None:
        return None
    held: Any = place.default
    held = held[part] if _has(held, part) else MISSING
    return Place(item, held, given)


def class_of(place: Place) -> type | None:
    """Return the dataclass that is read at a place: that of what the recipe says, or the default's."""
    if isinstance(place.said, dict):
        return chosen(place.hint, place.said)
    if place.said is not MISSING:
        return None
    if dataclasses.is_dataclass(place.default):
        return type(place.default)
    # A table that there need not be.
    return chosen(place.hint, {})


def default_of(place: Place, cls: type, name: str, member: Member) -> Any:
    """Return what a key is where it is left out: the table's own default where that is left out too."""
    if place.said is MISSING and isinstance(place.default, cls):
        return getattr(place.default, name)
    return MISSING if member.required else member.default


def _has(node: Any, part: Any) -> bool:
    if isinstance(node, list | tuple):
        return isinstance(part, int) and 0 <= part < len(node)
    return isinstance(node, Mapping) and part in node


def plain(hint: Hint, value: Any) -> Any:
    """Return a default as a recipe would write it: numbers, words, lists and tables.

    Of a table what is written is its kind, and what differs from the table's own defaults.
    """
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        table: dict[str, Any] = {}
        if hint.one_of is not None:
            table = {hint.one_of.tag: kind_of(hint, type(value))}
        for name, member in members(type(value)).items():
            held = getattr(value, name)
            if held is not None and (member.required or held != member.default):
                table[name] = plain(member.hint, held)
        return table
    if isinstance(value, tuple | list):
        each_hint = [hint.items[n] if n < len(hint.items) else hint.item or hint for n in range(len(value))]
        return [plain(one, each) for one, each in zip(each_hint, value, strict=True)]
    if isinstance(value, dict):
        return {name: plain(hint.item or hint, each) for name, each in value.items()}
    return str(value) if isinstance(value, str) else value


def kind_of(hint: Hint, cls: type) -> str:
    """Return the name that a catalogue has for a class."""
    assert hint.one_of is not None
    return next((name for name, known in hint.one_of.load().items() if known is cls), "")


def is_scalar(hint: Hint) -> bool:
    """Return whether a value is a number, a word, a switch, or a pair of such."""
    if hint.one_of is not None or hint.item is not None:
        return False
    if hint.items:
        return all(is_scalar(each) for each in hint.items)
    return not dataclasses.is_dataclass(hint.base)


def plain_list(hint: Hint) -> bool:
    """Return whether a list holds numbers or words, and no tables."""
    item = hint.item
    return item is not None and hint.origin is not dict and (is_scalar(item) or plain_list(item))


def sort_of(hint: Hint, offered: bool) -> str:
    """Return the kind of control for a value; ``offered`` says whether there are words to choose from."""
    if hint.base is bool:
        return "switch"
    if hint.names:
        return "choice"
    if hint.several:
        return "names"
    if hint.base is int:
        return "whole"
    if hint.base is float:
        return "number"
    if hint.text is not None and hint.text.parse is parse_colour:
        return "colour"
    return "text" if hint.base is str or offered else "list"


def number_of(hint: Hint, said: Any) -> Any:
    """Return what is said, a length in mm; what is no length as it stands."""
    if not hint.length:
        return said
    try:
        return parse_length(said)
    except ValueError:
        return said


def symbol_of(symbol: str, path: Path, around: Place | None) -> str:
    """Return the paper's symbol of a value; of a pair (``dx, dy``) each number has its own."""
    parts = symbol.split(", ")
    return parts[int(path[-1])] if around is not None and len(parts) == len(around.hint.items) else symbol


def label_of(path: Path, around: Place | None, called: str = "") -> str:
    """Return what a value is called: its word or its key; each number of a pair by its axis."""
    if around is None:
        return called or str(path[-1]).replace("_", " ")
    number = int(path[-1])
    if len(words := called.split(", ")) == len(around.hint.items):
        return words[number]
    name = called or str(path[-2]).replace("_", " ")
    return f"{name} {'xyzuvw'[number]}" if len(around.hint.items) <= 6 else f"{name} {number + 1}"
