from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from batik_vector.errors import GeometryError
from batik_vector.geometry.maps import Affine
from batik_vector.geometry.maps.affine import unit_power, unit_turn
from tests.geometry.maps.images.measure import array_of
from tests.strategies import polygons

numbers = st.floats(-3, 3)
maps = st.builds(Affine, *[numbers] * 6)


@given(maps, maps, polygons())
def test_composition_applies_the_right_hand_map_first(
    outer: Affine, inner: Affine, shape: shapely.Polygon
) -> None:
    points = shapely.get_coordinates(shape)
    np.testing.assert_allclose((outer @ inner).at(points), outer.at(inner.at(points)), atol=1e-9)


@given(maps)
def test_an_inverse_undoes_its_map(affine: Affine) -> None:
    if abs(affine.determinant) < 1e-3:
        return
    points = np.array([[0.0, 0.0], [1.0, 2.0], [-3.0, 0.5]])
    np.testing.assert_allclose(affine.inverse().at(affine.at(points)), points, atol=1e-8)


@given(maps, st.floats(0, 360))
def test_stretch_is_the_largest_singular_value(affine: Affine, degrees: float) -> None:
    matrix = np.array([[affine.a, affine.b], [affine.c, affine.d]])
    assert affine.stretch == pytest.approx(np.linalg.norm(matrix, 2), abs=1e-12)
    assert (Affine.turn(degrees) @ Affine.scale(2.0) @ Affine.mirror(degrees)).is_similarity()


@given(polygons(), st.floats(-360, 360))
def test_a_mirror_keeps_outer_rings_anticlockwise(shape: shapely.Polygon, degrees: float) -> None:
    image = Affine.mirror(degrees).apply(array_of(shapely.orient_polygons(shape)))[0]
    assert image.exterior.is_ccw
    assert image.area == pytest.approx(shape.area)


@pytest.mark.parametrize("quarters", range(-5, 6))
def test_quarter_turns_are_exact(quarters: int) -> None:
    exact = [1, 1j, -1, -1j][quarters % 4]
    assert unit_turn(90.0 * quarters) == exact
    assert unit_power(quarters, 4) == exact
    assert abs(unit_turn(45.0 + 90 * quarters).real) == abs(unit_turn(45.0 + 90 * quarters).imag)


@given(st.integers(-100, 100), st.integers(1, 64))
def test_roots_of_unity(k: int, n: int) -> None:
    assert unit_power(k, n) == pytest.approx(np.exp(2j * np.pi * (k % n) / n), abs=1e-14)
    assert unit_turn(360.0 * k / n) == pytest.approx(np.exp(2j * np.pi * k / n), abs=1e-12)


def test_maps_that_flatten_are_refused() -> None:
    flat = Affine(1, 1, 1, 1)
    with pytest.raises(GeometryError, match="flattens"):
        flat.inverse()
    with pytest.raises(GeometryError, match="flattens"):
        flat.apply(array_of(shapely.box(0, 0, 1, 1)))
    with pytest.raises(GeometryError, match="scale of 0"):
        Affine.scale(0.0)
    with pytest.raises(GeometryError, match="finite"):
        Affine(float("nan"))
