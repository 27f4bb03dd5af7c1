"""The JSON Schema of recipes, made of the same bounds and help that check them.

Draft 2020-12, with nothing that older readers of schemas (taplo, for TOML in editors) stumble over.
"""

from __future__ import annotations

import dataclasses
import enum
import inspect
from typing import Any

from batik_vector.recipe.model import Recipe
from batik_vector.recipe.reading.field_types import Hint, Member, example, members
from batik_vector.units import MM_PER_UNIT

Schema = dict[str, Any]

ENOUGH = (("place", "tile"), ("border", "yardage"))
"""A recipe draws a tile, or borders on a cloth."""

_LENGTH_PATTERN = r"(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?\s*(" + "|".join(MM_PER_UNIT) + r")?\s*$"


def schema() -> Schema:
    """Return the JSON Schema of a recipe."""
    definitions: dict[str, Schema] = {}
    root = _table(Recipe, definitions)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "batik_vector recipe",
        **root,
        "anyOf": [{"required": list(keys)} for keys in ENOUGH],
        "$defs": dict(sorted(definitions.items())),
    }


def _table(cls: type, definitions: dict[str, Schema], tag: tuple[str, str] | None = None) -> Schema:
    """Return the schema of a dataclass; ``tag`` is the key and the word that choose it in a catalogue."""
    known = members(cls)
    properties: dict[str, Schema] = {tag[0]: {"const": tag[1]}} if tag else {}
    properties |= {name: _member(member, definitions) for name, member in known.items()}
    required = [tag[0]] if tag else []
    required += [name for name, member in known.items() if member.required]
    return {
        "type": "object",
        "description": inspect.cleandoc(cls.__doc__ or "").split("\n\n")[0].replace("\n", " "),
        "properties": properties,
        **({"required": required} if required else {}),
        "additionalProperties": False,
    }


def _member(member: Member, definitions: dict[str, Schema]) -> Schema:
    found = _value(member.hint, definitions)
    says = member.hint.says
    if says:
        found["description"] = f"{says.text} (the paper's {says.symbol})" if says.symbol else says.text
    elif "$ref" in found:
        found["description"] = definitions[found["$ref"].rpartition("/")[2]]["description"]
    default = _plain(member.default)
    if default is not None and not member.required:
        found["default"] = default
    return found


def _value(hint: Hint, definitions: dict[str, Schema]) -> Schema:
    if hint.one_of:
        one_of = hint.one_of
        choices = [
            _defined(f"{one_of.what}.{name}", cls, definitions, (one_of.tag, name))
            for name, cls in one_of.load().items()
        ]
        return {"type": "object", "required": [one_of.tag], "oneOf": choices}
    if isinstance(hint.base, type) and dataclasses.is_dataclass(hint.base):
        return _defined(hint.base.__name__, hint.base, definitions, None)
    if hint.names:
        return {"enum": hint.names}
    if hint.length:
        sign = "[+]?" if hint.bounds and hint.bounds.low >= 0 else "[+-]?"
        text = {"type": "string", "pattern": rf"^\s*{sign}{_LENGTH_PATTERN}"}
        return {"anyOf": [_number("number", hint), text], "examples": [example(hint)]}
    if hint.base in (int, float):
        return _number("integer" if hint.base is int else "number", hint)
    if hint.base is bool:
        return {"type": "boolean"}
    return _collection(hint, definitions) or _text(hint)


def _collection(hint: Hint, definitions: dict[str, Schema]) -> Schema | None:
    if hint.items:
        items = [_value(item, definitions) for item in hint.items]
        same = all(item == items[0] for item in items)
        count = {"minItems": len(items), "maxItems": len(items)}
        return {"type": "array", **({"items": items[0]} if same else {"prefixItems": items}), **count}
    if hint.item is None:
        return None
    item = _value(hint.item, definitions)
    if hint.many:
        listed = {"type": "array", "items": item}
        return {"anyOf": [item, listed]} if hint.alone else listed
    return {
        "type": "object",
        "propertyNames": {"minLength": 1, "maxLength": 80},
        "additionalProperties": item,
    }


def _text(hint: Hint) -> Schema:
    if hint.several:
        return {"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}]}
    pattern = hint.text.pattern if hint.text else ""
    return {"type": "string", **({"pattern": pattern} if pattern else {})}


def _number(kind: str, hint: Hint) -> Schema:
    bounds = {"minimum": hint.bounds.low, "maximum": hint.bounds.high} if hint.bounds else {}
    return {"type": kind, **bounds}


def _defined(name: str, cls: type, definitions: dict[str, Schema], tag: tuple[str, str] | None) -> Schema:
    if name not in definitions:
        definitions[name] = {}  # taken, lest a table that holds its like be written for ever
        definitions[name] = _table(cls, definitions, tag)
    return {"$ref": f"#/$defs/{name}"}


def _plain(value: Any) -> Any:
    """Return a default as JSON writes it, or None for what it has no short form for."""
    if isinstance(value, enum.Enum):
        return value.value
    if isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, tuple):
        plain = [_plain(each) for each in value]
        return None if None in plain else plain
    return None
