"""Arithmetic on the torus: wrapping marks round a cell and cutting them at its edges.

Everything here is in **grid steps** (whole micrometres held in floats or int64), not in mm: integers
make translations exact, and make every rounding the same on both sides of a seam. A crossing of an
edge with a seam line is found by exact rational arithmetic and rounded half up, so it does not depend on
where the cell stands nor on the direction in which the ring runs: the crossing at x = 0 and its twin at
x = W are the same bits.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.errors import TooLargeError
from batik_vector.geometry import work
from batik_vector.geometry.ragged import Ragged
from batik_vector.tiling.torus import overlay
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

Steps = NDArray[np.int64]
Lattice = tuple[tuple[int, int], tuple[int, int]]
"""Two translations in grid steps; the first or the second is parallel to its axis."""


MAX_WRAPPED = 15_000_000
"""Vertices that the translates of marks may come to: they are in memory all at once, some 100 bytes each."""


@frozen
class Window:
    """An axis-parallel rectangle in grid steps."""

    left: int
    bottom: int
    right: int
    top: int

    @property
    def box(self) -> shapely.Polygon:
        """The rectangle as a polygon."""
        return shapely.box(self.left, self.bottom, self.right, self.top)


def to_step_grid(marks: Geometries) -> Geometries:
    """Return marks given in mm in grid steps: every vertex on the grid, polygons valid.

    Rounding moves a vertex by half a step at most; the few polygons that this makes invalid are mended
    by GEOS' precision reducer. A polygon may thereby fall into several, or become empty.
    """
    if not len(marks):
        return marks
    scaled = as_steps(marks)
    snapped = np.asarray(shapely.transform(scaled, np.rint), dtype=object)
    sound = shapely.is_valid(snapped)
    snapped[sound] = shapely.remove_repeated_points(snapped[sound])
    if not sound.all():
        snapped[~sound] = overlay.mended(scaled[~sound])
    return snapped


def polygons_of(marks: Geometries, names: NDArray[np.intp]) -> tuple[Geometries, NDArray[np.intp]]:
    """Return the polygons among the parts of geometries, with the names of those they come from.

    What is a polygon stays the same object.
    """
    plain = shapely.get_type_id(marks) == shapely.GeometryType.POLYGON
    if plain.all():
        there = ~shapely.is_empty(marks)
        return marks[there], names[there]
    parts, owner = shapely.get_parts(marks, return_index=True)
    own = plain[owner]
    parts[own] = marks[owner[own]]
    deep = shapely.get_type_id(parts) >= shapely.GeometryType.MULTIPOINT
    if deep.any():
        inner, inner_owner = shapely.get_parts(parts[deep], return_index=True)
        parts, owner = (
            np.concatenate([parts[~deep], inner]),
            np.concatenate([owner[~deep], owner[deep][inner_owner]]),
        )
    good = (shapely.get_type_id(parts) == shapely.GeometryType.POLYGON) & ~shapely.is_empty(parts)
    return parts[good], names[owner[good]]


def lines_of(marks: Geometries, names: NDArray[np.intp]) -> tuple[Geometries, NDArray[np.intp]]:
    """Return the polylines among the parts of geometries, joined end to end within each, with their names."""
    parts, owner = shapely.get_parts(shapely.line_merge(marks), return_index=True)
    good = shapely.length(parts) > 0
    return parts[good], names[owner[good]]


def as_steps(marks: Geometries) -> Geometries:
    """Return marks given in mm in grid steps, not rounded to whole ones."""
    if not len(marks):
        return np.empty(0, dtype=object)
    return np.asarray(shapely.transform(marks, lambda xy: xy * STEPS_PER_MM), dtype=object)


def to_mm(marks: Geometries) -> Geometries:
    """Return marks given in grid steps in mm: the place of k steps is the float k / 1000."""
    if not len(marks):
        return marks
    return np.asarray(shapely.transform(marks, lambda xy: xy / STEPS_PER_MM), dtype=object)


def wrap(
    marks: Geometries, names: NDArray[np.intp], lattice: Lattice, window: Window, reach: float = 0.0
) -> tuple[Geometries, NDArray[np.intp]]:
    """Return every lattice translate of every mark that comes within ``reach`` of the window.

    Args:
        marks: in grid steps, anywhere in the plane.
        names: shape (n,), carried along.
        lattice: the two translations that repeat them.
        window: the rectangle to fill, in grid steps.
        reach: in grid steps; half the breadth of a line, where its body counts.

    Raises:
        TooLargeError: where the translates have more vertices than fit in memory.
    """
    # What is empty lies nowhere.
    there = ~shapely.is_empty(marks)
    marks, names = marks[there], names[there]
    if not len(marks):
        return marks, names
    which, shift = wrapping(marks, lattice, window, reach)
    return translate(marks[which], shift), names[which]


def wrapping(
    marks: Geometries, lattice: Lattice, window: Window, reach: float = 0.0
) -> tuple[NDArray[np.intp], Steps]:
    """Return which marks :func:`wrap` moves where: (which, shift). None of them may be empty."""
    which, shift = translates(shapely.bounds(marks), lattice, window, reach)
    total = int(shapely.get_num_coordinates(marks)[which].sum())
    if total > MAX_WRAPPED:
        raise TooLargeError(
            f"marks that reach over so many repeats have {total:,} vertices in one of them, past the "
            f"limit of {MAX_WRAPPED:,}: expected smaller marks, or a larger tile"
        )
    return which, shift


def translates(
    bounds: NDArray[np.float64] | Steps, lattice: Lattice, window: Window, reach: float = 0.0
) -> tuple[NDArray[np.intp], Steps]:
    """Return the lattice translates that come within ``reach`` of a window: (which, shift).

    Args:
        bounds: left, lower, right and upper edge of each mark in grid steps, shape (n, 4).
        lattice, window, reach: as for :func:`wrap`.
    """
    (ax, ay), (bx, by) = lattice
    low_x, low_y, high_x, high_y = bounds.T
    box = (window.left - reach, window.bottom - reach, window.right + reach, window.top + reach)
    if bx == 0:
        which, i, j = _ranges((low_x, high_x), (low_y, high_y), (ax, ay, by), box)
    else:
        swapped = (box[1], box[0], box[3], box[2])
        which, j, i = _ranges((low_y, high_y), (low_x, high_x), (by, bx, ax), swapped)
    return which, np.column_stack([i * ax + j * bx, i * ay + j * by])


def reduced(points: Steps, lattice: Lattice) -> Steps:
    """Return the translates of points, shape (n, 2), that lie in the cell at the origin."""
    (ax, ay), (bx, by) = lattice
    x, y = points.T
    if bx == 0:
        x, y = x % ax, y - x // ax * ay
        return np.column_stack([x, y % by])
    x, y = x - y // by * bx, y % by
    return np.column_stack([x % ax, y])


def _ranges(
    major: tuple[NDArray[Any], NDArray[Any]],
    minor: tuple[NDArray[Any], NDArray[Any]],
    lattice: tuple[int, int, int],
    box: tuple[float, float, float, float],
) -> tuple[NDArray[np.intp], Steps, Steps]:
    """Return (mark, i, j) for translates by i·(step, slip) + j·(0, pitch) whose bounds meet the box.

    ``major`` is the direction of ``step``, ``minor`` the one of ``pitch``.
    """
    step, slip, pitch = lattice
    first = np.ceil((box[0] - major[1]) / step).astype(np.int64)
    last = np.floor((box[2] - major[0]) / step).astype(np.int64)
    which, i = _spread(first, last)
    first = np.ceil((box[1] - minor[1][which] - i * slip) / pitch).astype(np.int64)
    last = np.floor((box[3] - minor[0][which] - i * slip) / pitch).astype(np.int64)
    again, j = _spread(first, last)
    return which[again], i[again], j


def _spread(first: Steps, last: Steps) -> tuple[NDArray[np.intp], Steps]:
    """Write out the whole numbers from first to last of each row: (row, number)."""
    counts = np.maximum(last - first + 1, 0)
    row = np.repeat(np.arange(len(first)), counts)
    return row, first[row] + np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)


def translate(marks: Geometries, shift: NDArray[Any]) -> Geometries:
    """Return each mark moved by its own shift, shape (n, 2): exact on whole grid steps."""
    # What stays where it is stays the same object.
    moved = np.flatnonzero(shift.any(axis=1))
    if not len(moved):
        return marks
    found = marks.copy()
    coords, owner = shapely.get_coordinates(found[moved], return_index=True)
    found[moved] = shapely.set_coordinates(found[moved], coords + shift[moved][owner])
    return found


def clip_areas(
    areas: Geometries, names: NDArray[np.intp], window: Window
) -> tuple[Geometries, NDArray[np.intp]]:
    """Cut polygons (grid steps) to the window; those wholly inside are untouched."""
    inside, crossing = _inside_and_crossing(areas, window)
    crossed = float(shapely.get_num_coordinates(areas[crossing]).sum())
    work.spend(crossed, per_vertex=work.PER_CUTTER_VERTEX)
    split, split_names = _split_polygons(areas[crossing], window), names[crossing]
    # Rounding a crossing may fold a needle over itself, and an overlay of what is invalid may flood the
    # whole window.
    folded = ~shapely.is_valid(split)
    if folded.any():
        flat, flat_names = polygons_of(overlay.valid(split[folded]), split_names[folded])
        split = np.concatenate([split[~folded], flat])
        split_names = np.concatenate([split_names[~folded], flat_names])
    pieces, piece_names = polygons_of(overlay.within(split, window.box), split_names)
    return np.concatenate([areas[inside], pieces]), np.concatenate([names[inside], piece_names])


def clip_lines(
    lines: Geometries, names: NDArray[np.intp], window: Window
) -> tuple[Geometries, NDArray[np.intp]]:
    """Cut polylines (grid steps) to the window. No stretch along an edge is added.

    A stretch that runs on an edge belongs to the left or the lower one, so that the repeat draws it once.
    """
    inside, crossing = _inside_and_crossing(lines, window)
    pieces, owner = _runs(*_split_lines(lines[crossing], window), window)
    return np.concatenate([lines[inside], pieces]), np.concatenate([names[inside], names[crossing][owner]])


def _inside_and_crossing(marks: Geometries, window: Window) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    if not len(marks):
        return np.zeros(0, bool), np.zeros(0, bool)
    x0, y0, x1, y1 = shapely.bounds(marks).T
    inside = (x0 > window.left) & (y0 > window.bottom) & (x1 < window.right) & (y1 < window.top)
    outside = (x1 < window.left) | (y1 < window.bottom) | (x0 > window.right) | (y0 > window.top)
    return inside, ~inside & ~outside


def _split_polygons(areas: Geometries, window: Window) -> Geometries:
    if not len(areas):
        return areas
    flat = Ragged.of(areas)
    split, offsets = split_at(np.rint(flat.points).astype(np.int64), flat.rings, window)
    return replace(flat, points=split.astype(float), rings=offsets).geometries()


def _split_lines(lines: Geometries, window: Window) -> tuple[Steps, Steps]:
    if not len(lines):
        return np.empty((0, 2), np.int64), np.zeros(1, np.int64)
    flat = Ragged.of(lines)
    return split_at(np.rint(flat.points).astype(np.int64), flat.rings, window)


def split_at(coords: Steps, offsets: Steps, window: Window) -> tuple[Steps, Steps]:
    """Insert a vertex wherever an edge crosses one of the window's four lines.

    Args:
        coords: shape (n, 2), whole grid steps, polylines or rings one after another.
        offsets: shape (k + 1,), where each begins.
        window: whose edges, prolonged, are the lines.

    Returns:
        The longer coordinates and their offsets.
    """
    edge = np.ones(max(len(coords) - 1, 0), bool)
    edge[offsets[1:-1] - 1] = False
    where, points, order = [], [], []
    for axis, value in ((0, window.left), (0, window.right), (1, window.bottom), (1, window.top)):
        low, high = coords[:-1, axis], coords[1:, axis]
        at = np.flatnonzero(edge & ((low < value) & (high > value) | (low > value) & (high < value)))
        a, b = coords[at], coords[at + 1]
        flip = a[:, axis] > b[:, axis]
        a[flip], b[flip] = b[flip], a[flip]
        run = b[:, axis] - a[:, axis]
        rise = (b[:, 1 - axis] - a[:, 1 - axis]) * (value - a[:, axis])
        point = np.empty((len(at), 2), np.int64)
        point[:, axis] = value
        point[:, 1 - axis] = a[:, 1 - axis] + (2 * rise + run) // (2 * run)
        where.append(at)
        points.append(point)
        order.append((value - coords[at, axis]) / (coords[at + 1, axis] - coords[at, axis]))
    edges, inserted = np.concatenate(where), np.concatenate(points)
    rank = np.lexsort([np.concatenate(order), edges])
    edges, inserted = edges[rank], inserted[rank]
    split = np.insert(coords, edges + 1, inserted, axis=0)
    moved = offsets + np.searchsorted(edges, offsets - 1, side="left")
    return _without_repeats(split, moved)


def _without_repeats(coords: Steps, offsets: Steps) -> tuple[Steps, Steps]:
    """Drop vertices that repeat the one before them in the same polyline."""
    again = np.zeros(len(coords), bool)
    again[1:] = (coords[1:] == coords[:-1]).all(axis=1)
    again[offsets[:-1]] = False
    if not again.any():
        return coords, offsets
    return coords[~again], offsets - np.concatenate([[0], np.cumsum(again)])[offsets]


def _runs(coords: Steps, offsets: Steps, window: Window) -> tuple[Geometries, NDArray[np.intp]]:
    """Return the stretches of split polylines that lie in the window, and which polyline each is of."""
    if len(coords) < 2:
        return np.empty(0, object), np.empty(0, np.intp)
    doubled = coords[:-1] + coords[1:]
    x, y = doubled[:, 0], doubled[:, 1]
    # A stretch on the right or upper edge has its twin on the left or lower one.
    inside = (x >= 2 * window.left) & (x < 2 * window.right) & (y >= 2 * window.bottom) & (y < 2 * window.top)
    inside[offsets[1:-1] - 1] = False
    begins = np.zeros(len(inside), bool)
    begins[0] = inside[0]
    begins[1:] = inside[1:] & ~inside[:-1]
    first = np.flatnonzero(begins)
    ends = np.zeros(len(inside), bool)
    ends[-1] = inside[-1]
    ends[:-1] = inside[:-1] & ~inside[1:]
    last = np.flatnonzero(ends) + 1
    counts = last - first + 1
    index = np.repeat(first - np.concatenate([[0], np.cumsum(counts)[:-1]]), counts) + np.arange(counts.sum())
    owner = np.searchsorted(offsets, first, side="right") - 1
    if not len(first):
        return np.empty(0, object), np.empty(0, np.intp)
    lines = np.asarray(
        shapely.linestrings(coords[index].astype(float), indices=np.repeat(np.arange(len(first)), counts)),
        dtype=object,
    )
    # A ring that begins inside the window falls into one stretch too many: its last goes on in its first.
    opens = np.flatnonzero(
        (first == offsets[owner]) & (coords[first] == coords[offsets[owner + 1] - 1]).all(axis=1)
    )
    closes = np.searchsorted(owner, owner[opens], side="right") - 1
    whole = (last[closes] == offsets[owner[opens] + 1] - 1) & (opens != closes)
    opens, closes = opens[whole], closes[whole]
    for head, tail in zip(opens, closes, strict=True):
        lines[head] = shapely.LineString([*lines[tail].coords, *lines[head].coords[1:]])
    return np.delete(lines, closes), np.delete(owner, closes)
