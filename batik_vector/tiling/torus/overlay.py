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
from typing import Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry import work
from batik_vector.geometry.regions import polygonal
from batik_vector.tiling.torus.joining import joined_pairs
from batik_vector.tiling.torus.remembered import Asked, as_array, interned

SPECK = 0.25
"""Grid cells: a hole smaller than this is no drawing."""

MANY = 20_000
"""Vertices past which a union is not made once more on the grid, for which GEOS may take minutes, but rounded
there as a whole."""

STEPWISE = 100_000
"""Vertices of a group past which it is united step by step: crossings may be many times as many."""

MUCH = 2_000_000
"""Vertices of marks and of what is taken away from them that are overlaid at one go."""

Brought = Callable[[NDArray[np.intp]], Geometries]
"""Brings the geometries of some rows to another place."""

Again = Callable[[NDArray[np.intp]], shapely.Geometry | Geometries]
"""Makes the results of some rows again, on the grid."""


class Made(NamedTuple):
    """What came of an overlay: as GEOS made it, on the grid, and what it cost to make it again there.

    The cost is in vertices, as :func:`batik_vector.geometry.work.spend` takes them up; 0 where it was not.
    """

    raw: shapely.Geometry
    shape: shapely.Geometry
    again: float


def united(groups: Sequence[Geometries], known: Asked[Made] | None = None) -> Geometries:
    """Return the union of each group of areas: shape (n,).

    Args:
        groups: of areas.
        known: the unions that are known; those that are not are made known.

    Raises:
        TooLargeError: where they are too large, or cross too often.
    """
    known = unknown(len(groups)) if known is None else known
    work.foretell_union(groups)
    joined = _raw(known)
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
            part = rows[batch].tolist()
            fresh = known.fresh(part)
            if fresh:
                table = np.full((len(fresh), 2**power), None, dtype=object)
                for row, group in zip(table, fresh, strict=True):
                    row[: sizes[group]] = groups[group]
                joined[fresh] = shapely.union_all(table, axis=1)
            work.spend_on_union(np.concatenate([groups[row] for row in part]), joined[part])
    fresh = known.fresh()
    whole = _without_specks(joined[fresh])

    def again(rows: NDArray[np.intp]) -> Geometries:
        mine = [(groups[fresh[row]], whole[row]) for row in rows.tolist()]
        return np.array([_united_on_grid(*each) for each in mine], dtype=object)

    return _kept(known, joined, whole, again, lambda row, made: _grid_cost(groups[row], made))


def united_before(known: Asked[Made], given: int) -> Geometries | None:
    """Return unions that are all known, of areas of so many vertices; None where :func:`united` must look.

    Of few vertices no crossings are counted, and the areas themselves are not needed.
    """
    if known.fresh() or given >= work.SMALL:
        return None
    raw = _raw(known)
    if shapely.get_num_coordinates(raw).sum() > work.SMALL:
        return None
    work.spend(given)
    return _kept(known, raw, raw[:0], lambda rows: raw[rows], lambda row, made: 0.0)


def unknown(count: int) -> Asked[Made]:
    """Return as many overlays of which nothing is known, and nothing kept."""
    return Asked(None, np.empty((count, 0), np.int64), ())


def _raw(known: Asked[Made]) -> Geometries:
    """Return overlays as GEOS made them, as far as they are known."""
    return as_array([None if made is None else made.raw for made in known.found])


def _kept(
    known: Asked[Made],
    raw: Geometries,
    whole: Geometries,
    again: Again,
    cost: Callable[[int, shapely.Geometry], float],
) -> Geometries:
    """Return overlays on the grid; those that are fresh are rounded, and kept.

    Args:
        known: what is known.
        raw: all overlays, as GEOS made them.
        whole: the fresh ones, as they are to be rounded.
        again: makes some of the fresh ones again.
        cost: returns what it costs to make one again, by its row among all, given what was to be rounded.
    """
    for made in known.found:
        if made is not None and made.again:
            work.spend(made.again)
    fresh = known.fresh()
    if not fresh:
        return as_array([made.shape for made in known.answers()])
    shapes, torn = _rounding(whole, again)
    costs = dict.fromkeys(fresh, 0.0) | {fresh[row]: cost(fresh[row], whole[row]) for row in torn.tolist()}
    shapes = interned(shapes) if known.keeps else shapes
    sizes = shapely.get_num_coordinates(raw[fresh]) + shapely.get_num_coordinates(shapes)
    new = [Made(raw[row], shape, costs[row]) for row, shape in zip(fresh, shapes.tolist(), strict=True)]
    known.keep(fresh, new, sizes.tolist())
    return as_array([made.shape for made in known.answers()])


def _by_pairs(areas: Geometries) -> shapely.Geometry:
    """Return the union of many areas, neighbours first, two by two: so what it costs is known in time.

    Those that meet no other are only gathered.
    """
    tree = shapely.STRtree(areas)
    work.refuse_pairs(tree, shapely.envelope(areas))
    i, j = tree.query(areas)
    work.spend_on_pairs(len(i))
    meets = np.zeros(len(areas), bool)
    meets[i[i != j]] = True
    alone, areas = areas[~meets], areas[meets]
    if len(alone):
        rest = np.array([_by_pairs(areas)] if len(areas) else [], dtype=object)
        found: Any = shapely.multipolygons(polygonal(np.concatenate([alone, rest])))
        gathered: shapely.Geometry = found
        return gathered
    areas = areas[_side_by_side(areas)]
    while len(areas) > 1:
        pairs = len(areas) // 2
        first, second = areas[: 2 * pairs : 2], areas[1 : 2 * pairs : 2]
        joined = []
        for batch in work.batches(shapely.get_num_coordinates(first) + shapely.get_num_coordinates(second)):
            joined.append(joined_pairs(first[batch], second[batch]))
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
    work.spend(_grid_cost(areas, union))
    if _vertices(areas, union) > MANY:
        return shapely.set_precision(union, 1.0)
    return shapely.union_all(areas, grid_size=1.0)


