from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.errors import GeometryError, RecipeError
from batik_vector.geometry.outlines import Outlines, nothing, of_polygons
from batik_vector.machines import Machine
from batik_vector.processes.hatching.filling import hatched, unreached
from batik_vector.processes.hatching.options import (
    HATCHES,
    ConcentricHatch,
    CrossHatch,
    Hatch,
    ParallelHatch,
    SpiralHatch,
)
from batik_vector.processes.options import PlotProcess
from tests.thorough import examples, long

from .shapes import areas, inked, lines, outlines, unpainted

PENS = st.floats(0.3, 1.5)
KINDS = st.sampled_from([kind(edge=edge) for kind in HATCHES.values() for edge in (True, False)])
NECK = shapely.union_all(
    [shapely.box(0, 0, 12, 12), shapely.box(11, 5, 20, 7), shapely.Point(25, 6).buffer(6, quad_segs=32)]
)
RING = shapely.Point(0, 0).buffer(15, quad_segs=64) - shapely.Point(2, 1).buffer(5, quad_segs=64)


@long
@settings(max_examples=examples(80, 300), deadline=None)
@given(areas(), KINDS, PENS)
def test_no_ink_leaves_its_area(shapes: NDArray[np.object_], spec: Hatch, pen: float) -> None:
    assume(len(shapes))
    strokes = hatched(of_polygons(shapes), spec.__class__(edge=spec.edge, thin=False), pen)
    drawn = lines(strokes)
    # GEOS takes an outline's small dents for straight, up to a hundredth of the distance.
    edges = shapely.MultiLineString(list(shapely.get_rings(shapes)))
    assert (shapely.distance(drawn, edges) >= 0.99 * pen * 500 - 1.5).all()
    assert shapely.covers(shapely.union_all(shapes), drawn).all()


@long
@settings(max_examples=examples(60, 250), deadline=None)
@given(
    areas(most=2),
    st.sampled_from([ParallelHatch(), ParallelHatch(angle=10, join=False), CrossHatch(between=60)]),
    PENS,
)
def test_parallel_strokes_and_the_edge_leave_nothing_white(
    shapes: NDArray[np.object_], spec: Hatch, pen: float
) -> None:
    assert unpainted(shapes, hatched(of_polygons(shapes), spec, pen), pen) <= 0.01


@long
@settings(max_examples=examples(60, 250), deadline=None)
@given(areas(most=2), st.sampled_from([ConcentricHatch(), SpiralHatch(), SpiralHatch(edge=False)]), PENS)
def test_rings_leave_hardly_anything_white(shapes: NDArray[np.object_], spec: Hatch, pen: float) -> None:
    assert unpainted(shapes, hatched(of_polygons(shapes), spec, pen), pen) <= 0.02


@pytest.mark.parametrize("spec", [ConcentricHatch(), SpiralHatch(), SpiralHatch(edge=False)])
@pytest.mark.parametrize("shape", [RING, shapely.Point(0, 0).buffer(17.3, quad_segs=64)])
def test_rings_fill_round_areas(spec: Hatch, shape: shapely.Polygon) -> None:
    strokes = hatched(outlines(shape), spec, 1)
    assert unpainted(shapely.transform(np.array([shape]), lambda p: p * 1000), strokes, 1) < 0.002


def test_rings_are_a_spacing_apart_and_the_edge_comes_last() -> None:
    strokes = hatched(outlines(shapely.box(0, 0, 20, 30)), ConcentricHatch(spacing=1.5), 1.0)
    assert strokes.closed.all()
    first = strokes.points[strokes.rings[:-1]].min(axis=1)
    boxes = shapely.bounds(lines(strokes))
    assert (boxes[::-1] == [[500 + k, 500 + k, 19500 - k, 29500 - k] for k in range(0, 9500, 1500)]).all()
    assert len(first) == 7
    outward = hatched(outlines(shapely.box(0, 0, 20, 30)), ConcentricHatch(spacing=1.5, edge=False), 1.0)
    assert (shapely.bounds(lines(outward)) == boxes[::-1]).all()


def test_what_is_left_in_the_middle_is_drawn_once() -> None:
    line, ring = lines(hatched(outlines(shapely.box(0, 0, 9, 2.8)), ConcentricHatch(), 1.0))
    assert ring.bounds == (500, 500, 8500, 2300)
    assert line.bounds == pytest.approx((1400, 1400, 7600, 1400), abs=100)
    assert line.length < 6500
    spiral = hatched(outlines(shapely.box(0, 0, 9, 2.8)), SpiralHatch(edge=False), 1.0)
    assert len(spiral) == 1
    assert shapely.length(lines(spiral)).sum() == pytest.approx(ring.length + line.length, abs=400)


