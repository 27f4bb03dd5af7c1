"""Where keys, tables and members of lists stand in a text, from their first character to past their last."""

from __future__ import annotations

from typing import TypeAlias

from batik_vector.recipe.reading.lines import Spans
from batik_vector.recipe.references import Path

Span: TypeAlias = tuple[int, int]


class CannotRewriteError(ValueError):
    """A change that has no meaning in a text, such as to take out what is not there."""


def own_lines(text: str, known: Spans, table: Path) -> Span:
    """Return where the keys of a table stand: from behind its header to the next one."""
    starts = [start for start, _ in known.headers]
    if not table:
        return 0, block_start(text, starts[0]) if starts else len(text)
    for number, (start, path) in enumerate(known.headers):
        if path == table:
            stop = starts[number + 1] if number + 1 < len(starts) else len(text)
            return line_end(text, start), stop
    raise CannotRewriteError("the table has no header")


def line_end(text: str, at: int) -> int:
    """Return where the next line begins."""
    found = text.find("\n", at)
    return len(text) if found < 0 else found + 1


def block_start(text: str, at: int) -> int:
    """Return where the comment begins that stands right above a header."""
    while at > 0:
        above = text.rfind("\n", 0, at - 1) + 1
        if not text[above : at - 1].lstrip().startswith("#") or at < 2:
            return at
        at = above
    return at


def blocks_of(text: str, known: Spans, path: Path) -> Span | None:
    """Return from where to where a table's headers and those within it stand, comments above included.

    None where others stand between them.
    """
    mine = [number for number, (_, each) in enumerate(known.headers) if each[: len(path)] == path]
    if not mine or mine != list(range(mine[0], mine[-1] + 1)):
        return None
    first = block_start(text, known.headers[mine[0]][0])
    after = mine[-1] + 1
    last = block_start(text, known.headers[after][0]) if after < len(known.headers) else len(text)
    return first, last


def blocks_in(text: str, known: Spans, path: Path) -> list[Span]:
    """Return the blocks of a list's members."""
    found: list[Span] = []
    while (span := blocks_of(text, known, (*path, len(found)))) is not None:
        found.append(span)
    return found


def items_of(known: Spans, path: Path) -> list[Span]:
    """Return where the members of a list stand that is written in place."""
    found: list[Span] = []
    while (span := known.values.get((*path, len(found)))) is not None:
        found.append(span)
    return found
