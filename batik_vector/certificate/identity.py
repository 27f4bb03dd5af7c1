"""Torus identity: the field of tiles, welded and cut elsewhere, is the tile.

The measure is the area of the symmetric difference. It is no second look at the edges but at what comes
of them: joining across the seams must lose nothing, double nothing and move nothing, or yardage would
not be the tile. Where an artwork has a bleed, what it draws there must be the tile too.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.certificate.drawing import Frame
from batik_vector.certificate.recut import Elsewhere, translates
from batik_vector.certificate.report import Place
from batik_vector.tiling.torus.torus import Window, clip_areas, polygons_of, wrap
from batik_vector.tiling.welding.weld import welded

Difference = tuple[float, Place | None]
"""Area in mm², and where the largest piece of it lies, in mm; None where there is none to speak of."""

SLACK_STEPS = 0.5
"""How far joining off the 1 µm grid may move an outline: half a step of the finer grid it is measured on."""


def rolled_difference(areas: Geometries, field: Elsewhere, limit: float) -> Difference:
    """Return how far the field cut elsewhere differs from the tile.

    Args:
        areas: of the tile, in steps, apart from one another.
        field: made of them.
        limit: in mm²; the place of a difference below it is not looked for.
    """
    # Areas that neither the seams nor the new cut touch are the same bits on both sides.
    low, high = np.array(field.box.bounds).reshape(2, 2)
    bounds = shapely.bounds(field.whole).reshape(-1, 4)
    reaches = ((bounds[:, 2:] > low) & (bounds[:, :2] < high)).all(axis=1)
    crossing = field.whole[reaches & ~shapely.covered_by(field.whole, field.box)]
    again = _rolled(np.concatenate([field.healed, crossing]), field.box, field.frame)
    here = np.concatenate([areas[field.edge], _once(crossing, field.frame)])
    return _difference(here, again, field.frame, limit)


def _once(pieces: Geometries, frame: Frame) -> Geometries:
    """Return the areas of the tile of which pieces are translates, each of them once."""
    if not len(pieces):
        return pieces
    low = shapely.bounds(pieces)[:, :2]
    places = np.array([frame.on_page(x, y) for x, y in low.tolist()])
    moved = shapely.set_coordinates(
        pieces.copy(),
        shapely.get_coordinates(pieces)
        + np.repeat(np.rint(places - low), shapely.get_num_coordinates(pieces), axis=0),
    )
    _, first = np.unique(shapely.to_wkb(moved), return_index=True)
    return np.asarray(moved[np.sort(first)], dtype=object)


def _rolled(pieces: Geometries, box: shapely.Polygon, frame: Frame) -> Geometries:
    """Cut areas at a box, and move what is inside back onto the page."""
    parts = []
    for x, y in translates(frame, box):
        page = shapely.box(x, y, x + frame.cell.columns, y + frame.cell.rows)
        window = shapely.intersection(page, box)
        if shapely.area(window) == 0:
            continue
        near = pieces[shapely.intersects(pieces, window)]
        inside = shapely.covered_by(near, window)
        cut = shapely.intersection(near[~inside], window)
        found, _ = polygons_of(np.concatenate([near[inside], cut]), np.zeros(len(near), np.intp))
        parts.append(_moved(found, -x, -y))
    return np.concatenate(parts) if parts else pieces[:0]


def _moved(areas: Geometries, x: int, y: int) -> Geometries:
    if not len(areas):
        return areas
    return np.asarray(shapely.transform(areas, lambda xy: xy + np.array([x, y], np.float64)), dtype=object)


def _difference(one: Geometries, other: Geometries, frame: Frame, limit: float) -> Difference:
    """Return the area in exactly one of two sets of areas, each apart within itself."""
    total = float(shapely.area(one).sum() + shapely.area(other).sum())
    if len(one) and len(other):
        a, b = shapely.STRtree(one).query(other, predicate="intersects")
        total -= 2 * float(shapely.area(shapely.intersection(one[b], other[a])).sum())
    mm2 = abs(total) / frame.per_mm**2
    if mm2 <= limit:
        return mm2, None
    odd = shapely.get_parts(shapely.symmetric_difference(shapely.union_all(one), shapely.union_all(other)))
    if not shapely.area(odd).sum():
        # Areas lie over one another: what they cover is the same, and there is less of it.
        odd = one
    x, y = shapely.get_coordinates(shapely.point_on_surface(odd[np.argmax(shapely.area(odd))]))[0]
    return mm2, frame.mm(float(x), float(y))


def bleed_difference(
    marks: Geometries, areas: Geometries, frame: Frame, bleed: int, limit: float
) -> Difference:
    """Return how far what is drawn in the bleed differs from the tile's repeats there.

    Args:
        marks: valid areas in steps, uncut.
        areas: what they cover of the page, in steps.
        frame: the page.
        bleed: its breadth in steps.
        limit: as for :func:`rolled_difference`.
    """
    cell = frame.cell
    window = Window(-bleed, -bleed, cell.columns + bleed, cell.rows + bleed)
    field, _ = wrap(areas, np.zeros(len(areas), np.intp), cell.lattice, window)
    drawn, again = (clip_areas(*welded(each), window)[0] for each in (marks, field))
    return _difference(drawn, again, frame, limit)


def allowed(limit: float, areas: Sequence[shapely.Polygon] | NDArray[np.object_], frame: Frame) -> float:
    """Return the limit (mm²) for a tile: of one off the 1 µm grid, what joining on a grid may move more."""
    if frame.exact:
        return limit
    length = float(shapely.length(np.asarray(areas, dtype=object)).sum())
    return limit + SLACK_STEPS * length / frame.per_mm**2
