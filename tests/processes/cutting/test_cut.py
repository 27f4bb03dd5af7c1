from __future__ import annotations

import json
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely

from batik_vector import compile_recipe
from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import Outlines, to_polygons, to_polylines
from batik_vector.machines import Machine, Tool
from batik_vector.processes.cutting.arclength import length, turns
from batik_vector.processes.options import CutProcess
from batik_vector.processes.prepared import Prepared
from batik_vector.recipe.loading import read_recipe

from .designs import artwork

LEFT, RIGHT = shapely.box(10, 10, 30, 30), shapely.box(30, 10, 50, 30)
PLATE = shapely.Polygon(shapely.box(10, 10, 50, 40).exterior, [shapely.box(20, 20, 30, 30).exterior])


def cut(page: Artwork, machine: Machine | None = None, **told: object) -> Prepared:
    return CutProcess(**told).apply(page, machine or Machine())  # type: ignore[arg-type]


def only(prepared: Prepared) -> Outlines:
    (tool,) = prepared.tools
    return tool.strokes


def lines_of(strokes: Outlines) -> shapely.MultiLineString:
    return shapely.MultiLineString(to_polylines(strokes, 1000).tolist())


def test_what_inks_share_is_cut_once_and_before_what_is_around() -> None:
    strokes = only(cut(artwork([LEFT], [RIGHT])))
    assert strokes.closed.tolist() == [False, True]
    assert length(strokes) == pytest.approx(120 + 20)
    apart = cut(artwork([LEFT], [RIGHT]), inks="apart")
    assert [tool.ink.name for tool in apart.tools] == ["ink0", "ink1"]
    assert sum(length(tool.strokes) for tool in apart.tools) == pytest.approx(160)


def test_edges_are_shared_in_part_and_aslant() -> None:
    # A corner of one lies on the other's edge, half a step off it.
    turned = [
        shapely.affinity.rotate(each, 17, origin=(30, 20)) for each in (LEFT, shapely.box(30, 15, 45, 25))
    ]
    one, two = (shapely.set_precision(each, 0.001) for each in turned)
    strokes = only(cut(artwork([one], [two])))
    union = one.union(two.buffer(0.002))
    assert strokes.closed.sum() == 1
    assert length(strokes) == pytest.approx(union.length + 10, abs=0.05)
    assert lines_of(strokes).buffer(0.003).covers(shapely.boundary(one))
    assert lines_of(strokes).buffer(0.003).covers(shapely.boundary(two))


def test_what_is_covered_is_not_cut() -> None:
    strokes = only(cut(artwork([shapely.box(10, 10, 50, 50)], [shapely.box(30, 20, 70, 40)])))
    # The hidden edge of the lower square is gone.
    assert not lines_of(strokes).intersects(shapely.LineString([(50, 22), (50, 38)]))
    assert length(strokes) == pytest.approx(2 * (60 + 40) + 20 + 2 * 20)


def test_a_ring_between_inks_is_cut_once() -> None:
    hole = shapely.box(20, 20, 30, 30)
    strokes = only(cut(artwork([PLATE], [hole])))
    assert length(strokes) == pytest.approx(PLATE.exterior.length + hole.length)
    assert strokes.closed.all()
    assert shapely.area(to_polygons(strokes)).tolist() == sorted(shapely.area(to_polygons(strokes)))


@pytest.mark.parametrize(("keep", "outer", "hole"), [("ink", 0.1, -0.1), ("ground", -0.1, 0.1)])
def test_a_kerf_is_taken_from_what_is_not_kept(keep: str, outer: float, hole: float) -> None:
    strokes = only(cut(artwork([PLATE]), kerf=0.2, keep=keep))
    inner, around = (shapely.bounds(each).tolist() for each in to_polygons(strokes, 1000))
    assert inner == pytest.approx([20 - hole, 20 - hole, 30 + hole, 30 + hole])
    assert around == pytest.approx([10 - outer, 10 - outer, 50 + outer, 40 + outer])


def test_shared_edges_reach_the_cut_around() -> None:
    strokes = only(cut(artwork([LEFT], [RIGHT]), kerf=0.2))
    shared = shapely.bounds(to_polylines(strokes.taken(np.flatnonzero(~strokes.closed)), 1000))[0]
    assert shared.tolist() == pytest.approx([30, 9.9, 30, 30.1])


