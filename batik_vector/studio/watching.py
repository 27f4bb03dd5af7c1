"""A recipe is watched, and all that it names: the files that a save of any of them changes.

Files are asked for their state, ten times a second, which costs next to nothing and works on every file
system, over a network too. Editors save by putting a new file in the place of the old one, and for a moment
there may be none: what counts is a state that has come to rest.
"""

from __future__ import annotations

import os
import stat
import time
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from batik_vector.errors import BatikError, Fault, RecipeError
from batik_vector.recipe.reading.sources import is_compiled, parted, read_text, scheme_of
from batik_vector.recipe.references import children

PERIOD = 0.1
"""Seconds between two looks."""
REST = 0.1
"""Seconds that files must stay as they are before they are read: editors write in several steps."""
GONE = 1.0
"""Seconds that a recipe may be missing, on its way from one file to the next."""
NAMING = ("file", "machine")
"""Keys whose words may be names of files."""
BESIDE = (".svg", ".toml")

State: TypeAlias = tuple[int, int, int] | None
"""When a file was changed, its size, and which file it is; None where it is missing."""


class Watched:
    """A recipe's files, and how they were when they were last read."""

    def __init__(self, source: str) -> None:
        """Watch a recipe.

        Args:
            source: its path, or ``library:NAME``, which is watched in the library's file.

        Raises:
            RecipeError, LibraryError: where there is no such recipe, or it is a file that was compiled, which
                nobody saves by hand.
        """
        if is_compiled(source):
            words = "was compiled from a recipe, and is not saved by hand: expected the recipe's own file"
            raise RecipeError([Fault(words, source=source)])
        read_text(source)
        self.source = source
        self._states: dict[str, State] = {}
        self.seen()

    @property
    def files(self) -> tuple[str, ...]:
        """The paths that are watched, the recipe's first."""
        return tuple(self._states)

    def seen(self) -> None:
        """Take note of the files as they are now; what the recipe names is looked up anew."""
        # The recipe's own state before it is read: what is saved in between is seen at the next look.
        self._states = {path: state_of(path) for path in own_files(self.source)}
        for path in named_files(self.source):
            self._states.setdefault(path, state_of(path))

    def changed(self) -> tuple[str, ...]:
        """Return the paths whose files are not as they were."""
        return tuple(path for path, state in self._states.items() if state_of(path) != state)

    def settled(self, sleep: Callable[[float], object] = time.sleep) -> None:
        """Wait until the files have come to rest, and a recipe that is missing is there again, or gone."""
        waited = 0.0
        before: Sequence[State] = ()
        while True:
            now = [state_of(path) for path in self._states]
            missing = now[0] is None and waited < GONE
            if now == before and not missing:
                return
            before = now
            sleep(REST)
            waited += REST

    def changes(self, sleep: Callable[[float], object] = time.sleep) -> Iterator[tuple[str, ...]]:
        """Yield the paths of changed files each time that they have come to rest, without end.

        What is saved while a change is worked at is yielded after it, once.
        """
        while True:
            while not (changed := self.changed()):
                sleep(PERIOD)
            self.settled(sleep)
            # Noted before they are read: a save in between is seen at the next look.
            self.seen()
            yield changed


def own_files(source: str) -> list[str]:
    """Return the files that a source itself is in."""
    if not scheme_of(source)[0]:
        return [source]
    from batik_vector.library.places import place

    path = str(place()[0])
    return [path, f"{path}-wal"]


def named_files(source: str) -> list[str]:
    """Return the files that a recipe names, whether it reads or not; none where it is no TOML."""
    if scheme_of(source)[0]:
        return []
    try:
        tables = tomllib.loads(parted(read_text(source))[0])
    except (BatikError, ValueError, RecursionError):
        return []
    folder = os.path.dirname(source)
    carried = tables.get("drawing")
    known = carried if isinstance(carried, Mapping) else {}
    return [os.path.join(folder, name) for name in _names(tables) if name not in known]


def _names(node: Any) -> Iterator[str]:
    for key, value in children(node):
        if key in NAMING and isinstance(value, str) and value.lower().endswith(BESIDE):
            yield value
        elif isinstance(value, Mapping | list):
            yield from _names(value)


def state_of(path: str) -> State:
    """Return a file's state."""
    try:
        found = os.stat(path)
    except (OSError, ValueError):
        return None
    return None if stat.S_ISDIR(found.st_mode) else (found.st_mtime_ns, found.st_size, found.st_ino)
