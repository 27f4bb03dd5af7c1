"""Waves and segments: open lines that go on where they end."""

from __future__ import annotations

import numpy as np
import pytest

from batik_vector.geometry.curves import Segment, Wave, trace


@pytest.mark.parametrize("waves", [1, 2, 3, 7, 49])
@pytest.mark.parametrize("phase", [0.0, 33.0, -90.0])
def test_a_wave_ends_as_high_as_it_began_to_the_bit(waves: int, phase: float) -> None:
    points = trace(Wave(waves, 0.3, phase), 1e-3).strands[0]
    assert points[0, 1] == points[-1, 1]
    assert points[0, 0] == 0.0
    assert points[-1, 0] == 1.0


def test_a_wave_goes_on_without_a_kink() -> None:
    step = 1e-6
    begin, end = (Wave(3, 0.3, 25.0).at(np.array(t)) for t in ([0, step], [1 - step, 1]))
    slopes = [np.diff(part[:, 1]) / np.diff(part[:, 0]) for part in (begin, end)]
    assert slopes[0] == pytest.approx(slopes[1], rel=1e-3)


def test_crests_are_as_many_and_as_high_as_asked() -> None:
    y = Wave(5, 0.25).at(np.linspace(0, 1, 100_001))[:, 1]
    assert y.max() == pytest.approx(0.25)
    assert y.min() == pytest.approx(-0.25)
    tops = (y[1:-1] > y[:-2]) & (y[1:-1] > y[2:])
    assert tops.sum() == 5


def test_lines_bound_no_region_and_are_as_long_as_asked() -> None:
    for curve in (Segment(2.5), Wave(length=2.5)):
        traced = trace(curve, 1e-3)
        assert traced.rings == []
        assert np.ptp(traced.strands[0][:, 0]) == 2.5


def test_a_straight_line_has_two_vertices() -> None:
    assert trace(Segment(), 1e-3).strands[0].tolist() == [[0, 0], [1, 0]]
