"""Marks that all meet: our weld beside GEOS' own union of the same rings.

python -m benchmarks.netting lattice 5820     alike lobed marks on a lattice, every other row set off
python -m benchmarks.netting random 10000     rings that all differ, anywhere
python -m benchmarks.netting group 5184      alike marks under the operations of p4m
python -m benchmarks.netting ring 5820        alike marks in wreaths round one another
python -m benchmarks.netting julian 4096     alike marks as JuliaN spreads them where dist = power
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
GROUP_PITCH_MM, GROUP_MM = 40.0, 5.5
"""Side of a cell of the group, and the middle radius of its marks."""
STEPS = 1000


def lattice(count: int) -> Geometries:
    """Return marks of the drawing, so large that each meets its neighbours."""
    row, column = np.divmod(np.arange(count), max(round(count**0.5), 1))
    middles = np.column_stack([column + row % 2 / 2, row]) * PITCH_MM
    return _rings(middles, np.full(count, OVERLAPPING_MM), np.full(count, LOBES), np.full(count, WAVE))


def group(count: int) -> Geometries:
    """Return marks askew in cells of p4m, so large that each meets others: eight to a cell."""
    cells = max(round((count / 8) ** 0.5), 1)
    steps = GROUP_PITCH_MM * STEPS
    angle = 2 * np.pi * np.arange(RING) / RING
    mark = np.rint(STEPS * GROUP_MM * (1 + WAVE * np.cos(LOBES * angle)) * np.exp(1j * angle))
    mark = mark + round(0.27 * steps) + 1j * round(0.11 * steps)
    turned = [each * 1j**k for each in (mark, mark.conjugate()) for k in range(4)]
    corners = (np.arange(cells) * steps)[:, None] + 1j * (np.arange(cells) * steps)
    points = (corners.ravel()[:, None, None] + np.array(turned)).reshape(-1, RING)
    return np.asarray(shapely.polygons(np.stack([points.real, points.imag], axis=-1)), dtype=object)


def ring(count: int) -> Geometries:
    """Return marks in wreaths about one middle, each turned with its place: hardly two alike on the grid."""
    wreaths = max(round((count / 6) ** 0.5), 1)
    number = np.repeat(np.arange(1, wreaths + 1), 6 * np.arange(1, wreaths + 1))[:count]
    place = np.arange(len(number)) - 3 * number * (number - 1)
    turn = 2 * np.pi * place / (6 * number)
    middles = PITCH_MM * number[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])
    many = len(number)
    sizes, lobes, waves = np.full(many, OVERLAPPING_MM), np.full(many, LOBES), np.full(many, WAVE)
    return _rings(middles, sizes, lobes, waves, -LOBES * turn)


def julian(count: int) -> Geometries:
    """Return marks as JuliaN with dist = power = 4 spreads them: moved, and turned by quarters."""
    points = STEPS * OVERLAPPING_MM * np.exp(2j * np.pi * np.arange(RING) / RING)[None]
    points = points * (1 + WAVE * np.cos(LOBES * 2 * np.pi * np.arange(RING) / RING))
    shift = PITCH_MM * STEPS / 2
    while len(points) < count:
        moved = np.rint(points + shift * (1 + 1j))
        points = np.concatenate([moved * 1j**k for k in range(4)])
        shift *= 2
    return np.asarray(shapely.polygons(np.stack([points.real, points.imag], axis=-1)), dtype=object)


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
    areas = KINDS[how](count)
    ours, geos = [], []
    for _ in range(ROUNDS):
        stock = Stock()
        copies = stock.taken_up(areas)
        ours.append(seconds(lambda stock=stock, copies=copies: weld(stock, copies)))  # type: ignore[misc]
        geos.append(seconds(lambda: shapely.union_all(areas)))
    ratio = statistics.median(b / a for a, b in zip(ours, geos, strict=True))
    own, theirs = statistics.median(ours), statistics.median(geos)
    print(f"{how}: weld {own:.3f} s, GEOS {theirs:.3f} s, {ratio:.1f} times")


KINDS: dict[str, Callable[[int], Geometries]] = {
    "lattice": lattice,
    "random": random,
    "group": group,
    "ring": ring,
    "julian": julian,
}


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
