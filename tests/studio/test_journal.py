from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.errors import ExportError
from batik_vector.studio import journal as journals
from batik_vector.studio.drafts import Draft
from batik_vector.studio.journal import Desk, InUseError, Journal
from tests.studio.test_drafts import FLOWER

STEPS = st.lists(
    st.one_of(st.integers(0, 99), st.sampled_from(["undo", "redo", "settle", "drag", "lock", "svg", "note"])),
    max_size=12,
)


def work(desk: Desk, steps: list[int | str]) -> None:
    for number, step in enumerate(steps):
        now = desk.draft
        if step == "undo":
            desk.undo()
        elif step == "redo":
            desk.redo()
        elif step == "settle":
            desk.settle()
        elif step == "note":
            desk.note(version=number)
        elif step == "lock":
            desk.did(now.locking("seed", not now.is_locked("seed")), "lock")
        elif step == "svg":
            desk.did(now.with_drawing(f"{number}.svg", "<svg>é\n'\"</svg>"), "drawing")
        else:
            merge = "drag" if step == "drag" else ""
            desk.did(now.with_value("seed", number), f"seed {number}", merge)


def known(desk: Desk) -> tuple[object, ...]:
    """Return all that is to be there again."""
    first, done, undone = desk.history.unrolled()
    return desk.draft, dict(desk.notes), first, done, undone


@settings(max_examples=30, deadline=None)
@given(STEPS)
def test_what_was_open_is_there_again_with_every_step(
    tmp_path_factory: pytest.TempPathFactory, steps: list[int | str]
) -> None:
    folder = tmp_path_factory.mktemp("desks")
    with Journal(folder) as journal:
        desk = journal.begin(Draft(FLOWER, stem="k"), {"file": "k.toml"})
        work(desk, steps)
        before = known(desk)
    with Journal(folder) as journal:
        (kept,) = journal.kept()
        assert (kept.title, kept.in_use) == ("A flower", False)
        assert known(journal.restore(kept.key)) == before
        # Once more: what was read was written anew.
        journal.close()
        assert known(journal.restore(kept.key)) == before


@settings(max_examples=8, deadline=None)
@given(STEPS, st.data())
def test_a_file_cut_anywhere_loses_at_most_what_stood_behind(
    tmp_path_factory: pytest.TempPathFactory, steps: list[int | str], data: st.DataObject
) -> None:
    folder = tmp_path_factory.mktemp("desks")
    states = []
    with Journal(folder) as journal:
        desk = journal.begin(Draft(FLOWER))
        begun = desk.path.stat().st_size
        states.append((begun, known(desk)))
        for step in steps:
            work(desk, [step])
            states.append((desk.path.stat().st_size, known(desk)))
        key, whole = desk.key, desk.path.read_bytes()
    cut = data.draw(st.integers(begun, len(whole)))
    junk = data.draw(st.sampled_from([b"", b"\0" * 9, b"00000000 {}\n", whole[-4:]]))
    (folder / f"{key}.desk").write_bytes(whole[:cut] + junk)
    expected = [state for size, state in states if size <= cut][-1]
    with Journal(folder) as journal:
        assert known(journal.restore(key)) == expected


WRITER = """
import sys
from batik_vector.studio.drafts import Draft
from batik_vector.studio.journal import Journal

desk = Journal(sys.argv[1]).begin(Draft(sys.stdin.read()))
print(desk.key, flush=True)
for number in range(100_000):
    desk.did(desk.draft.with_text(f"seed = {number}\\n"), "seed")
    print(number, flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_a_process_killed_between_two_steps_loses_at_most_the_one_it_was_at(tmp_path: Path) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", WRITER, str(tmp_path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as run:
        assert run.stdin is not None
        assert run.stdout is not None
        run.stdin.write(FLOWER)
        run.stdin.close()
        key = run.stdout.readline().strip()
        told = [int(run.stdout.readline()) for _ in range(200)]
        journal = Journal(tmp_path)
        assert journal.kept()[0].in_use
        with pytest.raises(InUseError):
            journal.restore(key)
        with pytest.raises(InUseError):
            journal.forget(key)
        os.kill(run.pid, signal.SIGKILL)
        told += map(int, run.stdout.read().split())
    desk = journal.restore(key)
    assert int(str(desk.draft.value("seed"))) in (told[-1], told[-1] + 1)
    assert len(desk.history) == desk.draft.value("seed") + 1
    journal.close()


def test_a_file_that_has_grown_is_written_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(journals, "GROWN", 2000)
    with Journal(tmp_path) as journal:
        desk = journal.begin(Draft(FLOWER))
        for number in range(300):
            desk.did(desk.draft.with_value("seed", number), "seed", "seed")
        assert desk.path.stat().st_size < 5000
        assert len(desk.history) == 1
        before = known(desk)
    with Journal(tmp_path) as journal:
        assert known(journal.restore(desk.key)) == before


def test_one_desk_is_one_however_often_it_is_asked_for(tmp_path: Path) -> None:
    with Journal(tmp_path) as journal:
        desk = journal.begin(Draft(FLOWER))
        assert journal.restore(desk.key) is desk
        assert journal.kept()[0].in_use
        desk.close(forget=True)
        assert journal.kept() == []
        assert list(tmp_path.iterdir()) == []
        for key in (desk.key, "../../etc/passwd", "", "0" * 16):
            with pytest.raises(ExportError, match="no draft"):
                journal.restore(key)


def test_what_is_no_draft_is_passed_over(tmp_path: Path) -> None:
    (tmp_path / f"{'0' * 16}.desk").write_bytes(b"nonsense")
    (tmp_path / f"{'1' * 16}.desk").write_bytes(b"")
    (tmp_path / "readme.desk").write_bytes(b"")
    with Journal(tmp_path) as journal:
        assert journal.kept() == []
        with pytest.raises(ExportError, match="holds no draft"):
            journal.restore("0" * 16)


def test_the_folder_is_the_users_own_or_the_variables(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BATIK_STUDIO", str(tmp_path / "a" / "b"))
    assert Journal().folder == tmp_path / "a" / "b"
    (tmp_path / "file").write_text("")
    with pytest.raises(ExportError, match="could not be made"):
        Journal(tmp_path / "file" / "x")
