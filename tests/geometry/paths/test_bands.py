"""Bands: as broad as asked everywhere, round or pointed at their ends; curls as long as asked."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.geometry.paths.bands import band, curl
from batik_vector.geometry.paths.sampling import sampled


def ring(centre: np.ndarray, half: np.ndarray) -> shapely.Polygon:
    return shapely.Polygon(sampled(band(centre, half), 1e-4).parts()[0])


def test_a_band_has_the_body_of_a_round_pen_of_its_breadth() -> None:
    centre = curl(1.0, 120.0)
    drawn = ring(centre, np.full(len(centre), 0.04))
    pen = shapely.LineString(curl(1.0, 120.0, 2.0, 200)).buffer(0.04)
    assert drawn.is_valid
    assert shapely.symmetric_difference(drawn, pen).area < 0.02 * pen.area


@pytest.mark.parametrize("first", [0.0, 0.05])
@pytest.mark.parametrize("last", [0.0, 0.02])
def test_ends_are_points_where_there_is_no_breadth_and_round_else(first: float, last: float) -> None:
    centre = np.column_stack([np.linspace(0, 1, 7), np.zeros(7)])
    drawn = ring(centre, np.linspace(first, last, 7) + [0, *[0.03] * 5, 0])
    assert drawn.is_valid
    left, _, right, _ = drawn.bounds
    assert left == pytest.approx(-first, abs=2e-3)
    assert right == pytest.approx(1 + last, abs=2e-3)


@pytest.mark.parametrize(("turn", "power"), [(90.0, 1.0), (-360.0, 2.0), (400.0, 3.0)])
def test_a_curl_is_as_long_as_asked_and_ends_in_the_direction_asked(turn: float, power: float) -> None:
    line = curl(2.0, turn, power, 400)
    step = np.diff(line, axis=0)
    assert np.hypot(*step.T).sum() == pytest.approx(2.0, rel=1e-4)
    last = np.degrees(np.arctan2(step[-1, 1], step[-1, 0]))
    assert (last - turn + 180) % 360 - 180 == pytest.approx(0, abs=abs(turn) * power / 400)
