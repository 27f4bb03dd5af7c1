"""What stays where places lie too near to one another."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from batik_vector.geometry.fills.thinning import near_pairs, settled, thinned


@given(st.integers(0, 2**32 - 1), st.floats(0.05, 3))
def test_pairs_are_those_that_lie_near(seed: int, least: float) -> None:
    chance = np.random.default_rng(seed)
    points, group = chance.random((60, 2)) * 8 - 4, chance.integers(0, 3, 60)
    far = np.hypot(*(points[:, None] - points[None]).transpose(2, 0, 1))
    wanted = np.argwhere(np.triu((far < least) & (group[:, None] == group[None]), 1))
    assert sorted(zip(*near_pairs(points, group, least), strict=True)) == sorted(map(tuple, wanted))


@given(st.integers(0, 2**32 - 1))
def test_none_of_a_pair_stay_and_whoever_goes_has_a_reason(seed: int) -> None:
    chance = np.random.default_rng(seed)
    rank = chance.integers(0, 12, 25)
    first, second = chance.integers(0, 25, (2, 60))
    first, second = first[first != second], second[first != second]
    kept = settled(rank, first, second)
    assert not (kept[first] & kept[second]).any()
    for gone in np.flatnonzero(~kept).tolist():
        rivals = np.concatenate([second[first == gone], first[second == gone]])
        assert (kept[rivals] & (rank[rivals] < rank[gone])).any() or (rank[rivals] == rank[gone]).any()


def test_the_earlier_has_its_way_and_equals_both_go() -> None:
    points = np.array([[0, 0], [0.5, 0], [0.9, 0], [5, 0]])
    assert thinned(points, np.zeros(4, int), 0.6).tolist() == [True, False, True, True]
    assert thinned(points, np.zeros(4, int), 0.6, np.array([1, 1, 0, 0])).tolist() == [
        True,
        False,
        True,
        True,
    ]
    assert thinned(points, np.zeros(4, int), 0.6, np.array([0, 0, 1, 0])).tolist() == [
        False,
        False,
        True,
        True,
    ]


@pytest.mark.parametrize("count", [0, 1])
def test_few_stay_all(count: int) -> None:
    assert thinned(np.zeros((count, 2)), np.zeros(count, int), 1.0).all()
