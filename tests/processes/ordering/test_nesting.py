from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.processes.ordering import nesting
from batik_vector.processes.ordering.nesting import inside_first, parents
from tests.processes.strokes import box, line, strokes
from tests.thorough import examples, long


def test_each_lies_in_the_smallest_that_holds_it() -> None:
    found = parents(
        strokes(
            box(0, 0, 100),
            box(-20, 0, 40),
            box(-20, 0, 20),
            box(25, 25, 20),
            line((-21, 0), (-19, 0)),
            line((200, 0), (210, 0)),
            line((20, 20), (30, 25)),
        )
    )
    assert found.tolist() == [-1, 0, 1, 0, 2, -1, 3]


def test_bounds_alone_do_not_hold() -> None:
    hook = (True, [(0, 0), (100, 0), (100, 10), (10, 10), (10, 100), (0, 100)])
    assert parents(strokes(hook, box(60, 60, 10), box(5, 5, 4))).tolist() == [-1, -1, 0]


def test_one_that_touches_from_the_inside_lies_inside() -> None:
    wedge = (True, [(0, 50), (20, 40), (20, 60)])
    assert parents(strokes((True, [(0, 0), (100, 0), (100, 100), (0, 100)]), wedge)).tolist() == [-1, 0]


def test_what_lies_in_two_that_cross_comes_before_both() -> None:
    assert parents(strokes(box(0, 0, 10), box(0, 0, 10), box(0, 0, 4))).tolist() == [1, -1, 0]
    crossing = parents(strokes(box(0, 0, 12), box(3, 0, 10), box(0, 30, 4), box(2, 0, 4), box(-6, 0, 40)))
    assert crossing.tolist() == [4, 0, -1, 1, -1]


def test_many_are_asked_part_by_part(monkeypatch: pytest.MonkeyPatch) -> None:
    many = strokes(*(box(0, 0, 2 * size) for size in range(150, 0, -1)))
    monkeypatch.setattr(nesting, "PAIRS", 1)
    assert parents(many).tolist() == list(range(-1, 149))
    monkeypatch.setattr(nesting, "MOST", 1000)
    assert parents(many).tolist() == list(range(-1, 149))


@long
@settings(max_examples=examples(60, 1200))
@given(st.lists(st.integers(0, 10**6), min_size=1, max_size=40))
def test_what_lies_inside_comes_first_and_its_order_is_kept(draws: list[int]) -> None:
    # Stroke k lies in one of those before it, or in none.
    parent = np.array([draw % (k + 1) - 1 for k, draw in enumerate(draws)], np.intp)
    wanted = np.random.default_rng(draws[0]).permutation(len(parent))
    found = inside_first(wanted, parent).tolist()
    assert sorted(found) == list(range(len(parent)))
    place = np.argsort(found)
    inner = np.flatnonzero(parent >= 0)
    assert (place[inner] < place[parent[inner]]).all()
    for held in range(-1, len(parent)):
        siblings = [k for k in wanted.tolist() if parent[k] == held]
        assert sorted(siblings, key=lambda k: place[k]) == siblings
    # What lies inside comes right before it: nothing else between.
    size = np.ones(len(parent), int)
    for k in range(len(parent) - 1, -1, -1):
        if parent[k] >= 0:
            size[parent[k]] += size[k]
    for k in range(len(parent)):
        block = set(found[place[k] - size[k] + 1 : place[k] + 1])
        assert all(each == k or parent[each] in block for each in block)
