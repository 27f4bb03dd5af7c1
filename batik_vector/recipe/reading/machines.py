"""Machines that a recipe or a call names: profiles that come with the program, or files of one's own.

A file is read beside the recipe; a compiled file carries it behind its recipe, as it does drawings, in a
spelling of its own without comments. A profile may begin from one that comes with the program:
``base = "pen-plotter"``, and say only what is different.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

from batik_vector.errors import Fault, RecipeError, nearest, unknown_name
from batik_vector.machines import MACHINES, Machine, shipped_text
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.reading.beside import Kind, read_beside
from batik_vector.recipe.reading.sources import MAX_TEXT, decoded, parted, with_carried
from batik_vector.recipe.reading.tables import tables_of, values_of

TOML_FILE = Kind("a machine's profile in TOML", ".toml", "mine.toml")
EMPTY = 'a machine\'s profile, such as base = "pen-plotter"'
BASE = "base"


def with_machines(recipe: Recipe, folder: str | None) -> Recipe:
    """Return a recipe with the profiles of its outputs' machines read, and those of files carried.

    Args:
        recipe: read, its machines not yet.
        folder: where it stands; None where it stands nowhere.

    Raises:
        RecipeError: with the keys of all that is wrong.
    """
    faults: list[Fault] = []
    outputs = []
    texts: dict[str, str] = {}
    for number, output in enumerate(recipe.output):
        try:
            if output.machine and output.machine_profile is None:
                text, profile = _machine(output.machine, folder, recipe.drawing.get(output.machine))
                if text:
                    texts[output.machine] = text
                output = replace(output, machine_profile=profile)
        except RecipeError as error:
            faults += [Fault(_words(each), f"output[{number}].machine") for each in error.faults]
        outputs.append(output)
    if faults:
        raise RecipeError(faults)
    own, before = parted(recipe.source)
    return replace(
        recipe,
        output=tuple(outputs),
        drawing=recipe.drawing | texts,
        source=with_carried(own, before | texts),
    )


def read_machine(name: str) -> Machine:
    """Return the machine of a name, or of a file.

    Args:
        name: of a profile that comes with the program; or the path of a TOML file, with its suffix.

    Raises:
        RecipeError: where there is none such, or it is wrong.
    """
    return _machine(os.path.basename(name) if _is_file(name) else name, os.path.dirname(name) or ".", None)[1]


def is_profile(data: Mapping[str, Any]) -> bool:
    """Return whether tables are of a machine's profile, and not of a recipe."""
    known = {BASE, *(each.name for each in fields(Machine))}
    return bool(data.keys() & known) and not data.keys() & {each.name for each in fields(Recipe)}


def _is_file(name: str) -> bool:
    return name.lower().endswith(TOML_FILE.suffix)


def _words(fault: Fault) -> str:
    """Return what is wrong in a profile, with its place there."""
    place = ":".join(str(part) for part in (fault.source, fault.line) if part not in ("", None))
    said = f"{fault.key}: {fault.message}" if fault.key and place else fault.message
    return f"{place}: {said}" if place else said


def _machine(name: str, folder: str | None, carried: str | None) -> tuple[str, Machine]:
    """Return a machine, and the text that carries it where it is a file's."""
    if not _is_file(name):
        if name not in MACHINES:
            words = unknown_name(name, MACHINES, "machine")
            raise RecipeError([Fault(f"{words} (a profile of your own is a file: mine.toml)")])
        return "", values_of(Machine, tables_of(shipped_text(name), name, EMPTY), name, shipped_text(name))
    text = carried
    if text is None:
        text = decoded(read_beside(name, folder, TOML_FILE, MAX_TEXT)[0], name, TOML_FILE.words)
    data = tables_of(text, name, EMPTY)
    return _spelled(data), values_of(Machine, _based(data, name, text), name, text)


def _based(data: dict[str, Any], source: str, text: str) -> dict[str, Any]:
    """Return a profile with what it leaves out taken from the one that it begins from."""
    if BASE not in data:
        known = [BASE, *(each.name for each in fields(Machine))]
        for key in data:
            if key not in known and nearest(key, known) == BASE:
                raise _placed(unknown_name(key, known, "key"), key, source, text)
        return data
    base = data[BASE]
    if base not in MACHINES:
        words = unknown_name(str(base), MACHINES, "machine")
        raise _placed(words, BASE, source, text)
    below = tables_of(shipped_text(base), base, EMPTY)
    return _over({key: value for key, value in data.items() if key != BASE}, below)


def _placed(words: str, key: str, source: str, text: str) -> RecipeError:
    from batik_vector.recipe.reading.validator import relocated

    return relocated(RecipeError([Fault(words, key)]), source, text, ())


def _over(above: dict[str, Any], below: dict[str, Any]) -> dict[str, Any]:
    both = {
        key: _over(value, below[key])
        if isinstance(value, dict) and isinstance(below.get(key), dict)
        else value
        for key, value in above.items()
    }
    return below | both


def _spelled(data: dict[str, Any]) -> str:
    """Return tables as TOML in one spelling, without apostrophes: they would end the string that holds it."""
    lines = [f"{json.dumps(key)} = {_value(value)}\n" for key, value in data.items()]
    return "".join(lines).replace("'", "\\u0027")


def _value(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)} = {_value(each)}" for key, each in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    return json.dumps(value)
