"""Close boxes, beside each box held against each."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.audit import close_boxes
from batik_vector.audit.close_boxes import close_pairs

WHOLE = st.integers(-60, 60)
SIZES = st.one_of(st.integers(0, 9), st.integers(0, 120))


@settings(max_examples=150, deadline=None, derandomize=True)
@given(st.lists(st.tuples(WHOLE, WHOLE, SIZES, SIZES), max_size=40), st.integers(1, 12))
def test_all_close_pairs_are_found_once(boxes: list[tuple[int, int, int, int]], reach: int) -> None:
    box = np.array([[x, y, x + w, y + h] for x, y, w, h in boxes], float).reshape(-1, 4)
    found = list(zip(*(each.tolist() for each in close_pairs(box, float(reach))), strict=True))
    true = {
        (p, q)
        for p in range(len(box))
        for q in range(p + 1, len(box))
        if (np.maximum(box[p, :2], box[q, :2]) - np.minimum(box[p, 2:], box[q, 2:]) <= reach).all()
    }
    assert len(found) == len(set(found))
    assert set(found) == true


def test_many_boxes_are_compared_in_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    low = np.random.default_rng(5).uniform(0, 50, (300, 2))
    box = np.hstack([low, low + 3])
    whole = sorted(zip(*(each.tolist() for each in close_pairs(box, 2.0)), strict=True))
    monkeypatch.setattr(close_boxes, "MOST_PAIRS", 50)
    assert sorted(zip(*(each.tolist() for each in close_pairs(box, 2.0)), strict=True)) == whole
