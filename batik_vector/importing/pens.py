"""Pens: how a stroke's body is drawn round its centre line, by caps, joins and dashes (SVG 2, 13.5)."""

from __future__ import annotations

import math
import re
from typing import Literal, TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
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
_COMMA = re.compile(r"[\s,]++")


@frozen
class Pen:
    """How strokes are drawn: ``cap`` and ``join`` as shapely names them, ``dashes`` and ``begin`` in mm."""

    cap: Cap
    join: Join
    limit: float
    dashes: tuple[float, ...] = ()
    begin: float = 0.0


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
    radius = breadth / 2
    quarter = math.pi / 4 / math.acos(max(1 - tolerance / radius, 0.0)) if radius > tolerance else 1.0
    found = shapely.buffer(
        lines,
        radius,
        quad_segs=max(2, math.ceil(quarter)),
        cap_style=pen.cap,
        join_style=pen.join,
        mitre_limit=pen.limit,
    )
    return np.asarray(found, dtype=object), owner


def dashed(line: shapely.LineString, pen: Pen) -> list[shapely.LineString]:
    """Return the dashes of a polyline; the line itself where there would be too many."""
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
    ends = begins + np.tile(np.array(pen.dashes)[::2], len(begins) // (len(pen.dashes) // 2))
    found = []
    for low, high in zip(
        np.maximum(begins, 0.0).tolist(), np.minimum(ends, reached[-1]).tolist(), strict=True
    ):
        if low >= high:
            continue
        inner = np.flatnonzero((reached > low) & (reached < high))
        at = np.r_[low, reached[inner], high]
        found.append(shapely.LineString(np.column_stack([np.interp(at, reached, part) for part in xy.T])))
    return found
