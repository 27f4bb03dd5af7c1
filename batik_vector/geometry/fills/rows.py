"""Rows across regions: where parallel lines run within them, and places along these."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.fills.insets import Parts
from batik_vector.geometry.maps.affine import unit_turn
from batik_vector.geometry.sampling import Array, Indices


class Runs(NamedTuple):
    """Stretches of rows within parts.

    Attributes:
        row: number of the row; it runs at ``row * pitch``, counted across the direction of the rows.
        begin, end: along the row.
        part: that it lies in.
    """

    row: Indices
    begin: Array
    end: Array
    part: Indices

    def taken(self, which: NDArray[np.bool_] | Indices) -> Runs:
        """Return some of them."""
        return Runs(self.row[which], self.begin[which], self.end[which], self.part[which])


def runs(parts: Parts, angle: float, pitch: float) -> Runs:
    """Return where rows at an angle (degrees) through the origin, a pitch apart, run within parts.

    Every edge is crossed by the rows between its ends, its lower end counted and its upper not: the
    crossings of a row with a part, sorted along it, then go in and out in turn.
    """
    points, part, first = _turned(parts, angle)
    inner = np.flatnonzero(first[:-1] == first[1:])
    (x0, y0), (x1, y1) = points[inner].T, points[inner + 1].T
    low = np.ceil(np.minimum(y0, y1) / pitch).astype(np.int64)
    high = np.ceil(np.maximum(y0, y1) / pitch).astype(np.int64)
    crossed = np.maximum(high - low, 0)
    edge = np.repeat(np.arange(len(inner)), crossed)
    row = low[edge] + np.arange(len(edge)) - np.repeat(np.cumsum(crossed) - crossed, crossed)
    share = (row * pitch - y0[edge]) / (y1 - y0)[edge]
    x = x0[edge] + share * (x1 - x0)[edge]
    of = part[inner][edge]
    order = np.lexsort((x, row, of))
    x, row, of = x[order], row[order], of[order]
    return Runs(row[::2], x[::2], x[1::2], of[::2])


def parted(found: Runs, region: Indices, bare: float) -> Runs:
    """Return runs whose neighbours in a row of a region lie ``bare`` apart at least: both are shortened."""
    order = np.lexsort((found.begin, found.row, region[found.part]))
    found = found.taken(order)
    of = region[found.part]
    next_to = (found.row[1:] == found.row[:-1]) & (of[1:] == of[:-1])
    short = np.where(next_to, np.maximum(bare - (found.begin[1:] - found.end[:-1]), 0.0), 0.0) / 2
    begin, end = found.begin.copy(), found.end.copy()
    begin[1:] += short
    end[:-1] -= short
    return Runs(found.row, begin, end, found.part)


def _turned(parts: Parts, angle: float) -> tuple[Array, Indices, Indices]:
    """Return the vertices of parts in a plane whose x runs along the rows, their part, and their ring."""
    rings, owner = shapely.get_rings(parts.shapes, return_index=True)
    points, ring = shapely.get_coordinates(rings, return_index=True)
    back = unit_turn(-angle)
    x, y = points.T
    turned = np.column_stack([back.real * x - back.imag * y, back.imag * x + back.real * y])
    return turned, owner[ring], ring


def placed(x: NDArray[Any], y: NDArray[Any], angle: float) -> Array:
    """Return places told along and across the rows, shape (n, 2)."""
    turn = unit_turn(angle)
    return np.column_stack([turn.real * x - turn.imag * y, turn.imag * x + turn.real * y])


def lattice(
    parts: Parts, angle: float, step: float, pitch: float, stagger: float = 0.5
) -> tuple[Array, Indices]:
    """Return the places of a lattice within parts, shape (n, 2), and the part of each.

    Args:
        angle: of the rows, in degrees.
        step: from place to place in a row; one row goes through the origin.
        pitch: from row to row.
        stagger: share of a step by which every other row is moved.
    """
    x, row, part, _ = _spots(parts, angle, step, pitch, stagger)
    return placed(x, row * pitch, angle), part


def _spots(
    parts: Parts, angle: float, step: float, pitch: float, stagger: float
) -> tuple[Array, Indices, Indices, Indices]:
    """Return places along rows, the row and the part of each, and the number of it in its row."""
    found = runs(parts, angle, pitch)
    moved = (found.row % 2) * stagger * step
    low = np.ceil((found.begin - moved) / step).astype(np.int64)
    high = np.floor((found.end - moved) / step).astype(np.int64)
    count = np.maximum(high - low + 1, 0)
    run = np.repeat(np.arange(len(count)), count)
    number = low[run] + np.arange(len(run)) - np.repeat(np.cumsum(count) - count, count)
    return moved[run] + number * step, found.row[run], found.part[run], number


def hexagonal(parts: Parts, angle: float, spacing: float) -> tuple[Array, Indices]:
    """Return places that all have their six neighbours at the spacing."""
    return lattice(parts, angle, spacing, spacing * math.sqrt(0.75))


def segments(found: Runs, angle: float, pitch: float) -> tuple[Array, Array]:
    """Return the ends of runs, each shape (n, 2)."""
    y = found.row * pitch
    return placed(found.begin, y, angle), placed(found.end, y, angle)


def circles(parts: Parts, centres: Array, spacing: float, turns: int = 1) -> tuple[Array, Indices]:
    """Return places within parts on circles about a centre for each region, a spacing apart.

    The first place of a circle lies along +x, every other circle is turned by half a step; each has a
    multiple of ``turns`` places.
    """
    ring, centre, part = radii(parts, centres, spacing)
    number = np.where(ring > 0, np.maximum(2 * np.pi * ring / turns, 1.0).astype(np.intp) * turns, 1)
    of = np.repeat(np.arange(len(ring)), number)
    share = (np.arange(len(of)) - np.repeat(np.cumsum(number) - number, number)) + (ring[of] % 2) / 2
    angle = 2 * np.pi * share / number[of]
    at = centre[of] + (ring[of] * spacing)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    shapely.prepare(parts.shapes)
    inside = shapely.contains_xy(parts.shapes[part[of]], at[:, 0], at[:, 1])
    return at[inside], part[of][inside]


def radii(parts: Parts, centres: Array, spacing: float) -> tuple[Indices, Array, Indices]:
    """Return the circles about the centres that meet parts: their numbers, centres and parts."""
    centre = centres[parts.region]
    points, of = shapely.get_coordinates(parts.shapes, return_index=True)
    far = np.hypot(*(points - centre[of]).T)
    first = np.searchsorted(of, np.arange(len(parts.shapes)))
    most = np.maximum.reduceat(far, first) if len(first) else np.empty(0)
    least = shapely.distance(parts.shapes, shapely.points(centre))
    low, high = np.ceil(least / spacing).astype(np.intp), np.floor(most / spacing).astype(np.intp)
    count = np.maximum(high - low + 1, 0)
    part = np.repeat(np.arange(len(count)), count)
    ring = low[part] + np.arange(len(part)) - np.repeat(np.cumsum(count) - count, count)
    return ring, centre[part], part
