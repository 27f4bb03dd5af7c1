from __future__ import annotations

import sys
from dataclasses import replace
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector import compile_recipe, load_recipe
from batik_vector.artwork import page as pages
from batik_vector.geometry.outlines import Outlines, of_polygons, to_polygons, together
from batik_vector.processes import order as module
from batik_vector.processes.order import contours, in_order, joined, ordered, travel
from tests.thorough import examples, long

from .strokes import alike, box, line, parts_of, random_lines, spanning_tree, strokes

SAMPLES = Path(__file__).parents[2] / "samples"
PLACE = st.tuples(st.integers(-50, 50), st.integers(-50, 50))
STROKE = st.one_of(
    st.builds(box, st.integers(-50, 50), st.integers(-50, 50), st.integers(1, 40).map(lambda n: 2 * n)),
    st.lists(PLACE, min_size=2, max_size=4, unique=True).map(lambda points: line(*points)),
)


@long
@settings(max_examples=examples(60, 1200))
@given(st.lists(STROKE, max_size=25))
def test_what_is_drawn_stays_the_same_under_its_names(parts: list[Any]) -> None:
    found = in_order(strokes(*parts))
    assert alike(found) == alike(strokes(*parts))


@long
@settings(max_examples=examples(40, 800))
@given(
    st.lists(st.builds(box, st.integers(0, 9), st.integers(0, 9), st.sampled_from([2, 8, 20])), max_size=30)
)
def test_no_stroke_follows_one_that_it_lies_inside(parts: list[Any]) -> None:
    grown = [(closed, [(10 * x, 10 * y) for x, y in points]) for closed, points in parts]
    found = to_polygons(in_order(strokes(*grown)))
    inner, outer = shapely.STRtree(found).query(found, predicate="within")
    proper = ~shapely.equals(found[inner], found[outer])
    touching = shapely.intersects(shapely.boundary(found[inner]), shapely.boundary(found[outer]))
    assert (inner < outer)[proper & ~touching].all()


def test_rings_in_rings_are_drawn_from_the_inside_out() -> None:
    depths = [box(0, 0, 2 * size) for size in (50, 10, 40, 20, 30)]
    dot = line((0, 0), (1, 1))
    found = parts_of(in_order(strokes(dot, *depths, line((99, 0), (120, 0)))))
    reach = [max(x for x, _ in part) for part in found]
    assert [each for each in reach if each < 99] == [1, 10, 20, 30, 40, 50]


def test_lines_are_turned_and_rings_begun_where_it_is_nearest() -> None:
    row = [
        line((10 * k, 0), (10 * k + 8, 0)) if k % 2 else line((10 * k + 8, 0), (10 * k, 0)) for k in range(8)
    ]
    mixed = strokes(*(row[k] for k in (5, 2, 7, 0, 3, 6, 1, 4)), box(93, 3, 10))
    found = in_order(mixed)
    assert travel(found) == pytest.approx((7 * 2 + np.hypot(88 - 78, 2)) / 1000, abs=1e-4)
    assert parts_of(found)[-1][0] == (88, -2)


@pytest.mark.parametrize("count", [300, 1000])
@pytest.mark.parametrize("seed", [1, 2])
def test_ways_are_short(count: int, seed: int) -> None:
    given = random_lines(count, seed)
    ends = given.points.reshape(-1, 2, 2)
    # Ways of 1.25 times the tree are the shortest there are for such lines, about.
    assert travel(in_order(given)) * 1000 <= 1.40 * spanning_tree(ends)


def test_a_sample_is_drawn_with_little_way() -> None:
    artwork = compile_recipe(load_recipe(SAMPLES / "chrysanthemum-line.toml"))
    found = together(list(artwork.lines(0)))
    assert travel(found) > 39_000
    assert travel(in_order(found)) < 2_200


def test_the_order_does_not_hang_on_how_pieces_are_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = random_lines(200, 3)
    halves = [whole.taken(np.arange(0, 90)), whole.taken(np.arange(90, 200))]
    expected = parts_of(together(list(ordered([replace(whole, names=())]))))
    monkeypatch.setattr(module, "PIECE", 40)
    found = list(ordered(halves))
    assert len(found) >= 10
    assert parts_of(together(found)) == expected
    assert pages.PIECE > 40


