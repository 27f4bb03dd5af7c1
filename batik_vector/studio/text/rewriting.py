"""Changes of a recipe's text that leave alone what they do not change: comments, order, spelling.

Values are exchanged where they stand, keys and tables put in and taken out around them. Every change is read
again and compared with what it was to say; where the text is written in a way that cannot be mended in place
(a table in dotted keys, say) the document is written anew, and says the same.
"""

from __future__ import annotations

import copy
import re
import tomllib
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from batik_vector.recipe.reading.lines import spans
from batik_vector.recipe.references import Path
from batik_vector.studio.text.places import (
    CannotRewriteError as CannotRewriteError,
)
from batik_vector.studio.text.places import (
    Span,
    block_start,
    blocks_in,
    blocks_of,
    items_of,
    line_end,
    own_lines,
)
from batik_vector.studio.text.spelling import spelled, spelled_key

_WIDE = 118
"""Characters of a line past which a table is written with its keys on lines of their own."""


def with_value(text: str, path: Path, value: Any) -> str:
    """Return a text that says a value at a path; tables that are missing are made.

    Raises:
        CannotRewriteError: where the path leads into what is no table, or past the end of a list.
    """
    tables = tomllib.loads(text)
    if path in (known := spans(text).values):
        start, end = known[path]
        _set(tables, path, value)
        return _first([lambda: text[:start] + spelled(value) + text[end:]], tables)
    depth = _known_depth(tables, path)
    around, rest = path[:depth], path[depth:]
    if not rest:
        # A table under headers: what it said goes, and the value comes in its place.
        _set(tables, path, value)
        return _first([lambda: with_value(without(text, path), path, value)], tables)
    keys = [part for part in rest if isinstance(part, str)]
    if len(keys) < len(rest) or not isinstance(_at(tables, around), dict):
        raise CannotRewriteError("there is no such place in the list")
    _set(tables, path, value)
    held: Any = value
    for part in reversed(keys[1:]):
        held = {part: held}
    key = keys[0]
    ways = [lambda: _added(text, around, key, held), lambda: _headed(text, (*around, key), held)]
    return _first(ways, tables)


def exchanged(
    text: str, tables: dict[str, Any], values: Mapping[Path, Any]
) -> tuple[str, dict[str, Any]] | None:
    """Return a text that says other values where it says some, all at once, and the tables that it then says.

    Args:
        text: the recipe.
        tables: what it says; not changed.
        values: by their paths: numbers and words.

    Returns:
        None where some of them stand nowhere in the text as they are, or there is a list or a table.
    """
    known = spans(text).values
    if any(path not in known or isinstance(_at(tables, path), dict | list) for path in values):
        return None
    written = text
    for start, end, word in sorted(
        ((*known[path], spelled(value)) for path, value in values.items()), reverse=True
    ):
        written = written[:start] + word + written[end:]
    try:
        said = tomllib.loads(written)
    except tomllib.TOMLDecodeError:
        return None
    # But for these values it says what it said.
    whole = True
    for path, value in values.items():
        whole = whole and _at(said, path) == value
        _at(said, path[:-1])[path[-1]] = _at(tables, path)
    whole = whole and said == tables
    for path, value in values.items():
        _at(said, path[:-1])[path[-1]] = value
    return (written, said) if whole else None


def with_table(text: str, path: Path, value: dict[str, Any], written: str = "") -> str:
    """Return a text with another table under a header, behind its like.

    Args:
        text: the recipe.
        path: of the table, which is not there.
        value: what it says.
        written: how it is written, header and all, where that is known.

    Raises:
        CannotRewriteError: where the path leads into what is no table.
    """
    tables = tomllib.loads(text)
    _known_depth(tables, path)
    _set(tables, path, value)
    ways = [lambda: _headed(text, path, value, written)] if written else []
    return _first([*ways, lambda: with_value(text, path, value)], tables)


def without(text: str, path: Path) -> str:
    """Return a text without what stands at a path.

    Raises:
        CannotRewriteError: where nothing stands there.
    """
    tables = tomllib.loads(text)
    around = _at(tables, path[:-1])
    if not _has(around, path[-1]):
        raise CannotRewriteError("nothing stands there")
    del around[path[-1]]
    # The header of the only motif is all that says that there are motifs.
    bare = copy.deepcopy(tables)
    for depth in range(len(path) - 1, 0, -1):
        if _at(bare, path[:depth]) in ({}, []) and isinstance(path[depth - 1], str):
            del _at(bare, path[: depth - 1])[path[depth - 1]]
    return _first([lambda: _cut_out(text, path)], tables, or_else=bare)


