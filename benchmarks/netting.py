"""Marks that all meet: our weld beside GEOS' own union of the same rings.

python -m benchmarks.netting lattice 5820     alike lobed marks on a lattice, every other row set off
python -m benchmarks.netting random 10000     rings that all differ, anywhere
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.tiling.welding.congruent import Stock
from batik_vector.tiling.welding.weld import weld
from benchmarks.drawing import LOBES, OVERLAPPING_MM, PITCH_MM, RING, WAVE

ROUNDS = 5
STEPS = 1000


def lattice(count: int) -> Geometries:
    """Return marks of the drawing, so large that each meets its neighbours."""
    row, column = np.divmod(np.arange(count), max(round(count**0.5), 1))
    middles = np.column_stack([column + row % 2 / 2, row]) * PITCH_MM
    return _rings(middles, np.full(count, OVERLAPPING_MM), np.full(count, LOBES), np.full(count, WAVE))


def random(count: int) -> Geometries:
    """Return as many rings as there are places, none like another."""
    rng = np.random.default_rng(1)
    middles = rng.uniform(0, PITCH_MM * count**0.5, (count, 2))
    sizes, waves = rng.uniform(4.5, 9, count), rng.uniform(0.05, 0.3, count)
    return _rings(middles, sizes, rng.integers(2, 8, count), waves, rng.uniform(0, 2 * np.pi, count))


def _rings(
    middles: NDArray[np.float64],
    sizes: NDArray[np.float64],
    lobes: NDArray[np.int64],
    waves: NDArray[np.float64],
    turns: NDArray[np.float64] | float = 0.0,
) -> Geometries:
    """Return rings on the grid, in steps."""
    angle = 2 * np.pi * np.arange(RING)[:, None] / RING
    radius = sizes * (1 + waves * np.cos(lobes * angle + turns))
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1) + middles
    return np.asarray(shapely.polygons(np.rint(points.swapaxes(0, 1) * STEPS)), dtype=object)


def seconds(make: Callable[[], object]) -> float:
    """Return the seconds of CPU that something takes."""
    before = time.process_time()
    make()
    return time.process_time() - before


def main(how: str, count: int) -> None:
    """Time both in turn, and tell the medians of what they take and of how many times as long GEOS does."""
    areas = {"lattice": lattice, "random": random}[how](count)
    ours, geos = [], []
    for _ in range(ROUNDS):
        stock = Stock()
        copies = stock.taken_up(areas)
        ours.append(seconds(lambda stock=stock, copies=copies: weld(stock, copies)))  # type: ignore[misc]
        geos.append(seconds(lambda: shapely.union_all(areas)))
    ratio = statistics.median(b / a for a, b in zip(ours, geos, strict=True))
    own, theirs = statistics.median(ours), statistics.median(geos)
    print(f"{how}: weld {own:.3f} s, GEOS {theirs:.3f} s, {ratio:.1f} times")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
