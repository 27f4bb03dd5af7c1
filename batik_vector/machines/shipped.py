"""The profiles that come with the program: a page of TOML each, in `profiles/`."""

from __future__ import annotations

from pathlib import Path

_FOLDER = Path(__file__).parent / "profiles"

MACHINES = tuple(sorted(path.stem for path in _FOLDER.glob("*.toml")))
"""Their names."""


def shipped_text(name: str) -> str:
    """Return the profile of that name.

    Raises:
        KeyError: where there is none.
    """
    if name not in MACHINES:
        raise KeyError(name)
    return (_FOLDER / f"{name}.toml").read_text(encoding="utf-8")
