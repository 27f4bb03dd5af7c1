"""Messages: what is wrong with a recipe in lines that people can act on, with the nearest right name."""

from __future__ import annotations

import datetime
import math
import re
from collections.abc import Iterable, Mapping
from typing import Any

from batik_vector.errors import Fault, RecipeError, unknown_name
from batik_vector.fields import TAG, Catalogue, OneOf
from batik_vector.recipe.reading.field_types import Hint, chosen, expected, members, span
from batik_vector.recipe.reading.lines import parse_path
from batik_vector.recipe.references import Path, dotted
from batik_vector.values import frozen

_BOUNDS = ("greater_than_equal", "less_than_equal")
_LONGEST = 60
_MISSING = object()


@frozen
class Found:
    """A fault and the path whose line it is told with, which may lie deeper than its key."""

    path: Path
    fault: Fault


@frozen
class _Spot:
    """Where an error stands: its path, what is written there, and what should be."""

    path: Path
    value: Any
    hint: Hint
    around: Hint


def shown(value: Any) -> str:
    """Return a value as a recipe writes it, shortened."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and not math.isfinite(value):
        return "nan" if math.isnan(value) else "inf" if value > 0 else "-inf"
    if isinstance(value, int) and value.bit_length() > 200:
        return "a whole number of more than 60 digits"
    if isinstance(value, str):
        text = value if len(value) <= _LONGEST else value[:_LONGEST] + "…"
        return '"' + "".join(c if c.isprintable() else "\ufffd" for c in text) + '"'
    if isinstance(value, list):
        if not any(isinstance(each, list | dict) for each in value) and len(value) <= 8:
            return "[" + ", ".join(shown(each) for each in value) + "]"
        return f"a list of {len(value)}"
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, datetime.date | datetime.time):
        return value.isoformat()
    return str(value)


def found_in(errors: Iterable[Mapping[str, Any]], data: Any, root: type) -> list[Found]:
    """Return pydantic's errors as faults, in their order, each once."""
    faults: dict[tuple[Path, str], Found] = {}
    for error in errors:
        spot = _follow(error["loc"], data, Hint(root))
        for found in _told(error, spot):
            faults.setdefault((found.path, found.fault.message), found)
    return list(faults.values())


def _follow(loc: tuple[str | int, ...], data: Any, hint: Hint) -> _Spot:
    """Walk down a path of pydantic's through the data and the types."""
    path: Path = ()
    around = hint
    for part in loc:
        if isinstance(part, str) and part.startswith(TAG):
            continue
        if hint.alone and hint.item is not None and isinstance(data, dict):
            hint = hint.item  # the table itself stands where the list would
            continue
        around, hint, data = hint, _inside(hint, data, part), _at(data, part)
        path = (*path, part)
    return _Spot(path, data, hint, around)


def _at(data: Any, part: str | int) -> Any:
    if isinstance(data, dict):
        return data.get(part, _MISSING)
    if isinstance(data, list) and isinstance(part, int) and part < len(data):
        return data[part]
    return _MISSING


def _inside(hint: Hint, value: Any, part: str | int) -> Hint:
    cls = chosen(hint, value)
    if cls is not None:
        member = members(cls).get(str(part))
        return member.hint if member else Hint(object)
    if isinstance(part, int) and part < len(hint.items):
        return hint.items[part]
    return hint.item or Hint(object)


def _told(error: Mapping[str, Any], spot: _Spot) -> list[Found]:
    kind = error["type"]
    if kind == "missing":
        return [_missing(spot)]
    if kind == "unexpected_keyword_argument":
        return []  # told by unknown_keys, which has the whole table before it
    if kind in ("no_tag", "bad_tag"):
        return [_tag(spot)]
    if kind == "value_error":
        return _raised(error["ctx"]["error"], spot)
    if kind in _BOUNDS:
        return [_found(spot, f"{shown(spot.value)}, expected {span(spot.hint)}")]
    if spot.hint.names and isinstance(spot.value, str):
        words = unknown_name(spot.value, spot.hint.names, _what(spot.path))
        return [_found(spot, words)]
    return [_found(spot, f"{shown(spot.value)}, expected {_expected(spot)}")]


def _what(path: Path) -> str:
    """Return what a value at a path is called: its key, and within a list one of what the key names."""
    key = next((part for part in reversed(path) if isinstance(part, str)), "value")
    return key if path[-1] == key else key.removesuffix("s")


def _expected(spot: _Spot) -> str:
    words = expected(spot.hint)
    if len(spot.path) == 1 and spot.hint.many:
        words += f": write [[{spot.path[0]}]]"
    if len(spot.path) == 1 and spot.hint.origin is dict:
        words += f": write [{spot.path[0]}.NAME]"
    return words


