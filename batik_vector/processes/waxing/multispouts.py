"""Cantings with several spouts in a row: which lines and dots they draw at once, and what that saves.

A canting of two spouts (*loron*) draws two lines side by side where those run as far apart as its spouts, and
sets two dots at once; with more spouts it draws as many. Lines are found by the strips between them: bare
cloth that is as broad as what lies between two spouts. Dots are taken in rows, from left to right. What goes
on across the edge of a tile is taken to begin there anew.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.geometry.regions import polygonal
from batik_vector.geometry.sampling import Points

SLACK = 0.1
"""Part of the pitch by which lines and dots may be nearer or farther: the hand gives way by so much."""
QUARTER = 8
"""Chords of a quarter of a disc."""


def at_once(drawn: Geometries, dots: Geometries, spout: float, pitch: float, spouts: int) -> dict[str, Any]:
    """Return what several spouts save of the work of one, as plain values.

    Args:
        drawn: the wax that lines of a spout make, in mm; none overlap.
        dots: pieces of wax that one touch of it sets.
        spout: its breadth in mm.
        pitch: from the middle of a spout to that of the next, in mm, more than its breadth.
        spouts: how many there are.

    Returns:
        The metres of line that are drawn beside others, and the dots set beside others: strokes saved.
    """
    rows = _rows(shapely.get_coordinates(shapely.centroid(dots)), pitch, spouts)
    return {
        "spouts": spouts,
        "pitch_mm": pitch,
        "metres_saved": round(_beside(drawn, spout, pitch, spouts) / 1000, 3),
        "dots_saved": len(dots) - rows,
    }


def _beside(drawn: Geometries, spout: float, pitch: float, spouts: int) -> float:
    """Return how many mm of lines are drawn beside others."""
    if len(drawn) == 0:
        return 0.0
    bare = pitch - spout
    strips = _strips(drawn, bare, SLACK * pitch)
    strips = strips[shapely.area(strips) >= bare * pitch]
    group, groups = _together(drawn, strips, SLACK * pitch)
    lines = np.bincount(group[: len(drawn)], weights=shapely.area(drawn), minlength=groups) / spout
    # A strip is half as long as its outline, but for its ends.
    long = shapely.length(strips) / 2 - bare
    between = np.bincount(group[len(drawn) :], weights=long, minlength=groups)
    # So many lines run side by side, each as long as what is left of all when what lies between is paid.
    long = np.maximum(lines - between, spout)
    strokes = long * np.ceil(np.maximum(1, np.rint(lines / long)) / spouts)
    return float(np.clip(np.minimum(lines - strokes, between), 0, None).sum())


def _strips(drawn: Geometries, bare: float, slack: float) -> Geometries:
    """Return the strips of bare cloth that are as broad as told, or off by no more than the slack."""
    wax = shapely.union_all(drawn)
    narrow, broad = (_closed(wax, bare + by) for by in (-slack, slack))
    between = shapely.difference(broad, shapely.union(narrow, wax))
    # Where lines bend, closing leaves hairs in their corners.
    hairless = shapely.buffer(between, -bare / 4, quad_segs=QUARTER)
    return polygonal(shapely.intersection(shapely.buffer(hairless, bare / 4 + slack / 4), between))


def _closed(wax: shapely.Geometry, breadth: float) -> shapely.Geometry:
    """Return wax with all gaps that are no broader than told."""
    if breadth <= 0:
        return wax
    grown = shapely.buffer(wax, breadth / 2, quad_segs=QUARTER)
    return shapely.buffer(grown, -breadth / 2, quad_segs=QUARTER)


def _together(lines: Geometries, strips: Geometries, near: float) -> tuple[np.ndarray, int]:
    """Return for each line, and then for each strip, which group it is of, and how many groups there are."""
    number = np.arange(len(lines) + len(strips))
    strip, line = shapely.STRtree(lines).query(strips, predicate="dwithin", distance=near)
    one, other = np.concatenate([line, strip + len(lines)]), np.concatenate([strip + len(lines), line])
    while True:
        low = number.copy()
        np.minimum.at(low, one, number[other])
        if (low == number).all():
            break
        number = low
    names, group = np.unique(number, return_inverse=True)
    return group.ravel(), len(names)


def _rows(points: Points, pitch: float, most: int) -> int:
    """Return in how many rows, of so many at most, dots are set: each a pitch from the next, and straight."""
    if not len(points):
        return 0
    order = np.lexsort([points[:, 1], points[:, 0]])
    places = points[order]
    marks = np.asarray(shapely.points(places), dtype=object)
    one, other = shapely.STRtree(marks).query(marks, predicate="dwithin", distance=(1 + SLACK) * pitch)
    far = np.sqrt(((places[other] - places[one]) ** 2).sum(axis=1))
    kept = far >= (1 - SLACK) * pitch
    one, other = one[kept], other[kept]
    sort = np.lexsort([other, one])
    beside = np.split(other[sort], np.searchsorted(one[sort], np.arange(1, len(places))))
    free, rows = np.ones(len(places), bool), 0
    for first in range(len(places)):
        if not free[first]:
            continue
        row = max(
            (_row(first, int(to), beside, places, free, most, pitch) for to in beside[first]),
            key=len,
            default=[first],
        )
        free[row] = False
        rows += 1
    return rows


def _row(
    first: int,
    second: int,
    beside: list[np.ndarray],
    places: Points,
    free: np.ndarray,
    most: int,
    pitch: float,
) -> list[int]:
    """Return a row of free dots from two of them on."""
    row = [first]
    at: int | None = second if free[second] else None
    while at is not None and len(row) < most:
        row.append(at)
        x, y = (2 * places[at] - places[row[-2]]).tolist()
        ahead = (int(k) for k in beside[at] if free[k] and k not in row)
        at = next((k for k in ahead if math.dist(places[k], (x, y)) <= 2 * SLACK * pitch), None)
    return row
