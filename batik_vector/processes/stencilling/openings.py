"""Openings: what each ink leaves open in its stencil, wrapped round the tile, and brought back to a layer."""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.artwork.page import Border
from batik_vector.geometry.outlines import Steps, of_polygons, of_polylines
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.cutting.choices import LineBodies
from batik_vector.processes.cutting.overlays import united, without, without_hairs
from batik_vector.processes.cutting.regions import regions_of
from batik_vector.processes.stencilling.bridges import moved
from batik_vector.processes.stencilling.sheets import Torus, hanging
from batik_vector.units import STEPS_PER_MM

MEND = 4
"""Steps by which what meets across an edge of the tile may miss, since its two sides were rounded apart."""


def openings_of(layer: Layer, torus: Torus, lines: LineBodies) -> Geometries:
    """Return what an ink leaves open within the tile, as polygons in steps that touch in points at most.

    Raises:
        GeometryError: where lines have no body, or open ones are refused.
    """
    areas, strokes = of_polygons(layer.areas, STEPS_PER_MM), of_polylines(layer.lines, STEPS_PER_MM)
    regions, bodies = regions_of(areas, strokes, layer.ink, lines)
    if not bodies:
        return regions
    return within_tile(regions, torus)


def within_tile(regions: Geometries, torus: Torus) -> Geometries:
    """Return regions with all their repeats, cut out along the edges of the tile, alike on opposite edges."""
    cell = torus.cell
    high = np.array([cell.columns, cell.rows], float)
    which, gains = torus.around(shapely.bounds(regions), np.zeros(2), high)
    whole = united(moved(regions[which], torus.at(gains)))
    box = shapely.box(0, 0, *high)
    outside = ~shapely.covers(box, whole)
    if outside.any():
        # Larger by a step than all that is to be cut off.
        left, low, right, top = shapely.total_bounds([*whole, box]).tolist()
        beyond = shapely.difference(shapely.box(left - 1, low - 1, right + 1, top + 1), box)
        around = np.array([beyond], dtype=object)
        cut = [without(each, around) for each in whole[outside]]
        whole = np.concatenate([whole[~outside], *cut])
    return mended(without_hairs(whole), torus)


def with_thin(openings: Geometries, torus: Torus, neck: float) -> Geometries:
    """Return openings together with what of the sheet between them is too narrow to hold anything.

    Args:
        openings: within the tile, in steps.
        torus: the tile.
        neck: in steps; a disc of that diameter goes through all that is left of the sheet.
    """
    cell, margin = torus.cell, 2 * neck
    low, high = np.full(2, -margin), np.array([cell.columns, cell.rows]) + margin
    which, gains = torus.around(shapely.bounds(openings), low, high)
    around = shapely.union_all(moved(openings[which], torus.at(gains)))
    # Wide enough that no edge of the window makes a neck within the tile.
    sheet = shapely.difference(shapely.box(*low, *high), around)
    reached = shapely.buffer(shapely.buffer(sheet, -neck / 2, quad_segs=ROUND), neck / 2 + 1, quad_segs=ROUND)
    thin = polygonal(
        shapely.intersection(shapely.difference(sheet, reached), shapely.box(0, 0, cell.columns, cell.rows))
    )
    thin = without_crumbs(thin)
    if not len(thin):
        return openings
    # Grown by a step or two, so that it meets the openings on its sides.
    return within_tile(np.concatenate([openings, shapely.buffer(thin, 2, quad_segs=2)]), torus)


def mended(openings: Geometries, torus: Torus) -> Geometries:
    """Return openings of which the corners on far edges of the tile lie where their twins on near ones do."""
    cell = torus.cell
    for axis, size, long in ((0, cell.columns, cell.rows), (1, cell.rows, cell.columns)):
        slip = torus.basis[axis][1 - axis]
        coords = shapely.get_coordinates(openings)
        near = np.unique(coords[coords[:, axis] == 0][:, 1 - axis])
        far = np.flatnonzero(coords[:, axis] == size)
        if not len(near) or not len(far):
            continue
        along = (coords[far, 1 - axis] - slip) % long
        twins = np.concatenate([near - long, near, near + long])
        place = np.clip(np.searchsorted(twins, along), 1, len(twins) - 1)
        left, right = twins[place - 1], twins[place]
        nearest = np.where(along - left <= right - along, left, right)
        off = nearest - along
        move = np.where(np.abs(off) <= MEND, off, 0.0)
        if move.any():
            coords[far, 1 - axis] = np.clip(coords[far, 1 - axis] + move, 0, long)
            fixed = shapely.set_coordinates(np.array(openings, dtype=object), coords)
            openings = np.asarray(shapely.remove_repeated_points(fixed), dtype=object)
    return openings


def bridged(openings: Geometries, bodies: Geometries, torus: Torus) -> Geometries:
    """Return what bridges and all their repeats leave of openings."""
    if not len(bodies):
        return openings
    cell = torus.cell
    high = np.array([cell.columns, cell.rows], float)
    which, gains = torus.around(shapely.bounds(bodies), np.zeros(2), high)
    copies = moved(bodies[which], torus.at(gains))
    one, other = shapely.STRtree(copies).query(openings, predicate="intersects")
    met = np.unique(one)
    cut = [without(openings[each], copies[other[one == each]]) for each in met.tolist()]
    left = np.delete(openings, met)
    return mended(np.concatenate([left, *(without_crumbs(each) for each in cut)]), torus)


ROUND = 16
"""Chords of a quarter of a disc."""
CRUMB = 20.0
"""Steps of breadth, on average, below which what a bridge leaves of an opening is no opening."""


def without_crumbs(areas: Geometries) -> Geometries:
    """Return areas without those that are too fine to have been meant."""
    return areas[2 * shapely.area(areas) >= CRUMB * shapely.length(areas)]


def layer_of(ink: Ink, openings: Geometries, cell: Cell) -> tuple[Layer, frozenset[Border]]:
    """Return openings as a layer of the tile, and the stretches of its seam along which they end."""
    areas = oriented(shapely.remove_repeated_points(openings))
    order = np.lexsort(shapely.bounds(areas).reshape(-1, 4).T[::-1])
    areas = areas[order]
    ends = hanging(areas, cell).seams if len(areas) else np.empty((0, 5), np.int64)
    made = np.asarray(shapely.transform(areas, lambda coords: coords / STEPS_PER_MM), dtype=object)
    return Layer(ink, made), _borders(ink, ends, cell)


def _borders(ink: Ink, ends: Steps, cell: Cell) -> frozenset[Border]:
    found = set[Border]()
    for _, axis, value, low, high in ends.tolist():
        long = cell.rows if axis == 0 else cell.columns
        slip = Torus(cell).basis[axis][1 - axis] if value else 0
        for more in (-1, 0, 1, 2):
            first, last = max(low - slip + more * long, 0), min(high - slip + more * long, long)
            if first < last:
                found.add((ink.name, axis, first, last))
    return frozenset(found)


def as_layers(tile: Artwork, torus: Torus, lines: LineBodies) -> list[tuple[Ink, Geometries]]:
    """Return the openings of each ink of a tile."""
    return [(layer.ink, openings_of(layer, torus, lines)) for layer in tile.layers]
