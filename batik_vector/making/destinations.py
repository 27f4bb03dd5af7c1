"""Where the files of a recipe go: into their folders, to a stream, or nowhere."""

from __future__ import annotations

import contextlib
import io
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, BinaryIO, TypeAlias

from batik_vector.errors import ExportError
from batik_vector.export import write_all_whole

Files: TypeAlias = Sequence[tuple[Path, Callable[[BinaryIO], None]]]
"""Files, each with what writes it."""
Destination: TypeAlias = Callable[[Files], None]
IN_MEMORY = 32 << 20
"""Bytes of a file that are kept in memory until it is whole."""


def into_folders(files: Files, *, forced: bool = True) -> None:
    """Write all files or none; folders made for them go again where nothing comes of it.

    ``forced`` is as for :func:`~batik_vector.export.write_all_whole`.
    """
    fresh: list[Path] = []
    for path, _ in files:
        fresh += make_folder(path.parent)
    try:
        write_all_whole(files, forced=forced)
    except BaseException:
        for folder in fresh:
            with contextlib.suppress(OSError):
                folder.rmdir()
        raise


def check_folder(folder: Path) -> None:
    """Raise where a folder cannot be written to, or could not be made.

    Raises:
        ExportError: saying what stands there.
    """
    there = next(each for each in (folder, *folder.parents, Path()) if os.path.lexists(each))
    if not there.is_dir():
        raise ExportError(f"{there} is a file, expected a folder")
    if not os.access(there, os.W_OK | os.X_OK):
        raise ExportError(f"{there} may not be written to")


def make_folder(folder: Path) -> list[Path]:
    """Make a folder and those above it; return those that were not there, the innermost first.

    Raises:
        ExportError: naming what could not be made.
    """
    missing = [each for each in (folder, *folder.parents) if not each.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ExportError(f"{error.filename} could not be made: {error.strerror}") from error
    return missing


def nowhere(files: Files) -> None:
    """Make all files and keep none."""
    for _, write in files:
        with io.BufferedWriter(_Nothing()) as sink:
            write(sink)


def onto(stream: BinaryIO) -> Destination:
    """Return what writes the one file that there is to a stream, once it is whole.

    Raises:
        ExportError: where there are several files.
    """

    import shutil
    import tempfile

    def written(files: Files) -> None:
        if len(files) > 1:
            names = ", ".join(path.name for path, _ in files[:3])
            raise ExportError(f"{len(files)} files ({names} …), expected one: standard output holds no more")
        with tempfile.SpooledTemporaryFile(IN_MEMORY) as whole:
            for _, write in files:
                write(whole)  # type: ignore[arg-type]
            whole.seek(0)
            shutil.copyfileobj(whole, stream)
            stream.flush()

    return written


class _Nothing(io.RawIOBase):
    """A file that forgets what is written, and knows how far it would reach."""

    def __init__(self) -> None:
        self._at = self._end = 0

    def writable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def seek(self, offset: int, whence: int = os.SEEK_SET) -> int:
        self._at = offset + {os.SEEK_SET: 0, os.SEEK_CUR: self._at, os.SEEK_END: self._end}[whence]
        return self._at

    def write(self, data: Any) -> int:
        self._at += len(data)
        self._end = max(self._end, self._at)
        return len(data)
