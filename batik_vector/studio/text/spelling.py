"""How a value that a control gives is written into a recipe: in the unit and the kind of the one before."""

from __future__ import annotations

import math
import re
from typing import Any

from batik_vector.recipe.reading.field_types import Hint
from batik_vector.recipe.references import quoted
from batik_vector.units import MM_PER_UNIT

FIGURES = 6
"""Significant figures of numbers that sliders give."""
_BARE = re.compile(r"[A-Za-z0-9_-]+\Z")
_UNIT = re.compile(r"^\s*([+-]?[0-9.]+(?:[eE][+-]?\d+)?)(\s*)([a-zA-Zµ\"]*)\s*$")


def spelled(value: Any) -> str:
    """Return a value as TOML writes it on one line.

    Raises:
        ValueError: where TOML has no such value.
    """
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, int):
        return str(int(value))
    if isinstance(value, float):
        if not math.isfinite(value):
            raise ValueError(f"{value}, expected a number that is finite")
        return repr(float(value))
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(spelled, value)) + "]"
    if isinstance(value, dict):
        pairs = ", ".join(f"{spelled_key(str(key))} = {spelled(each)}" for key, each in value.items())
        return f"{{ {pairs} }}" if pairs else "{}"
    raise ValueError(f"a value of type {type(value).__name__}, expected what TOML can say")


def spelled_key(key: str) -> str:
    """Return a key as TOML writes it."""
    return key if _BARE.match(key) else quoted(key)


def as_written(hint: Hint, value: Any, before: Any = None) -> Any:
    """Return a value as the recipe writes it.

    Args:
        hint: what is declared there.
        value: as a control gives it, lengths in mm.
        before: what was written there.
    """
    if isinstance(value, list | tuple):
        held = before if isinstance(before, list) and len(before) == len(value) else [None] * len(value)
        kinds = [hint.items[n] if n < len(hint.items) else hint.item or hint for n in range(len(value))]
        return [as_written(kind, each, was) for kind, each, was in zip(kinds, value, held, strict=True)]
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value
    if hint.length:
        return _length(float(value), before)
    if hint.base is int and float(value).is_integer():
        return int(value)
    return _figures(float(value))


def _figures(value: float) -> int | float:
    """Return a number without binary leftovers; a whole one as people write it."""
    found = float(f"{value:.{FIGURES}g}") if abs(value) < 10**FIGURES else value
    return int(found) if found.is_integer() and abs(found) < 2**53 else found


def _length(mm: float, before: Any) -> str | float | int:
    """Return a length in the unit of the one before; in mm, where it had none a bare number."""
    if isinstance(before, int | float):
        return _figures(mm)
    found = _UNIT.match(before) if isinstance(before, str) else None
    gap, unit = (found[2], found[3]) if found and found[3] in MM_PER_UNIT else (" ", "mm")
    return f"{_figures(mm / MM_PER_UNIT[unit])}{gap}{unit}"
