"""What is open survives: every step of every draft is in a file before the next one is made.

    with Journal() as journal:
        desk = journal.begin(Draft.read("kawung.toml"))
        desk.did(desk.draft.with_value("seed", 3), "seed")

Each draft that is open has a file of its own in the user's state folder, to which steps are only ever added,
a line each. A process that is killed loses at most the step it was about to write: a line that is not whole
is not read, nor what comes behind it. Where the file has grown it is written anew, whole or not at all. A
draft is held by one process at a time, by a second file that is locked: another studio sees that it is in
use, and leaves it alone.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import secrets
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, BinaryIO

from batik_vector.errors import BatikError, ExportError
from batik_vector.export.files import write_whole
from batik_vector.studio.drafts import Draft
from batik_vector.studio.history import HELD, History, Patch, Step
from batik_vector.studio.holding import held_alone, let_go
from batik_vector.values import frozen

VARIABLE = "BATIK_STUDIO"
"""The variable of the environment that names another folder."""
SUFFIX, LOCK = ".desk", ".lock"
GROWN = 1 << 20
"""Bytes past which a file is written anew, where its steps have become fewer since."""
_NAME = re.compile(r"[a-z0-9]{16}\Z")


class InUseError(BatikError):
    """A draft that is open in another studio."""


@frozen
class Kept:
    """A draft that is kept: its title, when it was changed in seconds since 1970, whether it is open."""

    key: str
    title: str
    changed: float
    in_use: bool


class Journal:
    """The drafts that are open, in a folder."""

    def __init__(self, folder: str | os.PathLike[str] | None = None) -> None:
        """Open a journal.

        Args:
            folder: where it is; that of the variable ``BATIK_STUDIO``, or else the user's own, when left out.

        Raises:
            ExportError: where the folder cannot be made.
        """
        self.folder = Path(folder) if folder is not None else _own_folder()
        try:
            self.folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        except OSError as error:
            raise ExportError(f"{self.folder} could not be made: {error.strerror}") from error
        self._open: dict[str, Desk] = {}

    def begin(self, draft: Draft, notes: Mapping[str, Any] | None = None) -> Desk:
        """Return a desk with a draft on it.

        Args:
            draft: to begin with.
            notes: what is to be known of it besides, plain values: where it was saved, and as which version.
        """
        key = secrets.token_hex(8)
        desk = Desk(self, key, History(draft), dict(notes or {}))
        self._open[key] = desk
        return desk

    def kept(self) -> list[Kept]:
        """Return the drafts that are kept, the latest first; files that hold none are passed over."""
        found = []
        for path in self.folder.glob(f"*{SUFFIX}"):
            if not _NAME.match(path.stem):
                continue
            try:
                history, _ = _read(path)
                changed = path.stat().st_mtime
            except (OSError, ValueError):
                continue
            in_use = path.stem in self._open or not _free(path.with_suffix(LOCK))
            found.append(Kept(path.stem, history.now.title, changed, in_use))
        return sorted(found, key=lambda each: -each.changed)

    def restore(self, key: str) -> Desk:
        """Return the desk of a draft that is kept, all steps there; the same one where it is open here.

        Raises:
            InUseError: where another studio has it open.
            ExportError: where there is none.
        """
        if key in self._open:
            return self._open[key]
        path = self.folder / f"{key}{SUFFIX}"
        if not _NAME.match(key) or not path.exists():
            raise ExportError(f"there is no draft {key[:32]}: it was closed, or never kept")
        desk = Desk(self, key, None, {})
        self._open[key] = desk
        return desk

    def forget(self, key: str) -> None:
        """Remove a draft that is kept and open nowhere.

        Raises:
            InUseError: where a studio has it open.
        """
        path = self.folder / f"{key}{SUFFIX}"
        if not _NAME.match(key):
            return
        if key in self._open or not _free(path.with_suffix(LOCK)):
            raise InUseError("the draft is open: close it first")
        path.unlink(missing_ok=True)
        path.with_suffix(LOCK).unlink(missing_ok=True)

    def left(self, key: str) -> None:
        """Take note that a desk was closed."""
        self._open.pop(key, None)

    def close(self) -> None:
        """Close all desks; their drafts stay kept."""
        for desk in list(self._open.values()):
            desk.close()

    def __enter__(self) -> Journal:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class Desk:
    """A draft that is open with all its steps, each of which is in its file when the call returns."""

    def __init__(self, journal: Journal, key: str, history: History | None, notes: dict[str, Any]) -> None:
        """Open a desk; see :meth:`Journal.begin` and :meth:`Journal.restore`."""
        self.key = key
        self._journal = journal
        self.path = journal.folder / f"{key}{SUFFIX}"
        self._lock = _held_lock(self.path.with_suffix(LOCK))
        self._file: BinaryIO | None = None
        self._bytes = 0
        try:
            if history is None:
                history, notes = _read(self.path)
            self.history, self.notes = history, notes
            # Read or begun, it is written whole: what stands behind the last whole line would spoil the next.
            self.write_anew()
        except (OSError, ValueError) as error:
            self._shut()
            raise ExportError(f"{self.path} holds no draft: {error}") from error
        except BaseException:
            self._shut()
            raise

    @property
    def draft(self) -> Draft:
        """The draft as it is now."""
        return self.history.now

    def did(self, draft: Draft, label: str, merge: str = "") -> Draft:
        """Take up a change; see :meth:`History.did`."""
        before = self.history.now
        if draft == before:
            return draft
        told = {"did": _step_told(before, draft), "label": label, "merge": merge}
        self.history.did(draft, label, merge)
        self._add(told)
        return draft

    def undo(self) -> Draft:
        """Take a step back; see :meth:`History.undo`."""
        self.history.undo()
        self._add({"undo": True})
        return self.draft

    def redo(self) -> Draft:
        """Do a step again; see :meth:`History.redo`."""
        self.history.redo()
        self._add({"redo": True})
        return self.draft

    def settle(self) -> None:
        """End the step that is under way, and have the disk keep all that was written."""
        self.history.settle()
        self._add({"settle": True})
        if self._file is not None:
            with contextlib.suppress(OSError):
                os.fsync(self._file.fileno())

    def note(self, **notes: Any) -> None:
        """Take note of something beside the draft, plain values: ``library="kawung", version=3``."""
        self.notes |= notes
        self._add({"notes": notes})

    def close(self, *, forget: bool = False) -> None:
        """Close the desk; its draft stays kept, unless it is to be forgotten."""
        self._journal.left(self.key)
        if forget:
            self._close_file()
            self.path.unlink(missing_ok=True)
        self._shut()
        if forget:
            self.path.with_suffix(LOCK).unlink(missing_ok=True)

    def _close_file(self) -> None:
        if self._file is not None:
            self._file.close()
            self._file = None

    def _shut(self) -> None:
        self._close_file()
        if not self._lock.closed:
            let_go(self._lock)
            self._lock.close()

    def _add(self, told: Mapping[str, Any]) -> None:
        assert self._file is not None
        line = _line(told)
        try:
            self._file.write(line)
        except OSError as error:
            raise ExportError(f"{self.path} could not be written: {error.strerror}") from error
        self._bytes += len(line)
        if self._bytes > GROWN:
            self.write_anew()

    def write_anew(self) -> None:
        """Write the file anew, with the steps that there are."""
        whole = b"".join(map(_line, _told(self.history, self.notes)))
        # Not every system puts a file in place of one that is open.
        self._close_file()
        write_whole(self.path, whole)
        try:
            self._file = open(self.path, "ab", buffering=0)  # noqa: SIM115  (open as long as the desk is)
        except OSError as error:
            raise ExportError(f"{self.path} could not be opened: {error.strerror}") from error
        # Written anew again once as much has been added.
        self._bytes = -len(whole)


def _own_folder() -> Path:
    asked = os.environ.get(VARIABLE, "")
    if asked:
        return Path(asked).expanduser()
    from platformdirs import user_state_path

    return user_state_path("batik-vector", appauthor=False) / "studio"


def _held_lock(path: Path) -> BinaryIO:
    """Return a file that this process holds alone.

    Raises:
        InUseError: where another process has it.
        ExportError: where it cannot be opened.
    """
    try:
        file = open(path, "ab", buffering=0)  # noqa: SIM115  (held as long as the desk is open)
    except OSError as error:
        raise ExportError(f"{path} could not be opened: {error.strerror}") from error
    if not held_alone(file):
        file.close()
        raise InUseError("the draft is open in another studio: close it there first")
    return file


def _free(path: Path) -> bool:
    """Return whether nobody holds a lock."""
    try:
        with open(path, "rb", buffering=0) as file:
            free = held_alone(file)
            if free:
                let_go(file)
            return free
    except FileNotFoundError:
        return True
    except OSError:
        return False


def _line(told: Mapping[str, Any]) -> bytes:
    """Return a line: a sum over what it says, and that."""
    text = json.dumps(told, ensure_ascii=False, separators=(",", ":")).encode()
    return b"%08x %b\n" % (zlib.crc32(text), text)


def _lines(data: bytes) -> Iterator[dict[str, Any]]:
    """Yield what whole lines say, up to the first that is not whole."""
    for line in data.splitlines(keepends=True):
        found = re.match(rb"([0-9a-f]{8}) (\{.*\})\n\Z", line, re.DOTALL)
        if found is None or int(found[1], 16) != zlib.crc32(found[2]):
            return
        yield json.loads(found[2])


def _read(path: Path) -> tuple[History, dict[str, Any]]:
    """Return what a file keeps.

    Raises:
        ValueError: where it is no draft.
    """
    told = _lines(path.read_bytes())
    first = next(told, None)
    if first is None or not isinstance(first.get("draft"), dict):
        raise ValueError("it does not begin with a draft")
    notes = dict(first.get("notes", {}))
    history = History(_draft(first["draft"]))
    for each in told:
        _replay(history, notes, each)
    return history, notes


def _replay(history: History, notes: dict[str, Any], told: Mapping[str, Any]) -> None:
    if "did" in told:
        history.did(_after(history.now, told["did"]), told["label"], told["merge"])
    elif "undo" in told:
        history.undo()
    elif "redo" in told:
        history.redo()
    elif "settle" in told:
        history.settle()
    notes |= told.get("notes", {})


def _told(history: History, notes: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield the lines that a history and its notes come to."""
    first, done, undone = history.unrolled()
    yield {"draft": _draft_told(first), "notes": dict(notes)}
    for step in (*done, *undone):
        yield {"did": _told_step(step), "label": step.label, "merge": step.merge}
    for _ in undone:
        yield {"undo": True}