def test_a_machine_says_what_a_recipe_does_not() -> None:
    laser, vinyl = Machine(tool=Tool(kerf=0.2)), Machine(tool=Tool(kerf=0.0, blade_offset=0.3))
    assert cut(artwork([PLATE]), laser).facts["cut"]["kerf_mm"] == 0.2
    assert cut(artwork([PLATE]), laser, kerf=0.1).facts["cut"]["kerf_mm"] == 0.1
    assert cut(artwork([PLATE]), vinyl).facts["cut"]["blade_offset_mm"] == 0.3


def lined(*lines: list[tuple[float, float]]) -> Artwork:
    drawn = np.array([shapely.LineString(each) for each in lines], dtype=object)
    return Artwork("lines", Cell(60_000, 60_000), (Layer(Ink("wax", "#000000", 2.0), lines=drawn),))


def test_lines_have_bodies_are_left_out_or_refused() -> None:
    open_ = [(10.0, 10.0), (40.0, 10.0)]
    strokes = only(cut(lined(open_)))
    assert shapely.area(to_polygons(strokes, 1000)).sum() == pytest.approx(60 + math.pi, rel=1e-3)
    assert cut(lined(open_)).facts["cut"]["tools"][0]["lines_as_areas"] == 1
    assert len(only(cut(lined(open_), lines="skip"))) == 0
    with pytest.raises(GeometryError, match=r'lines = "refuse", expected closed lines alone: 1 of ink "wax"'):
        cut(lined(open_), lines="refuse")


def test_closed_lines_are_outlines_where_lines_are_refused() -> None:
    around = [(10.0, 10.0), (40.0, 10.0), (40.0, 40.0), (10.0, 40.0), (10.0, 10.0)]
    inside = [(20.0, 20.0), (30.0, 20.0), (30.0, 30.0), (20.0, 20.0)]
    strokes = only(cut(lined(around, inside), lines="refuse", kerf=0.2))
    assert shapely.area(to_polygons(strokes, 1000)).tolist()[1] == pytest.approx(30.2**2)
    assert shapely.area(to_polygons(strokes, 1000)).tolist()[0] < 50


def test_tabs_hold_a_part_by_their_breadth() -> None:
    strokes = only(cut(artwork([PLATE]), kerf=0.2, tabs=3, tab_length=0.6))
    outer = to_polylines(strokes, 1000)[1:]
    assert len(outer) == 3
    swept = shapely.union_all(shapely.buffer(to_polylines(strokes, 1000), 0.1, quad_segs=32))
    left = shapely.get_parts(shapely.box(0, 0, 60, 60).difference(swept))
    # The hole falls out; the plate hangs in the sheet.
    assert len(left) == 2
    ring = PLATE.buffer(0.1, join_style="mitre").exterior
    assert ring.difference(swept).length == pytest.approx(3 * 0.6, abs=0.01)
    # And none at a corner.
    gaps = shapely.get_parts(shapely.line_merge(ring.difference(swept)))
    assert all(len(gap.coords) == 2 for gap in gaps)


def test_tabs_are_as_many_as_a_long_contour_needs() -> None:
    facts = cut(artwork([PLATE]), tabs=1, tab_spacing=20.0).facts["cut"]["tools"][0]
    assert facts["tabs"] == 7


@pytest.mark.parametrize("start", ["corner", "straight"])
def test_contours_begin_where_they_are_told_to(start: str) -> None:
    strokes = only(cut(artwork([PLATE]), start=start))
    bent = turns(strokes)[strokes.rings[:-1]]
    places = strokes.points[strokes.rings[:-1]]
    if start == "corner":
        assert (np.abs(bent) > 1).all()
    else:
        assert (bent == 0).all()
        # In the middle of a longest side.
        assert places[1].tolist() in [[30_000, 10_000], [30_000, 40_000]]


def test_an_overcut_goes_on_past_the_start() -> None:
    for way in to_polylines(only(cut(artwork([PLATE]), overcut=2.0, start="straight")), 1000):
        begun = shapely.Point(way.coords[0])
        assert way.length == pytest.approx(shapely.Polygon(way).buffer(0).length + 2)
        assert begun.distance(shapely.Point(way.coords[-1])) == pytest.approx(2)


