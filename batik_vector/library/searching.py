"""What is listed and found: one question to SQLite, whatever is asked together."""

from __future__ import annotations

import sqlite3
from collections.abc import Mapping, Sequence
from math import sqrt
from typing import NamedTuple

from batik_vector.library import features, text
from batik_vector.library.features import Value


class Entry(NamedTuple):
    """A pattern as it is listed: its name, and its newest version."""

    name: str
    title: str
    version: int
    saved: str
    included: bool
    tags: tuple[str, ...]


class Hit(NamedTuple):
    """A pattern that was found, with its features in the order of ``FEATURES``.

    ``distance`` is from what it was to be like, see :mod:`batik_vector.library.features`.
    """

    name: str
    title: str
    version: int
    saved: str
    included: bool
    tags: tuple[str, ...]
    values: tuple[Value, ...]
    distance: float | None

    @property
    def features(self) -> dict[str, Value]:
        """The features by name."""
        return dict(zip(features.FEATURES, self.values, strict=True))


_HEAD = "p.id, p.name, v.title, v.number, v.saved, p.included"
_FROM = "FROM patterns p JOIN versions v ON v.id = p.head"


def _tagged(tags: Sequence[str]) -> tuple[list[str], list[Value]]:
    return ["p.id IN (SELECT pattern FROM tags WHERE tag = ?)"] * len(tags), list(tags)


def _tags(connection: sqlite3.Connection, ids: Sequence[int]) -> dict[int, tuple[str, ...]]:
    """Return the tags of patterns, of all at once where there are many."""
    few = len(ids) <= 500
    which = f"WHERE pattern IN ({', '.join('?' * len(ids))})" if few else ""
    found: dict[int, tuple[str, ...]] = {}
    for pattern, tag in connection.execute(
        f"SELECT pattern, tag FROM tags {which}", ids if few else ()
    ).fetchall():
        found[pattern] = found[pattern] + (tag,) if pattern in found else (tag,)
    return found


def _root(square: float | None) -> float | None:
    return None if square is None else sqrt(square)


def listed(
    connection: sqlite3.Connection, tags: Sequence[str], own: bool, removed: bool, limit: int | None
) -> list[Entry]:
    """Return what is listed; see :meth:`Library.entries`."""
    parts, values = _tagged(tags)
    parts.append("p.removed IS NOT NULL AND NOT p.included" if removed else "p.removed IS NULL")
    parts += ["NOT p.included"] if own else []
    asked = f"SELECT {_HEAD} {_FROM} WHERE {' AND '.join(parts)} ORDER BY p.key LIMIT ?"
    rows = connection.execute(asked, [*values, -1 if limit is None else limit]).fetchall()
    tagged = _tags(connection, [row[0] for row in rows])
    return [
        Entry(name, title, number, saved, included == 1, tagged.get(pattern, ()))
        for pattern, name, title, number, saved, included in rows
    ]


def found(
    connection: sqlite3.Connection,
    query: str,
    tags: Sequence[str],
    where: str,
    reference: Mapping[str, Value] | None,
    own: bool,
    limit: int | None,
) -> list[Hit]:
    """Return what is found; see :meth:`Library.search`."""
    parts, values = _tagged(tags)
    parts.append("p.removed IS NULL")
    parts += ["NOT p.included"] if own else []
    for condition, more in (text.condition(query), features.condition(where)):
        if condition:
            parts.append(condition)
            values += more
    order, first, measured = "p.key", "NULL", ", ".join(f"m.{name}" for name in features.FEATURES)
    before: list[Value] = []
    if reference is not None:
        first, before = features.distance(reference)
        order = "distance, p.key"
    elif words := text.terms(query):
        # Whose name has the words comes before whose recipe has them, and first whose name has little else.
        order = f"{' + '.join(['(instr(p.key, ?) = 0)'] * len(words))}, length(p.key), p.key"
        values += words
    asked = (
        f"SELECT {_HEAD}, {first} AS distance, {measured} {_FROM} JOIN measures m ON m.version = v.id "
        f"{'JOIN coordinates c ON c.version = v.id ' if reference is not None else ''}"
        f"WHERE {' AND '.join(parts)} ORDER BY {order} LIMIT ?"
    )
    rows = connection.execute(asked, [*before, *values, -1 if limit is None else limit]).fetchall()
    tagged = _tags(connection, [row[0] for row in rows])
    return [
        Hit._make((*row[1:5], row[5] == 1, tagged.get(row[0], ()), row[7:], _root(row[6]))) for row in rows
    ]
