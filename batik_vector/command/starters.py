"""New recipes from the starters."""

from __future__ import annotations

import os
import re
from pathlib import Path

from batik_vector.errors import ExportError
from batik_vector.recipe.references import quoted

STARTERS = Path(__file__).parents[1] / "starters"
"""The folder of recipes to begin with: each is a kind of new recipe."""
_TITLE = re.compile(r"^title( *)= .*$", re.MULTILINE)
_FILE_NAME = re.compile(r"[^\w.+-]+")


def summary(starter: Path) -> str:
    """Return what a starter is in one sentence: the first of the comment that it opens with."""
    with open(starter, encoding="utf-8") as file:
        sentence, _, _ = file.readline().removeprefix("# ").rstrip().partition(". ")
    return sentence.removesuffix(".")


def write_starter(starter: Path, name: str | None, path: str | None, force: bool) -> Path:
    """Write a copy of a starter.

    Args:
        starter: the recipe to begin with.
        name: its title, and what its file is called unless a path is given.
        path: of the new file.
        force: whether a file that is there is replaced.

    Raises:
        ExportError: where the file cannot be written, or is there already, or its name is a path.
    """
    if path is None and name is not None and _is_path(name):
        raise ExportError(f'"{name[:60]}" is a path, expected a name: -o FILE says where the file goes')
    text = starter.read_text("utf-8")
    if name is not None:
        title = quoted(name.removesuffix(".toml").encode("utf-8", "replace").decode("utf-8"))
        text = _TITLE.sub(lambda found: f"title{found[1]}= {title}", text, count=1)
    target = Path(path) if path is not None else Path(_file_name(name or starter.stem))
    try:
        if force:
            from batik_vector.export.files import write_whole

            write_whole(target, text.encode("utf-8"))
        else:
            with open(target, "xb") as file:
                file.write(text.encode("utf-8"))
    except FileExistsError:
        raise ExportError(f"{target} is there already: --force replaces it") from None
    except OSError as error:
        raise ExportError(f"{target} could not be written: {error.strerror}") from error
    return target


def _is_path(name: str) -> bool:
    """Whether a name is a path: what would be left of it was not meant."""
    return any(each in name for each in (os.sep, os.altsep) if each) or name in (".", "..", "~")


def _file_name(name: str) -> str:
    name = name.removesuffix(".toml")
    return f"{_FILE_NAME.sub('-', name).strip('.-').lower() or 'recipe'}.toml"
