from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import Outlines, nothing, to_polylines
from batik_vector.processes.ordering.distances import PARTS
from batik_vector.processes.plotting.once import once
from tests.processes.strokes import box, line, parts_of, strokes
from tests.thorough import examples, long

Segments: TypeAlias = NDArray[np.int64]

PLACE = st.tuples(st.integers(0, 7), st.integers(0, 7)).map(lambda place: (1000 * place[0], 1000 * place[1]))
POLYLINES = st.lists(
    st.tuples(st.booleans(), st.lists(PLACE, min_size=2, max_size=6)), min_size=1, max_size=30
)


def _length(*drawn: Outlines) -> float:
    return float(shapely.length(shapely.unary_union(np.concatenate([to_polylines(each) for each in drawn]))))


def _valid(parts: Any) -> Outlines:
    return strokes(*((closed and len(set(points)) > 2, points) for closed, points in parts))


@long
@settings(max_examples=examples(50, 1000), deadline=None)
@given(POLYLINES)
def test_what_is_left_is_the_union(parts: Any) -> None:
    drawn = _valid(parts)
    left, source, doubled = once(drawn)
    union = _length(drawn)
    total = float(shapely.length(to_polylines(left)).sum()) if len(left) else 0.0
    assert total == pytest.approx(union, rel=1e-6)
    if len(left):
        assert _length(left) == pytest.approx(union, rel=1e-6)
        assert _length(left, drawn) == pytest.approx(union, rel=1e-6)
    assert len(source) == len(left)
    assert (np.diff(source) >= 0).all()
    given_length = float(shapely.length(to_polylines(drawn)).sum())
    assert doubled.length / PARTS == pytest.approx(given_length - total, abs=2)


def test_strokes_that_share_nothing_stay_as_they_are() -> None:
    drawn = strokes(box(0, 0, 10_000), line((20_000, 0), (30_000, 7), (40_000, 5)), box(0, 0, 4000))
    left, source, doubled = once(drawn)
    assert parts_of(left) == parts_of(drawn)
    assert left.closed.tolist() == [True, False, True]
    assert source.tolist() == [0, 1, 2]
    assert len(doubled.places) == doubled.length == 0


def test_the_first_draws_what_it_shares_and_the_place_is_told() -> None:
    first, second = box(0, 0, 20_000), box(20_000, 0, 20_000)
    left, source, doubled = once(strokes(first, second))
    assert left.closed.tolist() == [True, False]
    # The second is one line, though it began in a corner elsewhere.
    assert parts_of(left)[1] == [(10_000, -10_000), (30_000, -10_000), (30_000, 10_000), (10_000, 10_000)]
    assert doubled.places.tolist() == [[10_000, 0]]
    assert doubled.source.tolist() == [1]
    assert doubled.length == 20_000 * PARTS
    assert source.tolist() == [0, 1]


@pytest.mark.parametrize("back", [False, True])
def test_parts_of_a_slanted_line_are_found_though_their_ends_are_rounded(back: bool) -> None:
    draw = np.random.default_rng(5)
    whole, part = [], []
    for number in range(300):
        begin = np.array([number * 40_000, 0])
        step = draw.integers(2000, 30_000, 2)
        low, high = np.sort(draw.uniform(0.05, 0.95, 2))
        if (high - low) * step.max() < 100:
            continue
        ends = [begin + np.rint(step * share).astype(np.int64) for share in (low, high)]
        whole.append(line(tuple(begin), tuple(begin + step)))
        part.append(line(*(tuple(end) for end in (ends[::-1] if back else ends))))
    for parts in (whole + part, part + whole):
        left, _, doubled = once(strokes(*parts))
        given_length = shapely.length(to_polylines(strokes(*whole))).sum()
        assert shapely.length(to_polylines(left)).sum() == pytest.approx(given_length, rel=1e-6)
        drawn = shapely.unary_union(to_polylines(strokes(*whole)))
        assert shapely.hausdorff_distance(drawn, shapely.multilinestrings(to_polylines(left))) <= 1.0
        assert len(doubled.places) >= len(part) or parts[0] is not whole[0]


def test_two_microns_beside_is_another_line() -> None:
    drawn = strokes(line((0, 0), (10_000, 0)), line((1000, 2), (9000, 2)), line((1000, 1), (9000, 1)))
    assert once(drawn)[1].tolist() == [0, 1]


def test_a_stroke_that_goes_back_on_itself_is_drawn_once() -> None:
    left, source, _ = once(strokes(line((0, 0), (9000, 0), (3000, 0), (3000, 5000))))
    assert parts_of(left) == [[(0, 0), (3000, 0), (9000, 0)], [(3000, 0), (3000, 5000)]]
    assert source.tolist() == [0, 0]


def test_nothing_is_nothing() -> None:
    left, source, doubled = once(nothing())
    assert len(left) == len(source) == len(doubled.places) == 0


def test_what_is_too_large_to_reckon_with_is_refused() -> None:
    with pytest.raises(GeometryError, match="3000000 mm large, expected at most 2 km"):
        once(strokes(line((0, 0), (3_000_000_000, 0))))


def _doubles(count: int) -> tuple[Segments, Segments]:
    """Short lines, and all of them with exact, reversed and partial doubles besides, mixed: (n, 2, 2)."""
    draw = np.random.default_rng(3)
    few, fifth = 2 * count // 5, count // 5
    begin = draw.integers(0, 2_000_000, (few, 2))
    step, times = draw.integers(1, 60, (few, 2)) * draw.choice([-1, 1], (few, 2)), draw.integers(10, 40, few)
    whole = np.stack([begin, begin + step * times[:, None]], axis=1)
    same, back, some = (draw.integers(0, few, fifth) for _ in range(3))
    low = draw.integers(0, times[some] // 2)
    high = draw.integers(times[some] // 2 + 1, times[some] + 1)
    part = np.stack([begin[some] + step[some] * at[:, None] for at in (low, high)], axis=1)
    return whole, draw.permutation(np.concatenate([whole, whole[same], whole[back][:, ::-1], part]))


def test_of_100_000_segments_nothing_is_lost_and_nothing_drawn_twice() -> None:
    whole, drawn = _doubles(100_000)
    count = len(drawn)
    ends = np.arange(count + 1)
    left, _, doubled = once(Outlines(drawn.reshape(-1, 2), 2 * ends, ends, np.zeros(count, bool)))
    union = float(np.hypot(*(whole[:, 1] - whole[:, 0]).T).sum())
    found = to_polylines(left)
    assert shapely.length(found).sum() == pytest.approx(union, rel=1e-6)
    assert doubled.length / PARTS == pytest.approx(np.hypot(*np.diff(drawn, axis=1)[:, 0].T).sum() - union)
    share = np.random.default_rng(4).random((count, 1))
    places = np.asarray(shapely.points((drawn[:, 0] + share * (drawn[:, 1] - drawn[:, 0]))[::5]), object)
    near = shapely.STRtree(found).query_nearest(places, max_distance=1.0, all_matches=False)
    assert np.unique(near[0]).tolist() == list(range(len(places)))
