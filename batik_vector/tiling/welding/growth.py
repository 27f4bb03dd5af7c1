"""Growth: shapes made larger all round, as for a gap or a line's breadth; round at corners and ends."""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.geometry import work
from batik_vector.tiling.torus import overlay
from batik_vector.tiling.torus.remembered import KEPT_VERTICES, Asked, identities, interned
from batik_vector.units import STEPS_PER_MM

PLAIN_CORNERS = 8
"""Chords in a quarter circle where a shape is only asked what it meets: off by 0.5 % of the reach."""

LEFT_OVER = 1.5
"""By how much longer than asked a chord may be: GEOS rounds how many a corner has, and a corner of almost one
and a half chords gets one. What is half way goes by the last bit, so that a corner turned gets another."""


def quad_segs(radius: float, tolerance: float) -> int:
    """Return into how many pieces a buffer must cut a quarter turn to keep the tolerance (both in mm)."""
    if radius <= tolerance:
        return 2
    return max(2, int(np.ceil(LEFT_OVER * np.pi / 4 / np.arccos(1 - tolerance / radius))))


def grown(marks: Geometries, reach: float, tolerance: float) -> Geometries:
    """Return areas or lines in mm, grown by ``reach`` in mm to a tolerance.

    Raises:
        TooLargeError: where they cross themselves too often.
    """
    if not len(marks):
        return marks
    work.spend_on_lines(marks, each=True)
    work.spend_on_growth(marks, reach)
    return np.asarray(shapely.buffer(marks, reach, quad_segs=quad_segs(reach, tolerance)), dtype=object)


def grown_on_grid(shapes: Geometries, reach: float, corners: int = PLAIN_CORNERS) -> Geometries:
    """Return areas in grid steps, grown by ``reach`` in mm, on the grid.

    Args:
        shapes: polygons.
        reach: in mm.
        corners: chords in a quarter circle.

    Raises:
        TooLargeError: where they have too many vertices.
    """
    if not reach:
        return shapes

    steps = reach * STEPS_PER_MM
    if shapely.get_num_coordinates(shapes).sum() > KEPT_VERTICES:
        work.spend_on_growth(shapes, steps)
        return overlay.grown(shapes, steps, corners, overlay.unknown(len(shapes)))
    shapes = interned(shapes)
    rows = identities(shapes)[:, None]
    close = Asked[float].together(("close strands", reach), rows, (shapes,))
    work.spend_on_growth(shapes, steps, *close.answers(lambda _: [work.close_strands(shapes, steps)]))
    return overlay.grown(shapes, steps, corners, Asked(("grown", reach, corners), rows, (shapes,)))
