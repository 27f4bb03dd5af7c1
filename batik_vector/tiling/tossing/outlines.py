"""The outlines of marks, as a toss keeps them apart."""

from __future__ import annotations

import math

import shapely

OUTLINE_SHARE, PACKED_SHARE = 1 / 400, 1 / 2000
"""How far an outline may be simplified, as a share of the breadth of a mark; see :func:`outline`. What it
stands beyond the mark is lost to a packing."""

NOTCH_SHARE = 0.08
"""Half the breadth of the notches in a mark, as a share of its own, that are closed to others: nobody sees
a bud between two petals as a bud."""


def outline(body: shapely.Geometry, distance: float, slack: float, packed: bool = False) -> shapely.Geometry:
    """Return a coarse shape that holds a mark (mm) and as much as it may stand beyond its body.

    Holes are filled and narrow notches closed, so that marks lie beside one another and not inside. Those
    that are packed nestle: of them only such notches are closed as nothing has room in.
    """
    low_x, low_y, high_x, high_y = shapely.bounds(body)
    breadth = math.hypot(high_x - low_x, high_y - low_y)
    close = distance / 2 if packed else max(distance / 2, NOTCH_SHARE * breadth)
    closed = shapely.buffer(shapely.buffer(body, close, quad_segs=4), -close, quad_segs=4)
    filled = shapely.union_all(shapely.polygons(shapely.get_exterior_ring(shapely.get_parts(closed))))
    step = max(breadth * (PACKED_SHARE if packed else OUTLINE_SHARE), slack / 2 if packed else slack)
    # Four pieces to a quarter turn reach to 0.98 of the radius, and simplifying takes off a step at most.
    grown = shapely.buffer(shapely.union(filled, body), slack + 1.1 * step, quad_segs=4)
    return shapely.simplify(grown, step * 0.95)
