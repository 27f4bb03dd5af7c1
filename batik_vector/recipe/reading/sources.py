"""From a source to a recipe's text: a TOML file, one that was compiled, or a pattern of the library."""

from __future__ import annotations

import codecs
import os
import re
import stat
import sys
import tomllib
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from batik_vector.errors import Fault, RecipeError
from batik_vector.recipe.references import quoted

if TYPE_CHECKING:
    from batik_vector.artwork import Provenance

MAX_TEXT = 1 << 20
"""Bytes of a recipe. The longest by hand has some thousands."""
MAX_COMPILED = 512 << 20
STDIN = "-"
"""Names standard input where a command takes a recipe."""
COMPILED = (".svg", ".pdf", ".dxf", ".hpgl", ".gcode", ".png", ".tiff")
_SUFFIXES = (".toml", *COMPILED)
CARRIED = (
    "\n# The drawings that stood beside the recipe. Without this table they are read from there again.\n"
    "[drawing]\n"
)
"""Begins what a compiled file carries behind its recipe."""
MAX_CARRIED = 14 << 20
"""Characters that the drawings in it may come to; the recipe too fits in what a file may carry."""
SCHEMES = {"library": "batik_vector.library.sources"}
"""Sources that are no files: what stands before their colon, and the module that is asked for them by its
``fetched(name, source)``, the text of a recipe and its drawings. It is imported when it is first needed."""
_ENTRY = re.compile(r'("[^"\\\n]*+(?:\\.[^"\\\n]*+)*") = \'\'\'\n([^\']*+)\'\'\'\n')


def read_text(path: str | os.PathLike[str]) -> str:
    """Return the text of a recipe, from its own file or from one compiled from it.

    Raises:
        BatikError: saying what about the file, or about the library, is wrong.
    """
    source = os.fspath(path)
    scheme, name = scheme_of(source)
    if scheme:
        text, drawings = import_module(SCHEMES[scheme]).fetched(name, source)
        return with_carried(text, drawings)
    try:
        found = os.stat(path)
    except (OSError, ValueError) as error:
        raise _fault(_reason(Path(path), error), source) from error
    if stat.S_ISDIR(found.st_mode):
        raise _fault("is a folder, expected a recipe file" + _offer(Path(path)), source)
    compiled = Path(path).suffix.lower() in COMPILED
    limit = MAX_COMPILED if compiled else MAX_TEXT
    if found.st_size > limit:
        raise _fault(f"{found.st_size:,} bytes, expected at most {limit:,}", source)
    return _from_compiled(path) if compiled else _from_text(path, source)


def read_stdin() -> str:
    """Return the text of a recipe from standard input, which may hold a file that was compiled from it, too.

    Raises:
        RecipeError: where it holds none.
    """
    data = b"" if sys.stdin is None else sys.stdin.buffer.read(MAX_TEXT + 1)
    from batik_vector.export.provenance import is_made, provenance_in

    if is_made(data):
        data += sys.stdin.buffer.read(MAX_COMPILED + 1 - len(data))
        if len(data) > MAX_COMPILED:
            raise _fault(f"more than {MAX_COMPILED:,} bytes, expected a compiled file", "stdin")
        return _carried(provenance_in(data, Path("stdin")), "stdin")
    if len(data) > MAX_TEXT:
        raise _fault(f"more than {MAX_TEXT:,} bytes, expected a recipe", "stdin")
    return decoded(data, "stdin")


def scheme_of(source: str) -> tuple[str, str]:
    """``library:kawung@3`` → library, kawung@3; a file has no scheme: it is called ``./library:kawung``."""
    scheme, colon, name = source.partition(":")
    return (scheme, name) if colon and scheme in SCHEMES else ("", source)


def stem_of(source: str | os.PathLike[str]) -> str:
    """Return what files of a source are called, without a suffix: ``library:sample/kawung@3`` → kawung."""
    scheme, name = scheme_of(os.fspath(source))
    if not scheme:
        return Path(source).stem
    return name.rpartition("/")[2].partition("@")[0] or scheme