def _found(spot: _Spot, message: str) -> Found:
    return Found(spot.path, Fault(message, dotted(spot.path)))


def _missing(spot: _Spot) -> Found:
    if spot.path and isinstance(spot.path[-1], int):
        # A list too short: what is wrong is the list.
        path = spot.path[:-1]
        return Found(path, Fault(f"too short, expected {expected(spot.around)}", dotted(path)))
    hint = spot.hint
    says = f" ({hint.says.text})" if hint.says else ""
    return _found(spot, f"missing, expected {_expected(spot)}{says}")


def _tag(spot: _Spot) -> Found:
    one_of = spot.hint.one_of
    assert one_of is not None
    tag, known = one_of.tag, list(one_of.load())
    what = f"{tag} of {one_of.what}"
    if tag not in spot.value:
        return _found(spot, f"no {what}: expected {tag} = one of {', '.join(known)}")
    written = spot.value[tag]
    words = _unknown(written, one_of, what) if isinstance(written, str) else ""
    path = (*spot.path, tag)
    return Found(path, Fault(words or f"{shown(written)}, expected one of {', '.join(known)}", dotted(path)))


def _unknown(written: str, one_of: OneOf, what: str) -> str:
    """Return what is wrong with a name of a catalogue: it is unknown, or its plug-in is broken."""
    catalogue = one_of.load()
    broken = catalogue.broken.get(written) if isinstance(catalogue, Catalogue) else None
    if broken:
        return f"{what} {shown(written)}: its plug-in is passed over, {broken}"
    return unknown_name(written, list(catalogue), what)


def _raised(raised: Exception, spot: _Spot) -> list[Found]:
    """Return the faults of an error that a parser or a dataclass raised."""
    if isinstance(raised, RecipeError):
        return [
            Found(keyed(fault.key, spot.path), Fault(fault.message, dotted(keyed(fault.key, spot.path))))
            for fault in raised.faults
        ]
    words = str(raised)
    cls = chosen(spot.hint, spot.value)
    if cls is None:
        words = words.removeprefix(f"{spot.path[-1]} {shown(spot.value)}: ") if spot.path else words
        glue = ", " if words.startswith("expected") else ": "
        return [_found(spot, f"{shown(spot.value)}{glue}{words}")]
    name, rest = field_first(words)
    if name in members(cls):
        path = (*spot.path, name)
        return [Found(path, Fault(rest, dotted(path)))]
    return [_found(spot, words)]


def field_first(words: str) -> tuple[str, str]:
    """Return the field that a message begins with, dots and all, and the rest: ``radius = 0: expected …``."""
    begins = re.match(r"(\w+(?:\.\w+)*)(?: = | (?=\"))(?!\w+ = )", words)
    return (begins[1], words[begins.end() :]) if begins else ("", words)


def keyed(key: str, before: Path = ()) -> Path:
    """Return the path of a key in words, behind another path; of a key that is none, the other path."""
    try:
        return (*before, *parse_path(key)) if key else before
    except ValueError:
        return before


def unknown_keys(data: Any, hint: Hint, path: Path = ()) -> list[Found]:
    """Return every key that the classes of its table do not know, with the nearest that they do."""
    found: list[Found] = []
    if isinstance(data, list):
        item = hint.item if hint.many else None
        items = hint.items or [item or Hint(object)] * len(data)
        for index, (each, inner) in enumerate(zip(data, items, strict=False)):
            found += unknown_keys(each, inner, (*path, index))
        return found
    if hint.alone and hint.item is not None:
        return unknown_keys(data, hint.item, path)
    cls = chosen(hint, data)
    if not isinstance(data, dict) or not (cls or hint.origin is dict):
        return found
    known = members(cls) if cls else {}
    tag = hint.one_of.tag if hint.one_of else None
    for key, value in data.items():
        within = known[key].hint if key in known else hint.item
        if cls and key not in known:
            found += [] if key == tag else [_unknown_key(key, cls, tag, path)]
        elif within:
            found += unknown_keys(value, within, (*path, key))
    return found


def _unknown_key(key: str, cls: type, tag: str | None, path: Path) -> Found:
    later = getattr(cls, "later", {})
    here = (*path, key)
    if key in later:
        return Found(here, Fault(later[key], dotted(here)))
    names = [*([tag] if tag else []), *members(cls)]
    return Found(here, Fault(unknown_name(key[:_LONGEST], names, "key"), dotted(path)))


def odd_number(number: int) -> str:
    """Return what is wrong with a whole number that TOML's 64 bits do not hold."""
    return f"{shown(number)}, expected a number of at most 64 bits"
