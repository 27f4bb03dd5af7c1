"""batik_vector's order of strokes: what it takes, and the way that is left with the pen up.

python -m benchmarks.ordering COUNT
python -m benchmarks.ordering COUNT way
"""

from __future__ import annotations

import json
import sys
from functools import partial

import numpy as np

from batik_vector.geometry.outlines import Outlines
from batik_vector.processes.order import in_order, travel
from benchmarks.peers.drawn import often, tell
from benchmarks.peers.strokes import spanning_tree, strokes


def outlines(count: int) -> Outlines:
    """Return the strokes."""
    points = np.rint(strokes(count).reshape(-1, 2) * 1000).astype(np.int64)
    return Outlines(points, np.arange(count + 1) * 2, np.arange(count + 1), np.zeros(count, bool))


def main(count: int, way: bool) -> None:
    """Order strokes, and tell what it took or what it gave."""
    in_order(outlines(200))
    if way:
        left = travel(in_order(outlines(count))) / spanning_tree(strokes(count))
        print(json.dumps({"ratio": round(left, 4)}))
        return
    part, _ = often(partial(outlines, count), in_order)
    tell({"": part})


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2:] == ["way"])
