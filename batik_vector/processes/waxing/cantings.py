"""Which canting draws what of a plate, and how many metres of line that is.

Wax is drawn by the broadest spout that fits: what a disc as broad as the spout reaches within the wax is that
canting's, the rest falls to the next finer one. What is finer than the finest is told: points of leaves, and
lines that nothing draws. Metres are of lines side by side, an area over the spout's breadth.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Geometries
from batik_vector.geometry.regions import polygonal
from batik_vector.processes.waxing.multispouts import at_once
from batik_vector.units import STEPS_PER_MM

QUARTER = 8
"""Chords of a quarter of a disc."""
HAIR = 0.02
"""How far (mm) what a spout reaches is drawn out, so that chords about corners leave no hairs."""
ROUND = 0.85
"""4πA/P² from which a piece is a dot: 0.785 is a square's, 1 a circle's."""


def drawn_by(
    page: Artwork,
    areas: Geometries,
    cantings: Mapping[str, float],
    multi_spouts: Mapping[str, tuple[float, int]] | None = None,
) -> dict[str, Any]:
    """Return what each canting draws of a plate, the broadest first, as plain values.

    Args:
        page: on which the plate lies; a tile's wax goes on across its edges.
        areas: the plate's, in mm, of which none overlap.
        cantings: breadths of spouts in mm, by their names.
        multi_spouts: of cantings that there are with several spouts, their pitch in mm and number.
    """
    if not cantings or not len(areas):
        return {"cantings": [], "dots": 0, "finer_mm2": 0.0}
    spouts = sorted(cantings.items(), key=lambda each: (-each[1], each[0]))
    window = shapely.box(
        -page.bleed, -page.bleed, page.cell.width + page.bleed, page.cell.height + page.bleed
    )
    left = _around(page, areas, 2 * spouts[0][1])
    told = list[dict[str, Any]]()
    for name, spout in spouts:
        reached = _reached(left, spout)
        drawn = shapely.intersection(reached, window)
        area = float(shapely.area(drawn))
        told.append(
            {
                "canting": name,
                "spout_mm": spout,
                "area_mm2": round(area, 1),
                "metres": round(area / spout / 1000, 3),
            }
        )
        if multi_spouts and name in multi_spouts:
            pieces = polygonal(drawn)
            dot = _are_dots(pieces, 1.5 * spout)
            told[-1]["at_once"] = at_once(pieces[~dot], pieces[dot], spout, *multi_spouts[name])
        left = _areas(shapely.difference(left, reached))
    finer = float(shapely.area(shapely.intersection(left, window)))
    dots = int(_are_dots(areas, 1.5 * spouts[0][1]).sum())
    return {"cantings": told, "dots": dots, "finer_mm2": round(finer, 1)}


def _around(page: Artwork, areas: Geometries, reach: float) -> shapely.Geometry:
    """Return wax with that of the repeats within reach, in mm."""
    if page.bleed:
        return shapely.union_all(areas)
    (ax, ay), (bx, by) = page.cell.lattice
    box = np.array([-reach, -reach, page.cell.width + reach, page.cell.height + reach])
    bounds = shapely.bounds(areas)
    found = []
    for i in (-1, 0, 1):
        for j in (-2, -1, 0, 1, 2):
            move = np.array([i * ax + j * bx, i * ay + j * by]) / STEPS_PER_MM
            low, high = bounds[:, :2] + move, bounds[:, 2:] + move
            near = (low < box[2:]).all(axis=1) & (high > box[:2]).all(axis=1)
            found += [shapely.affinity.translate(each, *move.tolist()) for each in areas[near]]
    return shapely.union_all(found)


def _reached(wax: shapely.Geometry, spout: float) -> shapely.Geometry:
    """Return what of wax a disc reaches that stays within."""
    inner = shapely.buffer(wax, -spout / 2 + HAIR / 4, quad_segs=QUARTER)
    grown = shapely.buffer(inner, spout / 2 + HAIR, quad_segs=QUARTER)
    return _areas(shapely.intersection(grown, wax))


def _areas(found: shapely.Geometry) -> shapely.Geometry:
    """Return what of a geometry is area: where areas touch, GEOS adds the lines and points they share."""
    areas = polygonal(found)
    return areas[0] if len(areas) == 1 else shapely.MultiPolygon(areas.tolist())


def _are_dots(areas: Geometries, most: float) -> NDArray[np.bool_]:
    """Return which pieces are round and no broader than told: *cecek*."""
    area, length = shapely.area(areas), shapely.length(areas)
    small = area <= np.pi * most * most / 4
    return np.asarray(small & (4 * np.pi * area >= ROUND * length * length), bool)
