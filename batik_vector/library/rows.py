"""Rows: what the library reads from its tables, and writes into them within a transaction."""

from __future__ import annotations

import hashlib
import json
import re
import sqlite3
import zlib
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from batik_vector import __version__
from batik_vector.library.features import FEATURES, Value, coordinates
from batik_vector.library.names import folded
from batik_vector.library.text import searched
from batik_vector.library.values import Details, Note, Page, Saved, Version

if TYPE_CHECKING:
    from batik_vector.library.measuring import Measured

Connection = sqlite3.Connection
_KIND = re.compile(r"^\s*kind\s*=\s*\"([\w-]+)\"", re.MULTILINE)
_SELECT = (
    "SELECT v.id, p.name, v.number, v.title, v.saved, v.origin, v.program, t.text "
    "FROM versions v JOIN patterns p ON p.id = v.pattern JOIN texts t ON t.digest = v.recipe "
)


def fact(connection: Connection, name: str) -> str:
    """Return a fact about the library, or nothing."""
    row = connection.execute("SELECT value FROM facts WHERE name = ?", (name,)).fetchone()
    return str(row[0]) if row else ""


def set_fact(connection: Connection, name: str, value: str) -> None:
    """Keep a fact about the library."""
    connection.execute("INSERT OR REPLACE INTO facts VALUES (?, ?)", (name, value))


# Patterns.


def pattern(connection: Connection, key: str, removed: bool = False) -> int:
    """Return the number of a pattern, of one that was removed if that is asked, too; or else 0."""
    which = "" if removed else "AND removed IS NULL"
    row = connection.execute(f"SELECT id FROM patterns WHERE key = ? {which}", (key,)).fetchone()
    return int(row[0]) if row else 0


def is_included(connection: Connection, pattern: int) -> bool:
    """Whether a pattern is a sample or a starter."""
    row = connection.execute("SELECT included FROM patterns WHERE id = ?", (pattern,)).fetchone()
    return bool(row[0])


def included_keys(connection: Connection) -> list[tuple[str, int]]:
    """Return the keys and numbers of samples and starters, removed ones too."""
    return connection.execute("SELECT key, id FROM patterns WHERE included").fetchall()


def set_removed(connection: Connection, pattern: int, time: str | None) -> None:
    """Note when a pattern was removed, or that it is there."""
    connection.execute("UPDATE patterns SET removed = ? WHERE id = ?", (time, pattern))


def delete(connection: Connection, pattern: int) -> None:
    """Delete a pattern with all its versions, and the texts that no other has."""
    connection.execute("DELETE FROM words WHERE rowid = ?", (pattern,))
    connection.execute("UPDATE patterns SET head = NULL WHERE id = ?", (pattern,))
    connection.execute("DELETE FROM patterns WHERE id = ?", (pattern,))
    connection.execute(
        "DELETE FROM texts WHERE NOT EXISTS (SELECT 1 FROM versions WHERE recipe = texts.digest) "
        "AND NOT EXISTS (SELECT 1 FROM drawings WHERE drawings.digest = texts.digest)"
    )


# Versions.


def save(
    connection: Connection,
    name: str,
    page: Page,
    time: str,
    origin: str,
    features: Mapping[str, Any],
    included: bool = False,
) -> Saved:
    """Save a recipe as the newest version of a pattern, unless the newest says the same."""
    key = folded(name)
    mine = pattern(connection, key, removed=True)
    before = version(connection, mine, None) if mine else None
    if before and before.text == page.text and dict(before.drawings) == dict(page.drawings):
        set_removed(connection, mine, None)
        if included:
            set_features(connection, before.id, features)
            index(connection, mine)
        return Saved(before.id, before.name, before.number, False)
    if not mine:
        made = connection.execute(
            "INSERT INTO patterns (key, name, included) VALUES (?, ?, ?)", (key, name, included)
        )
        mine = int(made.lastrowid or 0)
    number = last_number(connection, mine) + 1
    fresh = _insert(connection, mine, number, page, (time, origin, __version__))
    set_features(connection, fresh, features)
    connection.execute("UPDATE patterns SET head = ?, removed = NULL WHERE id = ?", (fresh, mine))
    index(connection, mine)
    return Saved(fresh, before.name if before else name, number, True)


def copy(connection: Connection, old: Version, number: int, time: str, program: str) -> Saved:
    """Save an old version once more, as the newest, with all that was measured of it."""
    (mine,) = connection.execute("SELECT pattern FROM versions WHERE id = ?", (old.id,)).fetchone()
    page = Page(old.title, old.text, old.drawings)
    fresh = _insert(connection, mine, number, page, (time, f"version {old.number}", program))
    for table in ("measures", "coordinates", "details"):
        names = ", ".join(
            row[1] for row in connection.execute(f"PRAGMA table_info({table})") if row[1] != "version"
        )
        connection.execute(
            f"INSERT INTO {table} (version, {names}) SELECT ?, {names} FROM {table} WHERE version = ?",
            (fresh, old.id),
        )
    connection.execute("UPDATE patterns SET head = ? WHERE id = ?", (fresh, mine))
    return Saved(fresh, old.name, number, True)


