"""What batik_vector's plotter costs on the sides of squares that share them, each a line of its own.

python -m benchmarks.plotting SIDE
"""

from __future__ import annotations

import sys
from dataclasses import replace
from functools import partial

import numpy as np

from batik_vector.geometry.outlines import Outlines
from batik_vector.processes.order import in_order
from batik_vector.processes.plotting.joining import longest
from batik_vector.processes.plotting.once import once
from benchmarks.peers.drawn import LEAST, Part, often, tell
from benchmarks.peers.strokes import sides


def outlines(count: int) -> Outlines:
    """Return the sides of squares, each for itself, those that two share twice."""
    points = np.rint(sides(count, twice=True).reshape(-1, 2) * 1000).astype(np.int64)
    ends = np.arange(len(points) // 2 + 1)
    return Outlines(points, 2 * ends, ends, np.zeros(len(ends) - 1, bool))


def passes(count: int) -> dict[str, Part]:
    """Return what it takes to draw once, to join and to order."""
    parts: dict[str, Part] = {}
    # The second time everything is warm.
    for size, least in ((3, 0.0), (count, LEAST)):
        parts["once"], (left, _, _) = often(partial(outlines, size), once, least)
        parts["joined"], paths = often(partial(replace, left), longest, least)
        parts["ordered"], _ = often(partial(replace, paths), in_order, least)
    return parts


if __name__ == "__main__":
    tell(passes(int(sys.argv[1])))
