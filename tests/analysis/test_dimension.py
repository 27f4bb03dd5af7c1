"""Box dimensions of curves whose dimensions are known, drawn by recursion."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import shapely
import shapely.affinity
from numpy.typing import NDArray

from batik_vector.analysis.dimension import box_dimension
from batik_vector.artwork import Geometries

Complexes = NDArray[np.complex128]
NOTHING: Geometries = np.empty(0, dtype=object)


def line(points: Complexes) -> Geometries:
    return np.array([shapely.linestrings(np.column_stack([points.real, points.imag]))], dtype=object)


def koch(steps: int) -> Complexes:
    points: Complexes = np.array([0, 1], np.complex128)
    for _ in range(steps):
        a, third = points[:-1], np.diff(points) / 3
        parts = [a, a + third, a + third * (1 + np.exp(1j * math.pi / 3)), a + 2 * third]
        points = np.append(np.column_stack(parts).ravel(), points[-1])
    return points


def sierpinski(steps: int) -> Geometries:
    corner: Complexes = np.zeros(1, np.complex128)
    size = 1.0
    for _ in range(steps):
        size /= 2
        corner = np.concatenate([corner, corner + size, corner + size * np.exp(1j * math.pi / 3)])
    triangles = corner[:, None] + np.array([0, size, size * np.exp(1j * math.pi / 3)])
    return np.asarray(shapely.polygons(np.stack([triangles.real, triangles.imag], axis=-1)), dtype=object)


def dragon(steps: int) -> Geometries:
    """Return the region of the dragon: a small square on each edge of the curve, on a grid of whole
    numbers."""
    points: Complexes = np.array([0, 2 ** (steps // 2) * 4], np.complex128)
    for _ in range(steps):
        a, step = points[:-1], np.diff(points)
        side = np.where(np.arange(len(a)) % 2, -1, 1)
        points = np.append(np.column_stack([a, a + step / 2 * (1 + 1j * side)]).ravel(), points[-1])
    a, step = points[:-1], np.diff(points)
    squares = np.column_stack([a, a + step / 2 * (1 + 1j), points[1:], a + step / 2 * (1 - 1j)])
    region: Any = shapely.union_all(shapely.polygons(np.stack([squares.real, squares.imag], axis=-1)))
    return np.array([shapely.Polygon(region.exterior)], dtype=object)


@pytest.mark.parametrize("steps", [6, 7])
@pytest.mark.parametrize("turn", [0.0, 0.3])
def test_the_koch_curve(steps: int, turn: float) -> None:
    found = box_dimension(NOTHING, line(koch(steps) * 100 * np.exp(1j * turn)))
    assert found is not None
    assert found.dimension == pytest.approx(math.log(4) / math.log(3), rel=0.02)
    assert found.smallest < found.largest / 30


def test_the_sierpinski_triangle() -> None:
    found = box_dimension(sierpinski(8), NOTHING)
    assert found is not None
    assert found.dimension == pytest.approx(math.log(3) / math.log(2), rel=0.02)


def test_the_dragons_boundary() -> None:
    found = box_dimension(dragon(12), NOTHING)
    assert found is not None
    # The root of an equation: https://mathworld.wolfram.com/DragonCurve.html
    assert found.dimension == pytest.approx(1.5236, rel=0.02)


def test_smooth_outlines_have_dimension_one_wherever_they_lie() -> None:
    circle = shapely.Point(0, 0).buffer(50, quad_segs=100)
    for moved in (circle, shapely.affinity.translate(circle, 1e4, -3e3)):
        found = box_dimension(np.array([moved], dtype=object), NOTHING)
        assert found is not None
        assert found.dimension == pytest.approx(1, abs=0.01)
        assert found.residual < 0.02


def test_a_straight_line_along_the_grid() -> None:
    found = box_dimension(NOTHING, np.array([shapely.LineString([(0, 0), (64, 0)])], dtype=object))
    assert found is not None
    assert found.dimension == pytest.approx(1, abs=0.02)


def test_nothing_has_no_dimension() -> None:
    assert box_dimension(NOTHING, NOTHING) is None
