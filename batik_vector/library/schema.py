"""The library's file: opened, made, and brought from one version of its schema to the next.

Each migration is a step of its own, and stands here for good: a library of any age is brought up step by
step, in one transaction, after a copy of it was laid beside it. A file of a newer schema is left alone.
"""

from __future__ import annotations

import contextlib
import os
import sqlite3
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from batik_vector import LibraryError

APPLICATION = 0x62746B6C
"""Marks an SQLite file as a library of ours (``PRAGMA application_id``): btkl."""
PATIENCE = 20.0
"""Seconds for which another writer is waited for."""
MAGIC = b"SQLite format 3\0"

_FIRST = """
CREATE TABLE patterns (
    id INTEGER PRIMARY KEY,
    key TEXT NOT NULL UNIQUE,
    name TEXT NOT NULL,
    included INTEGER NOT NULL DEFAULT 0,
    removed TEXT,
    head INTEGER REFERENCES versions (id) DEFERRABLE INITIALLY DEFERRED
);
CREATE TABLE texts (
    digest TEXT PRIMARY KEY,
    text TEXT NOT NULL
);
CREATE TABLE versions (
    id INTEGER PRIMARY KEY,
    pattern INTEGER NOT NULL REFERENCES patterns (id) ON DELETE CASCADE,
    number INTEGER NOT NULL,
    recipe TEXT NOT NULL REFERENCES texts (digest),
    title TEXT NOT NULL,
    saved TEXT NOT NULL,
    origin TEXT NOT NULL,
    program TEXT NOT NULL,
    UNIQUE (pattern, number)
);
CREATE INDEX versions_recipe ON versions (recipe);
CREATE TABLE drawings (
    version INTEGER NOT NULL REFERENCES versions (id) ON DELETE CASCADE,
    file TEXT NOT NULL,
    digest TEXT NOT NULL REFERENCES texts (digest),
    PRIMARY KEY (version, file)
) WITHOUT ROWID;
CREATE INDEX drawings_digest ON drawings (digest);
CREATE TABLE measures (
    version INTEGER PRIMARY KEY REFERENCES versions (id) ON DELETE CASCADE,
    width REAL, height REAL, inks INTEGER, coverage REAL, vertices INTEGER, marks INTEGER, motifs INTEGER,
    repeat TEXT
);
CREATE TABLE coordinates (
    version INTEGER PRIMARY KEY REFERENCES versions (id) ON DELETE CASCADE,
    width REAL, height REAL, inks REAL, coverage REAL, vertices REAL, marks REAL, motifs REAL
);
CREATE TABLE details (
    version INTEGER PRIMARY KEY REFERENCES versions (id) ON DELETE CASCADE,
    features TEXT NOT NULL,
    svg BLOB,
    png BLOB
);
CREATE TABLE tags (
    pattern INTEGER NOT NULL REFERENCES patterns (id) ON DELETE CASCADE,
    tag TEXT NOT NULL,
    PRIMARY KEY (pattern, tag)
) WITHOUT ROWID;
CREATE INDEX tags_tag ON tags (tag, pattern);
CREATE TABLE notes (
    id INTEGER PRIMARY KEY,
    pattern INTEGER NOT NULL REFERENCES patterns (id) ON DELETE CASCADE,
    written TEXT NOT NULL,
    text TEXT NOT NULL
);
CREATE INDEX notes_pattern ON notes (pattern);
CREATE TABLE facts (
    name TEXT PRIMARY KEY,
    value TEXT NOT NULL
);
CREATE VIRTUAL TABLE words USING fts5 (text, tokenize = 'trigram case_sensitive 1');
"""
"""Patterns with their versions. Recipes and drawings are kept once each, by their SHA-256. ``head`` is the
newest version; ``measures`` and ``coordinates`` are the features that are searched, raw and on the scales of
likeness; ``details`` is all that was measured as JSON, and the pictures, the SVG's packed by zlib."""

_ANALYSED = """
ALTER TABLE measures ADD COLUMN elements INTEGER;
ALTER TABLE measures ADD COLUMN relation TEXT;
ALTER TABLE measures ADD COLUMN symmetry INTEGER;
ALTER TABLE measures ADD COLUMN kind TEXT;
ALTER TABLE measures ADD COLUMN layers INTEGER;
ALTER TABLE measures ADD COLUMN shape TEXT;
ALTER TABLE measures ADD COLUMN petals INTEGER;
ALTER TABLE measures ADD COLUMN pistils REAL;
ALTER TABLE measures ADD COLUMN flowers INTEGER;
ALTER TABLE measures ADD COLUMN dimension REAL;
ALTER TABLE measures ADD COLUMN thinnest REAL;
ALTER TABLE measures ADD COLUMN thickest REAL;
ALTER TABLE measures ADD COLUMN nodes INTEGER;
ALTER TABLE measures ADD COLUMN "row" TEXT;
ALTER TABLE coordinates ADD COLUMN elements REAL;
ALTER TABLE coordinates ADD COLUMN symmetry REAL;
ALTER TABLE coordinates ADD COLUMN layers REAL;
ALTER TABLE coordinates ADD COLUMN petals REAL;
ALTER TABLE coordinates ADD COLUMN pistils REAL;
ALTER TABLE coordinates ADD COLUMN flowers REAL;
ALTER TABLE coordinates ADD COLUMN dimension REAL;
UPDATE coordinates SET coverage = coverage * 15, vertices = vertices * 1.5, marks = marks * 1.5;
"""
"""The features of the analyser, in columns. Coordinates are no longer divided by the unit that catches the
eye, which may then change without another schema."""

