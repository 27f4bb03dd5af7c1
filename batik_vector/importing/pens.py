"""Pens: how a stroke's body is drawn round its centre line, by caps, joins and dashes (SVG 2, 13.5)."""

from __future__ import annotations

import math
import re
from typing import Literal, TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry.paths.matrix import Matrix, spread
from batik_vector.geometry.paths.outline import EMPTY, MOVE, Outline, box, joined
from batik_vector.geometry.paths.shapes import ellipse
from batik_vector.importing.page import parse_px
from batik_vector.importing.styles import Style
from batik_vector.values import frozen

Cap: TypeAlias = Literal["flat", "round", "square"]
Join: TypeAlias = Literal["mitre", "round", "bevel"]
CAPS: dict[str, Cap] = {"butt": "flat", "round": "round", "square": "square"}
JOINS: dict[str, Join] = {
    "miter": "mitre",
    "round": "round",
    "bevel": "bevel",
    "miter-clip": "mitre",
    "arcs": "mitre",
}
MOST_DASHES = 100_000
"""Dashes of one line past which it is taken as a whole one: it would look so."""
SHORTEST = 1e-6
"""Length (mm) below which a dash has none."""
BLUNT = 0.999
"""Square of the cosine of half a turn from which a mitre is no more than a bevel."""
FOLD_MM = 1e-6
"""Mean breadth of a closed line up to which it is straight, there and back."""
ROUND = 1e-6
"""By how much the breadths of a pen may differ, as a part of them, for it to be round."""
_COMMA = re.compile(r"[\s,]++")


@frozen
class Pen:
    """How strokes are drawn: ``cap`` and ``join`` as shapely names them, ``dashes`` and ``begin`` in mm."""

    cap: Cap
    join: Join
    limit: float
    dashes: tuple[float, ...] = ()
    begin: float = 0.0


NO_PEN = Pen("flat", "mitre", 4.0)
"""What stands where there is no stroke."""


def pen_of(style: Style, size: tuple[float, float], scale: float) -> Pen:
    """Return the pen of a style.

    Args:
        style: of the shape.
        size: sides of its viewport, to which percentages refer.
        scale: mm of a user unit.
    """
    whole = math.hypot(*size) / 2**0.5
    limit = parse_px(style["stroke-miterlimit"]) or 4.0
    parts = _COMMA.split(style["stroke-dasharray"].strip()) if style["stroke-dasharray"] != "none" else []
    lengths = [parse_px(part, whole) for part in parts]
    dashes = [length * scale for length in lengths if length is not None]
    if len(dashes) < len(lengths) or any(dash < 0 for dash in dashes) or not sum(dashes):
        dashes = []
    begin = (parse_px(style["stroke-dashoffset"], whole) or 0.0) * scale
    cap, join = CAPS.get(style["stroke-linecap"], "flat"), JOINS.get(style["stroke-linejoin"], "mitre")
    return Pen(cap, join, max(limit, 1.0), tuple(dashes) * (1 + len(dashes) % 2), begin)


def stroke_first(style: Style) -> bool:
    """Tell whether a style's paint-order has the stroke before the fill (SVG 2, 13.8)."""
    words = style["paint-order"].split()
    return "stroke" in words and ("fill" not in words or words.index("stroke") < words.index("fill"))


def lean_of(matrix: Matrix) -> Matrix | None:
    """Return how a map distorts a round pen, by a map that keeps areas; None where it leaves it round."""
    most, least = spread(matrix)
    if most <= (1 + ROUND) * least or least <= ROUND * most:
        return None
    size = (most * least) ** 0.5
    a, b, c, d = (each / size for each in matrix[:4])
    return a, b, c, d, 0.0, 0.0


def bodies(
    lines: Geometries, breadth: float, pen: Pen, tolerance: float
) -> tuple[Geometries, NDArray[np.intp]]:
    """Return the bodies of polylines, and the number of the line that each belongs to.

    Args:
        lines: in mm.
        breadth: in mm.
        pen: of them all.
        tolerance: mm; how far round caps and joins may stand from circles.
    """
    owner = np.arange(len(lines))
    if pen.dashes:
        pieces = [dashed(line, pen) for line in lines]
        owner = np.repeat(owner, [len(each) for each in pieces])
        lines = np.array([piece for each in pieces for piece in each], dtype=object)
    lines = lines.copy()
    radius = breadth / 2
    quarter = math.pi / 4 / math.acos(max(1 - tolerance / radius, 0.0)) if radius > tolerance else 1.0
    segments, found = max(2, math.ceil(quarter)), np.empty(len(lines), dtype=object)
    folded = _folded(lines)
    ends: Cap = "round" if pen.join == "round" else "flat"
    tips, at = _mitres(lines, radius, pen.limit) if pen.join == "mitre" else (lines[:0], owner[:0])
    sharp = np.isin(np.arange(len(lines)), at)
    for some, cap in ((~folded, pen.cap), (folded, ends)):
        for these, join in ((some & ~sharp, pen.join), (some & sharp, "bevel")):
            found[these] = shapely.buffer(
                lines[these],
                radius,
                quad_segs=segments,
                cap_style=cap,
                join_style=join,
                mitre_limit=pen.limit,
            )
    for row in np.unique(at).tolist():
        found[row] = shapely.union_all([found[row], *tips[at == row]])
    return found, owner


