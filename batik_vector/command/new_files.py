"""Files that a command makes: they replace nothing unless they are told to."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path

from batik_vector.errors import ExportError
from batik_vector.export.files import write_all_whole

_ODD = re.compile(r"[^\w.+-]+")


def new_file(path: str | None, name: str, suffix: str, force: bool) -> Path:
    """Return where a new file goes.

    Args:
        path: as it was asked for, a file or a folder that is there; None for a file in this folder.
        name: what it is called unless a path says so.
        suffix: that it then has.
        force: whether a file that is there is replaced.

    Raises:
        ExportError: where there is a file already, or there can be none.
    """
    own = f"{_ODD.sub('-', name).strip('.-') or 'new'}{suffix}"
    target = Path(own) if path is None else Path(path)
    try:
        if path is not None and target.is_dir():
            target /= own
        if os.path.lexists(target) and not force:
            raise ExportError(f"{target} is there already: --force replaces it")
        if not target.parent.is_dir():
            raise ExportError(f'{target} cannot be written: there is no folder "{target.parent}"')
    except (OSError, ValueError) as error:
        raise ExportError(f"{target} cannot be written: {error}") from error
    return target


def write_new(files: Mapping[Path, bytes], force: bool) -> None:
    """Write new files, all or none; see :func:`new_file`.

    Raises:
        ExportError: where one cannot be written, or is there.
    """
    for path in files:
        if os.path.lexists(path) and not force:
            raise ExportError(f"{path} is there already: --force replaces it")
    write_all_whole(list(files.items()))
