from __future__ import annotations

import errno
import os
import stat
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, BinaryIO

import pytest

from batik_vector.errors import ExportError
from batik_vector.export import files
from batik_vector.export.files import BUFFER, write_all_whole, write_whole


def inside(folder: Path) -> dict[str, bytes]:
    return {p.name: p.read_bytes() for p in folder.iterdir() if p.is_file()}


def fail(monkeypatch: pytest.MonkeyPatch, name: str, error: BaseException, after: int = 0) -> None:
    """Let a function of os work some times, then fail once."""
    real, calls = getattr(os, name), iter(range(10**6))

    def stand_in(*args: Any, **named: Any) -> Any:
        if next(calls) == after:
            raise error
        return real(*args, **named)

    monkeypatch.setattr(os, name, stand_in)


def test_a_file_is_written_and_replaced(tmp_path: Path) -> None:
    write_whole(tmp_path / "a", b"one")
    write_whole(str(tmp_path / "a"), b"two" * 100_000)
    assert inside(tmp_path) == {"a": b"two" * 100_000}


def test_short_writes_are_continued(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    real = os.write
    monkeypatch.setattr(os, "write", lambda handle, data: real(handle, bytes(data[:3])))
    write_whole(tmp_path / "a", b"0123456789")
    assert inside(tmp_path) == {"a": b"0123456789"}


@pytest.mark.skipif(sys.platform == "win32", reason="permissions of POSIX")
def test_permissions_are_the_users(tmp_path: Path) -> None:
    before = os.umask(0o027)
    try:
        write_whole(tmp_path / "new", b"x")
        assert stat.S_IMODE((tmp_path / "new").stat().st_mode) == 0o640
        (tmp_path / "new").chmod(0o604)
        write_whole(tmp_path / "new", b"y")
        assert stat.S_IMODE((tmp_path / "new").stat().st_mode) == 0o604
    finally:
        os.umask(before)


FAULTS = [
    ("open", PermissionError(errno.EACCES, "Permission denied"), "Permission denied"),
    ("open", OSError(errno.EROFS, "Read-only file system"), "Read-only"),
    ("write", OSError(errno.ENOSPC, "No space left on device"), "No space left"),
    ("fsync", OSError(errno.EIO, "Input/output error"), "Input/output"),
    ("replace", PermissionError(errno.EPERM, "Operation not permitted"), "not permitted"),
]


@pytest.mark.parametrize(("name", "error", "words"), FAULTS)
def test_a_failure_leaves_what_was_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, error: OSError, words: str
) -> None:
    (tmp_path / "a").write_bytes(b"before")
    fail(monkeypatch, name, error)
    with pytest.raises(ExportError, match=words) as caught:
        write_whole(tmp_path / "a", b"after")
    assert str(tmp_path / "a") in str(caught.value)
    assert inside(tmp_path) == {"a": b"before"}


@pytest.mark.parametrize("name", ["write", "fsync", "close", "chmod", "replace", "link"])
@pytest.mark.parametrize("after", [0, 1])
def test_an_interrupt_leaves_what_was_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, after: int
) -> None:
    for old in ("a", "b"):
        (tmp_path / old).write_bytes(b"before")
    fail(monkeypatch, name, KeyboardInterrupt(), after)
    with pytest.raises(KeyboardInterrupt):
        write_all_whole([(tmp_path / "a", b"1"), (tmp_path / "b", b"2"), (tmp_path / "c", b"3")])
    monkeypatch.undo()
    assert inside(tmp_path) == {"a": b"before", "b": b"before"}


def test_an_interrupt_after_the_last_move_undoes_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a").write_bytes(b"before")
    real, calls = os.replace, iter(range(9))

    def late(source: Any, target: Any) -> None:
        real(source, target)
        if next(calls) == 1:
            raise KeyboardInterrupt

    monkeypatch.setattr(os, "replace", late)
    with pytest.raises(KeyboardInterrupt):
        write_all_whole([(tmp_path / "a", b"1"), (tmp_path / "b", b"2")])
    assert inside(tmp_path) == {"a": b"before"}


@pytest.mark.parametrize("after", [1, 2])
def test_when_one_move_fails_those_before_are_undone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, after: int
) -> None:
    (tmp_path / "a").write_bytes(b"before")
    real, calls = os.replace, iter(range(9))

    def stand_in(source: Any, target: Any) -> None:
        if next(calls) == after:
            raise OSError(errno.EIO, "Input/output error")
        real(source, target)

    monkeypatch.setattr(os, "replace", stand_in)
    with pytest.raises(ExportError, match="Input/output"):
        write_all_whole([(tmp_path / "a", b"1"), (tmp_path / "b", b"2"), (tmp_path / "c", b"3")])
    assert inside(tmp_path) == {"a": b"before"}