Step = str | Callable[[sqlite3.Connection], None]
MIGRATIONS: Sequence[Step] = (_FIRST, _ANALYSED)
"""The step from each version of the schema to the next, that from an empty file first."""
SCHEMA = len(MIGRATIONS)
"""The version of the schema that this program reads and writes."""


def opened(path: Path, asked: bool, write: bool) -> tuple[sqlite3.Connection, bool]:
    """Open a library, make it where it is missing, and bring it up to date.

    Args:
        path: of the file.
        asked: whether it was named: then it is not made by those that only read.
        write: whether it is to be changed.

    Returns:
        The connection, without a transaction, and whether it may be written to.

    Raises:
        LibraryError: where that cannot be, saying why; the file is as it was.
    """
    try:
        there = _looked_at(path, asked, write)
        writable = _may_write(path, there)
        connection = _connected(path, there, writable)
    except OSError as error:
        raise LibraryError(f"{path}: {error.strerror or error}") from error
    try:
        with told(path):
            _made_ready(connection, path, writable)
    except BaseException:
        connection.close()
        raise
    return connection, writable


def _looked_at(path: Path, asked: bool, write: bool) -> bool:
    """Whether there is a file, which then is one of SQLite's; folders for a new one are made."""
    if path.is_dir():
        raise LibraryError(f"{path} is a folder, expected a library's file")
    if path.exists():
        with open(path, "rb") as file:
            head = file.read(len(MAGIC))
        if head and head != MAGIC:
            raise LibraryError(f"{path} is no library: expected a file that batik-vector library made")
        return bool(head)
    if asked and not write:
        raise LibraryError(f"{path}: no such library: batik-vector library add begins one")
    if asked and not path.parent.is_dir():
        raise LibraryError(f'{path}: there is no folder "{path.parent}"')
    path.parent.mkdir(parents=True, exist_ok=True)
    return False


def _may_write(path: Path, there: bool) -> bool:
    return os.access(path, os.W_OK) and os.access(path.parent, os.W_OK) if there else True


def _connected(path: Path, there: bool, writable: bool) -> sqlite3.Connection:
    uri = path.resolve().as_uri()
    if writable:
        mode = "rw" if there else "rwc"
    else:
        # Where nobody can write, readers need no file beside it to agree by; but what a writer left counts.
        left = path.with_name(f"{path.name}-wal")
        mode = "ro" if left.exists() and left.stat().st_size else "ro&immutable=1"
    with told(path):
        return sqlite3.connect(f"{uri}?mode={mode}", timeout=PATIENCE, uri=True, isolation_level=None)


def _made_ready(connection: sqlite3.Connection, path: Path, writable: bool) -> None:
    # Not all of a file need be in memory, but what a search looks through may.
    connection.execute("PRAGMA cache_size = -65536")
    known = _version(connection, path)
    if known > SCHEMA:
        raise LibraryError(
            f"{path} was written by a newer batik-vector (its schema is {known}, this one knows {SCHEMA}): "
            "update this program, or name another file; nothing was changed"
        )
    if writable:
        _patiently(lambda: connection.execute("PRAGMA journal_mode = WAL"))
        # What was saved is saved, also where the power goes.
        connection.execute("PRAGMA synchronous = FULL")
        connection.execute("PRAGMA foreign_keys = ON")
    if known < SCHEMA:
        if not writable:
            raise LibraryError(
                f"{path} is of an older schema ({known}, not {SCHEMA}), and may not be written to"
            )
        _migrate(connection, path)


def _version(connection: sqlite3.Connection, path: Path) -> int:
    """Return the version of a file's schema: 0 of an empty one.

    Raises:
        LibraryError: where it is another program's.
    """
    with _snapshot(connection):
        (mark,) = connection.execute("PRAGMA application_id").fetchone()
        (version,) = connection.execute("PRAGMA user_version").fetchone()
        (tables,) = connection.execute("SELECT count(*) FROM sqlite_master").fetchone()
    if mark != APPLICATION and (tables or version):
        raise LibraryError(f"{path} is a database of another program, and no library")
    return int(version)


