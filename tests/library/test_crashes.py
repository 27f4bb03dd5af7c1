"""Writers are killed, write at once, and run out of disk: what was saved is there, and whole."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import pytest

from batik_vector.library import Library
from tests.library.test_store import NOTHING, RECIPE, recipe
from tests.thorough import examples, long

ROOT = Path(__file__).resolve().parents[2]
SAVES = 200
WRITER = textwrap.dedent(
    """
    import os, resource, sys
    from dataclasses import replace
    from batik_vector import LibraryError, read_recipe
    from batik_vector.library import Library
    from batik_vector.library.measuring import Measured

    path, name, first, count, most = sys.argv[1], sys.argv[2], *map(int, sys.argv[3:])
    if most:
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
    base = read_recipe(sys.stdin.read())
    picture = Measured({"inks": 1}, b"<svg>" + os.urandom(6000), os.urandom(3000))
    with Library(path) as library:
        print("ready", flush=True)
        for number in range(first, first + count):
            recipe = replace(base, source=f"# {name} {number}\\n{base.source}")
            try:
                saved = library.add(name, recipe, measured=picture)
            except LibraryError as error:
                print("told", error, flush=True)
                break
            # By now it must be on the disk.
            print(saved.number, number, flush=True)
    """
)


def writer(path: Path, name: str, first: int, count: int, most: int = 0) -> subprocess.Popen[str]:
    command = [sys.executable, "-c", WRITER, str(path), name, str(first), str(count), str(most)]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd=ROOT)
    assert process.stdin is not None
    process.stdin.write(RECIPE.format(number=1))
    process.stdin.close()
    return process


def lines_of(process: subprocess.Popen[str]) -> list[str]:
    assert process.stdout is not None
    found = process.stdout.read().splitlines()
    process.wait()
    process.stdout.close()
    return found


def saved_in(found: list[str]) -> dict[int, int]:
    """Return the numbers of the versions that a writer was told are saved, and what each says."""
    pairs = (line.split() for line in found if line[:1].isdigit())
    return {int(pair[0]): int(pair[1]) for pair in pairs if len(pair) == 2}


def held(library: Library, name: str) -> dict[int, int]:
    """Return the numbers of the versions that are there, and what each says; all must be whole."""
    found = {}
    for version in library.history(name):
        first = version.text.partition("\n")[0]
        assert version.text == f"{first}\n{RECIPE.format(number=1)}"
        found[version.number] = int(first.rpartition(" ")[2])
    return found


@long
def test_a_writer_that_is_killed_loses_nothing_that_was_saved(tmp_path: Path) -> None:
    path = tmp_path / "my.library"
    chance = random.Random(14)
    told: dict[int, int] = {}
    with Library(path):
        pass
    for turn in range(examples(3, 20)):
        process = writer(path, "dots", turn * SAVES, SAVES)
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        time.sleep(chance.uniform(0.01, 0.4))
        process.send_signal(signal.SIGKILL)
        told |= saved_in(lines_of(process))
        with Library(path) as library:
            there = held(library, "dots") if library.entries(own=True) else {}
            assert told.items() <= there.items()
            # One may have been saved whose writer did not live to say so.
            assert len(there) <= len(told) + turn + 1
            assert library.check() == []
    assert told
    assert {each.name for each in tmp_path.iterdir()} <= {path.name, f"{path.name}-wal", f"{path.name}-shm"}


@long
def test_two_processes_write_at_once_and_lose_nothing(tmp_path: Path) -> None:
    path, count = tmp_path / "my.library", examples(40, 500)
    # Neither finds the library there: both want to make it.
    both = [writer(path, "dots", 10_000 * which, count) for which in (1, 2)]
    told = [saved_in(lines_of(process)) for process in both]
    assert [len(each) for each in told] == [count, count]
    with Library(path) as library:
        assert held(library, "dots") == told[0] | told[1]
        assert len(library.history("dots")) == 2 * count
        assert library.check() == []


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no limits on the size of files here")
def test_a_full_disk_is_told_and_what_was_saved_is_there(tmp_path: Path) -> None:
    path = tmp_path / "my.library"
    with Library(path) as library:
        library.add("first", recipe(2), measured=NOTHING)
    size = path.stat().st_size
    found = lines_of(writer(path, "dots", 0, 400, most=size + 200_000))
    told = saved_in(found)
    assert found[-1].startswith(f"told {path} could not be ")
    assert "nothing was changed" in found[-1]
    assert 0 < len(told) < 400
    with Library(path) as library:
        assert held(library, "dots") == told
        assert library.version("first").number == 1
        assert library.check() == []
        assert library.add("dots", recipe(3), measured=NOTHING).number == len(told) + 1


@long
def test_a_library_whose_making_is_killed_is_made_again(tmp_path: Path) -> None:
    chance = random.Random(15)
    for turn in range(examples(2, 20)):
        path = tmp_path / f"{turn}.library"
        process = writer(path, "dots", 0, 1)
        time.sleep(chance.uniform(0.2, 1.4))
        process.send_signal(signal.SIGKILL)
        lines_of(process)
        with Library(path) as library:
            assert "sample/kawung" in library.names()
            assert library.check() == []
