from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.geometry.outlines import Steps
from batik_vector.processes.ordering.distances import PARTS, distances
from batik_vector.processes.ordering.neighbours import NOBODY, neighbours
from tests.thorough import examples, long


def scattered(count: int, crowded: bool) -> Steps:
    draw = np.random.default_rng(7)
    places = draw.integers(0, 1_000_000, (count, 2))
    # Crowded: one place in ten thousand times less room than the next.
    return np.asarray(places // (np.array([1, 100, 10_000])[np.arange(count) % 3, None] if crowded else 1))


@pytest.mark.parametrize("crowded", [False, True])
def test_most_of_the_nearest_are_found(crowded: bool) -> None:
    places = scattered(1500, crowded)
    found, apart = neighbours(places, np.zeros(1500, np.intp), np.arange(1500), 5)
    true = distances(places[:, None], places[None])
    np.fill_diagonal(true, 2**60)
    nearest = np.sort(true, axis=1)[:, :5]
    assert (apart[:, :3] == nearest[:, :3]).mean() > (0.8 if crowded else 0.9)
    assert (apart[:, 0] == nearest[:, 0]).mean() > 0.9
    assert (apart == distances(places[:, None], places[found])).all()


@long
@settings(max_examples=examples(60, 1200))
@given(st.lists(st.tuples(*[st.integers(0, 3)] * 4), min_size=1, max_size=40))
def test_neighbours_are_of_the_same_group_and_of_another_owner(rows: list[tuple[int, int, int, int]]) -> None:
    table = np.array(rows, np.int64)
    places, group, owner = table[:, :2] * 1000, table[:, 2], table[:, 3]
    found, apart = neighbours(places, group, owner, 4)
    for row, others in enumerate(found):
        there = others[others != NOBODY]
        assert len(set(there.tolist())) == len(there)
        assert (group[there] == group[row]).all()
        assert (owner[there] != owner[row]).all()
        assert (np.diff(apart[row]) >= 0).all()


def test_distances_are_whole_parts_of_a_step() -> None:
    a, b = np.array([[0, 0], [0, 0]]), np.array([[3, 4], [1, 1]])
    assert distances(a, b).tolist() == [5 * PARTS, round(2**0.5 * PARTS)]
    far = np.array([[10**9, 10**9]])
    assert distances(far, -far).tolist() == [round(8**0.5 * 10**9 * PARTS)]
