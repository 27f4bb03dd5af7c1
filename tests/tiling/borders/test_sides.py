"""Bands laid along sides: exact joints, exact mitres, true bends, honest stretches."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from batik_vector.artwork import Ink
from batik_vector.errors import GeometryError
from batik_vector.tiling.borders.bands import Band, Marks, mitred, solved, spans
from batik_vector.tiling.borders.bends import bent
from batik_vector.tiling.borders.joints import closed, straightened
from batik_vector.tiling.borders.sides import (
    Course,
    Measures,
    bent_round,
    corner_square,
    mitred_round,
    sides_of,
    straight,
    turned_corners,
)
from batik_vector.tiling.torus.torus import Window
from batik_vector.tiling.welding.congruent import Copies
from batik_vector.tiling.welding.sheets import Sheet
from batik_vector.tiling.welding.wrapping import Torus

many = settings(max_examples=60, deadline=None, derandomize=True)
INK = Ink("wax", "#f4efe2")
ALL = ("bottom", "right", "top", "left")


def marks(*areas: shapely.Polygon, lines: tuple[shapely.LineString, ...] = ()) -> Marks:
    def codes(count: int) -> NDArray[np.intp]:
        return np.zeros(count, np.intp)

    return Marks(
        np.array(areas, dtype=object),
        codes(len(areas)),
        np.zeros(len(areas), bool),
        np.array(lines, dtype=object),
        codes(len(lines)),
        np.zeros(len(lines), bool),
    )


def measures(period: int = 40_000, depth: int = 30_000, **other: float) -> Measures:
    return Measures(period, depth, int(other.get("phase", 0)), bool(other.get("whole", True)), 0.05)


@many
@given(
    first=st.integers(-200_000, 200_000),
    run=st.integers(1, 300_000),
    begin=st.integers(0, 10**6),
    stretch=st.floats(0.9, 1.1),
    period=st.integers(1000, 60_000),
)
def test_spans_lay_every_step_of_the_drawing_once(
    first: int, run: int, begin: int, stretch: float, period: int
) -> None:
    end = begin + max(1, round(run * stretch))
    laid = spans(first, first + run, begin, end, period)
    assert laid[0].begin == begin
    assert laid[-1].end == end
    assert all(a.end == b.begin for a, b in pairwise(laid))
    assert all(0 <= span.first < span.last <= period for span in laid)
    assert laid[0].first == first % period
    assert all(abs((s.end - s.begin) / (s.last - s.first) - stretch) * (s.last - s.first) < 2 for s in laid)
    if len(laid) > 2:
        assert {(span.first, span.last) for span in laid[1:-1]} == {(0, period)}


polygons = st.lists(
    st.tuples(st.integers(0, 40_000), st.integers(0, 30_000)), min_size=3, max_size=12, unique=True
).map(lambda points: shapely.make_valid(shapely.Polygon(points)))


@many
@given(polygons)
def test_the_cut_of_a_mitre_lies_on_its_line_to_the_bit(shape: shapely.Geometry) -> None:
    pieces = [part for part in shapely.get_parts(shape) if part.geom_type == "Polygon"]
    pieces = [shapely.set_precision(part, 1.0) for part in pieces]
    pieces = [part for part in pieces if part.geom_type == "Polygon" and part.area]
    cut = mitred(marks(*pieces))
    xy = shapely.get_coordinates(cut.areas)
    assert (xy[:, 0] >= xy[:, 1]).all()
    assert np.array_equal(xy, np.rint(xy))
    wedge = shapely.Polygon([(0, 0), (50_000, 0), (50_000, 50_000)])
    true = shapely.area(shapely.intersection(np.array(pieces, dtype=object), wedge)).sum()
    around = sum(part.length for part in pieces) + 50_000
    assert shapely.area(cut.areas).sum() == pytest.approx(true, abs=2 * around)


def test_a_stroke_and_its_mirror_image_are_one_area_at_a_mitre() -> None:
    bar = shapely.Polygon([(0, 9_000), (40_000, 9_300), (40_000, 12_300), (0, 12_000)])
    cut = mitred(marks(bar))
    both = Marks(
        np.concatenate([cut.areas, cut.moved(lambda xy: xy[:, ::-1]).areas]),
        np.zeros(2, np.intp),
        np.ones(2, bool),
    )
    joined = closed(both, merges=True)
    assert len(joined.areas) == 1
    # Two ends of two corners, and two corners on the mitre: no vertex is left from the cut itself.
    assert shapely.get_num_coordinates(joined.areas[0]) == 7


def test_a_line_goes_on_in_its_mirror_image() -> None:
    line = shapely.LineString([(0, 9_000), (40_000, 9_300)])
    cut = mitred(marks(lines=(line,)))
    assert cut.open_lines.all()
    both = np.concatenate([cut.lines, cut.moved(lambda xy: xy[:, ::-1]).lines])
    found = Marks(lines=both, line_codes=np.zeros(2, np.intp), open_lines=np.ones(2, bool))
    assert [len(whole.coords) for whole in closed(found, merges=True).lines] == [3]


def test_copies_of_unequal_length_meet_in_the_same_points() -> None:
    low, high = (
        [(0, 8_000), (13_337, 16_111), (40_000, 8_000)],
        [(0, 11_000), (9_999, 19_111), (40_000, 11_000)],
    )
    wave = shapely.Polygon([*low, *high[::-1]])
    band = Band(INK, marks(wave), 40_000, 30_000)
    pieces = [band.piece(0, 40_000, width) for width in (39_999, 40_000, 41_777)]
    for piece, width in zip(pieces, (39_999, 40_000, 41_777), strict=True):
        xy = shapely.get_coordinates(piece.areas)
        assert set(xy[xy[:, 0] == 0, 1]) == set(xy[xy[:, 0] == width, 1]) == {8_000.0, 11_000.0}
    laid = closed(band.laid(spans(0, 120_000, 0, 121_001, 40_000), (False, False), 121_001), merges=True)
    assert len(laid.areas) == 1


def test_a_bend_keeps_to_its_circle_within_the_tolerance() -> None:
    bar = shapely.Polygon([(0, 6_000), (30_000, 6_000), (30_000, 9_000), (0, 9_000)])
    round_bar = bent(marks(bar), 30_000, 50_000, 10.0, merges=True).areas
    assert len(round_bar) == 1
    away = np.hypot(*(shapely.get_coordinates(round_bar) - (0, 50_000)).T)
    assert min(abs(away - 41_000).min(), abs(away - 44_000).min()) < 1
    assert (np.minimum(abs(away - 41_000), abs(away - 44_000)) < 1).all()
    quarter = math.pi / 4 * (44_000**2 - 41_000**2)
    assert shapely.area(round_bar[0]) == pytest.approx(quarter, abs=10 * 2 * 44_000)
    chords = shapely.segmentize(round_bar[0].exterior, 100)
    off = np.abs(np.hypot(*(shapely.get_coordinates(chords) - (0, 50_000)).T) - 42_500)
    assert (off[off > 1_400] > 1_500 - 11).all()
    ends = shapely.get_coordinates(round_bar)
    assert {tuple(p) for p in ends if p[0] == 0} == {(0, 6_000), (0, 9_000)}
    assert {tuple(p) for p in ends if p[1] == 50_000} == {(44_000, 50_000), (41_000, 50_000)}


def test_straightened_leaves_corners_only() -> None:
    ring = [(5, 0), (10, 0), (10, 10), (6, 10), (3, 10), (0, 10), (0, 0)]
    hole = [(2, 4), (2, 6), (3, 6), (4, 6), (4, 4)]
    polygon = straightened(np.array([shapely.Polygon(ring, [hole])], dtype=object))[0]
    assert len(polygon.exterior.coords) == 5
    assert len(polygon.interiors[0].coords) == 5
    assert polygon.equals(shapely.Polygon(ring, [hole]))


def wave_sheet() -> Sheet:
    return Sheet("wave", INK, np.array([shapely.box(-5, 10, 60, 14)], dtype=object))


def test_what_is_solved_stays_within_its_box() -> None:
    names: dict[str, int] = {}
    ink, found = solved(
        [wave_sheet()], [INK], (40_000, 12_000), True, 0.02, lambda name: names.setdefault(name, len(names))
    )[0]
    assert ink == INK
    assert shapely.total_bounds(found.areas).tolist() == [0, 10_000, 40_000, 12_000]
    assert names == {"wave": 0}
    assert solved([], [INK], (40_000, 12_000), True, 0.02, lambda name: 0) == []


def test_the_two_edges_of_a_band_have_nothing_to_do_with_each_other() -> None:
    hair = Sheet("hair", INK, np.array([shapely.box(10, -1, 10.003, 5)], dtype=object))
    ((_, found),) = solved([hair], [INK], (40_000, 12_000), True, 0.02, lambda name: 0)
    assert shapely.total_bounds(found.areas).tolist() == [10_000, 0, 10_003, 5_000]


@pytest.mark.parametrize("periodic", [True, False])
def test_a_seam_that_had_to_be_moved_moves_no_edge_of_the_band(
    periodic: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    true = Torus.sealed

    def sealed(torus: Torus, ink: str, areas: Copies, *, apart: bool) -> Copies | None:
        return true(torus, ink, areas, apart=apart) if torus.phase.any() else None

    monkeypatch.setattr(Torus, "sealed", sealed)
    bar = Sheet("bar", INK, np.array([shapely.box(8, 3, 30, 7)], dtype=object))
    ((_, found),) = solved([bar], [INK], (40_000, 12_000), periodic, 0.02, lambda name: 0)
    x0, y0, x1, y1 = shapely.total_bounds(found.areas).tolist()
    assert (y0, y1) == (3_000, 7_000)
    assert (x0, x1) == ((8_013, 30_013) if periodic else (8_000, 30_000))


def window(width: int, height: int) -> Window:
    return Window(0, 0, width, height)


def ends_meet(courses: list[Course]) -> bool:
    """Whether at every corner the two sides lay the same drawing the same way."""
    reach: dict[int, list[list[tuple[int, int, int, int]]]] = {}
    for course in courses:
        for end, corner in enumerate(course.side.corners):
            spans_ = course.spans if not end else course.spans[::-1]
            near = []
            for span in spans_:
                at = span.begin if not end else course.side.length - span.end
                if at >= 30_000:
                    break
                near.append((span.first, span.last, at, span.end - span.begin))
            reach.setdefault(corner, []).append(near)
    return all(first == second for first, second in reach.values())


@many
@given(st.integers(5, 20), st.integers(5, 20), st.integers(-900, 900), st.integers(-900, 900))
def test_sides_that_meet_in_a_mitre_are_drawn_alike_at_the_corner(
    across: int, up: int, dx: int, dy: int
) -> None:
    sides = sides_of(window(across * 40_000 + dx, up * 40_000 + dy), ALL, "mitre")
    courses = mitred_round(sides, range(4), measures(phase=7_000))
    assert ends_meet(courses)
    assert [course.periods for course in courses] == [across, up, across, up]
    for course in courses:
        assert course.spans[0].begin == 0
        assert course.spans[-1].end == course.side.length
        worst = max(((s.end - s.begin) / (s.last - s.first) for s in course.spans), key=lambda x: abs(x - 1))
        assert course.stretch == pytest.approx(worst, abs=2e-4)


@pytest.mark.parametrize(("across", "up"), [(10, 7), (9, 9), (6, 4)])
def test_a_bent_ring_holds_an_even_number_of_periods(across: int, up: int) -> None:
    sides = sides_of(window(across * 40_000, up * 40_000), ALL, "turn")
    courses = bent_round(sides, range(4), 45_000, measures())
    total = sum(course.periods for course in courses)
    assert total == round(total)
    assert total % (4 if across == up else 2) == 0
    # Each side goes on where the arc before it ends.
    for one, two in zip(courses, [*courses[1:], courses[0]], strict=True):
        assert one.arc[-1].last % 40_000 == two.spans[0].first
        assert one.spans[-1].last % 40_000 == one.arc[0].first


def test_a_chain_of_sides_bends_where_they_meet_only() -> None:
    names = ("left", "bottom")
    assert turned_corners(names) == {0}
    courses = bent_round(sides_of(window(400_000, 300_000), names, "turn"), {0}, 45_000, measures())
    assert [(course.side.name, bool(course.arc)) for course in courses] == [("left", True), ("bottom", False)]
    assert courses[0].spans[0].begin == 0
    assert courses[1].spans[-1].end == 400_000


def test_trimmed_bands_keep_their_period() -> None:
    sides = sides_of(window(417_000, 300_000), ("bottom", "top"), "turn")
    courses = straight(sides, (), measures(whole=False))
    assert [course.stretch for course in courses] == [1.0, 1.0]
    assert all(span.last - span.first == span.end - span.begin for span in courses[0].spans)


@pytest.mark.parametrize(
    ("words", "width", "how"),
    [
        (
            "the bottom side, 93 mm, holds 2.33 .*past the limit of 5.0%; .* 80 or 120 mm of length",
            93_000,
            "straight",
        ),
        ("the bottom side, 93 mm, holds 2.33 .* stretched by 16.3%", 93_000, "mitre"),
        ("bottom side is 59 mm long, its corners alone take 60 mm", 59_000, "mitre"),
        ("bottom side is 89 mm long, its corners alone take 90 mm", 89_000, "bend"),
        ("the way round, .* expected a period of", 121_000, "bend"),
    ],
)
def test_what_does_not_fit_is_refused_with_what_would(words: str, width: int, how: str) -> None:
    sides = sides_of(window(width, width), ALL, "mitre" if how == "mitre" else "turn")
    lay = {
        "straight": lambda: straight(sides[:1], (), measures()),
        "mitre": lambda: mitred_round(sides, range(4), measures()),
        "bend": lambda: bent_round(sides, range(4), 45_000, measures(period=260_000)),
    }
    with pytest.raises(GeometryError, match=words):
        lay[how]()


def test_a_period_far_too_long_is_told_with_the_figures_of_one_side() -> None:
    sides = sides_of(window(400_000, 300_000), ALL, "mitre")
    words = "the right side, 300 mm, holds 0.33 periods of 900 mm: they would be squeezed by 66.7%"
    with pytest.raises(GeometryError, match=words):
        mitred_round(sides, range(4), measures(period=900_000, depth=20_000))


def test_corner_squares_turn_or_mirror() -> None:
    at = np.array([[3.0, 1.0]])
    places = {
        manner: [corner_square(window(100, 80), corner, manner)(at)[0].tolist() for corner in range(4)]
        for manner in ("turn", "mirror")
    }
    assert places["turn"] == [[3, 1], [99, 3], [97, 79], [1, 77]]
    assert places["mirror"] == [[3, 1], [97, 1], [97, 79], [3, 79]]
