"""Slivers along the seam: slits of bare ground and strips of ink that no hand would draw.

A drawing may have needles and narrow gaps of its own. Those that a seam makes run along it: both of their
long sides are straight and parallel to it, and there are none like them elsewhere in the drawing; of two
lines side by side one lies on either side of the seam, or on it. They
are looked for in the welded field, where a mark that reaches over the seam by a hair is no strip.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.certificate.drawing import Edges, Frame, InkDrawing, joined, repeats, ring_edges
from batik_vector.certificate.recut import Elsewhere
from batik_vector.certificate.report import Kind, Limits, SeamFault
from batik_vector.certificate.seam import EDGE_NAMES
from batik_vector.units import format_mm
from batik_vector.values import frozen

Floats = NDArray[np.float64]

PARALLEL = np.tan(np.radians(0.5))
"""Slope against the seam up to which an edge runs along it."""

SHORTEST_MM = 0.2
"""Shorter pieces (mm) of a sliver are not looked at."""

SLENDER = 5.0
"""A sliver is this many times as long as it is wide."""

ALIKE_MM = 0.002
"""Slivers whose widths differ by no more (mm) are alike."""

WORDS = {"slit": "a slit of bare ground", "strip": "a strip of ink", "lines": "two lines side by side"}


@frozen(eq=False)
class Along:
    """Edges that run along an axis: ``at`` their place across it (mean), ``low`` to ``high`` along it.

    ``side`` is +1 where ink lies beyond (at larger ``at``), -1 where it lies before, 0 for lines.
    """

    at: Floats
    low: Floats
    high: Floats
    side: NDArray[np.int64]


@frozen
class Sliver:
    """A sliver in steps: across ``axis`` from ``first`` to ``last``, along it from ``low`` to ``high``."""

    sort: str
    axis: int
    first: float
    last: float
    low: float
    high: float

    @property
    def width(self) -> float:
        """Breadth in steps."""
        return self.last - self.first

    def centre(self, frame: Frame) -> tuple[float, float]:
        """Return its middle on the page, in steps."""
        across, along = (self.first + self.last) / 2, (self.low + self.high) / 2
        return frame.on_page(*((across, along) if self.axis == 0 else (along, across)))


def slivers(ink: InkDrawing, field: Elsewhere, limits: Limits) -> list[Sliver]:
    """Return the slivers of an ink that a seam makes."""
    frame = field.frame
    near = limits.near * frame.per_mm
    found = []
    for axis in (0, 1):
        everything = _of_areas(ink, field, axis, limits) + _of_lines(ink, axis, limits, frame)
        side = frame.cell.columns if axis == 0 else frame.cell.rows
        away = [_from_seam(each, axis, side, frame) for each in everything]
        own = [each for each, apart in zip(everything, away, strict=True) if apart > near]
        for each, apart in zip(everything, away, strict=True):
            # Lines that the seam does not part are no work of its: curves touch, and cross mirrors upright.
            reach = each.width / 2 + limits.hair * frame.per_mm if each.sort == "lines" else near
            if apart <= reach and not any(_alike(each, other, frame) for other in own):
                found.append(each)
    # The joined areas and the single ones show a sliver at several places that are one on the page.
    places = [(each.sort, each.width, each.high - each.low, *each.centre(frame)) for each in found]
    return list(dict(zip(places, found, strict=True)).values())


def _from_seam(sliver: Sliver, axis: int, side: int, frame: Frame) -> float:
    across = sliver.centre(frame)[axis]
    return min(across, side - across)


def _alike(one: Sliver, other: Sliver, frame: Frame) -> bool:
    return one.sort == other.sort and abs(one.width - other.width) <= ALIKE_MM * frame.per_mm


def _of_areas(ink: InkDrawing, field: Elsewhere, axis: int, limits: Limits) -> list[Sliver]:
    edges = ring_edges(np.concatenate([field.healed, field.whole]))
    along = _along(edges, axis, field.frame)
    # Ink lies on the left of an edge: of one that runs up, at smaller x; of one that runs right, at larger y.
    found = _facing(along, axis, limits, field.frame)
    # Areas are there whole, and beyond the box end where the tile does: that edge is none of the field's.
    return [each for each in found if _within(each, field.box)]


def _within(sliver: Sliver, box: shapely.Polygon) -> bool:
    """Return whether a sliver's middle lies in a box of the field: of one that leaves it a translate does."""
    low_x, low_y, high_x, high_y = box.bounds
    across, along = (low_x, high_x), (low_y, high_y)
    if sliver.axis:
        across, along = along, across
    middles = (sliver.first + sliver.last) / 2, (sliver.low + sliver.high) / 2
    return all(low <= at < high for at, (low, high) in zip(middles, (across, along), strict=True))


