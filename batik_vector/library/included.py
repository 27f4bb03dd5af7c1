"""The samples and the starters: patterns that every library holds, and nobody can change.

What was measured of them stands in ``included.jsonl`` beside this file, a line for each, so that they are
found by their features at once, and small pictures in ``thumbnails``, so that they are seen at once; ``make
golden`` writes both. Their recipes are part of the package.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from batik_vector.library.values import Page, page_of

if TYPE_CHECKING:
    from batik_vector import Recipe

HERE = Path(__file__).parent
MEASURED = HERE / "included.jsonl"
THUMBNAILS = HERE / "thumbnails"
DIGEST = "Recipe"
"""Under which name a small picture has the digest of its recipe."""
FOLDERS = {
    "sample": (HERE / "samples", HERE.parents[1] / "samples"),
    "starter": (HERE.parent / "starters",),
}
"""Where recipes of each kind lie: in the installed package, or where it is worked on."""


def paths() -> Iterator[tuple[str, Path]]:
    """Yield the names and the files of all samples and starters."""
    for kind, folders in FOLDERS.items():
        folder = next((each for each in folders if each.is_dir()), None)
        for path in sorted(folder.glob("*.toml")) if folder else ():
            yield f"{kind}/{path.stem}", path


def state() -> str:
    """Return what changes whenever they do: the digest of what was measured of them."""
    return hashlib.sha256(MEASURED.read_bytes()).hexdigest() if MEASURED.exists() else ""


def digest(path: Path) -> str:
    """Return the digest of a recipe's file, and of the drawings beside it that it names."""
    text = path.read_text(encoding="utf-8").replace("\r\n", "\n")
    parts = [text]
    parts += [
        each.read_text(encoding="utf-8").replace("\r\n", "\n")
        for each in sorted(path.parent.glob("*.svg"))
        if f'"{each.name}"' in text
    ]
    return hashlib.sha256("\0".join(parts).encode("utf-8")).hexdigest()


def thumbnail_path(name: str) -> Path:
    """Return where the small picture of a recipe is kept."""
    return THUMBNAILS / f"{name}.png"


def thumbnail(name: str, text: str | None = None) -> bytes:
    """Return the small picture of a recipe as PNG; empty where none was drawn of what it says now.

    Args:
        name: of a sample or a starter, or of anything else.
        text: of the recipe as it is to be shown; as its file has it when left out.
    """
    path = dict(paths()).get(name)
    kept = thumbnail_path(name)
    if path is None or not kept.is_file():
        return b""
    if text is not None and text != path.read_text(encoding="utf-8").replace("\r\n", "\n"):
        return b""
    data = kept.read_bytes()
    return data if f"{DIGEST}\0{digest(path)}".encode() in data[:400] else b""


@dataclass(frozen=True)
class Known:
    """What is known of a recipe: the digest it had then, its title, if it has drawings, and its features."""

    digest: str
    title: str
    drawn: bool
    features: dict[str, Any]


def known() -> dict[str, Known]:
    """Return what is known of each recipe, by name."""
    found = {}
    for line in MEASURED.read_text(encoding="utf-8").splitlines() if MEASURED.exists() else ():
        each = json.loads(line)
        found[each["name"]] = Known(each["digest"], each["title"], each["drawn"], each["features"])
    return found


def included() -> Iterator[tuple[str, Page, dict[str, Any]]]:
    """Yield all of them by name, with what was measured; what has changed since then has no features."""
    before = known()
    for name, path in paths():
        each = before.get(name)
        fresh = each is not None and each.digest == digest(path)
        features = each.features if each is not None and fresh else {}
        if each is None or not fresh or each.drawn:
            from batik_vector import load_recipe

            yield name, page_of(load_recipe(path)), features
        else:
            # To read all recipes takes a second, and nothing more of them is asked than their text.
            yield name, Page(each.title, path.read_text(encoding="utf-8").replace("\r\n", "\n"), {}), features


def written(found: dict[str, tuple[Recipe, dict[str, Any]]]) -> str:
    """Return the page of what is known, by names of recipes and what was measured of them."""
    lines = []
    for name, path in paths():
        if name in found:
            recipe, features = found[name]
            about: dict[str, Any] = {"name": name, "digest": digest(path), "title": recipe.title}
            about |= {"drawn": bool(recipe.drawing), "features": features}
            lines.append(json.dumps(about, ensure_ascii=False))
    return "".join(f"{line}\n" for line in lines)
