"""Processes and the clock: what a command costs.

This module and all that drives it import nothing heavy: a child's peak of memory begins with its parent's.
"""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
import threading
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
OWN = ROOT / ".venv" / "bin"
PEERS = ROOT / ".venv-bench" / "bin"

LONGEST = 600.0
"""Seconds after which a command hangs, and is ended."""


class FailedError(Exception):
    """A command that did not succeed; its last words."""


@dataclass(frozen=True)
class Sample:
    """One run: seconds of CPU over all threads, seconds by the clock, peak of memory in MiB, and of what is
    drawn the bytes in the file and the vertices, where they are told.
    """

    cpu: float
    wall: float
    mib: float = 0.0
    bytes: float = 0
    vertices: float = 0


def environment() -> dict[str, str]:
    """Return the environment of every command: whoever calls must make no difference."""
    dropped = ("PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV", "PYTHONSTARTUP", "PYTHONOPTIMIZE")
    return {name: value for name, value in os.environ.items() if name not in dropped}


def process(command: Sequence[str]) -> tuple[Sample, str]:
    """Run a command; return what the whole process cost, and what it said.

    Raises:
        FailedError: where it fails.
    """
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        wall = time.perf_counter()
        try:
            child = subprocess.Popen(command, stdout=out, stderr=err, cwd=ROOT, env=environment())
        except OSError as error:
            raise FailedError(f"{Path(command[0]).name} cannot be run: {error.strerror}") from error
        hangs = threading.Timer(LONGEST, child.kill)
        hangs.start()
        _, status, used = os.wait4(child.pid, 0)
        hangs.cancel()
        wall = time.perf_counter() - wall
        child.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        err.seek(0)
        said, complained = out.read().decode("utf-8", "replace"), err.read().decode("utf-8", "replace")
    if child.returncode:
        lines = complained.strip().splitlines() or [f"exit {child.returncode}"]
        raise FailedError(lines[-1])
    return Sample(used.ru_utime + used.ru_stime, wall, used.ru_maxrss / 1024), said


def told(command: Sequence[str]) -> Mapping[str, Any]:
    """Run a command; return the JSON object that it prints in its last line."""
    _, said = process(command)
    answer: dict[str, Any] = json.loads(said.strip().splitlines()[-1])
    return answer


def parts(command: Sequence[str]) -> dict[str, Sample]:
    """Run a command that times parts of its own work; return them by name."""
    return {name: Sample(**part) for name, part in told(command).items()}