def test_a_drag_knife_is_turned_first_beside_all() -> None:
    strokes = only(cut(artwork([PLATE]), blade_offset=0.25, swivel=90.0, precut=3.0, overcut=0.0))
    first = strokes.points[: strokes.rings[1]] / 1000
    # Its tip went from 3 mm lower to the upper end.
    assert (first[-1] - first[0]).tolist() == pytest.approx([0, 3])
    assert first[:, 0].max() <= 8
    assert not strokes.closed.any()
    assert len(only(cut(artwork([PLATE]), blade_offset=0.25, precut=0.0))) == 2


def test_a_corner_is_swivelled_on_an_arc_about_it() -> None:
    strokes = only(cut(artwork([PLATE]), blade_offset=0.5))
    way = to_polylines(strokes, 1000)[-1]
    corner = shapely.Point(50, 10)
    near = [place for place in way.coords if corner.distance(shapely.Point(place)) < 0.51]
    assert len(near) > 5
    assert [corner.distance(shapely.Point(place)) for place in near] == pytest.approx(
        [0.5] * len(near), abs=0.002
    )


def test_weed_lines_keep_clear() -> None:
    plain = shapely.box(10, 10, 50, 40)
    prepared = cut(artwork([plain]), weed_box=5.0, weed_lines=8.0, weed_margin=1.5)
    strokes = only(prepared)
    lines = to_polylines(strokes.taken(np.flatnonzero(~strokes.closed)), 1000)
    box = shapely.box(5, 5, 55, 45)
    assert len(lines) == 8
    assert shapely.distance(lines, plain).min() == pytest.approx(1.5)
    assert (shapely.distance(lines, box.exterior) == 0).all()
    # The box comes last, about all.
    assert shapely.bounds(to_polylines(strokes, 1000)[-1]).tolist() == [5, 5, 55, 45]
    assert prepared.facts["cut"]["tools"][0]["weed_lines"] == 9


def test_registration_marks_have_a_layer_of_their_own() -> None:
    cutting, marks = cut(artwork([PLATE]), registration=6.0).tools
    assert marks.ink.name == "registration"
    assert len(marks.strokes) == 8
    assert marks.strokes.bounds()[:, :2].min(axis=0).tolist() == [-9000, -9000]
    assert len(cutting.strokes) == 2


@pytest.mark.parametrize(("cloth", "seen"), [("#ffffff", "#000000"), ("#1b2a4a", "#ff00ff")])
def test_registration_marks_are_seen_on_the_cloth(cloth: str, seen: str) -> None:
    _, marks = cut(replace(artwork([PLATE]), cloth=cloth), registration=6.0).tools
    assert marks.ink.colour == seen


