from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.processes.plotting import touching as module
from batik_vector.processes.plotting.touching import numbered, touching
from tests.thorough import examples, long

PLACE = st.tuples(st.integers(-40, 40), st.integers(-25, 25))

REACH, AT_ONCE = st.sampled_from([0, 1, 3]), st.sampled_from([3, 1 << 19])


def _by_hand(places: Any, start: Any, end: Any, reach: int) -> set[tuple[int, int]]:
    """Every place against every segment, in whole numbers."""
    found = set()
    for segment, (a, b) in enumerate(zip(places[start].tolist(), places[end].tolist(), strict=True)):
        x, y = b[0] - a[0], b[1] - a[1]
        for place, (u, v) in enumerate((places - a).tolist()):
            aside, along, square = x * v - y * u, x * u + y * v, x * x + y * y
            if 0 < along < square and aside * aside <= reach * reach * square:
                found.add((segment, place))
    return found


@long
@settings(max_examples=examples(80, 1500), deadline=None)
@given(st.lists(PLACE, min_size=2, max_size=40, unique=True), REACH, AT_ONCE)
def test_places_upon_segments_are_those_found_one_by_one(drawn: Any, reach: int, at_once: int) -> None:
    places, number = numbered(np.array(drawn, np.int64))
    start, end = number[:-1], number[1:]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "AT_ONCE", at_once)
        segment, place = touching(places, start, end, reach)
    assert set(zip(segment.tolist(), place.tolist(), strict=True)) == _by_hand(places, start, end, reach)
    along = ((places[place] - places[start[segment]]) * (places[end] - places[start])[segment]).sum(axis=1)
    assert np.lexsort((along, segment)).tolist() == list(range(len(segment))) or (np.diff(along) == 0).any()


def test_far_apart_and_all_in_a_line() -> None:
    places, number = numbered(np.array([[0, 0], [2_000_000_000, 0], [1_999_999_999, 0], [5, 1], [5, 2]]))
    place = touching(places, number[:1], number[1:2])[1]
    assert [places[k].tolist() for k in place] == [[5, 1], [1_999_999_999, 0]]
