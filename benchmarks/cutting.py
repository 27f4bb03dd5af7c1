"""batik_vector's way of a drag knife round stars: what it takes, and how far the tip is off them.

python -m benchmarks.cutting COUNT
python -m benchmarks.cutting COUNT off
"""

from __future__ import annotations

import json
import sys
from functools import partial

import numpy as np

from batik_vector.geometry.outlines import Outlines
from batik_vector.processes.cutting.arclength import ways
from batik_vector.processes.cutting.knife import Knife, holder, shut
from batik_vector.processes.cutting.starts import begun
from batik_vector.processes.cutting.told import told
from batik_vector.processes.options import CutProcess
from benchmarks.peers.drawn import often, tell
from benchmarks.trailing import CORNERS, OFFSET_MM, off, stars

TOLERANCE_MM = 0.01
ASKED = told(CutProcess(blade_offset=OFFSET_MM), TOLERANCE_MM)
"""All that the process does by default: the start of a cut and its overcut."""


def outlines(count: int) -> Outlines:
    """Return the stars."""
    points = np.rint(stars(count).reshape(-1, 2) * 1000).astype(np.int64)
    return Outlines(points, np.arange(count + 1) * CORNERS, np.arange(count + 1), np.ones(count, bool))


def cut(rings: Outlines) -> Outlines:
    """Return the way of the holder."""
    started = begun(rings, ASKED.start, ASKED.corner)
    opened = shut(started, np.full(len(started), ways(ASKED.overcut)))
    return holder(opened, Knife(ASKED.blade_offset, ASKED.corner, ASKED.swivel, ASKED.sag))


def main(count: int, how_far: bool) -> None:
    """Lead the knife, and tell what that took or how it cuts."""
    cut(outlines(4))
    if how_far:
        found = cut(outlines(count))
        print(json.dumps(off(np.split(found.points / 1000, found.rings[1:-1]), ASKED.swivel)))
        return
    part, _ = often(partial(outlines, count), cut)
    tell({"": part})


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2:] == ["off"])
