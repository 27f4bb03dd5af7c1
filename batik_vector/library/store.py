"""The library: patterns with all their versions, found by text, tags, features and likeness.

    with Library() as library:
        library.add("kawung", load_recipe("kawung.toml"), tags=["dots"])
        for hit in library.search("kawu", where="inks <= 2"):
            print(hit.name, hit.title)

A library is used by one thread. Any number of processes may read it and write to it at the same time; each
change is one transaction, and is on the disk when the call returns.
"""

from __future__ import annotations

import datetime
import os
import sqlite3
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from batik_vector import LibraryError, __version__
from batik_vector.library import included, rows
from batik_vector.library.names import checked_name, checked_tags, folded, keys, near, parsed, shown
from batik_vector.library.places import place
from batik_vector.library.schema import SCHEMA, changing, opened, told
from batik_vector.library.searching import Entry, Hit, found, listed
from batik_vector.library.values import Details, Note, Saved, Stats, Version, page_of

if TYPE_CHECKING:
    from batik_vector import Artwork, Recipe
    from batik_vector.library.features import Value
    from batik_vector.library.measuring import Measured

LONGEST_NOTE = 20_000
"""Characters of a note."""
READ_ONLY = "comes with batik-vector and is read-only: add it under a name of your own"


class Library:
    """A library of patterns, open until it is closed."""

    def __init__(self, path: str | os.PathLike[str] | None = None, *, write: bool = True) -> None:
        """Open a library, or begin one.

        Args:
            path: of its file; that of the variable ``BATIK_LIBRARY``, or else the user's own, when left out.
            write: whether it is to be changed. For those that only read, a file that was named must be there.

        Raises:
            LibraryError: where it cannot be opened, saying why.
        """
        self.path, asked = place(path)
        self._connection, self.writable = opened(self.path, asked, write)
        try:
            with told(self.path):
                self._take_in()
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Close it."""
        self._connection.close()

    def __enter__(self) -> Library:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _take_in(self) -> None:
        """Take in the samples and starters of this version of the program, where they are not there yet."""
        state = included.state()
        if not self.writable or state == rows.fact(self._connection, "included"):
            return
        with changing(self._connection):
            for name, page, features in included.included():
                rows.save(self._connection, name, page, self._now(), "batik-vector", features, True)
            names = {folded(name) for name, _ in included.paths()}
            for key, pattern in rows.included_keys(self._connection):
                rows.set_removed(self._connection, pattern, None if key in names else self._now())
            rows.set_fact(self._connection, "included", state)

    @staticmethod
    def _now() -> str:
        return datetime.datetime.now(datetime.UTC).isoformat(timespec="milliseconds")

    @contextmanager
    def _changing(self) -> Iterator[sqlite3.Connection]:
        with told(self.path):
            if not self.writable:
                raise LibraryError(f"{self.path} may not be written to; nothing was changed")
            with changing(self._connection):
                yield self._connection

    @contextmanager
    def together(self) -> Iterator[None]:
        """Make one transaction of all that is changed inside, as for a thousand recipes.

        Nothing of it is on the disk before the end, and other writers wait for it.
        """
        with self._changing():
            yield

    # What is there.

    def entries(
        self, *, tags: Sequence[str] = (), own: bool = False, removed: bool = False, limit: int | None = None
    ) -> list[Entry]:
        """Return what is in the library, by name.

        Args:
            tags: that they all have.
            own: without samples and starters.
            removed: those that were removed, in place of those that are there.
            limit: how many at most.
        """
        with told(self.path):
            return listed(self._connection, checked_tags(tags), own, removed, limit)

    def search(
        self,
        text: str = "",
        *,
        tags: Sequence[str] = (),
        where: str = "",
        like: str | dict[str, Value] | None = None,
        own: bool = False,
        limit: int | None = None,
    ) -> list[Hit]:
        """Return the patterns that fulfil all that is asked.

        Args:
            text: words, or parts of words, in names, titles, tags, notes, and what recipes say of themselves.
            tags: that they all have.
            where: conditions on features, such as ``inks <= 3, coverage 20..40``.
            like: a pattern's name, or features; the nearest come first.
            own: without samples and starters.
            limit: how many at most.

        Raises:
            LibraryError: where a condition is wrong, or there is no such pattern.
        """
        with told(self.path):
            reference = self.features(like) if isinstance(like, str) else like
            return found(self._connection, text, checked_tags(tags), where, reference, own, limit)

    def version(self, reference: str) -> Version:
        """Return a version of a pattern: ``kawung@3``, or ``kawung`` for the newest.

        Raises:
            LibraryError: where there is none.
        """
        name, number = parsed(reference)
        with told(self.path):
            pattern = self._found(name)
            version = rows.version(self._connection, pattern, number)
            if version is None:
                last = rows.last_number(self._connection, pattern)
                raise LibraryError(f"{shown(name)} has no version {number}: expected 1 to {last}")
            return version

    def history(self, name: str) -> list[Version]:
        """Return all versions of a pattern, the oldest first."""
        with told(self.path):
            return rows.versions(self._connection, self._found(self._whole(name)))

    def recipe(self, reference: str) -> Recipe:
        """Return the recipe of a version."""
        from batik_vector import read_recipe

        version = self.version(reference)
        return read_recipe(
            version.text, f"library:{version.name}@{version.number}", drawings=version.drawings
        )

    def details(self, reference: str) -> Details:
        """Return what :meth:`about` does; a picture that was never drawn is drawn now, and kept."""
        version, details = self.version(reference), self.about(reference)
        if details.svg:
            return details
        from batik_vector.library.measuring import measured

        made = measured(self.recipe(f"{version.name}@{version.number}"))
        if self.writable:
            with self._changing() as connection:
                rows.set_details(connection, version.id, made)
            return self.details(reference)
        return details._replace(features=details.features or made.features, svg=made.svg, png=made.png)

    def about(self, reference: str) -> Details:
        """Return tags, notes and features of a version, and its pictures where they were drawn."""
        with told(self.path):
            return rows.details(self._connection, self.version(reference).id)

    def features(self, reference: str) -> dict[str, Value]:
        """Return the features of a version that are searched."""
        version = self.version(reference)
        with told(self.path):
            return rows.measures(self._connection, version.id)

    def whole_text(self, version: Version) -> str:
        """Return a recipe with its drawings behind it, so that it compiles from itself alone."""
        return self.recipe(f"{version.name}@{version.number}").source if version.drawings else version.text

    # What changes it.

    def add(
        self,
        name: str,
        recipe: Recipe,
        *,
        artwork: Artwork | None = None,
        measured: Measured | None = None,
        origin: str = "",
        tags: Iterable[str] = (),
        note: str = "",
    ) -> Saved:
        """Save a recipe: as a new pattern, or as the newest version of the one that has its name.

        Args:
            name: of the pattern.
            recipe: that compiles.
            artwork: its tile, where it has been compiled already.
            measured: what was measured of it, likewise.
            origin: where it comes from, in a few words.
            tags: that the pattern gets besides those it has.
            note: that is added to its notes.

        Returns:
            The version; not a fresh one where the newest says the same.

        Raises:
            RecipeError: where it does not compile.
            LibraryError: where the name is none, or the library cannot be written.
        """
        if not recipe.source:
            raise LibraryError("a recipe that was made in Python has no page of TOML that could be kept")
        name, tags, note = checked_name(name), checked_tags(tags), _checked_note(note)
        if measured is None:
            from batik_vector.library import measuring

            measured = measuring.measured(recipe, artwork)
        with self._changing() as connection:
            saved = rows.save(connection, name, page_of(recipe), self._now(), origin, measured.features)
            if saved.fresh or not rows.details(connection, saved.id).svg:
                rows.set_details(connection, saved.id, measured)
            pattern = rows.pattern(connection, folded(name))
            rows.add_tags(connection, pattern, tags)
            if note:
                rows.add_note(connection, pattern, self._now(), note)
            rows.index(connection, pattern)
        return saved

    def restore(self, reference: str) -> Saved:
        """Make an old version the newest, or bring back a pattern that was removed."""
        name, number = parsed(reference)
        with self._changing() as connection:
            pattern = self._found(name, removed=True)
            rows.set_removed(connection, pattern, None)
            last = rows.last_number(connection, pattern)
            old = rows.version(connection, pattern, number)
            if old is None:
                raise LibraryError(f"{shown(name)} has no version {number}: expected 1 to {last}")
            if old.number == last:
                rows.index(connection, pattern)
                return Saved(old.id, old.name, old.number, False)
            self._refuse_included(pattern, old.name)
            saved = rows.copy(connection, old, last + 1, self._now(), __version__)
            rows.index(connection, pattern)
        return saved

    def tag(self, name: str, tags: Iterable[str], *, remove: bool = False) -> tuple[str, ...]:
        """Give a pattern tags, or take them from it; return those it has then.

        Raises:
            LibraryError: where a tag is none, or one that is to be taken is not there.
        """
        asked = checked_tags(tags)
        with self._changing() as connection:
            pattern = self._own(name)
            has = rows.tags(connection, pattern)
            for tag in asked if remove else ():
                if tag not in has:
                    words = f"it has {', '.join(has)}" if has else "it has none"
                    raise LibraryError(f'{shown(name)} has no tag "{tag}": {words}')
            (rows.remove_tags if remove else rows.add_tags)(connection, pattern, asked)
            rows.index(connection, pattern)
            return rows.tags(connection, pattern)

    def note(self, name: str, text: str) -> list[Note]:
        """Add a note to a pattern; return all it has."""
        if not text.strip():
            raise LibraryError("an empty note: expected some words")
        with self._changing() as connection:
            pattern = self._own(name)
            rows.add_note(connection, pattern, self._now(), _checked_note(text))
            rows.index(connection, pattern)
            return rows.notes(connection, pattern)

    def notes(self, name: str) -> list[Note]:
        """Return the notes of a pattern, the oldest first."""
        with told(self.path):
            return rows.notes(self._connection, self._found(self._whole(name)))

    def remove(self, *names: str, for_good: bool = False) -> None:
        """Remove patterns, all or none: out of sight, from where ``restore`` brings them back; or for good.

        Raises:
            LibraryError: where one comes with the program, or is not there.
        """
        with self._changing() as connection:
            for pattern in {name: self._own(name, removed=for_good) for name in names}.values():
                if for_good:
                    rows.delete(connection, pattern)
                else:
                    rows.set_removed(connection, pattern, self._now())

    # The library itself.

    def stats(self) -> Stats:
        """Return the library in figures."""
        with told(self.path):
            counts = rows.counts(self._connection)
        files = [self.path, *(self.path.with_name(self.path.name + end) for end in ("-wal", "-shm"))]
        size = sum(each.stat().st_size for each in files if each.exists())
        return Stats(str(self.path), size, SCHEMA, sqlite3.sqlite_version, self.writable, *counts)

    def check(self) -> list[str]:
        """Return what is wrong with the library, in words: nothing where all is as it should be."""
        with told(self.path):
            return rows.faults(self._connection)

    def unmeasured(self) -> list[str]:
        """Return the newest versions of which features were never measured, or by an older program."""
        with told(self.path):
            return rows.unmeasured(self._connection)

    def measure(self, reference: str, measured: Measured | None = None) -> dict[str, Any]:
        """Measure a version anew, samples too, and keep what was found; see :meth:`unmeasured`."""
        version = self.version(reference)
        if measured is None:
            from batik_vector.library import measuring

            measured = measuring.measured(self.recipe(f"{version.name}@{version.number}"))
        with self._changing() as connection:
            rows.set_features(connection, version.id, measured.features)
            rows.set_details(connection, version.id, measured)
        return dict(measured.features)

    # By name.

    def names(self) -> list[str]:
        """Return the names of all that is there."""
        return [each.name for each in self.entries()]

    def _found(self, name: str, removed: bool = False) -> int:
        for key in keys(name):
            pattern = rows.pattern(self._connection, key, removed)
            if pattern:
                return pattern
        gone = any(rows.pattern(self._connection, key, True) for key in keys(name))
        hint = ": it was removed, and restore brings it back" if gone else near(name, self.names())
        raise LibraryError(f"the library has no pattern {shown(name)}{hint}")

    @staticmethod
    def _whole(name: str) -> str:
        """Return the name of a pattern as a whole, of which no version can be meant."""
        whole, number = parsed(name)
        if number is not None:
            raise LibraryError(f"{shown(name)}: expected the name of a pattern as a whole, {whole}")
        return whole

    def _own(self, name: str, removed: bool = False) -> int:
        pattern = self._found(self._whole(name), removed)
        self._refuse_included(pattern, name)
        return pattern

    def _refuse_included(self, pattern: int, name: str) -> None:
        if rows.is_included(self._connection, pattern):
            raise LibraryError(f"{shown(name)} {READ_ONLY}")


def _checked_note(text: str) -> str:
    plain = "".join(each for each in text.strip() if each.isprintable() or each in "\n\t")
    if len(plain) > LONGEST_NOTE:
        raise LibraryError(f"a note of {len(plain):,} characters, expected at most {LONGEST_NOTE:,}")
    return plain
