"""Contours run where a field passes the level, close, and nest."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from batik_vector.geometry.generators.contours import rings, smooth
from batik_vector.geometry.paths.sampling import sampled

SLOW = [HealthCheck.too_slow]
"""Others may be at work on the machine."""

FIELDS = arrays(
    np.float64, st.tuples(st.integers(2, 8), st.integers(2, 8)), elements=st.floats(-1, 1, width=16)
)


def cone(size: int, x: float, y: float) -> np.ndarray:
    across, up = np.meshgrid(np.arange(size), np.arange(size))
    return np.asarray(-np.hypot(across - x, up - y))


def test_a_cones_contour_is_its_circle() -> None:
    points, offsets = rings(cone(60, 30.2, 29.7), -20.5)
    assert len(offsets) == 2
    away = np.hypot(points[:, 0] - 30.2, points[:, 1] - 29.7)
    assert np.abs(away - 20.5).max() < 0.01
    assert shapely.LinearRing(points).is_ccw


@settings(max_examples=80, deadline=None, derandomize=True, suppress_health_check=SLOW)
@given(FIELDS, st.floats(-0.9, 0.9))
def test_every_sample_is_on_its_side_of_the_rings(field: np.ndarray, level: float) -> None:
    points, offsets = rings(field, level)
    parts = [part for part in np.split(points, offsets[1:-1]) if len(part)]
    assert sum(map(len, parts)) == len(points)
    area: shapely.Geometry = shapely.Polygon()
    for part in parts:
        ring = shapely.make_valid(shapely.Polygon(np.vstack([part, part[:1]]))) if len(part) > 2 else area
        area = shapely.symmetric_difference(area, ring)
    rows, columns = np.indices(field.shape)
    spots = shapely.points(columns.ravel(), rows.ravel())
    away = shapely.distance(shapely.boundary(area), spots) > 1e-6 if len(parts) else np.ones(field.size, bool)
    # A sample on the level, or all but on it, is a ring of no extent, or none.
    away &= np.abs(field.ravel() - level) > 1e-9
    inside = shapely.contains(area, spots)
    assert (inside == (field > level).ravel())[away].all()


def test_what_reaches_the_edge_is_closed_along_it() -> None:
    points, offsets = rings(np.ones((4, 5)), 0.0)
    assert len(offsets) == 2
    assert shapely.Polygon(points).area == pytest.approx(12)
    drawn = smooth(points, offsets, np.ones(len(points), bool))
    (ring,) = sampled(drawn, 0.01).parts()
    assert shapely.Polygon(ring).area == pytest.approx(12)


def test_smooth_rings_keep_to_the_circle_they_sample() -> None:
    points, offsets = rings(cone(40, 19.6, 20.1), -15.2)
    drawn = smooth(points, offsets, np.zeros(len(points), bool))
    (ring,) = sampled(drawn, 1e-3).parts()
    assert np.abs(np.hypot(ring[:, 0] - 19.6, ring[:, 1] - 20.1) - 15.2).max() < 0.03
    step = np.diff(ring, axis=0)
    turn = np.abs(np.angle(np.exp(1j * np.diff(np.arctan2(step[:, 1], step[:, 0])))))
    assert turn.max() < 0.3
