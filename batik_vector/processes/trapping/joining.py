"""Joining: areas with what they gain, as areas that do not overlap, on whole steps and alike on both sides of
the seam.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from batik_vector.artwork import Cell
from batik_vector.artwork.page import Border
from batik_vector.geometry.outlines import Index, Steps, of_polygons, to_polygons
from batik_vector.geometry.regions import oriented, polygonal
from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.trapping.meeting import with_corners
from batik_vector.units import STEPS_PER_MM

MEND = 2.0
"""Steps by which what meets across an edge of the tile may miss, since its two sides were rounded apart."""
CRUMB = 4.0
"""Steps of breadth, on average, below which an area is nothing that could be printed."""


def grown(areas: Geometries, drawn: Geometries, traps: Geometries, cell: Cell) -> tuple[Geometries, Index]:
    """Return areas joined with traps, and in the place of which area each stands.

    Args:
        areas: of one ink, in steps, that do not overlap, with corners where others have them.
        drawn: the same as they were drawn: they stay so where they gain nothing.
        traps: what they gain; each touches an area, or does so across the seam.
        cell: of the tile.

    Returns:
        The areas, in the order of those in the place of which they stand: where several are joined the first;
        what goes on across the seam alone comes last, and has the number of areas.
    """
    met = np.zeros(len(areas), bool)
    met[shapely.STRtree(areas).query(traps, predicate="dwithin", distance=MEND)[1]] = True
    joined = _together(np.concatenate([areas[met], traps]))
    joined = _apart(_mended(_apart(_rounded(joined)), cell))
    joined = joined[2 * shapely.area(joined) >= CRUMB * shapely.length(joined)]
    number = np.flatnonzero(met)
    inside = shapely.get_coordinates(shapely.point_on_surface(areas[met]))
    at, into = shapely.STRtree(joined).query(shapely.points(inside), predicate="intersects")
    first = np.full(len(joined), len(areas))
    np.minimum.at(first, into, number[at])
    rest = np.flatnonzero(~met)
    every, which = _cornered(np.concatenate([drawn[rest], oriented(joined)]))
    place = np.concatenate([rest, first])[which]
    order = np.argsort(place, kind="stable")
    return every[order], place[order]


def _cornered(areas: Geometries) -> tuple[Geometries, Index]:
    """Return areas with corners where one lies on another's edge, if they overlap by a bit there in mm, and
    which each was; one that comes to touch itself there may become several.
    """
    apart = np.asarray(shapely.transform(areas, lambda xy: xy / STEPS_PER_MM), dtype=object)
    one, other = shapely.STRtree(apart).query(apart, predicate="intersects")
    one, other = one[one < other], other[one < other]
    off = ~np.asarray(shapely.touches(apart[one], apart[other]), bool)
    some = np.unique(np.concatenate([one[off], other[off]]))
    if not len(some):
        return areas, np.arange(len(areas))
    (found,) = with_corners([of_polygons(areas[some])])
    areas = areas.copy()
    areas[some] = to_polygons(found)
    torn = np.flatnonzero(~np.asarray(shapely.is_valid(areas), bool))
    sound = shapely.make_valid(areas[torn], method="structure", keep_collapsed=False)
    areas[torn] = shapely.orient_polygons(sound)
    parts, which = shapely.get_parts(areas, return_index=True)
    kept = shapely.get_type_id(parts) == shapely.GeometryType.POLYGON
    return np.asarray(parts[kept], dtype=object), which[kept]


def _together(areas: Geometries) -> Geometries:
    """Return areas as areas that do not overlap: those that meet one another by themselves, which is far less
    work than all at once.
    """
    one, other = shapely.STRtree(areas).query(areas, predicate="intersects")
    group = np.arange(len(areas))
    while True:
        low = group.copy()
        np.minimum.at(low, one, group[other])
        low = low[low]
        if (low == group).all():
            break
        group = low
    order = np.argsort(group, kind="stable")
    starts = np.append(np.flatnonzero(np.diff(group[order], prepend=-1)), len(order))
    sizes = np.diff(starts)
    pairs = starts[:-1][sizes == 2]
    found = [areas[order[starts[:-1][sizes == 1]]]]
    found.append(np.asarray(shapely.union(areas[order[pairs]], areas[order[pairs + 1]]), dtype=object))
    several = np.flatnonzero(sizes > 2).tolist()
    made = [shapely.union_all(areas[order[starts[each] : starts[each + 1]]]) for each in several]
    found.append(np.array([*made, None], dtype=object)[:-1])
    return polygonal(np.concatenate(found))


def _apart(areas: Geometries) -> Geometries:
    """Return areas, those as one that came to overlap by the rounding."""
    one, other = shapely.STRtree(areas).query(areas, predicate="intersects")
    one, other = one[one < other], other[one < other]
    meet = ~np.asarray(shapely.touches(areas[one], areas[other]), bool)
    near = np.zeros(len(areas), bool)
    near[one[meet]] = near[other[meet]] = True
    if not near.any():
        return areas
    return np.concatenate([areas[~near], polygonal(shapely.union_all(areas[near], grid_size=1))])


def _rounded(areas: Geometries) -> Geometries:
    """Return polygons on whole steps, still valid."""
    snapped = np.asarray(shapely.transform(areas, lambda xy: np.floor(xy + 0.5)), dtype=object)
    sound = np.asarray(shapely.is_valid(snapped), bool)
    good = np.asarray(shapely.remove_repeated_points(snapped[sound]), dtype=object)
    if sound.all():
        return good
    return np.concatenate([good, polygonal(shapely.set_precision(areas[~sound], 1))])


def _mended(areas: Geometries, cell: Cell) -> Geometries:
    """Return areas of which the corners on far edges of the tile lie where their twins on near ones do."""
    for axis, (slip, size, long) in enumerate(_sides(cell)):
        coords = shapely.get_coordinates(areas)
        near = np.unique(coords[coords[:, axis] == 0][:, 1 - axis])
        far = np.flatnonzero(coords[:, axis] == size)
        if not len(near) or not len(far):
            continue
        along = coords[far, 1 - axis] - slip
        twins = np.concatenate([near - long, near, near + long])
        place = np.clip(np.searchsorted(twins, along), 1, len(twins) - 1)
        left, right = twins[place - 1], twins[place]
        off = np.where(along - left <= right - along, left, right) - along
        move = np.where(np.abs(off) <= MEND, off, 0.0)
        if move.any():
            coords[far, 1 - axis] = np.clip(coords[far, 1 - axis] + move, 0, long)
            areas = _rounded(shapely.set_coordinates(np.array(areas, dtype=object), coords))
    return areas


def _sides(cell: Cell) -> tuple[tuple[int, int, int], tuple[int, int, int]]:
    """Return of the far side across each axis how far it has slipped, where it is, and how long it is."""
    (_, up), (right, _) = cell.lattice
    return (up, cell.columns, cell.rows), (right, cell.rows, cell.columns)


def seam_borders(ink: str, areas: Geometries, cell: Cell) -> frozenset[Border]:
    """Return the stretches of the seam along which areas of an ink end on one side alone."""
    rings = shapely.get_rings(areas)
    coords, ring = shapely.get_coordinates(rings, return_index=True)
    points = np.rint(coords).astype(np.int64)
    same = ring[1:] == ring[:-1]
    begin, end = points[:-1][same], points[1:][same]
    found = set[Border]()
    for axis, (slip, size, long) in enumerate(_sides(cell)):
        near = _along(begin, end, axis, 0)
        far = _along(begin, end, axis, size) - slip
        far = np.concatenate([far, far + long])
        far = far[(far[:, 1] > 0) & (far[:, 0] < long)].clip(0, long)
        found |= {(ink, axis, low, high) for low, high in _once(near, far)}
    return frozenset(found)


def _along(begin: Steps, end: Steps, axis: int, at: int) -> Steps:
    """Return the stretches of edges that run along a line, from their lower ends to their higher ones."""
    on = (begin[:, axis] == at) & (end[:, axis] == at)
    ends = np.column_stack([begin[on, 1 - axis], end[on, 1 - axis]])
    return np.sort(ends, axis=1)


def _once(near: Steps, far: Steps) -> Iterator[tuple[int, int]]:
    """Yield the longest stretches that are in one of two sets alone."""
    ends = np.concatenate([near, far]).ravel()
    steps = np.tile([1, -1], len(near) + len(far))
    side = np.repeat([0, 1], [2 * len(near), 2 * len(far)])
    places, which = np.unique(ends, return_inverse=True)
    count = np.zeros((2, len(places)), np.int64)
    np.add.at(count, (side, which.ravel()), steps)
    one, other = np.cumsum(count, axis=1) > 0
    apart = one != other
    begun: Index = np.flatnonzero(apart & ~np.append(False, apart[:-1]))
    ended: Index = np.flatnonzero(~apart & np.append(False, apart[:-1]))
    yield from zip(places[begun].tolist(), places[ended].tolist(), strict=True)
