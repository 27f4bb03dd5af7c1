"""vsketch with shapely: a disc with a hole filled with dots or lines, as sketches do it, mark by mark.

python -m benchmarks.peers.vsketch_fill cecek 100000
python -m benchmarks.peers.vsketch_fill galaran 100000 drawn     how many lines those are
"""

from __future__ import annotations

import json
import math
import sys
from functools import partial

import shapely

from benchmarks.disc import LINES, MARGIN, SPACING, WIDTH, region
from benchmarks.peers.drawn import often, tell
from benchmarks.peers.vsketch_svg import page

SIDE = 320.0
WARM = 100
"""Dots of the disc that warms up."""


def dots(shape: shapely.Polygon) -> int:
    """Draw a circle wherever a place of the lattice lies within."""
    sheet, inner = page(SIDE, SIDE), shape.buffer(-MARGIN - WIDTH / 2)
    shapely.prepare(inner)
    x0, y0, x1, y1 = inner.bounds
    pitch, count = SPACING * math.sqrt(0.75), 0
    for row in range(math.ceil(y0 / pitch), math.floor(y1 / pitch) + 1):
        shift = SPACING / 2 * (row % 2)
        for step in range(math.ceil((x0 - shift) / SPACING), math.floor((x1 - shift) / SPACING) + 1):
            x, y = shift + step * SPACING, row * pitch
            if inner.contains(shapely.Point(x, y)):
                sheet.circle(x, y, radius=WIDTH / 2)
                count += 1
    return count


def lines(shape: shapely.Polygon) -> int:
    """Draw what of each parallel line lies within, as a stroke with a body."""
    sheet, inner = page(SIDE, SIDE), shape.buffer(-MARGIN - LINES / 4)
    x0, y0, x1, y1 = inner.bounds
    count = 0
    for row in range(math.ceil(y0 / LINES), math.floor(y1 / LINES) + 1):
        cut = inner.intersection(shapely.LineString([(x0 - 1, row * LINES), (x1 + 1, row * LINES)]))
        for part in shapely.get_parts(cut):
            sheet.geometry(part.buffer(LINES / 4, quad_segs=3))
            count += 1
    return count


def main(kind: str, size: int, drawn: bool) -> None:
    """Fill the disc, and tell what that took or how many marks there are."""
    work = {"cecek": dots, "galaran": lines}[kind]
    work(region(WARM))
    part, marks = often(partial(region, size), work)
    if drawn:
        print(json.dumps({"marks": marks}))
    else:
        tell({"": part})


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), sys.argv[3:] == ["drawn"])