def pieces(number: int) -> list[shapely.Polygon]:
    return [shapely.Point(15 + 9 * (n % 10), 15 + 9 * (n // 10)).buffer(2 + n % 3) for n in range(number)]


def test_pieces_are_nested_on_a_sheet() -> None:
    page = artwork([shapely.set_precision(each, 0.001) for each in pieces(60)])
    prepared = cut(page, sheet=(60.0, 80.0), gap=2.0)
    assert (prepared.cell.width, prepared.cell.height) == (60, 80)
    laid = to_polygons(only(prepared), 1000)
    assert len(laid) == 60
    assert shapely.area(laid).sum() == pytest.approx(sum(map(shapely.area, page.layers[0].areas)))
    one, other = shapely.STRtree(laid).query(laid, predicate="dwithin", distance=1.999)
    assert (one == other).all()
    left, low, right, high = shapely.total_bounds(laid).tolist()
    assert (left >= 0.999, low >= 0.999, right <= 59.001, high <= 79.001) == (True,) * 4
    (facts,) = prepared.facts["cut"]["tools"]
    assert facts["sheets"] == 1
    assert facts["covered"] > facts["covered_before"]


def test_what_lies_in_a_hole_goes_with_what_is_around() -> None:
    page = artwork([PLATE, shapely.box(22, 22, 25, 28)])
    inner, hole, outer = to_polygons(only(cut(page, sheet=(60.0, 60.0))), 1000)
    assert shapely.Polygon(hole.exterior).contains(inner)
    assert shapely.Polygon(outer.exterior).contains(hole)


def test_each_sheet_is_an_output() -> None:
    page = artwork([shapely.box(x, 10, x + 8, 30) for x in (10, 20, 30, 40)])
    first, second = (cut(page, sheet=(25.0, 25.0), gap=1.0, sheet_number=n) for n in (1, 2))
    assert len(only(first)) + len(only(second)) == 4
    with pytest.raises(GeometryError, match=r"they fill 2; sheet_number = 1 to 2"):
        cut(page, sheet=(25.0, 25.0), gap=1.0)
    with pytest.raises(GeometryError, match="sheet_number = 3, expected at most 2"):
        cut(page, sheet=(25.0, 25.0), gap=1.0, sheet_number=3)


def neck(breadth: float) -> shapely.Polygon:
    bridge = shapely.box(20, 20, 40, 20 + breadth)
    parts = [shapely.box(10, 10, 22, 30), bridge, shapely.box(38, 10, 50, 30)]
    return shapely.Polygon(shapely.get_exterior_ring(shapely.union_all(parts)))


@pytest.mark.parametrize(
    ("areas", "told", "words"),
    [
        (
            [neck(0.1)],
            {"kerf": 0.15},
            r"kerf = 0.15 mm, expected at most 0.09\d mm: what is drawn is no broader",
        ),
        (
            [shapely.box(10, 10, 20, 20), shapely.box(20.1, 10, 30, 20)],
            {"kerf": 0.15},
            r"kerf = 0.15 mm, expected at most 0.098 mm: a gap is no broader than 0.1 mm at \(20.050, ",
        ),
        (
            [shapely.Polygon(shapely.box(5, 5, 20, 20).exterior, [shapely.box(10, 10, 15, 10.1).exterior])],
            {"kerf": 0.15},
            r"kerf = 0.15 mm, expected at most 0.09\d mm: a gap is no broader than 0.1 mm at \(12.500, 10.0",
        ),
        (
            [PLATE, shapely.box(1, 1, 1.2, 3)],
            {"blade_offset": 0.25},
            r"blade_offset = 0.25 mm, expected at most 0.(2|199) mm: a contour at \(1.100, 2.000\) mm",
        ),
        (
            [shapely.box(1, 1, 2, 2)],
            {"tabs": 4, "tab_length": 0.6},
            r"tab_length = 0.6 mm, expected at most 0.5 mm: 4 tabs of it are more than half of a contour",
        ),
        ([PLATE], {"sheet": (30.0, 20.0)}, r"sheet = 30 x 20 mm, expected at least 44 x 34 mm"),
    ],
)
def test_what_cannot_be_cut_is_refused_with_what_would_do(
    areas: list[shapely.Polygon], told: dict[str, Any], words: str
) -> None:
    with pytest.raises(GeometryError, match=words):
        cut(artwork(areas), **told)


def test_narrow_places_are_cut_where_they_are_accepted() -> None:
    strokes = only(cut(artwork([neck(0.1)]), kerf=0.15, narrow="accept"))
    assert len(strokes) == 1


@pytest.mark.parametrize("key", ["kerf", "blade_offset", "overcut", "tab_length", "weed_margin"])
def test_lengths_below_nothing_are_refused(key: str) -> None:
    with pytest.raises(GeometryError, match=key):
        CutProcess(**{key: -0.1})  # type: ignore[arg-type]


def test_facts_are_plain_values() -> None:
    facts = cut(artwork([LEFT], [RIGHT]), kerf=0.2, sheet=(60.0, 60.0), tabs=1).facts
    assert json.loads(json.dumps(facts)) == facts
    assert {type(each) for tool in facts["cut"]["tools"] for each in tool.values()} <= {int, float, str}


KAWUNG_LIKE = """
[motif.m]
kind = "rosette"
elements = [
  { curve = { kind = "circle", radius = 1 } },
  { curve = { kind = "circle", radius = 0.5 }, ink = "b" },
]
[ink.a]
[ink.b]
overlap = "knockout"
[[place]]
motif = "m"
ink = "a"
scale = 8
at = [10, 10]
[tile]
size = [20, 20]
"""


def test_nested_pairs_of_inks_are_cut_from_the_inside() -> None:
    strokes = only(cut(compile_recipe(read_recipe(KAWUNG_LIKE))))
    area = shapely.area(to_polygons(strokes, 1000)).tolist()
    assert area == sorted(area)
    assert len(area) == 2
