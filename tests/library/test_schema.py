"""A library is opened, brought up to date, or refused in one sentence; whatever happens, nothing is lost."""

from __future__ import annotations

import contextlib
import gzip
import random
import sqlite3
from pathlib import Path

import pytest

from batik_vector import LibraryError
from batik_vector.library import Library, schema
from batik_vector.library.schema import SCHEMA, backup_path
from tests.library.test_store import NOTHING, recipe

OLD = Path(__file__).parent / "old"


def old(version: int, folder: Path) -> Path:
    """Lay down a library as the program wrote it when its schema was that."""
    path = folder / "old.library"
    path.write_bytes(gzip.decompress((OLD / f"schema-{version}.gz").read_bytes()))
    return path


def schema_of(path: Path) -> int:
    with contextlib.closing(sqlite3.connect(path)) as connection:
        return int(connection.execute("PRAGMA user_version").fetchone()[0])


@pytest.mark.parametrize("version", range(1, SCHEMA + 1))
def test_an_old_library_is_brought_up_to_date_with_all_that_is_in_it(tmp_path: Path, version: int) -> None:
    path = old(version, tmp_path)
    before = path.read_bytes()
    assert schema_of(path) == version
    with Library(path) as library:
        assert [(each.name, each.version, each.tags) for each in library.entries(own=True)] == [
            ("bird", 1, ()),
            ("kawung", 2, ("dots", "old")),
        ]
        assert [each.name for each in library.entries(removed=True)] == ["gone"]
        assert [each.origin for each in library.history("kawung")] == ["samples/kawung.toml", "edited"]
        assert library.version("kawung").title == "Kawung picis"
        assert library.notes("kawung")[0].text == "For the elders"
        assert list(library.version("bird").drawings) == ["lasem-bird.svg"]
        assert "lasem-bird.svg" in library.recipe("bird").drawing
        assert library.features("kawung@1")["coverage"] == 55.11
        assert [hit.name for hit in library.search("elders", where="inks = 2")] == ["kawung"]
        assert library.search(like="kawung")[0].name == "kawung"
        assert library.restore("gone").number == 1
        assert library.add("kawung", recipe()).number == 3
        assert library.check() == []
    assert schema_of(path) == SCHEMA
    if version < SCHEMA:
        assert backup_path(path, version).read_bytes()[100:] == before[100:]
        with contextlib.closing(sqlite3.connect(backup_path(path, version))) as copy:
            assert copy.execute("PRAGMA integrity_check").fetchone() == ("ok",)


def broken_step(connection: sqlite3.Connection) -> None:
    connection.execute("CREATE TABLE halfway (a)")
    connection.execute("DELETE FROM patterns WHERE name = 'bird'")
    raise KeyboardInterrupt


def test_a_migration_that_is_stopped_leaves_what_was_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = old(1, tmp_path)
    before = path.read_bytes()
    with monkeypatch.context() as patched:
        patched.setattr(schema, "MIGRATIONS", (*schema.MIGRATIONS[:1], broken_step))
        patched.setattr(schema, "SCHEMA", 2)
        with pytest.raises(KeyboardInterrupt):
            Library(path)
    assert schema_of(path) == 1
    assert backup_path(path, 1).stat().st_size == len(before)
    with Library(path) as library:
        assert library.version("bird").number == 1
        assert library.check() == []


def test_without_a_copy_nothing_is_migrated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = old(1, tmp_path)
    before = path.read_bytes()
    backup_path(path, 1).mkdir()
    monkeypatch.setattr(schema, "MIGRATIONS", (*schema.MIGRATIONS[:1], "CREATE TABLE more (a)"))
    monkeypatch.setattr(schema, "SCHEMA", 2)
    with pytest.raises(LibraryError, match="no copy of it could be made first"):
        Library(path)
    assert schema_of(path) == 1
    assert path.stat().st_size == len(before)
    assert not list(tmp_path.glob("*.part"))