def _of_lines(ink: InkDrawing, axis: int, limits: Limits, frame: Frame) -> list[Sliver]:
    edges = _with_repeats(ink.strokes, axis, limits, frame)
    along = _along(edges, axis, frame)
    return _facing(Along(along.at, along.low, along.high, along.side * 0), axis, limits, frame)


def _with_repeats(strokes: Edges, axis: int, limits: Limits, frame: Frame) -> Edges:
    """Return the strokes of the page, and those near one of its edges once more beyond the opposite."""
    parts = [strokes]
    for rows, shift in repeats(strokes, frame, axis, limits.thin * frame.per_mm):
        again = strokes.only(rows)
        parts.append(replace(again, begin=again.begin + shift, end=again.end + shift))
    return joined(parts)


def _along(edges: Edges, axis: int, frame: Frame) -> Along:
    step = edges.end - edges.begin
    run, rise = step[:, 1 - axis], step[:, axis]
    mine = (np.abs(rise) <= PARALLEL * np.abs(run)) & (np.abs(run) >= SHORTEST_MM * frame.per_mm)
    begin, end = edges.begin[mine], edges.end[mine]
    ends = np.sort(np.column_stack([begin[:, 1 - axis], end[:, 1 - axis]]), axis=1)
    forward = np.sign(run[mine]).astype(np.int64)
    return Along(
        (begin[:, axis] + end[:, axis]) / 2,
        ends[:, 0].astype(np.float64),
        ends[:, 1].astype(np.float64),
        -forward if axis == 0 else forward,
    )


def _facing(along: Along, axis: int, limits: Limits, frame: Frame) -> list[Sliver]:
    """Return the pairs of edges that face each other, no further apart than slivers are broad, and not none.

    A hair that the limit for crossings puts up with is none.
    """
    if len(along.at) < 2:
        return []
    reach, least = limits.thin * frame.per_mm, max(1.0, limits.hair * frame.per_mm)
    boxes = shapely.box(along.at, along.low, along.at, along.high)
    wider = shapely.box(along.at + least, along.low, along.at + reach, along.high)
    one, other = shapely.STRtree(boxes).query(wider)
    low = np.maximum(along.low[one], along.low[other])
    high = np.minimum(along.high[one], along.high[other])
    width = along.at[other] - along.at[one]
    long = high - low >= np.maximum(SLENDER * width, SHORTEST_MM * frame.per_mm)
    long &= (width >= least) & (width <= reach)
    sides = along.side[one], along.side[other]
    found = []
    for sort, before, after in (("slit", -1, 1), ("strip", 1, -1), ("lines", 0, 0)):
        for i in np.flatnonzero(long & (sides[0] == before) & (sides[1] == after)):
            first = float(along.at[one[i]])
            found.append(Sliver(sort, axis, first, first + float(width[i]), float(low[i]), float(high[i])))
    return found


def sliver_fault(sliver: Sliver, ink: str, frame: Frame) -> SeamFault:
    """Say where a sliver is."""
    x, y = sliver.centre(frame)
    side = (frame.cell.columns, frame.cell.rows)[sliver.axis]
    far = (x, y)[sliver.axis] > side / 2
    width, length = sliver.width / frame.per_mm, (sliver.high - sliver.low) / frame.per_mm
    words = (
        f"{WORDS[sliver.sort]} {format_mm(width)} mm wide runs {format_mm(length)} mm along the "
        f"{EDGE_NAMES[sliver.axis][far]} edge"
    )
    return SeamFault(Kind.SLIVER, ink, frame.mm(x, y), words, width)
