"""What all scripts of this folder share: how they are called, and what they tell.

    python -m benchmarks.peers.NAME whole RINGS FOLDER
    python -m benchmarks.peers.NAME alone RINGS FOLDER

``whole`` works the drawing out and draws it, as a user's script would; the process is timed from outside.
``alone`` loads the coordinates that batik_vector drew, writes four marks to warm up, and times the writer:
one line of JSON tells what it took.
"""

from __future__ import annotations

import contextlib
import ctypes
import json
import resource
import statistics
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from benchmarks.drawing import evaluated, size

WARM = 4
"""Marks of the drawing that warms up."""
LEAST = 0.2
"""CPU seconds below which something is timed again."""
Part: TypeAlias = dict[str, float]
"""A part of the work: ``cpu`` and ``wall`` seconds, ``mib`` beyond what was held, ``bytes``, ``vertices``."""
Given = TypeVar("Given")
Done = TypeVar("Done")


@dataclass(frozen=True)
class Drawing:
    """What is drawn: points of shape (rings, 100, 2) in mm, y down; the page in mm; where files go."""

    points: NDArray[np.float64]
    width: float
    height: float
    folder: Path
    stem: str

    def path(self, suffix: str) -> Path:
        """Return the place of a file."""
        return self.folder / f"{self.stem}{suffix}"


def peak_kib() -> int:
    """Return the most memory that this process has held, in KiB."""
    try:
        status = Path("/proc/self/status").read_text(encoding="ascii")
        return int(status.split("VmHWM:")[1].split()[0])
    except (OSError, IndexError):
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def forget_peak() -> None:
    """Let the peak begin again from what is held now, where the system can."""
    try:
        Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
    except OSError:
        return


def let_go() -> None:
    """Give back memory that was freed: what is taken from it again would not be counted."""
    with contextlib.suppress(AttributeError, OSError):
        ctypes.CDLL(None).malloc_trim(0)


def timed(work: Callable[[], Done], made: Path | None = None) -> tuple[Part, Done]:
    """Do some work; return what it took, and what it returned.

    Args:
        work: what to do.
        made: the file that it writes, whose size is told.
    """
    forget_peak()
    before = peak_kib()
    wall, cpu = time.perf_counter(), time.process_time()
    done = work()
    cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
    size = made.stat().st_size if made else 0
    return {"cpu": cpu, "wall": wall, "mib": (peak_kib() - before) / 1024, "bytes": size}, done


def middle(parts: Sequence[Part]) -> Part:
    """Return the medians of several runs; of memory the most, since who runs again has what it needs."""
    medians = {name: statistics.median(part[name] for part in parts) for name in parts[0]}
    return medians | {"mib": max(part.get("mib", 0.0) for part in parts)}


def often(
    given: Callable[[], Given], work: Callable[[Given], Done], least: float = LEAST
) -> tuple[Part, Done]:
    """Do some work again and again, since little says what is over soon; return medians, and what it made.

    Args:
        given: makes what is worked on, each time anew, so that nothing that is kept with it can answer.
        work: what to do.
        least: CPU seconds that are timed in all, however often that is.
    """
    parts: list[Part] = []
    while not parts or sum(part["cpu"] for part in parts) < least:
        part, done = timed(partial(work, given()))
        parts.append(part)
    return middle(parts), done


def tell(parts: Mapping[str, Part]) -> None:
    """Print what parts of the work took, for the process that asked."""
    print(json.dumps(parts))


def main(
    suffix: str,
    write: Callable[[Drawing, Any], object],
    prepare: Callable[[Drawing], Any] = lambda drawing: None,
) -> None:
    """Do what the command line asks for.

    Args:
        suffix: of the file that is written.
        write: writes it; what is timed.
        prepare: brings the drawing into what the writer takes, where it takes a document of its own.
    """
    mode, rings, folder = sys.argv[1], int(sys.argv[2]), Path(sys.argv[3])
    stem = Path(sys.argv[0]).stem
    width, height = size(rings)
    if mode == "whole":
        drawing = Drawing(np.array([0, height]) - evaluated(rings) * [-1, 1], width, height, folder, stem)
        write(drawing, prepare(drawing))
        return
    points = np.array([0, height]) - np.load(folder / "drawing.npy") * [-1, 1]
    warm = Drawing(points[:WARM], width, height, folder, f"warm-{stem}")
    write(warm, prepare(warm))
    drawing = Drawing(points, width, height, folder, stem)
    prepared = prepare(drawing)
    let_go()
    part, _ = timed(partial(write, drawing, prepared), drawing.path(suffix))
    tell({"": part})
