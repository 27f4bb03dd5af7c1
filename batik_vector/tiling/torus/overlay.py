"""Overlays whose results lie on the grid.

GEOS can overlay on the grid itself, by snap rounding, at three to seven times the cost. Nearly always it
is enough to overlay as floats and to round what comes out, and that is done here; only where rounding
makes a result invalid is it made again on the grid. Halves are rounded up, never to even: an even
place may be odd a repeat farther on, and both sides of a seam must round alike.

Coordinates are whole grid steps.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry import work

SPECK = 0.25
"""Grid cells: a hole smaller than this is no drawing."""

MANY = 20_000
"""Vertices past which a union is not made once more on the grid, for which GEOS may take minutes, but rounded
there as a whole."""

STEPWISE = 100_000
"""Vertices of a group past which it is united step by step: crossings may be many times as many."""

MUCH = 2_000_000
"""Vertices of marks and of what is taken away from them that are overlaid at one go."""

Brought = Callable[[NDArray[np.intp] | slice], Geometries]
"""Brings the geometries of some rows to another place."""

Again = Callable[[NDArray[np.intp]], shapely.Geometry | Geometries]
"""Makes the results of some rows again, on the grid."""


def united(groups: Sequence[Geometries]) -> Geometries:
    """Return the union of each group of areas: shape (n,).

    Raises:
        TooLargeError: where they are too large, or cross too often.
    """
    work.foretell_union(groups)
    joined = np.empty(len(groups), dtype=object)
    sizes = np.array([len(group) for group in groups], np.intp)
    all_areas = np.concatenate([np.empty(0, dtype=object), *groups])
    ends = np.cumsum(shapely.get_num_coordinates(all_areas))[np.cumsum(sizes) - 1]
    vertices = np.diff(ends, prepend=0)
    for row in np.flatnonzero(vertices > STEPWISE).tolist():
        joined[row] = _by_pairs(groups[row])
    # Groups of about one size are united in one call: a row may end in nothing.
    powers = np.where(vertices > STEPWISE, -1, _powers(sizes))
    for power in sorted(set(powers.tolist()) - {-1}):
        rows = np.flatnonzero(powers == power)
        for batch in work.batches(vertices[rows]):
            part = rows[batch]
            table = np.full((len(part), 2**power), None, dtype=object)
            for row, group in zip(table, part.tolist(), strict=True):
                row[: sizes[group]] = groups[group]
            joined[part] = shapely.union_all(table, axis=1)
            work.spend_on_union(np.concatenate([groups[row] for row in part.tolist()]), joined[part])

    whole = _without_specks(joined)

    def again(rows: NDArray[np.intp]) -> Geometries:
        return np.array([_united_on_grid(groups[row], whole[row]) for row in rows.tolist()], dtype=object)

    return _rounded(whole, again)


def _by_pairs(areas: Geometries) -> shapely.Geometry:
    """Return the union of many areas, neighbours first, two by two: so what it costs is known in time."""
    areas = areas[_side_by_side(areas)]
    while len(areas) > 1:
        pairs = len(areas) // 2
        first, second = areas[: 2 * pairs : 2], areas[1 : 2 * pairs : 2]
        joined = []
        for batch in work.batches(shapely.get_num_coordinates(first) + shapely.get_num_coordinates(second)):
            joined.append(np.asarray(shapely.union(first[batch], second[batch]), dtype=object))
            work.spend_on_union(np.concatenate([first[batch], second[batch]]), joined[-1])
        areas = np.concatenate([*joined, areas[2 * pairs :]])
    whole: shapely.Geometry = areas[0]
    return whole


def _side_by_side(areas: Geometries) -> NDArray[np.intp]:
    """Return areas in an order in which neighbours follow one another: strips, and in each from below."""
    left, bottom, right, top = shapely.bounds(areas).T
    strip = np.empty(len(areas), np.intp)
    across = math.ceil(math.sqrt(len(areas)))
    strip[np.argsort(left + right, kind="stable")] = np.arange(len(areas)) // across
    return np.lexsort([bottom + top, strip])


def _united_on_grid(areas: Geometries, union: shapely.Geometry) -> shapely.Geometry:
    """Return the union of areas on the grid, given the one that lies between its points."""
    many = max(int(shapely.get_num_coordinates(areas).sum()), int(shapely.get_num_coordinates(union)))
    work.spend(many, per_vertex=work.PER_ROUNDED_VERTEX if many > MANY else work.PER_MENDED_VERTEX)
    if many > MANY:
        return shapely.set_precision(union, 1.0)
    return shapely.union_all(areas, grid_size=1.0)


def _powers(sizes: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return the least powers of two that hold some sizes."""
    return np.asarray(np.ceil(np.log2(np.maximum(sizes, 1))), np.intp)


