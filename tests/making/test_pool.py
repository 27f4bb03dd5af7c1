"""Work on several cores: what dies costs its task alone, and nothing stays behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from batik_vector.errors import Fault, RecipeError, SeamError
from batik_vector.making.pool import outcomes


def worked(task: int) -> int:
    """Return the square; 3 is refused, 4 has a broken seam, 5 kills its process, 6 has a defect."""
    if task == 3:
        raise RecipeError([Fault("wrong", "a.b", "x.toml", 7)])
    if task == 4:
        raise SeamError("torn")
    if task == 5:
        os.kill(os.getpid(), signal.SIGKILL)
    if task == 6:
        raise KeyError("defect")
    return task * task


@pytest.mark.parametrize("workers", [1, 2])
def test_what_fails_stops_nothing(workers: int) -> None:
    found = {each.task: each for each in outcomes(worked, [1, 2, 3, 4, 9], workers)}
    assert {task: each.result for task, each in found.items()} == {1: 1, 2: 4, 3: None, 4: None, 9: 81}
    failures = {task: each.failure for task, each in found.items() if each.failure}
    assert failures[3].words == "x.toml:7: a.b: wrong"
    assert (failures[3].exit_code, failures[4].exit_code) == (2, 1)
    with pytest.raises(RecipeError, match="torn") as raised:
        found[4].check()
    assert raised.value.exit_code == 1


def test_a_worker_that_dies_is_told_and_another_goes_on() -> None:
    found = {each.task: each for each in outcomes(worked, [5, 1, 5, 2, 7, 8], 2)}
    assert sorted(task for task, each in found.items() if each.result is not None) == [1, 2, 7, 8]
    assert found[5].failure is not None
    assert "SIGKILL" in found[5].failure.words


def test_a_defect_is_shown_as_one() -> None:
    with pytest.raises(RuntimeError, match="KeyError"):
        list(outcomes(worked, [1, 6], 2))


SCRIPT = """
import os, sys, time
from tests.making.test_pool import slow
from batik_vector.making.pool import outcomes
if __name__ == "__main__":
    for each in outcomes(slow, range(100), 2):
        print(each.result, flush=True)
"""


def slow(task: int) -> int:
    """Tell who works, after a moment."""
    time.sleep(0.2)
    return os.getpid()


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="processes are looked up in /proc")
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_no_worker_outlives_the_process_that_began_it(number: signal.Signals, tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    root = str(Path(__file__).parents[2])
    begun = subprocess.Popen(
        [sys.executable, str(script)],
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": root},
        text=True,
    )
    assert begun.stdout is not None
    workers = {int(begun.stdout.readline()) for _ in range(4)}
    begun.send_signal(number)
    begun.wait()
    begun.stdout.close()
    deadline = time.monotonic() + 20
    while any(Path(f"/proc/{each}").is_dir() for each in workers) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not [each for each in workers if Path(f"/proc/{each}").is_dir()]