def is_compiled(source: str | os.PathLike[str]) -> bool:
    """Whether a source is by its name a file that was compiled from its recipe."""
    return not scheme_of(os.fspath(source))[0] and Path(source).suffix.lower() in COMPILED


def _from_compiled(path: str | os.PathLike[str]) -> str:
    from batik_vector.export.provenance import read_provenance

    return _carried(read_provenance(Path(path)), os.fspath(path))


def _carried(told: Provenance, source: str) -> str:
    """Return the recipe that a compiled file carries."""
    if not told.recipe:
        raise _fault("was made from Python and carries no recipe", source)
    own, _ = parted(told.recipe)
    if len(own) > MAX_TEXT:
        raise _fault(f"its recipe has {len(own):,} characters, expected at most {MAX_TEXT:,}", source)
    return told.recipe


def _from_text(path: str | os.PathLike[str], source: str) -> str:
    try:
        with open(path, "rb") as file:
            # One byte more than allowed: pipes and devices do not tell their size.
            data = file.read(MAX_TEXT + 1)
    except OSError as error:
        raise _fault(_reason(Path(path), error), source) from error
    if len(data) > MAX_TEXT:
        raise _fault(f"more than {MAX_TEXT:,} bytes, expected a recipe", source)
    return decoded(data, source)


def decoded(data: bytes, source: str, expected: str = "a recipe in TOML") -> str:
    """Return bytes as text with the line ends of Unix.

    Raises:
        RecipeError: with the line of the first byte that is no UTF-8.
    """
    data = data.removeprefix(codecs.BOM_UTF8)
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise RecipeError([Fault(f"is no text in UTF-8, expected {expected}", "", source, line)]) from error
    return text.replace("\r\n", "\n")


def _reason(path: Path, error: Exception) -> str:
    if isinstance(error, FileNotFoundError):
        return "no such file" + _near(path)
    return (error.strerror if isinstance(error, OSError) else None) or "is no usable path"


def _near(path: Path) -> str:
    """Offer the file beside it whose name is nearest."""
    from difflib import get_close_matches

    try:
        names = sorted(name for name in os.listdir(path.parent) if name.lower().endswith(_SUFFIXES))[:10_000]
    except OSError:
        return f': there is no folder "{path.parent}"'
    near = get_close_matches(path.name, names, n=1, cutoff=0.6)
    return f': did you mean "{path.parent / near[0]}"?' if near else ""


def _offer(path: Path) -> str:
    try:
        names = sorted(name for name in os.listdir(path) if name.endswith(".toml"))
    except OSError:
        return ""
    return f', such as "{path / names[0]}"' if names else ""


def _fault(words: str, source: str) -> RecipeError:
    return RecipeError([Fault(words, source=source)])


def parted(text: str) -> tuple[str, dict[str, str]]:
    """Return a recipe's text without the drawings that are carried behind it, and these by their names.

    Where anything else stands behind it, all is the recipe's own.
    """
    own, mark, rest = text.partition(CARRIED)
    if not mark:
        return text, {}
    found: dict[str, str] = {}
    at = 0
    while entry := _ENTRY.match(rest, at):
        found[str(tomllib.loads(f"k = {entry[1]}")["k"])] = entry[2]
        at = entry.end()
    return (own, found) if at == len(rest) and found else (text, {})


def with_carried(source: str, texts: Mapping[str, str]) -> str:
    """Return a recipe's text with drawings behind it; without them where they would be too much."""
    if not texts or sum(map(len, texts.values())) > MAX_CARRIED:
        return source
    parts = [source if source.endswith("\n") or not source else f"{source}\n", CARRIED]
    # An apostrophe within an SVG's text or attribute is written as a reference, so that none ends the string.
    parts += [f"{quoted(file)} = '''\n{text}'''\n" for file, text in texts.items()]
    return "".join(parts)
