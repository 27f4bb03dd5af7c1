"""What a control is called, and of what kind it is."""

from __future__ import annotations

from typing import Any

from batik_vector.fields import parse_colour
from batik_vector.recipe.reading.field_types import Hint
from batik_vector.recipe.references import Path
from batik_vector.studio.declared import Place
from batik_vector.units import parse_length


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