def test_what_does_not_fit_together_is_ordered_batch_by_batch(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = random_lines(90, 4)
    monkeypatch.setattr(module, "BATCH", 60)
    found = list(ordered([whole.taken(np.arange(first, first + 30)) for first in (0, 30, 60)]))
    assert [len(each) for each in found] == [30, 30, 30]
    assert alike(found[1]) == alike(whole.taken(np.arange(30, 60)))


def test_contours_are_the_rings_without_moves_that_lead_nowhere() -> None:
    ring = shapely.Polygon(
        [(0, 0), (9, 0), (9, 0), (9, 9), (0, 9)], [[(2, 2), (2, 4), (4, 4), (4, 4), (4, 2)]]
    )
    areas = replace(of_polygons(np.array([ring])), names=["a"])
    lines = strokes(line((1, 1), (1, 1), (2, 1)), line((5, 5), (5, 5)))
    found = list(contours([areas, lines]))
    assert [parts_of(each) for each in found] == [
        [[(0, 0), (9, 0), (9, 9), (0, 9)], [(2, 2), (2, 4), (4, 4), (4, 2)]],
        [[(1, 1), (2, 1)]],
    ]
    assert list(contours([strokes(line((5, 5), (5, 5)))])) == []


def test_lines_that_meet_end_to_end_are_drawn_without_a_lift() -> None:
    open_, shut = [(0, 0), (5, 0), (9, 1)], [(20, 0), (30, 0), (30, 9)]
    pieces = strokes(
        line(*open_[1:]),
        line(shut[2], shut[0]),
        line(shut[1], shut[0]),
        line(*shut[1:]),
        line(*open_[:2]),
        box(9, 2, 2),
    )
    (found,) = ordered([pieces], join=True)
    drawn = [(closed, part) for (closed, part, _) in alike(found)]
    expected = alike(strokes(line(*open_), (True, shut), box(9, 2, 2)))
    turned = alike(strokes(line(*open_), (True, shut[::-1]), box(9, 2, 2)))
    assert drawn in [[each[:2] for each in way] for way in (expected, turned)]


def test_a_line_there_and_back_stays_open() -> None:
    (found,) = ordered([strokes(line((0, 0), (9, 0)), line((9, 0), (0, 0)))], join=True)
    assert found.closed.tolist() == [False]
    assert parts_of(joined(found)) == parts_of(found)
    assert len(found.points) == 3


@long
@settings(max_examples=examples(60, 1200))
@given(st.lists(st.tuples(*[st.tuples(st.integers(0, 3), st.integers(0, 3))] * 2), max_size=20))
def test_joining_loses_and_adds_no_step(pairs: list[Any]) -> None:
    pieces = strokes(*(line(a, b) for a, b in pairs if a != b))

    def steps(drawn: Outlines) -> list[Any]:
        points, rings = drawn.repeating()
        parts = np.split(points, rings[1:-1]) if len(drawn) else []
        return sorted(
            tuple(sorted(map(tuple, pair.tolist())))
            for part in parts
            for pair in np.stack([part[:-1], part[1:]], axis=1)
        )

    found = list(ordered([pieces], join=True)) if len(pieces) else []
    assert sorted(chain(*map(steps, found))) == steps(pieces)
    for drawn in found:
        ends = drawn.points[np.where(drawn.closed, drawn.rings[:-1], drawn.rings[1:] - 1)][:-1]
        meet = (ends == drawn.points[drawn.rings[1:-1]]).all(axis=1)
        assert not (meet & ~drawn.closed[1:] & ~drawn.closed[:-1]).any()


def test_nothing_and_one_are_in_order() -> None:
    assert list(ordered([])) == []
    one = strokes(box(0, 0, 4))
    assert in_order(one) is one


def calls(given: Outlines) -> int:
    counted = [0]

    def count(frame: object, event: str, argument: object) -> None:
        counted[0] += event in ("call", "c_call")

    sys.setprofile(count)
    try:
        in_order(given)
    finally:
        sys.setprofile(None)
    return counted[0]


def test_work_grows_with_the_strokes_and_no_faster() -> None:
    few, many = (calls(random_lines(count, 5)) for count in (500, 4000))
    assert many <= 8 * 1.3 * few