def _insert(
    connection: Connection,
    pattern: int,
    number: int,
    page: Page,
    about: tuple[str, str, str],
) -> int:
    """Enter a version; ``about`` is its time, its origin and the program's version."""
    made = connection.execute(
        "INSERT INTO versions (pattern, number, recipe, title, saved, origin, program) "
        "VALUES (?, ?, ?, ?, ?, ?, ?)",
        (pattern, number, _kept(connection, page.text), page.title, *about),
    )
    fresh = int(made.lastrowid or 0)
    connection.executemany(
        "INSERT INTO drawings VALUES (?, ?, ?)",
        [(fresh, file, _kept(connection, drawn)) for file, drawn in page.drawings.items()],
    )
    return fresh


def _kept(connection: Connection, text: str) -> str:
    """Keep a text once; return its digest."""
    digest = digest_of(text)
    connection.execute("INSERT OR IGNORE INTO texts VALUES (?, ?)", (digest, text))
    return digest


def digest_of(text: str) -> str:
    """Return the SHA-256 of a text in UTF-8."""
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def version(connection: Connection, pattern: int, number: int | None) -> Version | None:
    """Return a version of a pattern, or its newest."""
    if number is None:
        row = connection.execute(f"{_SELECT} WHERE v.id = p.head AND p.id = ?", (pattern,)).fetchone()
    else:
        row = connection.execute(
            f"{_SELECT} WHERE v.pattern = ? AND v.number = ?", (pattern, number)
        ).fetchone()
    return Version._make((*row, _drawings(connection, row[0]))) if row else None


def versions(connection: Connection, pattern: int) -> list[Version]:
    """Return all versions of a pattern, the oldest first."""
    rows = connection.execute(f"{_SELECT} WHERE v.pattern = ? ORDER BY v.number", (pattern,)).fetchall()
    return [Version._make((*row, _drawings(connection, row[0]))) for row in rows]


def last_number(connection: Connection, pattern: int) -> int:
    """Return the number of the last version that was saved; 0 where none was."""
    row = connection.execute("SELECT max(number) FROM versions WHERE pattern = ?", (pattern,)).fetchone()
    return int(row[0] or 0)


def _drawings(connection: Connection, version: int) -> dict[str, str]:
    found = connection.execute(
        "SELECT d.file, t.text FROM drawings d JOIN texts t ON t.digest = d.digest "
        "WHERE d.version = ? ORDER BY d.file",
        (version,),
    )
    return dict(found.fetchall())


# What is known of a version.


def set_features(connection: Connection, version: int, features: Mapping[str, Any]) -> None:
    """Keep the features of a version: all of them, and those that are searched in columns of their own."""
    known = {name: features.get(name) for name in FEATURES}
    places = coordinates(known)
    for table, values in (("measures", known), ("coordinates", places)):
        marks = ", ".join("?" * len(values))
        connection.execute(
            f"INSERT OR REPLACE INTO {table} (version, {', '.join(values)}) VALUES (?, {marks})",
            (version, *values.values()),
        )
    told = json.dumps(dict(features), ensure_ascii=False, sort_keys=True)
    connection.execute(
        "INSERT INTO details (version, features) VALUES (?, ?) "
        "ON CONFLICT (version) DO UPDATE SET features = excluded.features",
        (version, told),
    )


def set_details(connection: Connection, version: int, measured: Measured) -> None:
    """Keep the pictures of a version."""
    packed = zlib.compress(measured.svg, 6) if measured.svg else None
    connection.execute(
        "UPDATE details SET svg = ?, png = ? WHERE version = ?", (packed, measured.png or None, version)
    )


def measures(connection: Connection, version: int) -> dict[str, Value]:
    """Return the features of a version that are searched."""
    asked = f"SELECT {', '.join(FEATURES)} FROM measures WHERE version = ?"
    row = connection.execute(asked, (version,)).fetchone()
    return dict(zip(FEATURES, row, strict=True)) if row else {}


def details(connection: Connection, version: int) -> Details:
    """Return what there is about a version besides its recipe."""
    (mine,) = connection.execute("SELECT pattern FROM versions WHERE id = ?", (version,)).fetchone()
    row = connection.execute(
        "SELECT features, svg, png FROM details WHERE version = ?", (version,)
    ).fetchone()
    features, svg, png = row or ("{}", None, None)
    return Details(
        tags(connection, mine),
        tuple(notes(connection, mine)),
        json.loads(features),
        zlib.decompress(svg) if svg else b"",
        bytes(png) if png else b"",
    )


# Tags, notes, and the index of words.


