"""Rings that do not cross: told apart by following them, and put into one another as polygons with holes."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.geometry.sampling import Array, Geometries, Indices


def rings_of(following: NDArray[np.int64]) -> tuple[Indices, Indices]:
    """Return all steps ring by ring, each ring from its least number on, and how many steps each has.

    A list is followed step by step: NumPy would double pointers for the twenty rounds that a ring of a
    million steps takes, each of them dearer than this loop's twentieth.

    Args:
        following: for each step the next one; every step follows one other.
    """
    chain: list[int] = following.tolist()
    left = bytearray(b"\1") * len(chain)
    order: list[int] = []
    begins: list[int] = []
    at = left.find(1)
    while at >= 0:
        begins.append(len(order))
        step = at
        while left[step]:
            left[step] = 0
            order.append(step)
            step = chain[step]
        at = left.find(1, at)
    return np.array(order, np.intp), np.diff(np.append(begins, len(order))).astype(np.intp)


def with_holes(rings: Geometries) -> Geometries:
    """Return polygons of rings of which no two cross: shells run anticlockwise, holes clockwise.

    Rings may touch in points; no two share an edge.
    """
    shells = np.asarray(shapely.is_ccw(rings))
    exterior, inner = rings[shells], rings[~shells]
    if len(exterior) == 1:
        return np.array([shapely.polygons(exterior[0], inner if len(inner) else None)], dtype=object)
    outer: Geometries = np.asarray(shapely.polygons(exterior), dtype=object)
    if not len(inner):
        return outer
    ends = [shapely.get_coordinates(shapely.get_point(inner, place)) for place in (0, 1)]
    hole, shell = shapely.STRtree(outer).query(shapely.points((ends[0] + ends[1]) / 2), predicate="within")
    area: Array = np.asarray(shapely.area(outer))
    order = np.lexsort((area[shell], hole))
    mine: list[list[int]] = [[] for _ in outer]
    into = dict(zip(hole[order][::-1].tolist(), shell[order][::-1].tolist(), strict=True))
    for number in sorted(into):
        mine[into[number]].append(number)
    found = [
        shapely.polygons(ring, inner[held]) if held else whole
        for ring, held, whole in zip(exterior, mine, outer, strict=True)
    ]
    return np.array(found, dtype=object)
