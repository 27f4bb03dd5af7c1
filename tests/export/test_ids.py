"""Ids given out in bulk are those given out one by one."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from batik_vector.export.ids import Ids

names = st.sampled_from(
    ["petal", "petal1", "petal 1", "petal.11", "Petal", "core", "", "1", "11", "九", "a.b", "aB"]
)


def in_bulk(ids: Ids, asked: list[str]) -> list[str]:
    stems, which, numbers = ids.many(asked, "mark")
    return [f"{stems[code]}{number}" for code, number in zip(which, numbers, strict=True)]


@given(st.lists(names, max_size=3), st.lists(st.lists(names, min_size=1, max_size=30), max_size=4))
def test_many_are_the_next_one_by_one(singles: list[str], parts: list[list[str]]) -> None:
    bulk, single = Ids(), Ids()
    given_out = [ids.one(name, "ink") for ids in (bulk, single) for name in singles]
    assert given_out[: len(singles)] == given_out[len(singles) :]
    for part in parts:
        expected = [single.next(name, "mark") for name in part]
        assert in_bulk(bulk, part) == expected
        given_out += expected
    assert len(set(given_out)) == len(given_out) - len(singles)
    assert bulk.one("petal", "ink") == single.one("petal", "ink")