def inserted(text: str, path: Path, value: Any, index: int | None = None, written: str = "") -> str:
    """Return a text with another member of a list, which is made where it is missing.

    Args:
        text: the recipe.
        path: of the list.
        value: of the member.
        index: its place; the end when left out.
        written: how the member is written, where that is known: a block with its header, or a value in place.

    Raises:
        CannotRewriteError: where no list stands there.
    """
    tables = tomllib.loads(text)
    depth = _known_depth(tables, path)
    if depth < len(path):
        if len(path) == 1 and isinstance(value, dict):
            _set(tables, path, [value])
            return _first([lambda: _block_at(text, len(text), written or _block(path, value, True))], tables)
        return with_value(text, path, [value])
    members = _at(tables, path)
    if not isinstance(members, list):
        raise CannotRewriteError("no list stands there")
    place = len(members) if index is None else max(0, min(index, len(members)))
    members.insert(place, copy.deepcopy(value))
    ways = [lambda: _inserted_in_place(text, path, place, written or spelled(value))]
    if not members[1:] or path not in spans(text).values:
        block = written if written.lstrip().startswith(("[", "#")) else _block(path, value, True)
        ways = [lambda: _inserted_block(text, path, place, block)]
    return _first(ways, tables)


def moved(text: str, path: Path, to: int) -> str:
    """Return a text with a member of a list, or a table of tables by name, at another place among them.

    Raises:
        CannotRewriteError: where nothing stands there.
    """
    tables = tomllib.loads(text)
    around, key = _at(tables, path[:-1]), path[-1]
    if not _has(around, key):
        raise CannotRewriteError("nothing stands there")
    names: list[Any] = list(range(len(around))) if isinstance(around, list) else list(around)
    order = [name for name in names if name != key]
    order.insert(max(0, min(to, len(order))), key)
    if isinstance(around, list):
        around[:] = [around[name] for name in order]
    else:
        held = {name: around.pop(name) for name in order}
        around.update(held)
    return _first([lambda: _permuted(text, path[:-1], names, order)], tables, path[:-1])


def member_text(text: str, path: Path) -> str:
    """Return how a member of a list, or a table by name, is written: a block, or a value in place."""
    known = spans(text)
    if path in known.values:
        start, end = known.values[path]
        return text[start:end]
    blocks = blocks_of(text, known, path)
    return text[blocks[0] : blocks[1]].strip("\n") + "\n" if blocks else ""


def _first(
    ways: Sequence[Callable[[], str]],
    tables: dict[str, Any],
    ordered: Path | None = None,
    or_else: dict[str, Any] | None = None,
) -> str:
    """Return what the first way writes that says what is meant, or what will do; in the end the tables alone.

    Args:
        ways: that may fail, or write what says something else.
        tables: what is meant.
        ordered: the path of a table whose order is meant too.
        or_else: what will do.
    """
    import tomlkit

    for way in ways:
        try:
            written = way()
            said = tomllib.loads(written)
        except (ValueError, LookupError, TypeError):
            continue
        if said in (tables, or_else) and (
            ordered is None or _order(said, ordered) == _order(tables, ordered)
        ):
            return written
    return tomlkit.dumps(tables)


def _order(tables: Any, path: Path) -> list[Any]:
    held = _at(tables, path)
    return list(held) if isinstance(held, dict) else []


def _at(tables: Any, path: Path) -> Any:
    for part in path:
        if not _has(tables, part):
            raise CannotRewriteError("nothing stands there")
        tables = tables[part]
    return tables


def _has(node: Any, part: str | int) -> bool:
    if isinstance(node, list):
        return isinstance(part, int) and 0 <= part < len(node)
    return isinstance(node, dict) and part in node


def _known_depth(tables: Any, path: Path) -> int:
    """Return how much of a path is there."""
    for depth, part in enumerate(path):
        if not _has(tables, part):
            if not isinstance(tables, dict | list):
                raise CannotRewriteError("leads into what is no table")
            return depth
        tables = tables[part]
    return len(path)


def _set(tables: Any, path: Path, value: Any) -> None:
    for part in path[:-1]:
        tables = tables.setdefault(str(part), {}) if isinstance(tables, dict) else tables[part]
    tables[path[-1]] = copy.deepcopy(value)


# Keys into tables.


def _added(text: str, around: Path, key: str, value: Any) -> str:
    """Return the text with another key in a table that is written in place or has a header."""
    known = spans(text)
    pair = f"{spelled_key(key)} = {spelled(value)}"
    if around in known.values:
        start, end = known.values[around]
        if text[start] != "{":
            raise CannotRewriteError("no table stands there")
        inner = text[start + 1 : end - 1].rstrip()
        return f"{text[:start]}{{{inner}{', ' if inner.strip() else ' '}{pair} }}{text[end:]}"
    begin, stop = own_lines(text, known, around)
    if not around and isinstance(value, dict):
        raise CannotRewriteError("tables of the root have headers")
    ends = [end for start, end in known.values.values() if begin <= start < stop]
    if not ends:
        return _line_in(text, begin, pair)
    last = max(ends)
    mine = [start for path, start in known.starts.items() if len(path) == len(around) + 1]
    lines = [text[start:last].partition("\n")[0] for start in mine if begin <= start < stop]
    return _line_in(text, line_end(text, last), _aligned(key, pair, lines))


def _aligned(key: str, pair: str, lines: Sequence[str]) -> str:
    """Return ``key = value`` with its sign under those of other lines, where these stand in one column."""
    columns = {len(line.partition("=")[0]) for line in lines}
    name = spelled_key(key)
    column = columns.pop() if len(columns) == 1 and len(lines) > 1 else 0
    return name.ljust(column - 1) + pair[len(name) :] if column > len(name) else pair


