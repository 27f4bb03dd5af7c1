"""Where contours begin: on a corner, in a straight run, or where it saves way."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from batik_vector.geometry.outlines import Index, Offsets, Outlines, Steps
from batik_vector.processes.cutting.arclength import Ways, along, around, between, reached, turns
from batik_vector.processes.cutting.choices import Start
from batik_vector.processes.ordering.distances import distances

LONG = 0.9
"""Runs this part as long as a contour's longest will do as well."""


def begun(strokes: Outlines, start: Start, corner: float) -> Outlines:
    """Return strokes of which closed ones begin where they are told to, of such places at the nearest.

    Args:
        strokes: one ring or polyline to a mark, in their order, without points that repeat the one before.
        start: where contours begin.
        corner: from how many radians on a bend is a corner. Where a contour has none, any point will do.
    """
    if start is Start.NEAREST or not strokes.closed.any():
        return strokes
    reach = reached(strokes)
    at, offsets = _corners(strokes, reach, corner) if start is Start.CORNER else _runs(strokes, reach)
    places = between(strokes, reach, np.searchsorted(reach, at, side="right") - 1, at)
    begin = _nearest(strokes, at, offsets, places)
    whole = around(strokes)
    turned = along(strokes, np.arange(len(strokes)), begin, np.where(strokes.closed, begin + whole, whole))
    return _shut_again(strokes, turned)


def _corners(strokes: Outlines, reach: Ways, corner: float) -> tuple[Ways, Offsets]:
    """Return the ways to the corners of all closed strokes, and where those of each stroke begin."""
    good = np.abs(turns(strokes)) >= corner
    ring = np.repeat(np.arange(len(strokes)), np.diff(strokes.rings))
    none = np.bincount(ring[good], minlength=len(strokes)) == 0
    return _chosen(strokes, good | none[ring], ring, reach[:-1])


def _runs(strokes: Outlines, reach: Ways) -> tuple[Ways, Offsets]:
    """Return the ways to the middles of the longest sides, likewise."""
    side = np.diff(reach)
    ring = np.repeat(np.arange(len(strokes)), np.diff(strokes.rings))
    longest = np.maximum.reduceat(side, strokes.rings[:-1])
    return _chosen(strokes, side >= LONG * longest[ring], ring, reach[:-1] + side // 2)


def _chosen(strokes: Outlines, good: NDArray[np.bool_], ring: Index, way: Ways) -> tuple[Ways, Offsets]:
    good = good & strokes.closed[ring]
    counts = np.bincount(ring[good], minlength=len(strokes))
    return way[good], np.concatenate([np.zeros(1, np.int64), np.cumsum(counts)])


def _nearest(strokes: Outlines, at: Ways, offsets: Offsets, places: Steps) -> Ways:
    """Return how far along each closed stroke begins: at its place nearest to where the one before ends."""
    begin = np.zeros(len(strokes), np.int64)
    base = reached(strokes)[strokes.rings[:-1]]
    tool = np.zeros(2, np.int64)
    for number, (first, stop) in enumerate(zip(offsets[:-1].tolist(), offsets[1:].tolist(), strict=True)):
        if first == stop:
            tool = strokes.points[strokes.rings[number + 1] - 1]
            continue
        best = first + int(np.argmin(distances(places[first:stop], tool)))
        begin[number] = at[best] - base[number]
        tool = places[best]
    return begin


def _shut_again(strokes: Outlines, opened: Outlines) -> Outlines:
    """Return parts all round closed strokes as closed strokes, which do not repeat their first point."""
    kept = np.ones(len(opened.points), bool)
    kept[opened.rings[1:][strokes.closed] - 1] = False
    rings = opened.rings - np.concatenate([np.zeros(1, np.int64), np.cumsum(strokes.closed)])
    return replace(
        opened, points=opened.points[kept], rings=rings, closed=strokes.closed, names=strokes.names
    )
