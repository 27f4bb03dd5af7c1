"""batik_vector's fillings of the drawing, at 0.5 mm: what they take, and what they draw.

python -m benchmarks.hatching parallel RINGS          "parallel": also the edge, no ink beyond it
python -m benchmarks.hatching bare RINGS              parallel up to the very edge, which is not drawn
python -m benchmarks.hatching concentric RINGS drawn
"""

from __future__ import annotations

import json
import sys
from functools import partial

import numpy as np
import shapely

from batik_vector.geometry.outlines import MM, Outlines, of_polygons, to_polylines
from batik_vector.processes.hatching.filling import hatched
from batik_vector.processes.hatching.options import ConcentricHatch, Hatch, ParallelHatch, SpiralHatch
from benchmarks.drawing import evaluated
from benchmarks.peers.drawn import tell, timed

SPACING_MM = 0.5
WAYS: dict[str, Hatch] = {
    "parallel": ParallelHatch(angle=0.0),
    "bare": ParallelHatch(angle=0.0, inset=0.0, edge=False),
    "concentric": ConcentricHatch(),
    "spiral": SpiralHatch(),
}


def areas(rings: int) -> Outlines:
    """Return the drawing."""
    return of_polygons(np.asarray(shapely.polygons(evaluated(rings)), dtype=object), MM)


def main(way: str, rings: int, drawn: bool) -> None:
    """Fill the drawing, and tell what it took or what is drawn."""
    hatched(areas(4), WAYS[way], SPACING_MM)
    part, found = timed(partial(hatched, areas(rings), WAYS[way], SPACING_MM))
    if drawn:
        metres = float(shapely.length(to_polylines(found)).sum()) / MM / 1000
        print(json.dumps({"strokes": len(found), "metres": metres}))
    else:
        tell({"": part})


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), sys.argv[3:] == ["drawn"])
