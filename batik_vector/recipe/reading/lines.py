"""On which line of a TOML text each key stands. Only looked up when there is a fault to tell."""

from __future__ import annotations

import contextlib
import functools
import re
import tomllib
from bisect import bisect_right
from collections.abc import Mapping, Sequence

from batik_vector.recipe.references import EVERY, Path
from batik_vector.values import frozen

_BLANK = re.compile(r"[ \t\r\n]*+(?:#[^\n]*+[ \t\r\n]*+)*")
_SPACE = re.compile(r"[ \t]*+")
_BARE = re.compile(r"[A-Za-z0-9_-]++")
_TEXT = re.compile(
    r'"""[^"\\]*+(?:(?:\\.|"(?!""))[^"\\]*+)*"{3,5}'
    r"|'''[^']*+(?:'(?!'')[^']*+)*'{3,5}"
    r'|"[^"\\\n]*+(?:\\.[^"\\\n]*+)*"'
    r"|'[^'\n]*+'",
    re.DOTALL,
)
_SCALAR = re.compile(r"[^,\]}\n#]*+")


class _Scanner:
    """Walks through a text that tomllib has accepted, and notes where each path begins."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0
        self.starts: dict[Path, int] = {}
        self.values: dict[Path, tuple[int, int]] = {}
        self.headers: list[tuple[int, Path]] = []
        self._counts: dict[Path, int] = {}

    def run(self) -> None:
        table: Path = ()
        self._skip(_BLANK)
        while self.at < len(self.text):
            if self.text[self.at] == "[":
                table = self._header()
            else:
                self._pair(table)
            self._skip(_BLANK)

    def _skip(self, pattern: re.Pattern[str]) -> str:
        found = pattern.match(self.text, self.at)
        assert found is not None
        self.at = found.end()
        return found[0]

    def _note(self, path: Path, start: int) -> None:
        self.starts.setdefault(path, start)

    def _header(self) -> Path:
        start = self.at
        double = self.text.startswith("[[", self.at)
        self.at += 2 if double else 1
        *parents, last = self._key()
        self.at += 2 if double else 1
        path: Path = ()
        for part in parents:
            path = self._latest((*path, part))
            self._note(path, start)
        path = (*path, last)
        self._note(path, start)
        if double:
            self._counts[path] = self._counts.get(path, 0) + 1
        path = self._latest(path)
        self._note(path, start)
        self.headers.append((start, path))
        return path

    def _latest(self, path: Path) -> Path:
        return (*path, self._counts[path] - 1) if path in self._counts else path

    def _key(self) -> list[str]:
        parts = []
        while True:
            self._skip(_SPACE)
            if self.text[self.at] in "\"'":
                parts.append(str(tomllib.loads("k = " + self._skip(_TEXT))["k"]))
            else:
                parts.append(self._skip(_BARE))
            self._skip(_SPACE)
            if self.text[self.at] != ".":
                return parts
            self.at += 1

    def _pair(self, table: Path) -> None:
        start = self.at
        path = table
        for part in self._key():
            path = (*path, part)
            self._note(path, start)
        self.at += 1
        self._value(path)

    def _value(self, path: Path) -> None:
        self._skip(_SPACE)
        start, first = self.at, self.text[self.at]
        if first == "[":
            self._array(path)
        elif first == "{":
            self._inline(path)
        elif first in "\"'":
            self._skip(_TEXT)
        else:
            self._skip(_SCALAR)
        self.values[path] = start, start + len(self.text[start : self.at].rstrip())

    def _array(self, path: Path) -> None:
        self.at += 1
        index = 0
        self._skip(_BLANK)
        while self.text[self.at] != "]":
            self._note((*path, index), self.at)
            self._value((*path, index))
            index += 1
            self._comma()
        self.at += 1

    def _inline(self, path: Path) -> None:
        self.at += 1
        self._skip(_BLANK)
        while self.text[self.at] != "}":
            self._pair(path)
            self._comma()
        self.at += 1

    def _comma(self) -> None:
        self._skip(_BLANK)
        if self.text[self.at] == ",":
            self.at += 1
            self._skip(_BLANK)


@frozen
class Spans:
    """Where what a text says stands in it, in characters.

    Args:
        starts: of the key or the header of each path.
        values: of each value that is written in place, from its first character to past its last.
        headers: the start of each, and the path of its table, in the order of the text.
    """

    starts: Mapping[Path, int]
    values: Mapping[Path, tuple[int, int]]
    headers: Sequence[tuple[int, Path]]


@functools.lru_cache(maxsize=4)
def spans(text: str) -> Spans:
    """Return where all stands in a text that tomllib has accepted.

    Kept: of one recipe many variants are made.
    """
    scanner = _Scanner(text)
    with contextlib.suppress(IndexError, AssertionError, RecursionError, ValueError):
        scanner.run()
    return Spans(scanner.starts, scanner.values, scanner.headers)


def value_spans(text: str) -> Mapping[Path, tuple[int, int]]:
    """Return where each value stands that is written in place, from its first character to past its last."""
    return spans(text).values


class Lines:
    """Finds lines in a text by path."""

    def __init__(self, text: str) -> None:
        scanner = _Scanner(text)
        # Should the walk lose its way: what has been noted so far is right, the rest goes without a line.
        with contextlib.suppress(IndexError, AssertionError, RecursionError, ValueError):
            scanner.run()
        self._starts = scanner.starts
        self._ends = [found.start() for found in re.finditer("\n", text)]

    def __contains__(self, path: Path) -> bool:
        return path in self._starts

    def line(self, path: Path) -> int | None:
        """Return the line, from 1, of a path, or of the nearest thing around it that is written."""
        while path and path not in self._starts:
            path = path[:-1]
        return bisect_right(self._ends, self._starts[path] - 1) + 1 if path else None


def parse_path(text: str) -> Path:
    """Return the path that people write: ``place[1].width`` or ``place.1.width`` → ``("place", 1, "width")``.

    Raises:
        ValueError: with what was expected.
    """
    path: list[str | int] = []
    at = 0
    token = re.compile(
        r"""\[(\d{1,9}|\*)\]|(?:^|(?<=.)\.)(?:([A-Za-z0-9_-]+)|("[^"\\\n]*+(?:\\.[^"\\\n]*+)*"|'[^'\n]*+'))"""
    )
    while at < len(text):
        found = token.match(text, at)
        if found is None:
            raise ValueError("expected keys joined by dots, such as motif.flower.petal.count")
        index, bare, quoted = found.groups()
        if index is not None:
            path.append(EVERY if index == EVERY else int(index))
        elif bare is not None:
            path.append(bare)
        else:
            path.append(str(tomllib.loads("k = " + quoted)["k"]))
        at = found.end()
    if not path or isinstance(path[0], int):
        raise ValueError("expected keys joined by dots, such as motif.flower.petal.count")
    return tuple(path)
