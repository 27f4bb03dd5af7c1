"""Spreading: what of a darker ink lies within a trap's breadth of where it meets a lighter one.

A stretch of meeting is made as broad as the trap on both sides, which never tears, and the darker ink's area
is cut out with it. Where an area has tens of thousands of holes, only the rings near a stretch are looked at.
"""

from __future__ import annotations

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Cell
from batik_vector.geometry.outlines import Index, Steps
from batik_vector.geometry.sampling import Geometries
from batik_vector.values import frozen

SAG = 1.0
"""Steps by which chords may lie within the arcs of a trap."""
SMALL = 400
"""Vertices of an area up to which it is cut whole."""
PIECE = 48
"""Edges of a ring that are looked for at once."""
HEAVY = 400_000
"""Vertices to be read from which all stretches along an area are cut out of it at once."""
APART = 2.0
"""Steps from a stretch within which what touches it was rounded off it."""


@frozen(eq=False)
class Spread:
    """Areas that are to be printed with a lighter ink too, and the darker area that each lies in."""

    areas: Geometries
    owner: Index


def broadened(lines: Geometries, width: float) -> Geometries:
    """Return all within so many steps of each polyline."""
    turn = math.acos(max(1 - SAG / width, 0.0))
    quarter = max(4, math.ceil(round(math.pi / 4 / turn, 6)))
    return np.asarray(shapely.buffer(lines, width, quad_segs=quarter), dtype=object)