@pytest.mark.parametrize("degrees", [30, 45, 60, 90])
def test_rings_reach_into_corners_without_lifting_the_pen(degrees: float) -> None:
    half = np.radians(degrees / 2)
    kite = shapely.Polygon([(0, 0), (30, 30 * np.tan(half)), (60, 0), (30, -30 * np.tan(half))])
    strokes = hatched(outlines(kite), ConcentricHatch(), 1.0)
    in_steps = shapely.transform(np.array([kite]), lambda points: points * 1000)
    assert unpainted(in_steps, strokes, 1.0) < 0.005
    rings = 30 * np.sin(half)
    assert strokes.closed.sum() == int(rings + 0.5)
    assert len(strokes) <= rings + 3
    drawn = shapely.length(lines(strokes)).sum()
    # In sharp corners the pen goes to and fro.
    assert drawn < 1.08 * in_steps[0].area / 1000


def test_with_wide_spacings_corners_stay_corners() -> None:
    strokes = hatched(outlines(shapely.box(0, 0, 21, 31)), ConcentricHatch(spacing=2), 1.0)
    assert (np.diff(strokes.rings)[strokes.closed] == 4).all()


@pytest.mark.parametrize("shape", [shapely.box(0, 0, 31, 23), shapely.Point(3, 3).buffer(12, quad_segs=32)])
def test_a_simple_area_is_one_spiral(shape: shapely.Polygon) -> None:
    alone = hatched(outlines(shape), SpiralHatch(edge=False), 0.8)
    assert len(alone) == 1
    # It begins outside and ends in the middle.
    edge = shapely.LineString(shape.exterior.coords)
    begin, end = (edge.distance(shapely.Point(alone.points[which] / 1000)) for which in (0, -1))
    assert begin == pytest.approx(0.4, abs=0.01)
    assert end > 9
    with_edge = hatched(outlines(shape), SpiralHatch(), 0.8)
    assert with_edge.closed.tolist() == [False, True]


def test_a_spiral_draws_nearly_all_of_its_rings_and_crosses_none() -> None:
    rings = hatched(outlines(RING), ConcentricHatch(), 0.8)
    spiral = lines(hatched(outlines(RING), SpiralHatch(edge=False), 0.8))
    # A gap and the way to the next ring are as long.
    assert shapely.length(spiral).sum() == pytest.approx(shapely.length(lines(rings)).sum(), rel=0.02)
    assert shapely.is_simple(spiral).all()
    assert not shapely.intersects(spiral[:-1], spiral[1:]).any()


def test_parts_have_spirals_of_their_own() -> None:
    strokes = hatched(outlines(NECK), SpiralHatch(edge=False), 1.0)
    assert len(strokes) == 2
    assert len(hatched(outlines(RING), SpiralHatch(edge=False), 1.0)) <= 5


