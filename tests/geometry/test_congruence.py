from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from batik_vector.geometry.congruence import alike

rows = st.lists(
    st.lists(st.tuples(st.integers(-2, 2), st.integers(0, 1)), min_size=1, max_size=3), max_size=20
)


@given(rows)
def test_runs_are_alike_when_they_are_equal(given_runs: list[list[tuple[int, int]]]) -> None:
    flat = np.array([row for run in given_runs for row in run], np.int64).reshape(-1, 2)
    offsets = np.concatenate([[0], np.cumsum([len(run) for run in given_runs])]).astype(np.int64)
    heads, number = alike(flat, offsets)
    first = [given_runs.index(run) for run in given_runs]
    assert heads.tolist() == sorted(set(first))
    assert heads[number].tolist() == first


def test_fingerprints_that_agree_by_chance_do_not_make_rows_equal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("batik_vector.geometry.congruence._fingerprints", lambda rows, _: np.zeros(len(rows)))
    heads, number = alike(np.array([[1, 2], [3, 4], [1, 2]]))
    assert heads[number].tolist() == [0, 1, 0]
