"""L-systems and contours: what is timed inside a process of ours, one line of JSON for each call.

python -m benchmarks.growing line SYSTEM LEVEL      a word to its open line
python -m benchmarks.growing stroke SYSTEM LEVEL    the line to one welded stroke
python -m benchmarks.growing buffer SYSTEM LEVEL    the same by shapely's buffer
python -m benchmarks.growing field SAMPLES FOLDER   a field of escape times, left for the others
python -m benchmarks.growing rings SAMPLES FOLDER   such a field to smooth rings
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import shapely

from batik_vector.geometry.generators.contours import rings, smooth
from batik_vector.geometry.generators.escape import escapes
from batik_vector.geometry.lsystems.catalogue import NAMED
from batik_vector.geometry.lsystems.expansion import expanded
from batik_vector.geometry.lsystems.grammar import grammar_of
from batik_vector.geometry.lsystems.lattice import on_lattice
from batik_vector.geometry.lsystems.turtle import Gait, Walk, walked
from benchmarks.peers.drawn import let_go, tell, timed

WIDTH, TOLERANCE = 0.4, 0.008
"""Breadth of a stroke in steps, and what its round ends may stand off: five chords in a quarter, about."""
QUARTER = 5
LEVELS = (4.5, 8.5, 16.5, 32.5)
"""Escapes at which rings run."""


def line(system: str, level: int) -> Walk:
    """Return what a turtle draws."""
    known = NAMED[system]
    word = expanded(grammar_of(known.axiom, known.rules, known.draws), level)
    return walked(word, known.draws, Gait(known.angle, known.heading))


def stroke(walk: Walk) -> object:
    """Return the welded body of a line."""
    found = on_lattice(walk.points, walk.offsets, WIDTH, TOLERANCE)
    assert found is not None
    assert len(found) == 1
    return found


def buffered(walk: Walk) -> object:
    """Return it as shapely makes it."""
    points = np.column_stack([walk.points.real, walk.points.imag])
    return shapely.buffer(shapely.linestrings(points), WIDTH / 2, quad_segs=QUARTER)


def field(samples: int) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """Return escape times of the Mandelbrot set's window."""
    return escapes(None, 2, (-2.2, -1.4, 0.8, 1.6), (samples, samples), 34, False)


def ringed(values: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> object:
    """Return the smooth rings at all levels."""
    found = []
    for level in LEVELS:
        points, offsets = rings(values, level)
        found.append(smooth(points, offsets, np.zeros(len(points), bool)))
    return found


def _saved(samples: int, path: Path) -> None:
    np.save(path, field(samples))


def main() -> None:
    """Do what is asked, once warm."""
    task, name, last = sys.argv[1:4]
    work: Callable[[], object]
    if task == "field":
        work = partial(_saved, int(name), Path(last) / "field.npy")
    elif task == "rings":
        values = np.load(Path(last) / "field.npy")
        ringed(values[:50, :50])
        work = partial(ringed, values)
    elif task == "line":
        line(name, 3)
        work = partial(line, name, int(last))
    else:
        make = {"stroke": stroke, "buffer": buffered}[task]
        make(line(name, 3))
        work = partial(make, line(name, int(last)))
    let_go()
    part, _ = timed(work)
    tell({"": part})


if __name__ == "__main__":
    main()
