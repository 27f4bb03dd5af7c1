"""The samples and the starters: patterns that every library holds, and nobody can change.

What was measured of them stands in ``included.jsonl`` beside this file, a line for each, so that they are
found by their features at once; ``make golden`` writes it. Their recipes are part of the package.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
MEASURED = HERE / "included.jsonl"
FOLDERS = {
    "sample": (HERE / "samples", HERE.parents[1] / "samples"),
    "starter": (HERE.parent / "starters",),
}
"""Where recipes of each kind lie: in the installed package, or where it is worked on."""


@dataclass(frozen=True)
class Included:
    """A sample or a starter: sample/kawung, its recipe's file, and what was measured of it."""

    name: str
    path: Path
    features: dict[str, Any]


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


def known() -> dict[str, tuple[str, dict[str, Any]]]:
    """Return the digest of each recipe when it was measured, and its features, by name."""
    found = {}
    for line in MEASURED.read_text(encoding="utf-8").splitlines() if MEASURED.exists() else ():
        each = json.loads(line)
        found[each["name"]] = each["digest"], each["features"]
    return found


def included() -> Iterator[Included]:
    """Yield all of them; what has changed since it was measured has no features."""
    measured = known()
    for name, path in paths():
        before, features = measured.get(name, ("", {}))
        yield Included(name, path, features if before == digest(path) else {})


def written(features: dict[str, dict[str, Any]]) -> str:
    """Return the page of what was measured, by names."""
    lines = [
        json.dumps({"name": name, "digest": digest(path), "features": features[name]}, ensure_ascii=False)
        for name, path in paths()
        if name in features
    ]
    return "".join(f"{line}\n" for line in lines)