@contextlib.contextmanager
def _snapshot(connection: sqlite3.Connection) -> Iterator[None]:
    """Let all that is read inside be of one moment: another process may be making the library just now."""
    if connection.in_transaction:
        yield
        return
    connection.execute("BEGIN")
    try:
        yield
    finally:
        connection.execute("ROLLBACK")


def _patiently(work: Callable[[], object]) -> None:
    """Do what SQLite does not wait for by itself where another process does the same."""
    end = time.monotonic() + PATIENCE
    while True:
        try:
            work()
            return
        except sqlite3.OperationalError as error:
            if error.sqlite_errorcode != sqlite3.SQLITE_BUSY or time.monotonic() > end:
                raise
            time.sleep(0.02)


def _migrate(connection: sqlite3.Connection, path: Path) -> None:
    """Bring a file to the newest schema, all steps in one transaction."""
    with changing(connection):
        # Another process may have been first.
        known = _version(connection, path)
        if known:
            _backed_up(path, known)
        for step in MIGRATIONS[known:]:
            if callable(step):
                step(connection)
            else:
                for statement in filter(str.strip, step.split(";\n")):
                    connection.execute(statement)
        connection.execute(f"PRAGMA application_id = {APPLICATION}")
        connection.execute(f"PRAGMA user_version = {SCHEMA}")


def backup_path(path: Path, version: int) -> Path:
    """Return where a library's copy of an older schema lies."""
    return path.with_name(f"{path.name}.schema-{version}.backup")


def _backed_up(path: Path, version: int) -> None:
    """Lay a copy of a library beside it, whole or not at all; while it is made nobody else may write."""
    target = backup_path(path, version)
    fresh = target.with_name(f"{target.name}.{os.getpid()}.part")
    try:
        uri = f"{path.resolve().as_uri()}?mode=rw"
        with (
            contextlib.closing(sqlite3.connect(uri, timeout=PATIENCE, uri=True)) as source,
            contextlib.closing(sqlite3.connect(fresh)) as copy,
        ):
            source.backup(copy)
        os.replace(fresh, target)
    except BaseException as error:
        with contextlib.suppress(OSError):
            fresh.unlink()
        if isinstance(error, (sqlite3.Error, OSError)):
            raise LibraryError(
                f"{path} is of an older schema, and no copy of it could be made first ({error}): "
                "nothing was changed"
            ) from error
        raise


@contextlib.contextmanager
def changing(connection: sqlite3.Connection) -> Iterator[None]:
    """Change a library in one transaction, alone: all that is done inside, or nothing.

    Inside another change it is a part of that, and undone by itself where it fails.
    """
    inner = connection.in_transaction
    connection.execute("SAVEPOINT part" if inner else "BEGIN IMMEDIATE")
    try:
        yield
        connection.execute("RELEASE part" if inner else "COMMIT")
    except BaseException:
        # A full disk may have ended the transaction already.
        if connection.in_transaction:
            with contextlib.suppress(sqlite3.Error):
                connection.execute("ROLLBACK TO part" if inner else "ROLLBACK")
                if inner:
                    connection.execute("RELEASE part")
        raise


@contextlib.contextmanager
def told(path: Path) -> Iterator[None]:
    """Tell SQLite's errors in words; what is no fault of the file goes through."""
    try:
        yield
    except sqlite3.DatabaseError as error:
        if "fts5" in str(error) or "tokenizer" in str(error):
            lacking = f"SQLite {sqlite3.sqlite_version} lacks FTS5 with trigrams: 3.34 or later is needed"
            raise LibraryError(f"{path} cannot be searched: {lacking} ({error})") from error
        words = _WORDS.get((getattr(error, "sqlite_errorcode", None) or 0) & 0xFF)
        if words is None:
            raise
        raise LibraryError(f"{path} {words} ({error})") from error


_WORDS = {
    sqlite3.SQLITE_BUSY: "is locked by another program; nothing was changed: try again when that is done",
    sqlite3.SQLITE_LOCKED: "is locked by another program; nothing was changed: try again when that is done",
    sqlite3.SQLITE_READONLY: "may not be written to; nothing was changed",
    sqlite3.SQLITE_PERM: "may not be opened; nothing was changed",
    sqlite3.SQLITE_FULL: "could not be written: the disk is full; nothing was changed",
    sqlite3.SQLITE_IOERR: "could not be read or written: is the disk full? nothing was changed",
    sqlite3.SQLITE_CANTOPEN: "cannot be opened",
    sqlite3.SQLITE_CORRUPT: "is damaged; batik-vector library check tells more, and copies may lie beside it",
    sqlite3.SQLITE_NOTADB: "is no library: it is no database of SQLite, or damaged",
    sqlite3.SQLITE_TOOBIG: "cannot hold a text of this length; nothing was changed",
}