def _line_in(text: str, at: int, line: str) -> str:
    before = text[:at] if not at or text[at - 1 : at] == "\n" else text[:at] + "\n"
    return f"{before}{line}\n{text[at:]}"


# Tables with headers.


def _headed(text: str, path: Path, value: Any, written: str = "") -> str:
    """Return the text with a table under a header of its own, behind those of its kind."""
    if not isinstance(value, dict):
        raise CannotRewriteError("a table is expected to have a header")
    known = spans(text)
    alike = [place for place, (_, at) in enumerate(known.headers) if at[: len(path) - 1] == path[:-1]]
    at = len(text)
    if len(path) > 1 and alike and alike[-1] + 1 < len(known.headers):
        at = block_start(text, known.headers[alike[-1] + 1][0])
    return _block_at(text, at, written or _block(path, value, False))


def _block(path: Path, value: dict[str, Any], double: bool) -> str:
    names = ".".join(spelled_key(part) for part in path if isinstance(part, str))
    header = f"[[{names}]]" if double else f"[{names}]"
    room = max((len(spelled_key(key)) for key in value), default=0)
    lines = [f"{spelled_key(key):<{room}} = {_in_lines(each)}" for key, each in value.items()]
    return "\n".join([header, *lines]) + "\n"


def _in_lines(value: Any) -> str:
    """Return a value on one line; a long list of tables on several."""
    line = spelled(value)
    if len(line) <= _WIDE or not isinstance(value, list | tuple):
        return line
    return "[\n" + "".join(f"  {spelled(each)},\n" for each in value) + "]"


def _block_at(text: str, at: int, block: str) -> str:
    """Return the text with a block put in, an empty line on both sides."""
    before, after = text[:at].rstrip("\n"), text[at:].lstrip("\n")
    parts = [part for part in (before, block.strip("\n"), after.rstrip("\n")) if part]
    return "\n\n".join(parts) + "\n"


def _inserted_block(text: str, path: Path, place: int, block: str) -> str:
    known = spans(text)
    blocks = blocks_in(text, known, path)
    if place < len(blocks):
        return _block_at(text, blocks[place][0], block)
    return _block_at(text, blocks[-1][1] if blocks else len(text), block)


# Members of what is written in place.


def _inserted_in_place(text: str, path: Path, place: int, written: str) -> str:
    known = spans(text)
    start, end = known.values[path]
    items = items_of(known, path)
    if not items:
        return f"{text[:start]}[{written}]{text[end:]}"
    first = items[0][0]
    # The line of its own, where the first has one.
    line = text.rfind("\n", start, first)
    gap = text[line:first] if line >= 0 and not text[line:first].strip() else " "
    if place < len(items):
        at = items[place][0]
        return f"{text[:at]}{written},{gap}{text[at:]}"
    at = items[-1][1]
    return f"{text[:at]},{gap}{written}{text[at:]}"


def _cut_out(text: str, path: Path) -> str:
    """Return the text without a key, a member or a block."""
    known = spans(text)
    if path not in known.values:
        blocks = blocks_of(text, known, path)
        if blocks is None:
            raise CannotRewriteError("it stands in several places")
        return text[: blocks[0]] + text[blocks[1] :]
    end = known.values[path][1]
    around = path[:-1]
    if around in known.values:
        start = known.starts[path]
        return _cut_from(text, known.values[around], start, end)
    start = text.rfind("\n", 0, known.starts[path]) + 1
    return text[:start] + text[line_end(text, end) :]


def _cut_from(text: str, around: Span, start: int, end: int) -> str:
    """Return the text without a member of what is written in place, and without its comma."""
    line, stop = text.rfind("\n", 0, start) + 1, line_end(text, end)
    rest = text[end:stop]
    alone = line > around[0] and not text[line:start].strip() and stop <= around[1]
    if alone and re.fullmatch(r"\s*,?\s*(#[^\n]*)?\n", rest):
        return text[:line] + text[stop:]
    behind = re.match(r"\s*,[ \t]*", text[end : around[1]])
    if behind is not None:
        return text[:start] + text[end + behind.end() :]
    before = re.search(r",\s*\Z", text[around[0] : start])
    return text[: around[0] + before.start()] + text[end:] if before else text[:start] + text[end:]


def _permuted(text: str, path: Path, names: Sequence[Any], order: Sequence[Any]) -> str:
    """Return the text with the members of a list or a table in another order, each written as it was."""
    known = spans(text)
    slots: list[Span] = []
    for name in names:
        member = (*path, name)
        if member in known.values:
            slots.append((known.starts[member], known.values[member][1]))
        elif (span := blocks_of(text, known, member)) is not None:
            slots.append((span[0], span[0] + len(text[span[0] : span[1]].rstrip())))
        else:
            raise CannotRewriteError("it stands in several places")
    held = {name: text[start:end] for name, (start, end) in zip(names, slots, strict=True)}
    for (start, end), name in sorted(zip(slots, order, strict=True), key=lambda each: -each[0][0]):
        text = text[:start] + held[name] + text[end:]
    return text