def _grid_cost(areas: Geometries, union: shapely.Geometry) -> float:
    """Return what it costs to unite areas on the grid, in vertices."""
    many = _vertices(areas, union)
    return many * (work.PER_ROUNDED_VERTEX if many > MANY else work.PER_MENDED_VERTEX)


def _vertices(areas: Geometries, union: shapely.Geometry) -> int:
    return max(int(shapely.get_num_coordinates(areas).sum()), int(shapely.get_num_coordinates(union)))


def _powers(sizes: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return the least powers of two that hold some sizes."""
    return np.asarray(np.ceil(np.log2(np.maximum(sizes, 1))), np.intp)


def less(
    marks: Geometries, away: Geometries, brought: Brought | None = None, known: Asked[Made] | None = None
) -> Geometries:
    """Return each mark without the area that stands in the same row.

    Args:
        marks, away: as many of each.
        brought: brings the areas of some rows to where they are taken away, a few at a time since they may
            be far larger than the marks; left out where they lie there.
        known: what is known of what is left; what is not is made known.

    Raises:
        TooLargeError: where they are too large, or cross too often.
    """
    known = unknown(len(marks)) if known is None else known
    left, numbers = _raw(known), np.arange(len(marks))

    def there(rows: NDArray[np.intp]) -> Geometries:
        return away[rows] if brought is None else brought(rows)

    for batch in work.batches(shapely.get_num_coordinates(marks) + shapely.get_num_coordinates(away), MUCH):
        fresh = np.array(known.fresh(numbers[batch].tolist()), np.intp)
        left[fresh] = shapely.difference(marks[fresh], there(fresh))
        work.spend_on_cuts(marks[batch], away[batch], left[batch])
    fresh = np.array(known.fresh(), np.intp)

    def again(rows: NDArray[np.intp]) -> Geometries:
        mine = fresh[rows]
        work.spend(sum(_cut_cost(marks[row], away[row]) for row in mine.tolist()))
        return np.asarray(shapely.difference(marks[mine], there(mine), grid_size=1.0), dtype=object)

    return _kept(known, left, left[fresh], again, lambda row, _: _cut_cost(marks[row], away[row]))


def _cut_cost(mark: shapely.Geometry, away: shapely.Geometry) -> float:
    """Return what it costs to cut a mark on the grid, in vertices."""
    return float(
        work.PER_MENDED_VERTEX * shapely.get_num_coordinates(mark) + shapely.get_num_coordinates(away)
    )


def within(areas: Geometries, window: shapely.Polygon) -> Geometries:
    """Return what of each area lies in a window; the work is not counted."""
    inside = np.asarray(shapely.intersection(areas, window), dtype=object)
    return _rounded(inside, lambda rows: shapely.intersection(areas[rows], window, grid_size=1.0))


def grown(shapes: Geometries, reach: float, corners: int, known: Asked[Made]) -> Geometries:
    """Return shapes grown by so many steps, with so many chords in a quarter circle; the work is not counted.

    What is not known of them is made known.
    """
    raw, fresh = _raw(known), known.fresh()
    if fresh:
        raw[fresh] = shapely.buffer(shapes[fresh], reach, quad_segs=corners)
    whole = raw[fresh]

    def cost(_: int, body: shapely.Geometry) -> float:
        return float(work.PER_MENDED_VERTEX * shapely.get_num_coordinates(body))

    return _kept(known, raw, whole, lambda rows: mended(whole[rows]), cost)


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
    """Return marks made valid, and finished, in the way that keeps the area of each best.

    Neither way in which GEOS mends is right for all: the one fills a hole that a hair crosses, the other may
    lose a ring that touches itself, or give up.
    """
    found = np.empty(len(marks), dtype=object)
    for number, (mark, area) in enumerate(zip(marks, shapely.area(marks), strict=True)):
        work.spend(int(shapely.get_num_coordinates(mark)), per_vertex=work.PER_MENDED_VERTEX)
        # To mend what is valid gives the same points, for several times what asking costs.
        makes = (_as_it_is,) if shapely.is_valid(mark) else (_by_lines, _by_structure)
        best: tuple[float, shapely.Geometry] = math.inf, shapely.Polygon()
        for way in (each for make in makes for each in _made(mark, make, finish)):
            best = min(best, (abs(shapely.area(way) - area), way), key=lambda pair: pair[0])
            if not best[0]:
                break
        found[number] = best[1]
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


def _as_it_is(mark: shapely.Geometry) -> shapely.Geometry:
    return mark


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
    return _rounding(results, again)[0]


def _rounding(results: Geometries, again: Again) -> tuple[Geometries, NDArray[np.intp]]:
    """Return results on whole steps, and which of them had to be made again there."""
    if not len(results):
        return results, np.empty(0, np.intp)
    rounded = np.asarray(shapely.transform(results, lambda xy: np.floor(xy + 0.5)), dtype=object)
    # Where nothing moved nothing can have gone wrong.
    moved = np.flatnonzero(~shapely.equals_exact(rounded, results))
    valid = shapely.is_valid(rounded[moved])
    sound, torn = moved[valid], moved[~valid]
    rounded[sound] = shapely.remove_repeated_points(rounded[sound])
    if len(torn):
        rounded[torn] = again(torn)
    return rounded, torn