def test_marks_come_one_after_another_each_with_its_edge_at_last() -> None:
    squares = outlines(*(shapely.box(20 * k, 0, 20 * k + 10, 10) for k in range(3)))
    for spec in (ParallelHatch(), SpiralHatch()):
        strokes = hatched(squares, spec, 0.5)
        assert strokes.closed.tolist() == [False, True] * 3
        assert (strokes.points[strokes.rings[:-1], 0] // 20_000).tolist() == [0, 0, 1, 1, 2, 2]


def test_areas_that_lie_over_one_another_are_filled_each() -> None:
    box = shapely.box(0, 0, 10, 10)
    one, two = (hatched(outlines(*[box] * count), ParallelHatch(), 0.5) for count in (1, 2))
    assert two.points.tolist() == [*one.points.tolist()] * 2


@pytest.mark.parametrize("kind", ["concentric", "spiral"])
def test_copies_are_filled_alike_and_once(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    shapes = [shapely.affinity.translate(each, 40 * k, 3 * k) for k in range(4) for each in (NECK, RING)]
    buffered = list[int]()
    buffer = shapely.buffer

    def counted(areas: NDArray[np.object_], *more: Any, **chosen: Any) -> NDArray[np.object_]:
        buffered.append(len(areas))
        return np.asarray(buffer(areas, *more, **chosen))

    monkeypatch.setattr(shapely, "buffer", counted)
    strokes = hatched(outlines(*shapes), HATCHES[kind](), 1.0)
    assert max(buffered) < len(shapes)
    alone = hatched(outlines(NECK, RING), HATCHES[kind](), 1.0)
    copies = [alone.moved(40_000 * k, 3_000 * k) for k in range(4)]
    assert strokes.points.tolist() == [place for each in copies for place in each.points.tolist()]
    assert strokes.closed.tolist() == alone.closed.tolist() * 4


def test_what_is_too_narrow_for_the_pen_has_its_edge_drawn() -> None:
    for broad in (0.6, 0.3, 0.15, 0.01):
        shape = shapely.box(0, 0, 20, broad)
        strokes = hatched(outlines(shape), ParallelHatch(), 1.0)
        assert strokes.closed.tolist() == [True]
        in_steps = shapely.box(0, 0, 20_000, broad * 1000)
        assert shapely.covers(in_steps, lines(strokes)).all()
        assert inked(strokes, 1.0).covers(in_steps)
        assert not len(hatched(outlines(shape), ParallelHatch(thin=False), 1.0))


def test_an_inset_of_nothing_goes_to_the_very_edge() -> None:
    strokes = hatched(outlines(shapely.box(0, 0, 10, 10)), ParallelHatch(angle=0, inset=0, edge=False), 0.5)
    assert len(strokes) == 1
    assert np.unique(strokes.points[:, 0]).tolist() == [0, 10_000]
    # What lies on a line is taken for just below it.
    assert np.unique(strokes.points[:, 1]).tolist() == list(range(0, 10_000, 500))


@pytest.mark.parametrize("kind", list(HATCHES))
def test_nothing_is_filled_with_nothing(kind: str) -> None:
    assert len(hatched(nothing(), HATCHES[kind](), 1.0)) == 0
    flat = Outlines(np.array([[0, 0], [9, 9]]), np.array([0, 2]), np.array([0, 1]), np.ones(1, bool))
    assert len(hatched(flat, HATCHES[kind](), 1.0)) == 0


@pytest.mark.parametrize(
    ("spec", "pen", "count", "words"),
    [
        (ParallelHatch(spacing=0.001), 0.5, 1, "hatch.spacing = 0.001 mm, expected a twentieth of the pen's"),
        (ConcentricHatch(spacing=0.02), 0.5, 1, " width of 0.5 mm or more: 0.025 mm would do"),
        (ParallelHatch(angle=0), 0.001, 10, "hatch.spacing = 0.001 mm, the pen's width: about 4,000,000 str"),
        (ParallelHatch(angle=0, spacing=0.005), 0.05, 50, "at most 2,000,000: 0.01 mm would do"),
        (CrossHatch(angle=0), 0.001, 10, "about 7,000,000 strokes, expected at most 2,000,000: 0.004 mm"),
        (SpiralHatch(spacing=0.001), 0.01, 1000, "hatch.spacing = 0.001 mm: about 6,000,000 strokes"),
    ],
)
def test_a_hairs_spacing_is_refused_with_what_would_do(
    spec: Hatch, pen: float, count: int, words: str
) -> None:
    boxes = outlines(*(shapely.box(0, 500 * k, 300, 500 * k + 400) for k in range(count)))
    with pytest.raises(GeometryError) as caught:
        hatched(boxes, spec, pen)
    assert words in str(caught.value)


@pytest.mark.parametrize("key", ["spacing", "inset"])
@pytest.mark.parametrize("value", [-0.001, -1.0, float("nan")])
def test_widths_of_nothing_are_refused(key: str, value: float) -> None:
    with pytest.raises((RecipeError, ValueError), match=key):
        ParallelHatch(**{key: value})  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", list(HATCHES))
@pytest.mark.parametrize("shape", [NECK, RING])
def test_nothing_is_drawn_twice(kind: str, shape: shapely.Polygon) -> None:
    strokes = lines(hatched(outlines(shape), HATCHES[kind](), 0.7))
    assert shapely.length(shapely.union_all(strokes)) == pytest.approx(shapely.length(strokes).sum(), abs=1)


def test_what_the_pen_cannot_reach_is_told() -> None:
    # Each corner keeps what a square has more than the quarter of a circle, and the neck all of it.
    corners = 4 * (1 - np.pi / 4) * 0.5**2
    box = shapely.box(0, 0, 10, 10)
    assert unreached(outlines(box), ParallelHatch(), 1.0) == pytest.approx(corners, rel=0.05)
    neck = shapely.union_all([box, shapely.box(20, 0, 30, 10), shapely.box(9, 5, 21, 5.6)])
    assert unreached(outlines(neck), ParallelHatch(), 1.0) == pytest.approx(6 + 2 * corners, rel=0.01)
    bar = outlines(shapely.box(0, 0, 10, 0.6))
    assert unreached(bar, ParallelHatch(), 1.0) == 0
    twice = outlines(neck, shapely.affinity.translate(neck, 40, 1), box)
    assert unreached(twice, ParallelHatch(), 1.0) == pytest.approx(12 + 5 * corners, rel=0.01)
    assert unreached(bar, ParallelHatch(thin=False), 1.0) == pytest.approx(6)
    assert unreached(nothing(), SpiralHatch(), 1.0) == 0


def test_a_plot_fills_areas_and_keeps_lines() -> None:
    ink = Ink("wax", "#123456", 0.8)
    areas = np.array([shapely.box(10, 10, 30, 30)], dtype=object)
    line = np.array([shapely.LineString([(40, 10), (40, 30)])], dtype=object)
    page = Artwork("Square", Cell(50_000, 40_000), (Layer(ink, areas, line),))
    done = PlotProcess(hatch=ParallelHatch(angle=0), width=0.5).apply(page, Machine())
    strokes = done.tools[0].strokes
    assert sorted(strokes.closed.tolist()) == [False, False, True]
    edge = lines(strokes)[strokes.closed][0]
    assert edge.bounds == (10_250, 10_250, 29_750, 29_750)
    assert done.facts["plot"]["drawn_mm"] == pytest.approx(20 + 78 + 39 * 19.375 + 38 * 0.5, abs=0.05)
    assert "hatch.kind=parallel" in done.done[0]
