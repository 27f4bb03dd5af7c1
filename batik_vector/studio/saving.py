"""Drafts are saved: as a version in the library, or as a file, and never over what one has not seen.

Two tabs, or two studios, may work at one pattern. Who saves says which version the work began with; where the
library has a newer one by now, that is told, and nothing is written until one says so.
"""

from __future__ import annotations

import hashlib
import os
from pathlib import Path

from batik_vector.errors import BatikError, ExportError
from batik_vector.export.files import write_whole
from batik_vector.recipe.loading import read_recipe
from batik_vector.studio.drafts import Draft
from batik_vector.values import frozen

ORIGIN = "the studio"


class NewerError(BatikError):
    """What would be saved over is newer than what the work began with."""


@frozen
class Saving:
    """A version to be saved.

    Args:
        name: of the pattern.
        base: the number of the version that the work began with; 0 where it is a new pattern.
        library: the library's file; the user's own when left out.
        tags: that the pattern gets.
        note: that is added to its notes.
        over: whether a newer version may be saved over; it stays in the history in any case.
    """

    name: str
    base: int = 0
    library: str = ""
    tags: tuple[str, ...] = ()
    note: str = ""
    over: bool = False


def save(draft: Draft, saving: Saving) -> tuple[str, int, bool]:
    """Save a draft as the newest version of a pattern.

    Returns:
        The pattern's name, the number of the version, and whether it is a fresh one: where the newest says
        the same, none is made.

    Raises:
        RecipeError: where the draft does not compile.
        NewerError: where the library has a newer version than the work began with.
        LibraryError: where the name is none, or the library cannot be written.
    """
    from batik_vector.library import Library
    from batik_vector.library.measuring import measured

    recipe = read_recipe(draft.text, draft.stem, folder=draft.folder, drawings=dict(draft.drawings))
    # Measured first: nobody else waits for the library meanwhile.
    found = measured(recipe)
    with Library(saving.library or None) as library, library.together():
        newest = newest_version(library, saving.name)
        if newest > saving.base and not saving.over:
            words = f"version {saving.base}" if saving.base else "nothing"
            raise NewerError(
                f"{saving.name} has version {newest} by now, and this began with {words}: look at it first, "
                "or save over it; the older versions stay"
            )
        saved = library.add(
            saving.name, recipe, measured=found, origin=ORIGIN, tags=saving.tags, note=saving.note
        )
    return saved.name, saved.number, saved.fresh


def newest_version(library: object, name: str) -> int:
    """Return the number of a pattern's newest version; 0 where there is none, or it has been removed."""
    from batik_vector.errors import LibraryError
    from batik_vector.library import Library

    assert isinstance(library, Library)
    try:
        return library.version(name).number
    except LibraryError:
        return 0


def fingerprint(text: str) -> str:
    """Return what tells a text from any other: to be noted when a file is read or written."""
    return hashlib.sha256(text.encode()).hexdigest()


def save_file(draft: Draft, path: str | os.PathLike[str], seen: str = "") -> str:
    """Write a draft to a file, whole or not at all; drawings go with it where it stands in no folder.

    Args:
        draft: to be written.
        path: of the file.
        seen: the fingerprint of the file as it was when it was last read or written; nothing for a new file,
            ``"*"`` to replace whatever is there.

    Returns:
        The fingerprint of what was written.

    Raises:
        NewerError: where another program has changed the file since, or one is there that was not seen.
        ExportError: where it cannot be written.
    """
    place = Path(path)
    text = draft.text if draft.folder is not None else draft.whole
    if seen != "*" and place.exists():
        try:
            there = place.read_text("utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise ExportError(f"{place} could not be read: {error}") from error
        if there != text and fingerprint(there) != seen:
            raise NewerError(f"{place} is there and says something else: open it first, or replace it")
    write_whole(place, text.encode())
    return fingerprint(text)
