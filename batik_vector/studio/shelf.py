"""The shelf: patterns of the library with small pictures, which are drawn in a process beside the studio.

A library is used by one thread, and each call here opens and closes it in its own. A picture that was never
drawn takes a compile, so that is done by a process of its own, one picture at a time.
"""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, TypeVar

from batik_vector.errors import BatikError, LibraryError
from batik_vector.library.included import thumbnail
from batik_vector.studio.aside import Aside

if TYPE_CHECKING:
    from collections.abc import Callable

    from batik_vector.library import Library
    from batik_vector.library.searching import Hit
    from batik_vector.library.values import Saved, Version

_T = TypeVar("_T")

PATIENCE = 60.0
"""Seconds that one small picture may take."""
MOST_FOUND = 400
"""Patterns that a search shows."""


class Shelf:
    """The patterns of one library."""

    def __init__(self, aside: Aside, path: str | None = None) -> None:
        """Look into a library; the user's own where no path is given."""
        self.path = path
        self._aside = aside

    async def find(self, words: str, where: str = "", *, own: bool = False) -> list[Hit]:
        """Return the patterns that are found; see :meth:`batik_vector.library.Library.search`.

        Raises:
            LibraryError: where a condition is wrong, or the library cannot be opened.
        """
        return await self._ask(lambda library: library.search(words, where=where, own=own, limit=MOST_FOUND))

    async def versions(self, name: str) -> list[Version]:
        """Return all versions of a pattern, the newest first; none where there is no such pattern."""

        def asked(library: Library) -> list[Version]:
            try:
                return library.history(name)[::-1]
            except LibraryError:
                return []

        return await self._ask(asked)

    async def version(self, reference: str) -> Version:
        """Return a version, ``kawung@3``, or the newest.

        Raises:
            LibraryError: where there is none.
        """
        return await self._ask(lambda library: library.version(reference))

    async def restore(self, reference: str) -> Saved:
        """Make an old version the newest."""
        return await self._ask(lambda library: library.restore(reference))

    async def _ask(self, question: Callable[[Library], _T]) -> _T:
        return await asyncio.to_thread(_asked, self.path, question)

    async def picture(self, reference: str) -> bytes:
        """Return the small picture of a version, as SVG or PNG.

        Raises:
            BatikError: where it cannot be drawn.
        """
        kept = await self._ask(lambda library: _kept(library, reference))
        if kept:
            return kept
        svg = await self._aside.run(PATIENCE, _drawn, self.path, reference)
        if not svg:
            raise LibraryError(f"{reference} could not be drawn")
        return svg


def _asked(path: str | None, question: Callable[[Library], _T]) -> _T:
    from batik_vector.library import Library

    with Library(path) as library:
        return question(library)


def _kept(library: Library, reference: str) -> bytes:
    """Return the picture that came with the package or was drawn before; empty where there is none."""
    version = library.version(reference)
    return thumbnail(version.name, version.text) or library.about(reference).svg


def _drawn(path: str | None, reference: str) -> bytes:
    """Draw a picture and keep it in the library; empty where the recipe does not compile."""
    from batik_vector.library import Library

    try:
        with Library(path) as library:
            return library.details(reference).svg
    except BatikError:
        return b""
