"""What a recipe will come to, told before it is compiled: about how many vertices, and how much work.

It is counted from the coarse drawings that every placement begins with and from how many copies its layout
sets out, which takes a few milliseconds. Nothing is refused here, and nothing is promised: half or twice as
much is usual.
"""

from __future__ import annotations

import math

import numpy as np
import shapely

from batik_vector.compiling.placements import COARSE
from batik_vector.errors import BatikError
from batik_vector.recipe.figures import draw, size_of
from batik_vector.recipe.model import Placement, Recipe
from batik_vector.tiling.layouts import Bend, FreeGround, Scattered, Stripes
from batik_vector.values import frozen

COVERED = 0.6
"""Share of the repeat that the boxes of tossed marks cover, with half the distance round each: about."""
LEAST_MM = 0.2
"""A mark is taken to be no smaller than this: what is smaller is refused."""
PER_BENT, PER_TOSSED = 4.0, 300.0
"""What a vertex of a bent motif, and a mark that is tossed, take as long as: so many plain vertices. Measured
on the samples."""


@frozen
class Foretold:
    """About how many vertices a tile will have, and how much work it is: vertices that are no trouble."""

    vertices: int
    effort: float


def foretold(recipe: Recipe) -> Foretold:
    """Return what the tile of a recipe will come to; nothing where that cannot be told."""
    vertices, effort = 0.0, 0.0
    for placement in recipe.place:
        try:
            count, weight = _foretold(placement, recipe)
        except (BatikError, KeyError):
            # What is wrong with it is told by compiling it.
            continue
        vertices += count
        effort += weight
    return Foretold(int(vertices), effort)


def _foretold(placement: Placement, recipe: Recipe) -> tuple[float, float]:
    """Return the vertices and the effort of a placement."""
    if isinstance(placement.layout, FreeGround):
        # What it fills is what the others leave.
        return 0.0, 0.0
    unit = recipe.tiling.unit()
    orbit = recipe.tiling.orbit(placement.symmetry, placement.phase, placement.spread)
    times = max(len(orbit.operations), 1)
    drawn, fine, boxes = [], [], []
    for name in placement.motifs:
        motif = recipe.motif[name]
        coarse = COARSE * size_of(motif)
        figures = draw(motif, coarse)
        marks = np.concatenate([part for each in figures for part in (each.areas, each.lines)])
        low_x, low_y, high_x, high_y = shapely.total_bounds(marks).tolist()
        box = high_x - low_x, high_y - low_y
        scale = placement.scale or (placement.width or 1.0) / max(box[0], 1e-9)
        finer = math.sqrt(max(coarse * scale / recipe.tolerance, 0.01))
        fine.append(min(finer, 1.0))
        drawn.append(float(shapely.get_num_coordinates(marks).sum()) * max(finer, 1.0))
        boxes.append((max(box[0] * scale, LEAST_MM), max(box[1] * scale, LEAST_MM)))
    each, layout, extra, factor = float(np.mean(drawn)), placement.layout, 0.0, 1.0
    if isinstance(layout, Scattered):
        sides = [(width + layout.distance) * (height + layout.distance) for width, height in boxes]
        room = COVERED * unit.width * unit.height / float(np.mean(sides)) / times
        count, extra = (room if layout.count is None else float(layout.count)), PER_TOSSED
    elif isinstance(layout, Stripes):
        width, height = boxes[0]
        count = unit.width * unit.height / (width * max(height, width / 10))
    elif isinstance(images := layout.images((unit.width, unit.height)), Bend):
        count, factor = float(images.system.image_count()), PER_BENT
    else:
        count = float(len(images))
    count *= times
    return count * each * float(np.mean(fine)), count * (each * factor + extra)
