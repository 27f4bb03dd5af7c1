"""The field that a tile makes, welded, and cut at another place.

Tiles are set side by side, what the seams divided is joined, and one cell's worth of it is cut out with
the seams inside. Moved back onto the page piece by piece, it must be the tile again.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.certificate.drawing import Frame
from batik_vector.tiling.torus.torus import Window, wrap
from batik_vector.tiling.welding.weld import welded
from batik_vector.values import frozen

GOLDEN = (5**0.5 - 1) / 2
"""Share of the height at which the field is cut elsewhere, and of the width, squared: no simple fraction
of a tile, so that no symmetry of a drawing brings a seam onto the cut."""


@frozen(eq=False)
class Elsewhere:
    """One ink's field over the shifted ``box`` (steps), in which the seams lie inside.

    ``healed`` are the areas that a seam divided, joined; ``whole`` those that touch none. Both are
    everything that reaches into the box, uncut. ``edge`` tells which areas of the tile touch its edges.
    """

    frame: Frame
    box: shapely.Polygon
    healed: Geometries
    whole: Geometries
    edge: NDArray[np.bool_]


def elsewhere(areas: Geometries, frame: Frame) -> Elsewhere:
    """Return the field of a tile's areas (steps, apart from one another) over a page cut elsewhere."""
    cell = frame.cell
    # Half a step beside the grid no edge of the drawing runs along the cut.
    x, y = round(cell.columns * GOLDEN**2) + 0.5, round(cell.rows * GOLDEN) + 0.5
    box = shapely.box(x, y, x + cell.columns, y + cell.rows)
    outer = Window(int(x), int(y), int(x) + cell.columns + 1, int(y) + cell.rows + 1)
    bounds = shapely.bounds(areas).reshape(-1, 4)
    low, high = bounds[:, :2] <= 0, bounds[:, 2:] >= np.array([cell.columns, cell.rows])
    edge = np.asarray((low | high).any(axis=1), dtype=bool)
    pieces, on_edge = wrap(areas, edge.astype(np.intp), cell.lattice, outer)
    divided = on_edge.astype(bool)
    healed, _ = welded(pieces[divided])
    return Elsewhere(frame, box, healed, pieces[~divided], edge)


def translates(frame: Frame, box: shapely.Polygon) -> list[tuple[int, int]]:
    """Return the shifts that carry the page to those translates of it that meet a box."""
    page = np.array([frame.window.box], dtype=object)
    x0, y0, x1, y1 = shapely.bounds(box)
    window = Window(int(np.floor(x0)), int(np.floor(y0)), int(np.ceil(x1)), int(np.ceil(y1)))
    pages, _ = wrap(page, np.zeros(1, np.intp), frame.cell.lattice, window)
    return [(int(x), int(y)) for x, y, _, _ in shapely.bounds(pages)]