def _draft_told(draft: Draft) -> dict[str, Any]:
    return {"text": draft.text, **{name: getattr(draft, name) for name in HELD}}


def _draft(told: Mapping[str, Any]) -> Draft:
    return replace(Draft(str(told["text"])), **_held(told))


def _held(told: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a draft has besides its text, lists as tuples."""
    found = {name: told[name] for name in HELD if name in told}
    if "locked" in found:
        found["locked"] = tuple(found["locked"])
    if "drawings" in found:
        found["drawings"] = tuple((str(name), str(svg)) for name, svg in found["drawings"])
    return found


def _step_told(before: Draft, after: Draft) -> dict[str, Any]:
    patch = Patch.between(before.text, after.text)
    differ = {name: getattr(after, name) for name in HELD if getattr(before, name) != getattr(after, name)}
    return {"at": patch.at, "cut": len(patch.old), "put": patch.new, **differ}


def _told_step(step: Step) -> dict[str, Any]:
    return {"at": step.patch.at, "cut": len(step.patch.old), "put": step.patch.new, **step.after}


def _after(draft: Draft, told: Mapping[str, Any]) -> Draft:
    text, at = draft.text, int(told["at"])
    text = text[:at] + str(told["put"]) + text[at + int(told["cut"]) :]
    return replace(draft, text=text, **_held(told))
