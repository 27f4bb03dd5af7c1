"""A sweep of the four-square flower: in one process, in two, and as a loop of a shell over the command.

python -m benchmarks.sweeps WAY COUNT FOLDER     WAY is 1 or 2 (processes), or loop
"""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

from benchmarks.timing import OWN

SAMPLE = "samples/four-square.toml"
KEY = "motif.flower.pistil.length"
LOW, HIGH = 0.55, 0.85


def values(count: int) -> list[float]:
    """Return what the key is set to."""
    return [round(LOW + (HIGH - LOW) * number / (count - 1), 6) for number in range(count)]


def run(way: str, count: int, folder: Path) -> None:
    """Make all variants anew."""
    out = folder / f"sweep-{way}"
    shutil.rmtree(out, ignore_errors=True)
    batik = str(OWN / "batik-vector")
    if way != "loop":
        axis = f"{KEY}={LOW}:{HIGH}:{count}"
        subprocess.run([batik, "sweep", SAMPLE, "--vary", axis, "-o", str(out), "-j", way], check=True)
        return
    for number, value in enumerate(values(count)):
        into = str(out / str(number))
        subprocess.run([batik, "compile", SAMPLE, "--set", f"{KEY}={value}", "-o", into], check=True)


if __name__ == "__main__":
    run(sys.argv[1], int(sys.argv[2]), Path(sys.argv[3]))