def test_a_newer_library_is_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "new.library"
    with Library(path):
        pass
    with contextlib.closing(sqlite3.connect(path)) as connection:
        connection.execute(f"PRAGMA user_version = {SCHEMA + 1}")
    before = path.read_bytes()
    with pytest.raises(
        LibraryError, match=rf"a newer batik-vector .its schema is {SCHEMA + 1}, this one knows"
    ):
        Library(path)
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    "content",
    [b"title = 'Kawung'\n", b"\0" * 40, b"SQLite format 4\0" + b"x" * 200, random.Random(7).randbytes(5000)],
    ids=["recipe", "nothing", "another format", "anything"],
)
def test_what_is_no_library_is_refused_and_left_alone(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "notes.txt"
    path.write_bytes(content)
    for write in (True, False):
        with pytest.raises(LibraryError, match="is no library"):
            Library(path, write=write)
    assert path.read_bytes() == content
    assert list(tmp_path.iterdir()) == [path]


def test_the_database_of_another_program_is_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "places.sqlite"
    with contextlib.closing(sqlite3.connect(path)) as connection:
        connection.execute("CREATE TABLE moz_places (id INTEGER)")
        connection.commit()
    before = path.read_bytes()
    with pytest.raises(LibraryError, match="is a database of another program, and no library"):
        Library(path)
    assert path.read_bytes() == before


def test_a_folder_and_what_is_not_there_are_told(tmp_path: Path) -> None:
    with pytest.raises(LibraryError, match="is a folder"):
        Library(tmp_path)
    with pytest.raises(LibraryError, match="no such library: batik-vector library add begins one"):
        Library(tmp_path / "typo", write=False)
    with pytest.raises(LibraryError, match=r'there is no folder ".*nowhere"'):
        Library(tmp_path / "nowhere" / "my.library")
    with pytest.raises(LibraryError, match="there is no folder"):
        Library(Path(__file__) / "my.library")
    assert list(tmp_path.iterdir()) == []


def test_an_empty_file_becomes_a_library(tmp_path: Path) -> None:
    path = tmp_path / "empty"
    path.touch()
    with Library(path) as library:
        assert library.names()


def test_damage_is_told(tmp_path: Path) -> None:
    path = tmp_path / "my.library"
    with Library(path) as library:
        library.add("dots", recipe())
    data = bytearray(path.read_bytes())
    data[8192:-4096] = random.Random(1).randbytes(len(data) - 12288)
    path.write_bytes(data)
    with pytest.raises(LibraryError, match=r"is damaged|is no library"):
        _looked_through(path)


def _looked_through(path: Path) -> None:
    with Library(path) as library:
        library.check()
        library.entries()
        library.search("dots")


def test_check_finds_what_somebody_changed_by_hand(tmp_path: Path) -> None:
    path = tmp_path / "my.library"
    with Library(path) as library:
        library.add("dots", recipe(1), measured=NOTHING)
        library.add("dots", recipe(2), measured=NOTHING)
    with contextlib.closing(sqlite3.connect(path)) as connection:
        connection.execute("UPDATE texts SET text = 'x' WHERE text LIKE '%Dots 1%'")
        connection.execute("DELETE FROM versions WHERE title = 'Dots 2'")
        connection.execute("INSERT INTO tags VALUES (999, 'lost')")
        connection.commit()
    with Library(path) as library:
        words = "\n".join(library.check())
    assert "a text is not what was saved" in words
    assert "belongs to a row of patterns that is not there" in words
    assert '"dots": its newest version is not the one that is shown' in words


def test_another_writer_is_waited_for_and_then_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "my.library"
    monkeypatch.setattr(schema, "PATIENCE", 0.1)
    with Library(path) as library, contextlib.closing(sqlite3.connect(path)) as other:
        other.execute("BEGIN IMMEDIATE")
        with pytest.raises(LibraryError, match="is locked by another program; nothing was changed"):
            library.add("dots", recipe(), measured=NOTHING)
        # Readers wait for nobody.
        with Library(path, write=False) as reader:
            assert reader.version("sample/kawung")
        other.execute("ROLLBACK")
        assert library.add("dots", recipe(), measured=NOTHING).fresh


def test_a_library_that_may_not_be_written_to_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "my.library"
    with Library(path) as library:
        library.add("dots", recipe(), measured=NOTHING)
    # As on a disk that is read only, where root is refused, too.
    monkeypatch.setattr(schema, "_may_write", lambda path, there: False)
    with Library(path) as library:
        assert library.search("dots", own=True)[0].name == "dots"
        assert library.stats().writable is False
        assert library.details("sample/kawung").svg
        with pytest.raises(LibraryError, match="may not be written to; nothing was changed"):
            library.tag("dots", ["x"])
    assert list(tmp_path.iterdir()) == [path]


def test_an_sqlite_without_an_index_of_words_is_told(tmp_path: Path) -> None:
    def lacking() -> None:
        with schema.told(tmp_path / "my.library"):
            raise sqlite3.OperationalError("no such module: fts5")

    with pytest.raises(LibraryError, match=r"lacks FTS5 with trigrams: 3\.34 or later is needed"):
        lacking()


def test_a_library_that_another_process_is_making_is_not_taken_for_a_foreign_one(tmp_path: Path) -> None:
    """What tells them apart is read at one moment: between mark and tables the other could finish."""
    path = tmp_path / "my.library"
    with (
        contextlib.closing(sqlite3.connect(path, isolation_level=None)) as mine,
        contextlib.closing(sqlite3.connect(path, timeout=0, isolation_level=None)) as other,
    ):

        def meanwhile(statement: str) -> None:
            if "user_version" in statement:
                with contextlib.suppress(sqlite3.OperationalError):
                    other.execute("CREATE TABLE recipe (name TEXT)")

        mine.set_trace_callback(meanwhile)
        assert schema._version(mine, path) == 0