def tags(connection: Connection, pattern: int) -> tuple[str, ...]:
    """Return the tags of a pattern."""
    found = connection.execute("SELECT tag FROM tags WHERE pattern = ? ORDER BY tag", (pattern,))
    return tuple(row[0] for row in found)


def add_tags(connection: Connection, pattern: int, tags: Sequence[str]) -> None:
    """Give a pattern tags."""
    connection.executemany("INSERT OR IGNORE INTO tags VALUES (?, ?)", [(pattern, tag) for tag in tags])


def remove_tags(connection: Connection, pattern: int, tags: Sequence[str]) -> None:
    """Take tags from a pattern."""
    connection.executemany("DELETE FROM tags WHERE pattern = ? AND tag = ?", [(pattern, tag) for tag in tags])


def notes(connection: Connection, pattern: int) -> list[Note]:
    """Return the notes of a pattern, the oldest first."""
    found = connection.execute("SELECT written, text FROM notes WHERE pattern = ? ORDER BY id", (pattern,))
    return [Note(*row) for row in found]


def add_note(connection: Connection, pattern: int, time: str, text: str) -> None:
    """Add a note to a pattern."""
    connection.execute("INSERT INTO notes (pattern, written, text) VALUES (?, ?, ?)", (pattern, time, text))


def index(connection: Connection, pattern: int) -> None:
    """Bring what the index of words holds of a pattern up to date."""
    connection.execute("DELETE FROM words WHERE rowid = ?", (pattern,))
    connection.execute("INSERT INTO words (rowid, text) VALUES (?, ?)", (pattern, words(connection, pattern)))


def words(connection: Connection, pattern: int) -> str:
    """Return what a pattern is found by: name, title, tags, notes, and what its recipe says of itself."""
    newest = version(connection, pattern, None)
    if newest is None:
        return ""
    said = [note.text for note in notes(connection, pattern)]
    return searched(
        newest.name,
        newest.title,
        *tags(connection, pattern),
        *said,
        story(newest.text),
        *_KIND.findall(newest.text),
    )


def story(recipe: str) -> str:
    """Return the comment that a recipe begins with."""
    lines = []
    for line in recipe.splitlines():
        if not line.startswith("#"):
            break
        lines.append(line.removeprefix("#").strip())
    return " ".join(lines)


# The library as a whole.


def counts(connection: Connection) -> tuple[int, ...]:
    """Return how many own patterns, included ones, removed ones, versions, tags and notes there are."""
    asked = (
        "SELECT count(*) FROM patterns WHERE removed IS NULL AND NOT included",
        "SELECT count(*) FROM patterns WHERE removed IS NULL AND included",
        "SELECT count(*) FROM patterns WHERE removed IS NOT NULL AND NOT included",
        "SELECT count(*) FROM versions",
        "SELECT count(DISTINCT tag) FROM tags",
        "SELECT count(*) FROM notes",
    )
    return tuple(connection.execute(each).fetchone()[0] for each in asked)


def unmeasured(connection: Connection) -> list[str]:
    """Return the names of patterns whose newest version lacks features that are measured today."""
    asked = (
        "SELECT p.name FROM patterns p JOIN measures m ON m.version = p.head "
        "WHERE p.removed IS NULL AND (m.width IS NULL OR m.nodes IS NULL AND m.repeat IS NOT NULL) "
        "ORDER BY p.key"
    )
    return [row[0] for row in connection.execute(asked)]


def faults(connection: Connection) -> list[str]:
    """Return what is wrong with the library, in words."""
    return [*_of_the_file(connection), *_of_texts(connection), *_of_patterns(connection)]


def _of_the_file(connection: Connection) -> Iterator[str]:
    for (words,) in connection.execute("PRAGMA integrity_check"):
        if words != "ok":
            yield f"the file is damaged: {words}"
    for table, row, other, _ in connection.execute("PRAGMA foreign_key_check"):
        yield f"row {row} of {table} belongs to a row of {other} that is not there"


def _of_texts(connection: Connection) -> Iterator[str]:
    for digest, text in connection.execute("SELECT digest, text FROM texts"):
        if digest_of(text) != digest:
            yield f"a text is not what was saved: {digest}"


def _of_patterns(connection: Connection) -> Iterator[str]:
    asked = (
        "SELECT p.id, p.name, p.head, "
        "(SELECT id FROM versions WHERE pattern = p.id ORDER BY number DESC LIMIT 1), "
        "(SELECT count(*) FROM versions WHERE pattern = p.id), "
        "(SELECT max(number) FROM versions WHERE pattern = p.id), "
        "(SELECT text FROM words WHERE rowid = p.id) FROM patterns p ORDER BY p.key"
    )
    for mine, name, head, newest, count, last, text in connection.execute(asked).fetchall():
        if head is None or head != newest:
            yield f'"{name}": its newest version is not the one that is shown'
        elif count != last:
            yield f'"{name}": has {count} versions, and the last is number {last}'
        elif text != words(connection, mine):
            yield f'"{name}": the index of words is out of date'