def test_several_files_are_written(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"before")
    write_all_whole([(tmp_path / "a", b"1"), (tmp_path / "b", b"")])
    assert inside(tmp_path) == {"a": b"1", "b": b""}


def test_without_links_files_are_still_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a").write_bytes(b"before")
    fail(monkeypatch, "link", OSError(errno.EPERM, "no links"))
    write_all_whole([(tmp_path / "a", b"1"), (tmp_path / "b", b"2")])
    assert inside(tmp_path) == {"a": b"1", "b": b"2"}


def without_links(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*args: Any, **named: Any) -> None:
        raise OSError(errno.EPERM, "no links")

    monkeypatch.setattr(os, "link", refuse)


def without_nameless_files(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "CAN_BE_NAMELESS", False)


@pytest.mark.skipif(sys.platform == "win32", reason="permissions of POSIX")
@pytest.mark.parametrize("less", [without_links, without_nameless_files])
def test_a_system_that_can_do_less_writes_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, less: Callable[[pytest.MonkeyPatch], None]
) -> None:
    (tmp_path / "a").write_bytes(b"before")
    (tmp_path / "a").chmod(0o604)
    less(monkeypatch)
    write_all_whole([(tmp_path / "a", halves), (tmp_path / "b", b"2")])
    assert inside(tmp_path) == {"a": b"two" + b"end" * 500_000, "b": b"2"}
    assert stat.S_IMODE((tmp_path / "a").stat().st_mode) == 0o604


@pytest.mark.skipif(not files.CAN_BE_NAMELESS, reason="files without names, of Linux")
def test_a_file_has_no_name_until_all_are_whole(tmp_path: Path) -> None:
    seen: list[dict[str, bytes]] = []

    def looking(sink: BinaryIO) -> None:
        sink.write(b"x" * (BUFFER + 1))
        seen.append(inside(tmp_path))

    write_all_whole([(tmp_path / "a", looking), (tmp_path / "b", looking)])
    assert seen == [{}, {}]
    assert sorted(inside(tmp_path)) == ["a", "b"]


def test_a_thread_that_ends_the_process_clears_away_what_is_half_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    without_nameless_files(monkeypatch)
    seen: list[int] = []

    def abandon(sink: BinaryIO) -> None:
        seen.append(len(inside(tmp_path)))
        with files.abandoned():
            seen.append(len(inside(tmp_path)))
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_whole(tmp_path / "a", abandon)
    assert seen == [1, 0]
    assert inside(tmp_path) == {}


def test_nothing_is_written_when_one_place_cannot_be(tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    with pytest.raises(ExportError, match="it is a folder"):
        write_all_whole([(tmp_path / "a", b"1"), (tmp_path / "sub", b"2")])
    with pytest.raises(ExportError, match="No such file or directory"):
        write_all_whole([(tmp_path / "a", b"1"), (tmp_path / "none" / "b", b"2")])
    with pytest.raises(ExportError, match="same path"):
        write_all_whole([(tmp_path / "a", b"1"), (tmp_path / "sub" / ".." / "a", b"2")])
    assert inside(tmp_path) == {}


@pytest.mark.skipif(sys.platform == "win32", reason="links of POSIX")
def test_links_are_neither_followed_nor_broken(tmp_path: Path) -> None:
    (tmp_path / "real").write_bytes(b"before")
    (tmp_path / "link").symlink_to("real")
    with pytest.raises(ExportError, match="symbolic link"):
        write_whole(tmp_path / "link", b"x")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_bytes() == b"before"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes of POSIX")
def test_pipes_are_refused(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(ExportError, match="no plain file"):
        write_whole(tmp_path / "pipe", b"x")


def halves(sink: BinaryIO) -> None:
    """Write a file from its middle, and its beginning at last."""
    sink.write(b"..." + b"end" * 500_000)
    sink.seek(0)
    sink.write(b"two")


def test_what_writes_itself_may_go_back(tmp_path: Path) -> None:
    write_all_whole([(tmp_path / "a", halves), (tmp_path / "b", b"1")])
    assert inside(tmp_path) == {"a": b"two" + b"end" * 500_000, "b": b"1"}


def test_short_writes_of_what_writes_itself_are_continued(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = os.write
    monkeypatch.setattr(os, "write", lambda handle, data: real(handle, bytes(data[:100_000])))
    write_whole(tmp_path / "a", halves)
    assert inside(tmp_path) == {"a": b"two" + b"end" * 500_000}


@pytest.mark.parametrize("after", [0, 1])
def test_a_disk_that_fills_while_a_file_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, after: int
) -> None:
    (tmp_path / "a").write_bytes(b"before")
    fail(monkeypatch, "write", OSError(errno.ENOSPC, "No space left on device"), after)
    with pytest.raises(ExportError, match="No space left"):
        write_whole(tmp_path / "a", halves)
    assert inside(tmp_path) == {"a": b"before"}
