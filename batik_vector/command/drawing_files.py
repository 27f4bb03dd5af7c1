"""Whether a file that a call names is a drawing. Importing it costs nothing heavy."""

from __future__ import annotations

from pathlib import Path

from batik_vector.errors import Fault, RecipeError
from batik_vector.recipe.reading.sources import COMPILED, scheme_of

SNIFFED = 512
"""Bytes at the beginning of a file that show whether it is an SVG under another name."""


def is_drawing(source: str) -> bool:
    """Whether a file is an SVG, by its name or by how it begins, and no swatch of ours: that shows its tile
    twice, in a page that is no tile.

    Raises:
        RecipeError: where it is neither a drawing nor a recipe.
    """
    path = Path(source)
    if scheme_of(source)[0]:
        return False
    if path.is_dir():
        raise _fault(source, f'is a folder, expected files, such as "{path / "*.svg"}"')
    if path.suffix.lower() == ".svg":
        return path.exists() and not _is_swatch(path)
    if path.suffix.lower() in (".toml", *COMPILED):
        return False
    try:
        with path.open("rb") as file:
            head = file.read(SNIFFED)
    except (OSError, ValueError):
        return False
    if b"\0" in head or head.startswith((b"\xff\xd8\xff", b"GIF8", b"%!PS", b"%PDF")):
        raise _fault(source, "is neither a recipe (.toml) nor an SVG drawing")
    return head.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<")


def _is_swatch(path: Path) -> bool:
    from batik_vector.export.provenance import NAMESPACE
    from batik_vector.export.swatch import LABEL

    try:
        data = path.read_bytes()
    except OSError:
        return False
    return all(each.encode() in data for each in (NAMESPACE, f'="{LABEL}"'))


def _fault(source: str, words: str) -> RecipeError:
    return RecipeError([Fault(words, source=source)])
