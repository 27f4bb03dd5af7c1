from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.geometry.outlines import Index, Steps
from batik_vector.processes.ordering.chaining import chained
from batik_vector.processes.ordering.distances import distances
from batik_vector.processes.ordering.improving import improved
from batik_vector.processes.ordering.sites import Sites
from tests.processes.strokes import random_lines, valid
from tests.thorough import examples, long

PLACE = st.tuples(st.integers(0, 400), st.integers(0, 400))


NEAR = 7


def first_and_better(ends: Steps, group: Index) -> tuple[Index, Index]:
    sites = Sites.of(ends, group)
    pairs = sites.near(NEAR)
    first = chained(sites, pairs)
    return first, improved(first, sites, pairs)


def way(order: Index, ends: Steps, group: Index) -> int:
    """The ways between the strokes of each group."""
    out, into = order[1:-1:2], order[2::2]
    return int(distances(ends[out], ends[into])[group[out >> 1] == group[into >> 1]].sum())


@long
@settings(max_examples=examples(80, 1600))
@given(st.lists(st.tuples(PLACE, PLACE, st.booleans(), st.integers(0, 3)), min_size=1, max_size=40))
def test_each_stroke_is_passed_once_among_its_group_and_no_change_lengthens_the_way(
    rows: list[tuple[tuple[int, int], tuple[int, int], bool, int]],
) -> None:
    ends = np.array([place for a, b, closed, _ in rows for place in (a, a if closed else b)], np.int64)
    group = np.array([row[3] for row in rows], np.intp)
    first, better = first_and_better(ends, group)
    for order in (first, better):
        assert valid(order, len(rows))
        assert (np.diff(group[order >> 1]) >= 0).all()
    assert way(better, ends, group) <= way(first, ends, group)


@pytest.mark.parametrize("seed", range(4))
def test_of_few_strokes_the_way_is_all_but_the_shortest(seed: int) -> None:
    ends = random_lines(5, seed).points
    group = np.zeros(5, np.intp)
    shortest = min(
        way(
            np.array(
                [
                    end
                    for k, back in zip(order, turned, strict=True)
                    for end in (2 * k + back, 2 * k + 1 - back)
                ]
            ),
            ends,
            group,
        )
        for order in itertools.permutations(range(5))
        for turned in itertools.product((0, 1), repeat=5)
    )
    assert way(first_and_better(ends, group)[1], ends, group) <= 1.1 * shortest


def test_an_order_is_improved_however_bad_it_is() -> None:
    ends = random_lines(400, 1).points
    group = np.zeros(400, np.intp)
    given = np.arange(800)
    good = way(first_and_better(ends, group)[1], ends, group)
    sites = Sites.of(ends, group)
    found = improved(given, sites, sites.near(NEAR))
    assert valid(found, 400)
    assert way(given, ends, group) > 10 * good
    assert way(found, ends, group) < 1.25 * good


def test_strokes_on_one_place_are_all_passed() -> None:
    ends = np.zeros((200, 2), np.int64)
    for order in first_and_better(ends, np.zeros(100, np.intp)):
        assert valid(order, 100)
