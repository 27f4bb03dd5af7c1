"""Areas to fill, and what is true of strokes that fill them."""

from __future__ import annotations

import numpy as np
import shapely
from hypothesis import strategies as st
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from batik_vector.geometry.outlines import Outlines, of_polygons, to_polylines
from tests.strategies import polygons


@st.composite
def areas(draw: st.DrawFn, most: int = 3, mm: float = 14.0) -> NDArray[np.object_]:
    """Valid polygons with holes, on the grid, side by side, each some mm across."""
    found = []
    for number in range(draw(st.integers(1, most))):
        shape = shapely.transform(draw(polygons()), lambda points: np.rint(points * mm * 1000))
        shape = shapely.affinity.translate(shape, number * 9 * mm * 1000 - 700)
        if shape.is_valid and shape.geom_type == "Polygon":
            found.append(shape)
    return np.array(found, dtype=object)


def outlines(*shapes: BaseGeometry, scale: float = 1000.0) -> Outlines:
    """Polygons given in mm."""
    return of_polygons(np.array(shapes, dtype=object), scale)


def lines(strokes: Outlines) -> NDArray[np.object_]:
    """Strokes as polylines in steps; closed ones come back to their beginning."""
    return to_polylines(strokes)


def inked(strokes: Outlines, width: float) -> BaseGeometry:
    """What a round pen of so many mm paints, in steps."""
    return shapely.union_all(shapely.buffer(lines(strokes), width * 500, quad_segs=16))


def unpainted(shapes: NDArray[np.object_], strokes: Outlines, width: float) -> float:
    """The share that stays white of what a round pen can reach without leaving the shapes."""
    inner = shapely.buffer(shapes, -width * 500, quad_segs=32)
    reached = shapely.union_all(shapely.buffer(inner, width * 500, quad_segs=32))
    if reached.area < 1e6:
        return 0.0
    return float(reached.difference(inked(strokes, width)).area / reached.area)
