"""plottool's way of a drag knife round stars: what it takes, and how far the tip is off them.

python -m benchmarks.peers.plottool_knife COUNT
python -m benchmarks.peers.plottool_knife COUNT off
"""

from __future__ import annotations

import json
import sys
from functools import partial

import numpy as np
from hpgl import HPGL, mm2hpgl

from benchmarks.peers.drawn import often, tell
from benchmarks.trailing import OFFSET_MM, off, stars


def read(count: int) -> HPGL:
    """Return the stars as a drawing of plottool's."""
    drawing = HPGL(None)
    for star in np.rint(mm2hpgl(stars(count))).astype(int).tolist():
        drawing.routes.append([tuple(place) for place in [*star, star[0]]])
    return drawing


def cut(drawing: HPGL) -> HPGL:
    """Return it as a knife is led: begun in the longest side, with overcut, and corners."""
    drawing.optimizeCut(OFFSET_MM)
    drawing.bladeOffset(OFFSET_MM)
    return drawing


def main(count: int, how_far: bool) -> None:
    """Lead the knife, and tell what that took or how it cuts."""
    if how_far:
        ways = [np.array(path) / mm2hpgl(1) for path in cut(read(count)).getPaths()]
        # Its own first cut (bladePrepCut) turns the blade to the right.
        print(json.dumps(off(ways, 0.0)))
        return
    part, _ = often(partial(read, count), cut)
    tell({"": part})


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2:] == ["off"])
