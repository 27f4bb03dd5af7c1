"""``--process "cut kerf=0.15mm"``: processes asked for by the call, read as a recipe's are."""

from __future__ import annotations

import re
import shlex
from collections.abc import Sequence
from typing import Annotated, Any

from batik_vector.errors import Fault, RecipeError
from batik_vector.fields import Alone
from batik_vector.processes.hatching.options import HATCHES
from batik_vector.processes.options import AnyProcess
from batik_vector.processes.spec import ProcessSpec
from batik_vector.recipe.reading.overrides import parsed_value
from batik_vector.recipe.reading.tables import values_of
from batik_vector.values import frozen

_PIECE = re.compile(r"""[][{}]|"(?:\\.|[^"\\])*"|'[^']*'|[^][{}\s"']+""")
"""A bracket, what stands in quotes, or what stands between these and blanks."""

_BRACKETS = {"[": 1, "{": 1, "]": -1, "}": -1}


@frozen(kw_only=True)
class _Called:
    process: Annotated[tuple[AnyProcess, ...], Alone()]


def read_process(text: str) -> ProcessSpec:
    """Return the process that a call asks for.

    Args:
        text: its kind, and its keys as ``KEY=VALUE`` parted by blanks; keys of a table within it with a dot.
            Values are written as in a recipe, and need no quotes where they hold no blank.

    Raises:
        RecipeError: with everything that is wrong.
    """
    source = f"--process {text}"
    try:
        kind, *said = _words(text)
    except ValueError:
        raise RecipeError([Fault('expected a process such as "cut kerf=0.15mm"', source=source)]) from None
    table: dict[str, Any] = {"kind": kind}
    for each in said:
        key, equals, value = each.partition("=")
        if not (equals and key and value):
            raise RecipeError([Fault(f'"{each}", expected KEY=VALUE, such as kerf=0.15mm', source=source)])
        _put(table, key.split("."), parsed_value(value), source)
    try:
        return values_of(_Called, {"process": table}, source).process[0]
    except RecipeError as error:
        raise RecipeError([_without_root(each) for each in error.faults]) from None


def read_processes(texts: Sequence[str]) -> tuple[ProcessSpec, ...]:
    """Return the processes that a call asks for, in their order."""
    return tuple(map(read_process, texts))


def _put(table: dict[str, Any], path: list[str], value: Any, source: str) -> None:
    for part in path[:-1]:
        inner = table.setdefault(part, {})
        if not isinstance(inner, dict):
            raise RecipeError([Fault(f"{part} has a value already", ".".join(path), source)])
        table = inner
    if path[-1] in table:
        raise RecipeError([Fault("has a value already", ".".join(path), source)])
    table[path[-1]] = value


def _words(text: str) -> list[str]:
    """Return what blanks part, but for those within quotes, lists and tables; values keep their quotes.

    Raises:
        ValueError: where a quote or a bracket is not closed.
    """
    words: list[str] = []
    depth = end = 0
    for found in _PIECE.finditer(text):
        piece, between = found[0], text[end : found.start()]
        if between.strip():
            raise ValueError("a quote is not closed")
        if not words or (between and not depth):
            words.append(piece)
        else:
            words[-1] += between + piece
        depth += _BRACKETS.get(piece, 0)
        end = found.end()
    if depth or text[end:].strip():
        raise ValueError("a quote or a bracket is not closed")
    return [shlex.split(each)[0] if each[0] in "\"'" else each for each in words]


def _without_root(fault: Fault) -> Fault:
    """Return a fault as the call has it: without the key of processes, and tables by their keys."""
    key, message = fault.key.removeprefix("process").removeprefix("."), fault.message
    name = re.fullmatch(r'"([a-z-]+)", expected a table with a kind', message)
    if key == "hatch" and name and name[1] in HATCHES:
        message += f", as {key}.kind={name[1]} makes it"
    return Fault(message, key, fault.source)
