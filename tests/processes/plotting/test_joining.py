from __future__ import annotations

import math
from collections import Counter
from itertools import pairwise
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.geometry.outlines import Outlines, nothing
from batik_vector.processes.plotting.joining import ENDS, longest
from batik_vector.processes.plotting.once import once
from tests.processes.strokes import Place, box, line, parts_of, strokes
from tests.thorough import examples, long

PLACE = st.tuples(st.integers(0, 4), st.integers(0, 4)).map(lambda place: (1000 * place[0], 1000 * place[1]))
POLYLINES = st.lists(
    st.tuples(st.booleans(), st.lists(PLACE, min_size=2, max_size=5)), min_size=1, max_size=25
)


def _segments(drawn: Outlines, corners: set[Place]) -> list[tuple[Place, Place]]:
    """Segments cut at all corners upon them, so that vertices on a straight way do not matter."""
    found = []
    for points, closed in zip(parts_of(drawn), drawn.closed.tolist(), strict=True):
        for a, b in pairwise([*points, *points[: int(closed)]]):
            upon = [place for place in corners if _upon(place, a, b)]
            upon.sort(key=lambda place: math.dist(a, place))
            found += [(min(pair), max(pair)) for pair in pairwise(upon)]
    return sorted(found)


def _upon(place: Place, a: Place, b: Place) -> bool:
    (x, y), (u, v) = (place[0] - a[0], place[1] - a[1]), (b[0] - a[0], b[1] - a[1])
    return x * v == y * u and 0 <= x * u + y * v <= u * u + v * v


def _fewest(segments: list[tuple[Place, Place]]) -> int:
    """Half of the odd places of what hangs together, or one."""
    root: dict[Place, Place] = {}

    def found(place: Place) -> Place:
        while root.setdefault(place, place) != place:
            place = root[place]
        return place

    degree = Counter[Place]()
    for a, b in segments:
        root[found(a)] = found(b)
        degree.update([a, b])
    odd = Counter(found(place) for place, count in degree.items() if count % 2)
    return sum(max(1, odd[part] // 2) for part in {found(place) for place in degree})


@long
@settings(max_examples=examples(60, 1500), deadline=None)
@given(POLYLINES)
def test_the_same_is_drawn_with_as_few_lifts_as_can_be(parts: Any) -> None:
    drawn = once(strokes(*((closed and len(set(points)) > 2, points) for closed, points in parts)))[0]
    corners = {place for part in parts_of(drawn) for place in part}
    segments = _segments(drawn, corners)
    found = longest(drawn)
    assert _segments(found, corners) == segments
    assert len(found) == _fewest(segments)


def test_paths_go_straight_on_where_they_cross() -> None:
    arms = [line((0, 0), place) for place in [(900, 10), (-900, -20), (30, 800), (-40, -800)]]
    assert sorted(map(sorted, parts_of(longest(strokes(*arms))))) == [
        sorted([(900, 10), (0, 0), (-900, -20)]),
        sorted([(30, 800), (0, 0), (-40, -800)]),
    ]


def test_rings_that_touch_are_one_closed_path() -> None:
    found = longest(strokes(box(0, 0, 2000), box(2000, 2000, 2000), box(4000, 0, 2000)))
    assert (len(found), found.closed.tolist(), len(found.points)) == (1, [True], 8)


def test_a_ring_is_drawn_on_the_way() -> None:
    found = longest(strokes(box(0, 0, 2000), line((-5000, -1000), (-1000, -1000))))
    assert (len(found), found.closed.tolist()) == (1, [False])
    assert parts_of(found)[0][-1] in [(-1000, -1000), (-5000, -1000)]


def test_a_closed_path_alone_stays_closed_and_straight_vertices_go() -> None:
    ring = (True, [(0, 0), (500, 0), (1000, 0), (1000, 1000), (0, 1000)])
    assert parts_of(longest(strokes(ring))) == [[(0, 0), (1000, 0), (1000, 1000), (0, 1000)]]


def test_pieces_of_a_ring_close() -> None:
    found = longest(strokes(line((0, 0), (1000, 0), (1000, 1000)), line((0, 0), (0, 1000), (1000, 1000))))
    assert found.closed.tolist() == [True]


@pytest.mark.parametrize("count", [5, ENDS, ENDS + 1, 301])
def test_a_star_of_many_lines_takes_half_as_many_paths(count: int) -> None:
    star = strokes(*(line((0, 0), (1_000_000, 1000 * n)) for n in range(count)))
    assert len(longest(star)) == (count + 1) // 2


def test_nothing_is_nothing() -> None:
    assert len(longest(nothing())) == 0
