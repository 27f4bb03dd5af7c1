from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.geometry.outlines import Index, Steps
from batik_vector.processes.ordering import neighbours as neighbours_module
from batik_vector.processes.ordering.distances import PARTS, distances
from batik_vector.processes.ordering.neighbours import NOBODY, neighbours
from tests.thorough import examples, long


def scattered(count: int, crowded: bool) -> Steps:
    draw = np.random.default_rng(7)
    places = draw.integers(0, 1_000_000, (count, 2))
    # Crowded: one place in ten thousand times less room than the next.
    return np.asarray(places // (np.array([1, 100, 10_000])[np.arange(count) % 3, None] if crowded else 1))


def found(places: Steps, group: Index, twin: Index, count: int) -> set[tuple[int, int]]:
    pairs = neighbours(places[:, 0].astype(float), places[:, 1].astype(float), group, twin, count)
    assert (pairs.apart == distances(places[pairs.one], places[pairs.two])).all()
    each = [(min(pair), max(pair)) for pair in zip(pairs.one.tolist(), pairs.two.tolist(), strict=True)]
    assert len(each) == len(set(each))
    return set(each)


@pytest.mark.parametrize("crowded", [False, True])
def test_most_of_the_nearest_are_found(crowded: bool) -> None:
    count = 1500
    places = scattered(count, crowded)
    pairs = found(places, np.zeros(count, np.intp), np.full(count, NOBODY), 5)
    true = distances(places[:, None], places[None])
    np.fill_diagonal(true, np.inf)
    nearest = np.argsort(true, axis=1)
    seen = [[(min(k, o), max(k, o)) in pairs for o in row[:3]] for k, row in enumerate(nearest.tolist())]
    assert np.mean(seen) > (0.85 if crowded else 0.95)
    assert np.mean([row[0] for row in seen]) > 0.9
    assert len(pairs) < 5 * count


@long
@settings(max_examples=examples(60, 1200))
@given(
    st.lists(st.tuples(*[st.integers(0, 3)] * 3, st.integers(-1, 70)), min_size=1, max_size=70),
    st.sampled_from([0, neighbours_module.FEW]),
)
def test_neighbours_are_of_one_group_and_no_twins(rows: list[tuple[int, int, int, int]], few: int) -> None:
    table = np.array(rows, np.int64)
    places, group = table[:, :2] * 1000, table[:, 2]
    twin = np.where(table[:, 3] < len(table), table[:, 3], NOBODY)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(neighbours_module, "FEW", few)
        pairs = found(places, group, twin, 4)
    for one, two in pairs:
        assert one != two
        assert group[one] == group[two]
        assert twin[one] != two
        assert twin[two] != one


def test_places_are_looked_at_part_by_part(monkeypatch: pytest.MonkeyPatch) -> None:
    places = scattered(500, True)
    group, twin = np.arange(500) % 3, np.arange(500) ^ 1
    whole = found(places, group, twin, 6)
    monkeypatch.setattr(neighbours_module, "TOGETHER", 7)
    assert found(places, group, twin, 6) == whole


def test_distances_are_whole_parts_of_a_step() -> None:
    a, b = np.array([[0, 0], [0, 0]]), np.array([[3, 4], [1, 1]])
    assert distances(a, b).tolist() == [5 * PARTS, round(2**0.5 * PARTS)]
    far = np.array([[10**8, 10**8]])
    assert distances(far, -far).tolist() == [round(8**0.5 * 10**8 * PARTS)]