def less(marks: Geometries, away: Geometries, brought: Brought | None = None) -> Geometries:
    """Return each mark without the area that stands in the same row.

    Args:
        marks, away: as many of each.
        brought: brings the areas of some rows to where they are taken away, a few at a time since they may
            be far larger than the marks; left out where they lie there.

    Raises:
        TooLargeError: where they are too large, or cross too often.
    """
    left = np.empty(len(marks), dtype=object)
    for batch in work.batches(shapely.get_num_coordinates(marks) + shapely.get_num_coordinates(away), MUCH):
        taken = away[batch] if brought is None else brought(batch)
        left[batch] = shapely.difference(marks[batch], taken)
        work.spend_on_cuts(marks[batch], taken, left[batch])
    return _rounded(
        left, lambda rows: _less_on_grid(marks[rows], away[rows] if brought is None else brought(rows))
    )


def _less_on_grid(marks: Geometries, away: Geometries) -> Geometries:
    work.spend(float(shapely.get_num_coordinates(marks).sum()), per_vertex=work.PER_MENDED_VERTEX)
    work.spend(float(shapely.get_num_coordinates(away).sum()))
    return np.asarray(shapely.difference(marks, away, grid_size=1.0), dtype=object)


def within(areas: Geometries, window: shapely.Polygon) -> Geometries:
    """Return what of each area lies in a window."""
    work.spend(float(shapely.get_num_coordinates(areas).sum()), per_vertex=work.PER_CUTTER_VERTEX)
    inside = np.asarray(shapely.intersection(areas, window), dtype=object)
    return _rounded(inside, lambda rows: shapely.intersection(areas[rows], window, grid_size=1.0))


def on_grid(areas: Geometries) -> Geometries:
    """Return areas rounded to whole steps."""
    return _rounded(areas, lambda rows: mended(areas[rows]))


def mended(marks: Geometries) -> Geometries:
    """Return invalid marks as valid ones on the grid."""
    return _best(marks, lambda mark: shapely.set_precision(mark, 1.0))


def valid(marks: Geometries) -> Geometries:
    """Return marks, of which those that are invalid are made valid, between the points of the grid."""
    torn = ~shapely.is_valid(marks)
    if torn.any():
        marks = marks.copy()
        marks[torn] = _best(marks[torn], lambda mark: mark)
    return marks


def _best(marks: Geometries, finish: Callable[[shapely.Geometry], shapely.Geometry]) -> Geometries:
    """Return invalid marks made valid, and finished, in the way that keeps the area of each best.

    Neither way in which GEOS mends is right for all: the one fills a hole that a hair crosses, the other may
    lose a ring that touches itself, or give up.
    """
    found = np.empty(len(marks), dtype=object)
    for number, (mark, area) in enumerate(zip(marks, shapely.area(marks), strict=True)):
        work.spend(int(shapely.get_num_coordinates(mark)), per_vertex=work.PER_MENDED_VERTEX)
        ways = [each for make in (_by_lines, _by_structure) for each in _made(mark, make, finish)]
        found[number] = min(ways, key=lambda way: abs(shapely.area(way) - area), default=shapely.Polygon())
    return found


def _made(
    mark: shapely.Geometry,
    make: Callable[[shapely.Geometry], shapely.Geometry],
    finish: Callable[[shapely.Geometry], shapely.Geometry],
) -> list[shapely.Geometry]:
    """Return a mark mended in one way; nothing where that way fails."""
    try:
        return [finish(make(mark))]
    except shapely.errors.GEOSException:
        return []


def _by_lines(mark: shapely.Geometry) -> shapely.Geometry:
    return shapely.make_valid(mark)


def _by_structure(mark: shapely.Geometry) -> shapely.Geometry:
    return shapely.make_valid(mark, method="structure", keep_collapsed=False)


def _without_specks(areas: Geometries) -> Geometries:
    """Fill the holes that hold no grid point: floats leave them between edges that all but coincide.

    Rounding would draw such a hole out to a slit a whole step wide.
    """
    parts, owner = shapely.get_parts(areas, return_index=True)
    rings, part = shapely.get_rings(parts, return_index=True)
    holes = np.flatnonzero(np.r_[False, part[1:] == part[:-1]])
    specks = holes[shapely.area(shapely.polygons(rings[holes])) < SPECK]
    if not len(specks):
        return areas
    areas = areas.copy()
    kept = np.delete(rings, specks), np.delete(part, specks)
    for row in np.unique(owner[part[specks]]):
        mine = [kept[0][kept[1] == each] for each in np.flatnonzero(owner == row)]
        whole = [shapely.Polygon(shell, list(inner)) for shell, *inner in mine]
        areas[row] = whole[0] if len(whole) == 1 else shapely.MultiPolygon(whole)
    return areas


def _rounded(results: Geometries, again: Again) -> Geometries:
    if not len(results):
        return results
    rounded = np.asarray(shapely.transform(results, lambda xy: np.floor(xy + 0.5)), dtype=object)
    # Where nothing moved nothing can have gone wrong.
    moved = np.flatnonzero(~shapely.equals_exact(rounded, results))
    valid = shapely.is_valid(rounded[moved])
    sound, torn = moved[valid], moved[~valid]
    rounded[sound] = shapely.remove_repeated_points(rounded[sound])
    if len(torn):
        rounded[torn] = again(torn)
    return rounded
