"""Files are written whole or not at all.

Every file goes to a hidden neighbour of its place first, is forced to the disk, and only then takes the
place, in one step. Several files that belong together are all written before the first is moved; where a
move fails, those before it are undone. Whatever stops the work, Ctrl-C included, what was there before is
there afterwards, and nothing beside it.
"""

from __future__ import annotations

import contextlib
import io
import os
import stat
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, BinaryIO, TypeAlias

from batik_vector.errors import ExportError

Content: TypeAlias = bytes | Callable[[BinaryIO], object]
"""What goes into a file: its bytes, or what writes them into a sink, which may be seeked."""
BUFFER = 1 << 20
"""Bytes gathered before the system is asked to write them."""


def write_whole(path: str | os.PathLike[str], data: Content) -> None:
    """Write a file, or leave what was there.

    Raises:
        ExportError: naming the path and the reason.
    """
    write_all_whole([(path, data)])


def write_all_whole(files: Iterable[tuple[str | os.PathLike[str], Content]]) -> None:
    """Write several files, or leave what was there in place of each.

    Whatever one that writes its own content raises leaves everything as it was, and goes on to the caller.

    Raises:
        ExportError: naming the path that failed and the reason.
    """
    work = [(Path(path), data) for path, data in files]
    places = {os.path.realpath(path) for path, _ in work}
    if len(places) < len(work):
        raise ExportError("two outputs would have the same path")
    batch = _Batch()
    try:
        for path, data in work:
            with _named(path):
                batch.write(path, data)
        for path, _ in work:
            with _named(path):
                batch.place(path)
    except BaseException:
        batch.undo()
        raise
    batch.done()


@contextlib.contextmanager
def _named(path: Path) -> Iterator[None]:
    """Turn the system's errors into ours, with the path."""
    try:
        yield
    except OSError as error:
        reason = error.strerror or str(error)
        raise ExportError(f"{path} could not be written: {reason}") from error


class _Batch:
    """The files of one call and how far each has come.

    An interrupt may come between any two steps, so every name is entered before the thing exists.
    """

    def __init__(self) -> None:
        self._temps: dict[Path, Path] = {}
        self._backups: dict[Path, Path] = {}
        self._fresh: set[Path] = set()

    def write(self, path: Path, data: Content) -> None:
        """Write the neighbour of a path."""
        mode = _mode(path)
        temp = self._temps[path] = _neighbour(path)
        handle = os.open(temp, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o666)
        try:
            if isinstance(data, bytes):
                _write(handle, data)
            else:
                with io.BufferedWriter(_Raw(handle), BUFFER) as sink:
                    data(sink)
            os.fsync(handle)
        finally:
            os.close(handle)
        if mode is not None:
            os.chmod(temp, mode)

    def place(self, path: Path) -> None:
        """Move the neighbour to its place, keeping what was there until all is done."""
        if _mode(path) is None:
            self._fresh.add(path)
        elif len(self._temps) > 1:
            backup = self._backups[path] = _neighbour(path)
            # Some file systems have no links: there the moves cannot be undone, but each is still whole.
            with contextlib.suppress(OSError):
                os.link(path, backup)
        os.replace(self._temps[path], path)

    def undo(self) -> None:
        """Put back what was there, and leave nothing behind."""
        for path, temp in self._temps.items():
            if os.path.lexists(temp):
                continue
            with contextlib.suppress(OSError):
                if path in self._fresh:
                    path.unlink()
                elif path in self._backups:
                    os.replace(self._backups[path], path)
        self.done()

    def done(self) -> None:
        """Remove every neighbour that is left."""
        for leftover in (*self._temps.values(), *self._backups.values()):
            with contextlib.suppress(OSError):
                leftover.unlink()


class _Raw(io.RawIOBase):
    """An open file, for a buffer to write to. Closing it leaves the file open."""

    def __init__(self, handle: int) -> None:
        self._handle = handle

    def writable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def seek(self, offset: int, whence: int = os.SEEK_SET) -> int:
        return os.lseek(self._handle, offset, whence)

    def write(self, data: Any) -> int:
        return os.write(self._handle, data)


def _neighbour(path: Path) -> Path:
    return path.with_name(f".batik-{os.urandom(8).hex()}.tmp")


def _write(handle: int, data: bytes) -> None:
    rest = memoryview(data)
    while rest:
        rest = rest[os.write(handle, rest) :]


def _mode(path: Path) -> int | None:
    """Return the permissions of the file that will be replaced, None where there is none.

    A link is refused: to follow it may write where nobody looks, to replace it would break it.
    """
    try:
        found = os.lstat(path)
    except FileNotFoundError:
        return None
    if stat.S_ISREG(found.st_mode):
        return stat.S_IMODE(found.st_mode)
    what = {stat.S_IFDIR: "a folder", stat.S_IFLNK: "a symbolic link"}.get(
        stat.S_IFMT(found.st_mode), "no plain file"
    )
    raise ExportError(f"{path} could not be written: it is {what}")
