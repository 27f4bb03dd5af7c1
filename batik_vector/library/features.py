"""Features: what is measured of a pattern, how it is asked for, and how far two patterns are apart.

The likeness of two patterns is the distance of their features, each brought to a scale on which 1 is a
difference that catches the eye: ``(a - b) / unit``, for sizes and counts that differ by factors
``log2(a / b) / unit``, and for words 0 or 1. The distance is the root of the mean of the squares, taken over
the features of the pattern that is asked for; what the other lacks counts as 1.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import TypeAlias

from batik_vector import LibraryError

Value: TypeAlias = float | int | str | None


@dataclass(frozen=True)
class Feature:
    """One thing that is measured.

    ``unit`` is the difference that counts as 1 in likeness, on a scale of factors of two where ``by_factor``.
    Without a unit it is no part of likeness. ``kind`` is int, float or str. ``words`` are all that a feature
    in words may hold, of which one pattern may have several: "curved and wavy".
    """

    says: str
    kind: type
    unit: float = 0.0
    by_factor: bool = False
    words: tuple[str, ...] = ()


RELATIONS = ("none", "rotation", "translation")
FEATURES: Mapping[str, Feature] = {
    "width": Feature("width of the tile, or of a cloth without one, mm", float, 2.0, True),
    "height": Feature("height of it, mm", float, 2.0, True),
    "inks": Feature("inks that draw something", int, 1.0),
    "coverage": Feature("ink on the tile, per cent of it", float, 15.0),
    "vertices": Feature("vertices of the tile", int, 1.5, True),
    "marks": Feature("areas and lines on the tile", int, 1.5, True),
    "motifs": Feature("motifs that are placed", int, 1.0),
    "repeat": Feature("how the tile repeats: grid, half-drop, p4m, …", str, 1.0),
    "elements": Feature("kinds of elements that are repeated", int, 1.0),
    "relation": Feature("how like elements lie to one another", str, 1.0, words=RELATIONS),
    "symmetry": Feature("order of the flower's symmetry: turns of 360° / order keep it", int, 2.0),
    "kind": Feature("kind of its symmetry", str, 1.0, words=("none", "rotation", "reflection")),
    "layers": Feature("layers of petals", int, 1.0),
    "shape": Feature("shape of the petals", str, 1.0, words=("rhombus", "curved", "wavy")),
    "petals": Feature("petals of the outermost layer", int, 2.0),
    "pistils": Feature("pistils that a petal has at most", float, 1.0),
    "flowers": Feature("flowers on the tile like the one that is told of", int, 2.0, True),
    "dimension": Feature("box dimension of all outlines and lines", float, 0.2),
    "thinnest": Feature("least breadth of a line, mm", float),
    "thickest": Feature("greatest breadth of a line, mm", float),
    "nodes": Feature("nodes of the paths", int),
    "row": Feature('the row of the paper\'s Table 2: "2, rotation, 1/8, single, curved, 8, 1"', str),
}
"""What is measured of a pattern, by name; from ``elements`` on by :func:`batik_vector.analyse`."""

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?"
_RANGE = re.compile(rf"\s*([A-Za-z_-]+)\s*(?:=|\s|\bin\b)\s*({_NUMBER})\s*\.\.\s*({_NUMBER})\s*")
_COMPARED = re.compile(r"\s*([A-Za-z_-]+)\s*(<=|>=|!=|==|=|<|>|≤|≥|≠)\s*(\"[^\"]*\"|'[^']*'|[^<>=!]+?)\s*")
_AND = re.compile(r"\s+and\s+(?=[A-Za-z_-]+\s*(?:[<>=!≤≥≠.+\d-]|in\b))", re.IGNORECASE)
_SAME = {"==": "=", "≤": "<=", "≥": ">=", "≠": "!="}
EXAMPLE = "petals = 8, shape = wavy, inks <= 3, coverage 20..40"
MOST_CONDITIONS = 50


def coordinates(measured: Mapping[str, Value]) -> dict[str, float | None]:
    """Return the numbers among features that are compared; those compared by factors as logarithms to 2."""
    found: dict[str, float | None] = {}
    for name, feature in FEATURES.items():
        if feature.kind is str or not feature.unit:
            continue
        value = measured.get(name)
        if value is None or isinstance(value, str):
            found[name] = None
        elif feature.by_factor:
            found[name] = math.log2(max(float(value), 1e-3))
        else:
            found[name] = float(value)
    return found


def condition(text: str) -> tuple[str, list[Value]]:
    """Return an expression over features as a condition in SQL on ``m``, and its values.

    ``petals = 8, inks <= 3, coverage 20..40``: all must hold. A number equals what rounds to it at its last
    digit; a feature that was not measured fulfils nothing.

    Raises:
        LibraryError: saying which part is wrong.
    """
    parts = [part for part in _parts(text) if part.strip()]
    if not parts:
        return "", []
    if len(parts) > MOST_CONDITIONS:
        raise LibraryError(f"{len(parts)} conditions, expected at most {MOST_CONDITIONS}")
    found = [_condition(part) for part in parts]
    return " AND ".join(sql for sql, _ in found), [value for _, values in found for value in values]


def _parts(text: str) -> Iterator[str]:
    """Yield what stands between commas, but for those in quotes, and what follows "and" as a condition."""
    for quoted in re.findall(r"(?:\"[^\"]*\"|'[^']*'|[^,])+", text):
        yield from _AND.split(quoted)


def _condition(part: str) -> tuple[str, list[Value]]:
    found = _RANGE.fullmatch(part)
    if found:
        name = _known(found[1], part)
        if FEATURES[name].kind is str:
            raise LibraryError(f'"{part.strip()}": {name} is a word, and has no range')
        low, high = (_number(each, part) for each in (found[2], found[3]))
        if low > high:
            raise LibraryError(
                f'"{part.strip()}": the range is empty, expected {found[1]} {found[3]}..{found[2]}'
            )
        return f"m.{name} BETWEEN ? AND ?", [low, high]
    found = _COMPARED.fullmatch(part)
    if not found:
        raise LibraryError(f'"{part.strip()[:60]}" is no condition, expected such as {EXAMPLE}')
    name, how, value = _known(found[1], part), _SAME.get(found[2], found[2]), found[3].strip()
    if FEATURES[name].kind is str:
        return _worded(name, how, value.strip("\"'"), part)
    number = _number(value, part)
    if how in ("=", "!="):
        half = 0.5 * 10.0 ** -_digits(value)
        between = f"m.{name} BETWEEN ? AND ?"
        return between if how == "=" else f"NOT {between}", [
            number - half * (1 - 1e-9),
            number + half * (1 - 1e-9),
        ]
    return f"m.{name} {how} ?", [number]


def _worded(name: str, how: str, value: str, part: str) -> tuple[str, list[Value]]:
    if how not in ("=", "!="):
        raise LibraryError(
            f'"{part.strip()}": {name} is a word: expected {name} = {value}, or {name} != {value}'
        )
    words = FEATURES[name].words
    if words and not set(value.lower().split(" and ")) <= {*words}:
        near = get_close_matches(value.lower(), words, n=1, cutoff=0.5)
        hint = f'did you mean "{near[0]}"?' if near else f"expected one of {', '.join(words)}"
        raise LibraryError(f'"{part.strip()[:60]}": no {name} is called "{value[:40]}": {hint}')
    if words:
        has = f"instr(' ' || m.{name} || ' ', ?)"
        return f"{has} {'>' if how == '=' else '='} 0", [f" {value.lower()} "]
    return f"m.{name} {how} ? COLLATE NOCASE", [value]


def _known(name: str, part: str) -> str:
    plain = name.lower().replace("-", "_")
    if plain in FEATURES:
        return plain
    near = get_close_matches(plain, FEATURES, n=1, cutoff=0.55)
    hint = f'did you mean "{near[0]}"?' if near else f"expected one of {', '.join(FEATURES)}"
    raise LibraryError(f'"{part.strip()[:60]}": no feature is called "{name[:40]}": {hint}')


def _number(text: str, part: str) -> float:
    if not re.fullmatch(_NUMBER, text) or not math.isfinite(float(text)):
        raise LibraryError(f'"{part.strip()[:60]}": expected a number, and "{text[:40]}" is none')
    return float(text)


def _digits(number: str) -> int:
    """Return how many digits a number has behind its point."""
    mantissa, _, power = number.lower().partition("e")
    return len(mantissa.partition(".")[2]) - int(power or 0)


def distance(reference: Mapping[str, Value]) -> tuple[str, list[Value]]:
    """Return the distance from a pattern's features in SQL over ``m`` and ``c``, squared, and its values.

    Raises:
        LibraryError: where nothing of the pattern was measured.
    """
    places = coordinates(reference)
    parts: list[str] = []
    values: list[Value] = []
    for name, feature in FEATURES.items():
        value = places.get(name) if feature.kind is not str else reference.get(name)
        if value is None or not feature.unit:
            continue
        if feature.kind is str:
            parts.append(f"coalesce(m.{name} != ?, 1)")
            values.append(value)
        else:
            apart = f"(c.{name} - ?) / {float(feature.unit)!r}"
            parts.append(f"coalesce({apart} * {apart}, 1.0)")
            values += [value, value]
    if not parts:
        raise LibraryError("nothing of it was measured, and so nothing can be found to be like it")
    return f"({' + '.join(parts)}) / {len(parts)}.0", values


def columns(kind_of_text: bool = True) -> Sequence[str]:
    """Return the names of features, those in words too or numbers alone."""
    return [name for name, feature in FEATURES.items() if kind_of_text or feature.kind is not str]