def repeats(bands: Geometries, cell: Cell) -> tuple[Index, Steps]:
    """Return which bands, and by how much moved, shape (n, 2), reach into a tile with all their repeats."""
    bounds = shapely.bounds(bands).reshape(-1, 4)
    (ax, ay), (bx, by) = cell.lattice
    low, high = bounds[:, :2].min(axis=0, initial=0), bounds[:, 2:].max(axis=0, initial=0)
    # What goes on across the seam may reach far from the tile, and a drop carries it farther.
    wide, tall = (int((high - low)[k] // side) + 2 for k, side in ((0, ax), (1, by)))
    wide, tall = wide + (tall if bx else 0), tall + (wide if ay else 0)
    found, shifts = [np.empty(0, np.intp)], [np.empty((0, 2), np.int64)]
    for i in range(-wide, wide + 1):
        for j in range(-tall, tall + 1):
            shift = np.array([i * ax + j * bx, i * ay + j * by], np.int64)
            meets = (bounds[:, 2:] + shift > 0) & (bounds[:, :2] + shift < (cell.columns, cell.rows))
            at = np.flatnonzero(meets.all(axis=1))
            found.append(at)
            shifts.append(np.broadcast_to(shift, (len(at), 2)))
    return np.concatenate(found), np.concatenate(shifts)


def moved(geometries: Geometries, shifts: Steps) -> Geometries:
    """Return geometries, each moved by its own shift."""
    if not shifts.any():
        return geometries
    by = np.repeat(shifts, shapely.get_num_coordinates(geometries), axis=0)
    return np.asarray(shapely.transform(geometries, lambda xy: xy + by), dtype=object)


def spread(lines: Geometries, bands: Geometries, areas: Geometries, which: Index, shifts: Steps) -> Spread:
    """Return what of areas lies within bands about the stretches at which a lighter ink meets them.

    Args:
        lines: the stretches, one for each band.
        bands: what is within the trap's breadth of them.
        areas: valid polygons in steps, of the darker ink.
        which: of which stretch each of them is a repeat.
        shifts: by how much it is moved, shape (n, 2).
    """
    if not len(bands) or not len(areas):
        return Spread(np.empty(0, dtype=object), np.empty(0, np.intp))
    todo, joined = _gathered(_around(_near(bands, areas), bands, areas), bands, areas)
    pairs, cut = todo.pairs, np.empty(len(todo.pairs), dtype=object)
    cut[todo.holes] = shapely.difference(todo.bands[todo.holes], todo.around[todo.holes])
    cut[~todo.holes] = shapely.intersection(todo.around[~todo.holes], todo.bands[~todo.holes])
    parts, index = _polygons(cut)
    near = _touching(parts, index, lines, pairs, joined)
    band = pairs[index, 1]
    if not near.all():
        _go_on(moved(parts, -shifts[band]), which[band], near)
    kept = np.flatnonzero(near)
    return Spread(parts[kept], pairs[index[kept], 0])


def _polygons(geometries: Geometries) -> tuple[Geometries, Index]:
    """Return the polygons among the parts of geometries, and which each is of."""
    parts, index = shapely.get_parts(geometries, return_index=True)
    parts, of = shapely.get_parts(parts, return_index=True)
    good = (shapely.get_type_id(parts) == shapely.GeometryType.POLYGON) & ~shapely.is_empty(parts)
    return np.asarray(parts[good], dtype=object), index[of[good]]


@frozen(eq=False)
class _Near:
    """Which bands come near which rings: their numbers beside one another; all rings, and whose each is."""

    band: Index
    ring: Index
    rings: Geometries
    owner: Index


def _near(bands: Geometries, areas: Geometries) -> _Near:
    rings, owner = shapely.get_rings(areas, return_index=True)
    coords, ring = shapely.get_coordinates(rings, return_index=True)
    begin = np.flatnonzero(ring[1:] == ring[:-1])
    first = np.searchsorted(ring, np.arange(len(rings)))
    fresh = np.ones(len(begin), bool)
    fresh[1:] = (ring[begin[1:]] != ring[begin[:-1]]) | ((begin[1:] - first[ring[begin[1:]]]) % PIECE == 0)
    starts = np.flatnonzero(fresh)
    points = np.insert(coords[begin + 1], starts, coords[begin[starts]], axis=0)
    stops = np.append(starts, len(begin))[1:] + np.arange(1, len(starts) + 1)
    pieces = shapely.from_ragged_array(
        shapely.GeometryType.LINESTRING, points, (np.concatenate([[0], stops]),)
    )
    band, piece = shapely.STRtree(pieces).query(bands, predicate="intersects")
    both = np.unique(np.column_stack([band, ring[begin[starts[piece]]]]), axis=0)
    return _Near(both[:, 0], both[:, 1], np.asarray(rings, dtype=object), owner)


@frozen(eq=False)
class _Todo:
    """What is to be cut with which bands: ``pairs`` has the area and the band of each, shape (n, 2).

    ``around`` is the same as the area within the band; where ``holes`` says so it is a hole of the area, and
    all around it belongs to the area.
    """

    pairs: Index
    around: Geometries
    bands: Geometries
    holes: NDArray[np.bool_]


def _around(near: _Near, bands: Geometries, areas: Geometries) -> _Todo:
    """Return what areas are like within the bands that come near them."""
    pairs, which, counts = np.unique(
        np.column_stack([near.owner[near.ring], near.band]), axis=0, return_inverse=True, return_counts=True
    )
    ring = near.ring[np.argsort(which.ravel(), kind="stable")]
    starts = np.cumsum(counts) - counts
    around = areas[pairs[:, 0]]
    large = shapely.get_num_coordinates(areas)[pairs[:, 0]] > SMALL
    # Rings of an area stand together, the outer one first.
    shell = np.searchsorted(near.owner, pairs[:, 0])
    first = ring[starts]
    alone = large & (counts == 1) & (first != shell)
    around[alone] = shapely.polygons(near.rings[first[alone]])
    for number in np.flatnonzero(large & ~alone).tolist():
        mine = ring[starts[number] : starts[number] + counts[number]]
        holes = near.rings[mine[mine != shell[number]]]
        if len(holes) < len(mine):
            outer = near.rings[shell[number]]
        else:
            bounds = shapely.bounds(np.append(holes, bands[pairs[number, 1]]))
            low, high = bounds[:, :2].min(axis=0) - 1, bounds[:, 2:].max(axis=0) + 1
            outer = shapely.get_exterior_ring(shapely.box(*low, *high))
        around[number] = shapely.polygons(outer, holes if len(holes) else None)
    return _Todo(pairs, around, bands[pairs[:, 1]], alone)


def _gathered(todo: _Todo, bands: Geometries, areas: Geometries) -> tuple[_Todo, dict[int, Index]]:
    """Return what is to be cut with what; long outlines with many bands are cut with all of them at once.

    Returns:
        What is to be cut, and which bands those are that are several.
    """
    owner = todo.pairs[:, 0]
    load = np.bincount(owner, weights=shapely.get_num_coordinates(todo.around), minlength=len(areas))
    heavy = np.flatnonzero(load > HEAVY)
    if not len(heavy):
        return todo, {}
    kept, several = np.ones(len(owner), bool), dict[int, Index]()
    for each in heavy.tolist():
        mine = np.flatnonzero(owner == each)
        todo.around[mine[0]] = areas[each]
        todo.bands[mine[0]] = shapely.union_all(bands[todo.pairs[mine, 1]])
        todo.holes[mine[0]] = False
        kept[mine[1:]] = False
        several[int(mine[0])] = todo.pairs[mine, 1]
    place = np.cumsum(kept) - 1
    left = _Todo(todo.pairs[kept], todo.around[kept], todo.bands[kept], todo.holes[kept])
    return left, {int(place[number]): those for number, those in several.items()}


def _touching(
    parts: Geometries,
    index: Index,
    lines: Geometries,
    pairs: Index,
    joined: dict[int, Index],
) -> NDArray[np.bool_]:
    """Return which parts touch their stretch: others lie across a gap from it, or go on across the seam."""
    alone = np.bincount(index, minlength=len(pairs)) == 1
    # Where a part has a corner of a stretch, it lies along it: most do, and need no measuring.
    near = np.asarray(alone[index] & _share_corners(parts, lines, pairs[index, 1]), bool)
    near[np.isin(index, list(joined))] = False
    asked = np.flatnonzero(~near)
    if not len(asked):
        return near
    plain = asked[~np.isin(index[asked], list(joined))]
    near[plain] = shapely.dwithin(parts[plain], lines[pairs[index[plain], 1]], APART)
    for number, those in joined.items():
        mine = asked[index[asked] == number]
        near[
            mine[shapely.STRtree(lines[those]).query(parts[mine], predicate="dwithin", distance=APART)[0]]
        ] = True
    return near


def _go_on(parts: Geometries, which: Index, near: NDArray[np.bool_]) -> None:
    """Take in the parts that touch one of the same stretch across the seam, and what touches those.

    Args:
        parts: where they lie about the stretch itself, and not about its repeats.
        which: the stretch of each.
        near: which are taken in already; changed here.
    """
    rest = np.flatnonzero(~near)
    one, other = shapely.STRtree(parts).query(parts[rest], predicate="dwithin", distance=APART)
    one = rest[one]
    same = which[one] == which[other]
    one, other = one[same], other[same]
    while (more := ~near[one] & near[other]).any():
        near[one[more]] = True


def _share_corners(parts: Geometries, lines: Geometries, line: Index) -> NDArray[np.bool_]:
    """Return which parts have a corner in the same place as their line: ``line`` has the number of each."""
    coords, part = shapely.get_coordinates(parts, return_index=True)
    corners, of = shapely.get_coordinates(lines, return_index=True)
    if not len(corners):
        return np.zeros(len(parts), bool)
    # Corners of stretches are whole steps, and numbers are found faster than pairs.
    low, high = corners.min(axis=0), corners.max(axis=0)
    among = np.flatnonzero(((coords == np.rint(coords)) & (coords >= low) & (coords <= high)).all(axis=1))
    span = int(high[1] - low[1]) + 1
    one, other = ((xy - low).astype(np.int64) @ (span, 1) for xy in (coords[among], corners))
    places, which = np.unique(other, return_inverse=True)
    at = np.minimum(np.searchsorted(places, one), len(places) - 1)
    here = places[at] == one
    among, at = among[here], at[here]
    # Of its own line: that of another may lie across a gap from it.
    found = among[np.isin(at * len(lines) + line[part[among]], which.ravel() * len(lines) + of)]
    return np.bincount(part[found], minlength=len(parts)) > 0
