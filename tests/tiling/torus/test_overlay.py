"""Overlays on the grid: what is united step by step is what is united at once, and too much is refused."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from batik_vector.errors import TooLargeError
from batik_vector.geometry import work
from batik_vector.tiling.torus import overlay


def boxes(seed: int, count: int) -> NDArray[np.object_]:
    low = np.random.default_rng(seed).integers(0, 1000, (count, 2))
    size = np.random.default_rng(seed + 1).integers(1, 200, (count, 2))
    return np.asarray(shapely.box(*low.T, *(low + size).T), dtype=object)


def discs(seed: int, count: int) -> NDArray[np.object_]:
    centres = np.random.default_rng(seed).integers(0, 5000, (count, 2)).astype(float)
    return np.asarray(shapely.buffer(shapely.points(centres), 400), dtype=object)


@settings(max_examples=10, deadline=None)
@given(seed=st.integers(0, 1000), count=st.integers(1, 40))
def test_united_step_by_step_is_united_at_once(seed: int, count: int) -> None:
    at_once = overlay.united([boxes(seed, count), boxes(seed + 5, 3)])
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(overlay, "STEPWISE", 0)
        patch.setattr(work, "BATCH", 30)
        in_steps = overlay.united([boxes(seed, count), boxes(seed + 5, 3)])
    assert shapely.equals(at_once, in_steps).all()


def test_steps_are_refused_once_their_crossings_come_to_too_much(monkeypatch: pytest.MonkeyPatch) -> None:
    shapes = discs(1, 60)
    monkeypatch.setattr(overlay, "STEPWISE", 0)
    overlay.united([shapes])
    # Each goes through more than one step.
    monkeypatch.setattr(work, "LIMIT", 1.5 * shapely.get_num_coordinates(shapes).sum())
    with pytest.raises(TooLargeError), work.account():
        overlay.united([shapes])


def test_marks_are_cut_each_by_its_own_in_any_batches(monkeypatch: pytest.MonkeyPatch) -> None:
    marks, away = boxes(1, 30), boxes(7, 30)
    whole = overlay.less(marks, away)
    monkeypatch.setattr(overlay, "MUCH", 25)
    assert shapely.equals_exact(whole, overlay.less(marks, away)).all()
    assert shapely.area(whole) == pytest.approx(
        shapely.area(marks) - shapely.area(shapely.intersection(marks, away))
    )


def test_what_is_mended_or_cut_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(work, "LIMIT", 100.0)
    bow = np.array([shapely.Polygon([(0, 0), (9, 9), (9, 0), (0, 9)])] * 30, dtype=object)
    with pytest.raises(TooLargeError), work.account():
        overlay.mended(bow)
    with pytest.raises(TooLargeError), work.account():
        overlay.less(boxes(1, 30), boxes(2, 30))
