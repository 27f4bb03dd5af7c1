"""Files beside a recipe, which it names: read whole, and never from outside its folder."""

from __future__ import annotations

import errno
import os
import re
import stat
from pathlib import PurePosixPath

from batik_vector.errors import RecipeError, nearest, shortened
from batik_vector.recipe.references import quoted
from batik_vector.values import frozen

OPENING = (
    os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
)
_WINDOWS = re.compile(r"[a-zA-Z]:|.*\\")


@frozen
class Kind:
    """A kind of file in words, by its suffix, and as an example."""

    words: str
    suffix: str
    example: str


def read_beside(file: str, folder: str | None, kind: Kind, most: int) -> tuple[bytes, str]:
    """Return the bytes of a file that a recipe names, and its path.

    Args:
        file: its name, in the recipe's folder or below it.
        folder: the recipe's; None where it has none.
        kind: what is expected.
        most: bytes it may have.

    Raises:
        RecipeError: where it lies outside of the recipe's folder, or cannot be read.
    """
    if folder is None:
        raise RecipeError(
            f"{_shown(file)}: a recipe that is no file has no folder for it: read the recipe from its file"
        )
    _refuse_outside(file, folder, kind)
    path = os.path.realpath(os.path.join(folder, file))
    try:
        handle = os.open(path, OPENING)
    except (OSError, ValueError) as error:
        raise RecipeError(f"{_shown(file)}: {_reason(file, folder, kind, error)}") from error
    found = os.fstat(handle)
    if not stat.S_ISREG(found.st_mode):
        os.close(handle)
        what = "a folder" if stat.S_ISDIR(found.st_mode) else "no ordinary file"
        raise RecipeError(f"{_shown(file)}: is {what}, expected {kind.words}")
    with os.fdopen(handle, "rb") as opened:
        try:
            data = opened.read(most + 1)
        except OSError as error:
            raise RecipeError(f"{_shown(file)}: {error.strerror}") from error
    if len(data) > most:
        size = max(found.st_size, len(data))
        raise RecipeError(f"{_shown(file)}: {size:,} bytes, expected at most {most:,}")
    return data, path


def _refuse_outside(file: str, folder: str, kind: Kind) -> None:
    """Raise where a name leads out of the recipe's folder: by itself, or by a link on its way."""
    path = PurePosixPath(file)
    if not file.strip() or not file.isprintable():
        raise RecipeError(f'{_shown(file)}, expected the name of {kind.words}, such as "{kind.example}"')
    if path.is_absolute() or ".." in path.parts or _WINDOWS.match(file):
        raise RecipeError(
            f'{_shown(file)}, expected a file in the recipe\'s folder or below it, such as "{path.name}"'
        )
    inside = os.path.realpath(folder)
    there = os.path.realpath(os.path.join(folder, file))
    if os.path.commonpath([inside, there]) != inside:
        raise RecipeError(
            f"{_shown(file)}: is a link that leads out of the recipe's folder, expected the file"
        )


def _reason(file: str, folder: str, kind: Kind, error: Exception) -> str:
    if not isinstance(error, FileNotFoundError):
        if isinstance(error, OSError) and error.errno == errno.EISDIR:
            return f"is a folder, expected {kind.words}"
        return (error.strerror if isinstance(error, OSError) else None) or "is no usable name"
    try:
        beside = os.path.join(folder, os.path.dirname(file))
        names = sorted(name for name in os.listdir(beside) if name.lower().endswith(kind.suffix))[:10_000]
    except OSError:
        return f'no such file: there is no folder "{os.path.dirname(file)}"'
    near = nearest(os.path.basename(file), names)
    beside = f"{os.path.dirname(file)}/" if os.path.dirname(file) else ""
    return "no such file" + (f': did you mean "{beside}{near}"?' if near else " beside the recipe")


def _shown(file: str) -> str:
    return quoted(shortened(file))
