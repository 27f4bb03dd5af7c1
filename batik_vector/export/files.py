"""Files are written whole or not at all.

Every file is written beside its place first, is forced to the disk, and only then takes the place, in one
step. Several files that belong together are all written before the first is moved; where a move fails, those
before it are undone. Whatever stops the work, Ctrl-C included, what was there before is there afterwards, and
nothing beside it.

Where the system can (Linux, on all but a few file systems) a file has no name until it is whole, so that
nothing stays of it even where the process is killed; elsewhere it is a hidden neighbour of its place.
"""

from __future__ import annotations

import contextlib
import errno
import io
import os
import stat
import threading
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, BinaryIO, TypeAlias

from batik_vector.errors import ExportError

Content: TypeAlias = bytes | Callable[[BinaryIO], object]
"""What goes into a file: its bytes, or what writes them into a sink, which may be seeked."""
BUFFER = 1 << 20
"""Bytes gathered before the system is asked to write them."""
OPEN_HANDLES = "/proc/self/fd"
"""Where Linux lists the open files of a process, those without a name too."""
CAN_BE_NAMELESS = hasattr(os, "O_TMPFILE") and os.link in os.supports_dir_fd and os.path.isdir(OPEN_HANDLES)
CHMOD_TAKES_HANDLES = os.chmod in os.supports_fd
NEEDS_A_NAME = (errno.EOPNOTSUPP, errno.EISDIR, errno.EINVAL, errno.ENOENT)
"""How a system says that a file needs a name."""


def write_whole(path: str | os.PathLike[str], data: Content) -> None:
    """Write a file, or leave what was there.

    Raises:
        ExportError: naming the path and the reason.
    """
    write_all_whole([(path, data)])


def write_all_whole(files: Iterable[tuple[str | os.PathLike[str], Content]], *, forced: bool = True) -> None:
    """Write several files, or leave what was there in place of each.

    Without ``forced`` they are not forced to the disk before they take their places: no end of the process
    costs more for that, but a failing system may leave them empty. That is for what is looked through anyway.

    Whatever one that writes its own content raises leaves everything as it was, and goes on to the caller.

    Raises:
        ExportError: naming the path that failed and the reason.
    """
    work = [(Path(path), data) for path, data in files]
    places = {os.path.realpath(path) for path, _ in work}
    if len(places) < len(work):
        raise ExportError("two outputs would have the same path")
    batch = _Batch(forced)
    _at_work.append(batch)
    try:
        for path, data in work:
            with _named(path):
                batch.write(path, data)
        with _placing:
            for path, _ in work:
                with _named(path):
                    batch.place(path)
    except BaseException:
        with _placing:
            batch.undo()
        raise
    else:
        batch.done()
    finally:
        _at_work.remove(batch)


_at_work: list[_Batch] = []
_placing = threading.RLock()
"""Held while files take their places, which is never long."""


@contextlib.contextmanager
def abandoned() -> Iterator[None]:
    """Clear away what is half written, for a process that is to end inside while another thread works on.

    Files that are taking their places do so first, all of them.
    """
    with _placing:
        for batch in _at_work:
            batch.done()
        yield


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

    def __init__(self, forced: bool) -> None:
        self._forced = forced
        self._temps: dict[Path, Path] = {}
        self._handles: dict[Path, int] = {}
        self._backups: dict[Path, Path] = {}
        self._fresh: set[Path] = set()

    def write(self, path: Path, data: Content) -> None:
        """Write a file beside its path, without a name where that can be."""
        mode = _mode(path)
        temp = self._temps[path] = _neighbour(path)
        nameless = _opened_nameless(path)
        handle = _opened(temp) if nameless is None else nameless
        try:
            if isinstance(data, bytes):
                _write(handle, data)
            else:
                with io.BufferedWriter(_Raw(handle), BUFFER) as sink:
                    data(sink)
            if mode is not None:
                os.chmod(handle if CHMOD_TAKES_HANDLES else temp, mode)
            if self._forced:
                os.fsync(handle)
            if nameless is not None:
                self._handles[path] = handle
        finally:
            if path not in self._handles:
                os.close(handle)

    def place(self, path: Path) -> None:
        """Move what was written to its place, keeping what was there until all is done."""
        if path in self._handles:
            _give_name(self._handles[path], self._temps[path])
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
        """Remove every neighbour that is left, and let go of what has no name."""
        for leftover in (*self._temps.values(), *self._backups.values()):
            with contextlib.suppress(OSError):
                leftover.unlink()
        while self._handles:
            with contextlib.suppress(OSError):
                os.close(self._handles.popitem()[1])


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


def _opened(path: Path) -> int:
    """Open a new file."""
    return os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o666)


def _opened_nameless(path: Path) -> int | None:
    """Open a file without a name on the file system of a path; None where it could never be given one."""
    if not CAN_BE_NAMELESS:
        return None
    try:
        return os.open(path.parent, os.O_RDWR | os.O_TMPFILE, 0o666)
    except OSError as error:
        if error.errno in NEEDS_A_NAME:
            return None
        raise


def _give_name(handle: int, path: Path) -> None:
    """Name a file that has none (open(2), O_TMPFILE); where there are no links, a copy of it."""
    listed = os.open(OPEN_HANDLES, os.O_RDONLY)
    try:
        os.link(str(handle), path, src_dir_fd=listed, follow_symlinks=True)
    except OSError:
        _copy(handle, path)
    finally:
        os.close(listed)


def _copy(handle: int, path: Path) -> None:
    """Write a new file that holds what an open one does, and may what that may."""
    copy = _opened(path)
    try:
        os.lseek(handle, 0, os.SEEK_SET)
        while part := os.read(handle, BUFFER):
            _write(copy, part)
        os.chmod(copy, stat.S_IMODE(os.fstat(handle).st_mode))
        os.fsync(copy)
    finally:
        os.close(copy)


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
