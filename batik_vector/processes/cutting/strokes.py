"""The strokes of a cut: contours, shared edges and weed lines in order, and the way of their tool."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np
import shapely

from batik_vector.geometry.outlines import Outlines, of_polygons, together
from batik_vector.geometry.sampling import Geometries
from batik_vector.processes.cutting.arclength import around, length, ways
from batik_vector.processes.cutting.choices import Keep, Narrow
from batik_vector.processes.cutting.faults import check_blade, check_kerf, check_tabs
from batik_vector.processes.cutting.kerf import compensated
from batik_vector.processes.cutting.knife import Knife, holder, shut
from batik_vector.processes.cutting.overlays import meeting
from batik_vector.processes.cutting.sequence import in_sequence
from batik_vector.processes.cutting.shared import lengthened
from batik_vector.processes.cutting.starts import begun
from batik_vector.processes.cutting.stock import Stock
from batik_vector.processes.cutting.tabs import tabbed
from batik_vector.processes.cutting.told import Told
from batik_vector.processes.cutting.weeding import bounds, weed_lines
from batik_vector.processes.order import travel
from batik_vector.processes.ordering.distances import PARTS
from batik_vector.units import STEPS_PER_MM

OUTER, HOLE, SHARED, WEED, PRECUT = "outer", "hole", "shared", "weed", "swivel"
CLEAR = 2000
"""Steps to the left of all else where a drag knife is turned first."""

ROUND = 12
"""Chords of a quarter of the beam."""


def cut_out(stock: Stock, told: Told) -> tuple[Outlines, dict[str, Any]]:
    """Return the strokes of a tool in its order, and what there is to say of them.

    Raises:
        GeometryError: where the tool cannot cut what is asked.
    """
    contours = _contours(stock, told)
    if not len(contours):
        return contours, {"contours": 0}
    strokes = begun(in_sequence(_with_weeding(contours, stock.regions, told)), told.start, told.corner)
    facts = _facts(strokes, stock)
    if told.kerf and told.keep is Keep.INK:
        facts["left_uncut_mm2"] = _left_uncut(stock.regions, told.kerf)
    strokes, facts["tabs"] = _tabbed(strokes, told)
    if told.overcut or told.blade_offset:
        strokes = shut(strokes, np.full(len(strokes), ways(told.overcut)))
    facts["cut_mm"] = round(length(strokes), 3)
    if told.blade_offset:
        strokes = _trailed(strokes, told)
    return strokes, facts | {"travel_mm": round(travel(strokes), 3)}


def _contours(stock: Stock, told: Told) -> Outlines:
    """Return closed contours where the middle of the cut runs, and shared edges, named by what they are."""
    inward = told.keep is Keep.GROUND
    if told.kerf and told.narrow is Narrow.REFUSE:
        check_kerf(stock.regions, told.kerf)
    rings = of_polygons(compensated(stock.regions, told.kerf, inward=inward))
    kinds = np.full(len(rings.closed), HOLE, dtype=object)
    kinds[rings.marks[:-1]] = OUTER
    contours = _named(replace(rings, marks=np.arange(len(rings.rings))), kinds.tolist())
    if told.blade_offset:
        check_blade(contours, told.blade_offset)
    edges = lengthened(stock.edges, -told.kerf / 2 if inward else told.kerf / 2)
    return together([contours, _named(edges, [SHARED] * len(edges))])


def _named(strokes: Outlines, names: Iterable[str]) -> Outlines:
    return replace(strokes, names=tuple(names))


def _with_weeding(contours: Outlines, regions: Geometries, told: Told) -> Outlines:
    if told.weed_box is None and told.weed_lines is None:
        return contours
    box = bounds(contours).grown(told.weed_box or 0)
    more = []
    if told.weed_box is not None:
        more.append(box.outline)
    if told.weed_lines is not None:
        more.append(weed_lines(regions, box, told.weed_lines, told.weed_margin + told.kerf))
    return together([contours, *(_named(each, [WEED] * len(each)) for each in more)])


def _tabbed(strokes: Outlines, told: Told) -> tuple[Outlines, int]:
    """Return strokes of which the outer contours of parts leave tabs, and how many they leave."""
    outer = np.array([name in (OUTER, SHARED) for name in strokes.names], bool)
    whole = around(strokes)
    counts = np.full(len(strokes), told.tabs)
    if told.tab_spacing is not None:
        counts = np.maximum(counts, -(-whole // (told.tab_spacing * PARTS)))
    counts = np.where(outer & strokes.closed, counts, 0)
    if not counts.any():
        return strokes, 0
    # The beam takes half of its breadth at either end of a cut.
    gap = told.tab_length + told.kerf
    check_tabs(whole / PARTS, counts, gap, told.tab_length)
    return tabbed(strokes, counts, gap * PARTS, told.corner), int(counts.sum())


def _trailed(strokes: Outlines, told: Told) -> Outlines:
    """Return the way of a drag knife's holder; a cut beside all turns the blade first."""
    if told.precut:
        way = told.precut * np.array([math.cos(told.swivel), math.sin(told.swivel)])
        step = np.rint(way).astype(np.int64)
        box = bounds(strokes)
        begin = np.array([box.left - CLEAR, box.low]) - np.array([max(step[0], 0), min(step[1], 0)])
        first = Outlines(
            np.array([begin, begin + step]), np.array([0, 2]), np.array([0, 1]), np.zeros(1, bool), (PRECUT,)
        )
        strokes = together([first, strokes])
    return holder(strokes, Knife(told.blade_offset, told.corner, told.swivel, told.sag))


def _left_uncut(regions: Geometries, kerf: int) -> float:
    """Return the area of the corners and gaps into which a beam does not come, in mm²."""
    grown = np.asarray(shapely.buffer(regions, kerf / 2, quad_segs=ROUND), dtype=object)
    near = meeting(grown)
    one = np.array([shapely.union_all(grown[near])], dtype=object)
    grown = np.concatenate([grown[~near], one])
    back = shapely.area(shapely.buffer(grown, -kerf / 2, quad_segs=ROUND))
    left = float(back.sum() - shapely.area(regions).sum())
    return round(max(left, 0.0) / STEPS_PER_MM**2, 3)


def _facts(strokes: Outlines, stock: Stock) -> dict[str, Any]:
    kinds = np.array(strokes.names, dtype=object)
    whole = around(strokes)
    return {
        "contours": int(strokes.closed.sum()),
        "holes": int((kinds == HOLE).sum()),
        "shared_edges": int((kinds == SHARED).sum()),
        "shared_mm": round(int(whole[kinds == SHARED].sum()) / PARTS / STEPS_PER_MM, 3),
        "weed_lines": int((kinds == WEED).sum()),
        "lines_as_areas": stock.bodies,
    }
