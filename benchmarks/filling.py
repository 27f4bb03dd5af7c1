"""Fills of a disc with a hole: ours, beside a loop over marks with shapely, as scripts for vsketch have it.

python -m benchmarks.filling cecek        dots in rows, about 10^5
python -m benchmarks.filling galaran      parallel lines
python -m benchmarks.filling KIND         any other kind, ours alone
python -m benchmarks.filling pack         twelve leaves packed a millimetre apart on 300 × 300 mm, and tossed

``benchmarks.peers.vsketch_fill`` has the same as a sketch of vsketch.

Both make the same marks as areas, at the same spacing, width and margin; the loop prepares its region.
"""

from __future__ import annotations

import math
import sys
import time

import numpy as np
import shapely
from shapely import affinity

from batik_vector.artwork import Cell
from batik_vector.geometry.fills.insets import whole
from batik_vector.recipe.fills import FILLS, Cecek, Fill, Galaran, Room
from batik_vector.tiling.layouts import Pack, Toss
from batik_vector.tiling.tossing.marks import Field
from batik_vector.tiling.tossing.scatter import Torus
from batik_vector.tiling.tossing.toss import Marks, toss
from benchmarks.disc import LINES, MARGIN, SPACING, WIDTH, least, region
from tests.tiling.tossing.leaves import LEAVES


def dots_by_loop(shape: shapely.Polygon) -> int:
    """Fill a region with dots, one by one."""
    inner = shape.buffer(-MARGIN - WIDTH / 2)
    shapely.prepare(inner)
    x0, y0, x1, y1 = inner.bounds
    pitch = SPACING * math.sqrt(0.75)
    found = []
    for row in range(math.ceil(y0 / pitch), math.floor(y1 / pitch) + 1):
        shift = SPACING / 2 * (row % 2)
        for step in range(math.ceil((x0 - shift) / SPACING), math.floor((x1 - shift) / SPACING) + 1):
            middle = shapely.Point(shift + step * SPACING, row * pitch)
            if inner.contains(middle):
                found.append(middle.buffer(WIDTH / 2, quad_segs=3))
    return len(found)


def lines_by_loop(shape: shapely.Polygon) -> int:
    """Fill a region with parallel lines, one by one."""
    inner = shape.buffer(-MARGIN - LINES / 4)
    x0, y0, x1, y1 = inner.bounds
    across = shapely.LineString([(x0 - 1, 0), (x1 + 1, 0)])
    found = []
    for row in range(math.ceil(y0 / LINES), math.floor(y1 / LINES) + 1):
        cut = inner.intersection(affinity.translate(across, 0, row * LINES))
        found += [part.buffer(LINES / 4, quad_segs=3) for part in shapely.get_parts(cut)]
    return len(found)


def ours(fill: Fill, shape: shapely.Polygon) -> int:
    """Fill a region with all marks at once."""
    return len(fill.lay(Room(whole(np.array([shape])), np.zeros((1, 2)), 1, 0.02, 1))[0])


def main(kind: str) -> None:
    """Tell what a fill takes."""
    shape = region()
    dots, lines = (
        Cecek(spacing=SPACING, width=WIDTH, margin=MARGIN),
        Galaran(spacing=LINES, width=LINES / 2, margin=MARGIN),
    )
    fill: Fill = {"cecek": dots, "galaran": lines}.get(kind) or FILLS[kind]()
    seconds, count = least(lambda: ours(fill, shape))
    print(f"{kind}: {count:,} marks in {seconds:.3f} s of CPU")
    loops = {"cecek": dots_by_loop, "galaran": lines_by_loop}
    if kind in loops:
        slow, made = least(lambda: loops[kind](shape))
        print(f"a loop with shapely: {made:,} marks in {slow:.3f} s, {slow / seconds:.0f} times as long")


def packing() -> None:
    """Tell what packing takes and covers, and what a toss does."""
    for spec in (Pack(distance=1.0), Toss(distance=1.0)):
        begin = time.process_time()
        torus, nothing = Torus(Cell(300_000, 300_000).lattice), Field.of(np.empty(0, dtype=object))
        report = toss(spec, Marks(tuple("abcdefghijkl"), LEAVES, 0.03), torus, nothing, 1).report
        seconds = time.process_time() - begin
        print(
            f"{spec.kind}: {sum(report.counts)} marks cover {100 * report.covers:.1f} %, least gap "
            f"{report.distance:g} mm, in {seconds:.1f} s of CPU"
        )


if __name__ == "__main__":
    packing() if sys.argv[1] == "pack" else main(sys.argv[1])
