"""Bare gaps between inks: slits of cloth that show where two inks were meant to meet.

Tracing programs follow each colour by itself, and leave hairs of ground between neighbours. A printer closes
them by trapping; here they are found, on the torus, where two inks come nearer to each other than a given
breadth and neither they nor any other ink covers what is between.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.certificate.drawing import Drawing, Frame
from batik_vector.certificate.report import Kind, SeamFault
from batik_vector.geometry.congruence import distinct
from batik_vector.tiling.torus.torus import Window, wrap
from batik_vector.units import format_mm

SLENDER = 4.0
"""A gap is this many times as long as it is allowed to be broad; what is shorter lies where inks part."""

QUADRANT = 4
"""Pieces of a quarter circle; corners of what is grown decide nothing."""


def bare_gaps(tile: Drawing, breadth: float) -> list[SeamFault]:
    """Return a fault for each bare gap between two inks that is narrower than a breadth (mm)."""
    frame = tile.frame
    reach = breadth * frame.per_mm
    fields = {ink.ink.name: _field(ink.areas, frame, reach) for ink in tile if len(ink.areas)}
    faults = []
    for (one, here), (other, there) in combinations(fields.items(), 2):
        covered = np.concatenate(list(fields.values()))
        for gap in _between(here, there, covered, frame, reach):
            x, y = shapely.get_coordinates(shapely.point_on_surface(gap))[0]
            at = shapely.Point(x, y)
            size = float(sum(shapely.distance(each, at).min() for each in (here, there))) / frame.per_mm
            half = float(shapely.length(gap)) / 2
            # The longer side of the rectangle that has its area and its outline.
            length = (half + max(half * half - 4 * shapely.area(gap), 0.0) ** 0.5) / 2 / frame.per_mm
            words = f"a bare gap of {format_mm(size)} mm to ink {other} runs {format_mm(length)} mm"
            faults.append(SeamFault(Kind.BETWEEN, one, frame.mm(float(x), float(y)), words, size))
    return faults


def _field(areas: Geometries, frame: Frame, reach: float) -> Geometries:
    """Return areas of the page and those of its neighbours that come near it."""
    margin = int(np.ceil(reach))
    window = Window(-margin, -margin, frame.cell.columns + margin, frame.cell.rows + margin)
    return wrap(areas, np.zeros(len(areas), np.intp), frame.cell.lattice, window)[0]


def _between(
    here: Geometries, there: Geometries, covered: Geometries, frame: Frame, reach: float
) -> Geometries:
    """Return what of the page is bare between areas of two inks less than ``reach`` steps apart."""
    a, b = shapely.STRtree(there).query(here, predicate="dwithin", distance=reach)
    if not len(a):
        return here[:0]
    one, other = (
        shapely.union_all(shapely.buffer(side[distinct(rows)], reach / 2, quad_segs=QUADRANT))
        for side, rows in ((here, a), (there, b))
    )
    both = shapely.intersection(shapely.intersection(one, other), frame.window.box)
    near = covered[shapely.intersects(covered, both)]
    gaps = shapely.get_parts(shapely.difference(both, shapely.union_all(near)))
    gaps = gaps[shapely.get_type_id(gaps) == shapely.GeometryType.POLYGON]
    return np.asarray(gaps[shapely.length(gaps) / 2 >= SLENDER * reach], dtype=object)
