"""Fills of a disc with a hole, beside a loop over marks with shapely; and leaves packed, beside a toss.

python -m benchmarks.filling cecek 100000          dots in rows, about so many
python -m benchmarks.filling galaran 100000 loop   parallel lines in the same disc, one by one
python -m benchmarks.filling KIND 100000           any other kind, as it is by default
python -m benchmarks.filling pack 300              twelve leaves a millimetre apart on 300 × 300 mm
python -m benchmarks.filling toss 300              the same leaves tossed

One word more, ``drawn``, tells how many marks that are, and of leaves how much they cover.
``benchmarks.peers.vsketch_fill`` has the fills as sketches of vsketch. All make the same marks as areas, at
the same spacing, width and margin; the loops prepare their region.
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable, Mapping
from functools import partial
from types import MappingProxyType
from typing import Any

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
from benchmarks.disc import LINES, MARGIN, SPACING, WIDTH, region
from benchmarks.peers.drawn import often, tell
from tests.tiling.tossing.leaves import LEAVES

WARM = 100
"""Dots of the disc that warms up."""
LAYOUTS: Mapping[str, type[Pack | Toss]] = MappingProxyType({"pack": Pack, "toss": Toss})


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


LOOPS: Mapping[str, Callable[[shapely.Polygon], int]] = MappingProxyType(
    {"cecek": dots_by_loop, "galaran": lines_by_loop}
)


def fill_of(kind: str) -> Fill:
    """Return a fill, such as the loops make it where there is one."""
    if kind == "cecek":
        return Cecek(spacing=SPACING, width=WIDTH, margin=MARGIN)
    if kind == "galaran":
        return Galaran(spacing=LINES, width=LINES / 2, margin=MARGIN)
    return FILLS[kind]()


def ours(fill: Fill, shape: shapely.Polygon) -> int:
    """Fill a region with all marks at once."""
    return len(fill.lay(Room(whole(np.array([shape])), np.zeros((1, 2)), 1, 0.02, 1))[0])


def leaves(layout: str, side: int) -> dict[str, Any]:
    """Set leaves down on a tile with sides in mm; return how many, and how much they cover."""
    torus, nothing = Torus(Cell(1000 * side, 1000 * side).lattice), Field.of(np.empty(0, dtype=object))
    marks = Marks(tuple("abcdefghijkl"), LEAVES, 0.03)
    report = toss(LAYOUTS[layout](distance=1.0), marks, torus, nothing, 1).report
    covers = round(100 * float(report.covers), 1)
    return {"marks": sum(report.counts), "covers": covers, "gap": report.distance}


def filled(kind: str, by_loop: bool, shape: shapely.Polygon) -> dict[str, Any]:
    """Fill a region; return how many marks there are."""
    return {"marks": LOOPS[kind](shape) if by_loop else ours(fill_of(kind), shape)}


def main(kind: str, size: int, ways: list[str]) -> None:
    """Fill, and tell what that took or what was made."""
    if kind in LAYOUTS:
        part, made = often(lambda: size, partial(leaves, kind))
    else:
        work = partial(filled, kind, "loop" in ways)
        work(region(WARM))
        part, made = often(partial(region, size), work)
    if "drawn" in ways:
        print(json.dumps(made))
    else:
        tell({"": part})


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), sys.argv[3:])
