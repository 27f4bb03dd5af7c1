"""Where the library is: in the user's data folder, unless a call or a variable says otherwise."""

from __future__ import annotations

import os
from pathlib import Path

VARIABLE = "BATIK_LIBRARY"
"""The variable of the environment that names another file."""
FILE = "patterns.batik-library"
"""What the file is called in the data folder."""


def place(path: str | os.PathLike[str] | None = None) -> tuple[Path, bool]:
    """Return where the library is, and whether that was asked for by name.

    Args:
        path: of the file; the variable's when left out, or else the user's own.
    """
    asked = os.fspath(path) if path is not None else os.environ.get(VARIABLE, "")
    if asked:
        return Path(asked).expanduser(), True
    # What an explicit file can do without.
    from platformdirs import user_data_path

    return user_data_path("batik-vector", appauthor=False) / FILE, False