def _mitres(lines: Geometries, radius: float, limit: float) -> tuple[Geometries, NDArray[np.intp]]:
    """Return the mitres of lines that have sharper corners, too, and the line of each.

    SVG bevels a corner past the limit, where GEOS cuts its mitre off at the limit.
    """
    xy, line = shapely.get_coordinates(lines, return_index=True)
    closed = shapely.is_closed(lines)
    first = np.searchsorted(line, np.arange(len(lines)))
    # A closed line has a corner where it ends, too: its second point stands behind the last.
    rank = np.concatenate([np.arange(len(xy)), np.searchsorted(line, np.flatnonzero(closed), "right") - 0.5])
    order = np.argsort(rank, kind="stable")
    xy = np.concatenate([xy, xy[first[closed] + 1]])[order]
    line = np.concatenate([line, np.flatnonzero(closed)])[order]
    step = np.diff(xy, axis=0)
    step /= np.maximum(np.hypot(*step.T), 1e-12)[:, None]
    inner = (line[:-2] == line[2:]) if len(line) > 2 else np.zeros(0, bool)
    one, other, corner, of = step[:-1][inner], step[1:][inner], xy[1:-1][inner], line[1:-1][inner]
    # The square of the cosine of half the turn; the limit is of its inverse.
    half = (1 + (one * other).sum(axis=1)) / 2
    past = half * limit**2 < 1
    drawn = ~past & (half < BLUNT) & np.isin(of, of[past])
    side = -np.sign(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])[drawn, None] * radius
    begin, end = (np.column_stack([-way[drawn, 1], way[drawn, 0]]) * side for way in (one, other))
    tip = (begin + end) / (2 * half[drawn, None])
    places = corner[drawn, None] + np.stack([np.zeros_like(tip), begin, tip, end], axis=1)
    bevelled = np.setdiff1d(of[past], of[drawn])
    empty = np.full(len(bevelled), shapely.Polygon(), dtype=object)
    return np.concatenate([shapely.polygons(places), empty]), np.concatenate([of[drawn], bevelled])


def _folded(lines: Geometries) -> NDArray[np.bool_]:
    """Tell which closed lines are straight, there and back, and open these at an end, in place.

    GEOS loses parts of their bodies; an open line that begins and ends where it folds has the same body.
    """
    closed = np.flatnonzero(shapely.is_closed(lines) & (shapely.get_num_coordinates(lines) > 3))
    flat = closed[shapely.area(shapely.convex_hull(lines[closed])) <= FOLD_MM * shapely.length(lines[closed])]
    folded = np.zeros(len(lines), bool)
    folded[flat] = True
    if len(flat):
        lines[flat] = [_from_outermost(shapely.get_coordinates(line)) for line in lines[flat]]
    return folded


def _from_outermost(xy: NDArray[np.float64]) -> shapely.LineString:
    """Return a closed line, shape (n, 2), as an open one from a point beyond which there is none."""
    ring = np.roll(xy[:-1], -int(np.lexsort(xy[:-1].T)[0]), axis=0)
    last = ring[-1] - ring[0]
    short = ring[0] + last * min(FOLD_MM / float(np.hypot(*last)), 0.5)
    return shapely.LineString(np.vstack([ring, short]))


def dots(outline: Outline, pen: Pen, radius: float) -> Outline:
    """Return the dots that a pen draws where subpaths have no length (SVG 2, 13.5.4).

    Args:
        outline: in the units of the shape, as are the dots.
        pen: its cap makes them round or square; without one there are none.
        radius: half the stroke's breadth.
    """
    begins = np.flatnonzero(outline.kinds == MOVE)
    if pen.cap == "flat" or not len(begins):
        return EMPTY
    low, high = (ufunc.reduceat(outline.points, begins, axis=0) for ufunc in (np.minimum, np.maximum))
    places = low[(low == high).all(axis=1)].tolist()
    if pen.cap == "round":
        return joined([ellipse(x, y, radius, radius) for x, y in places])
    return joined([box(x - radius, y - radius, 2 * radius, 2 * radius) for x, y in places])


def dashed(line: shapely.LineString, pen: Pen) -> list[shapely.LineString]:
    """Return the dashes of a polyline; the line itself where there would be too many.

    Dashes of no length are drawn by their caps (SVG 2, 13.5.4), and one that begins where the line ends is
    not there: a sum of floats may say that it begins just before.
    """
    xy = shapely.get_coordinates(line)
    step = np.hypot(*np.diff(xy, axis=0).T)
    reached = np.r_[0.0, np.cumsum(step)]
    period = sum(pen.dashes)
    first = math.floor(-abs(pen.begin) / period) - 1
    count = (reached[-1] + abs(pen.begin)) / period + 3
    if count * len(pen.dashes) > MOST_DASHES:
        return [line]
    marks = np.r_[0.0, np.cumsum(pen.dashes)]
    begins = (
        np.arange(first, first + int(count) + 2)[:, None] * period + marks[None, :-1:2] - pen.begin
    ).ravel()
    lengths = np.tile(np.array(pen.dashes)[::2], len(begins) // (len(pen.dashes) // 2))
    if pen.cap != "flat":
        begins, lengths = np.where(np.abs(begins) < SHORTEST, 0.0, begins), np.maximum(lengths, 2 * SHORTEST)
    lows, highs = np.maximum(begins, 0.0), np.minimum(begins + lengths, reached[-1])
    found = []
    for row in np.flatnonzero(highs - lows > SHORTEST).tolist():
        low, high = float(lows[row]), float(highs[row])
        inner = np.flatnonzero((reached > low) & (reached < high))
        at = np.r_[low, reached[inner], high]
        found.append(shapely.LineString(np.column_stack([np.interp(at, reached, part) for part in xy.T])))
    return found
