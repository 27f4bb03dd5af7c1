"""Prints the oldest versions that pyproject.toml allows, as constraints for pip: ``numpy==1.26``."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent / "pyproject.toml"


def lowest(text: str) -> Iterator[str]:
    """Yield a constraint for each requirement of a pyproject.toml, those of its extras included.

    Raises:
        ValueError: naming a requirement that has no lowest version.
    """
    project = tomllib.loads(text)["project"]
    extras = project.get("optional-dependencies", {}).values()
    for requirement in (*project["dependencies"], *(each for extra in extras for each in extra)):
        found = re.fullmatch(r"([A-Za-z0-9._-]+)>=([0-9.]+)", requirement)
        if found is None:
            raise ValueError(f'"{requirement}": expected a name and its lowest version, as "numpy>=1.26"')
        yield f"{found[1]}=={found[2]}"


if __name__ == "__main__":
    print(*lowest(PROJECT.read_text(encoding="utf-8")), sep="\n")
