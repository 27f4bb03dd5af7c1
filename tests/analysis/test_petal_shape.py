"""Shapes of petals: straight, curved or wavy, whatever their breadth."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.analysis.petal_shape import PetalShape, petal_shape
from batik_vector.geometry.curves import CURVES
from batik_vector.geometry.curves.superellipse import Superellipse
from tests.analysis.flowers import FRILL

CENTRE = np.zeros(2)


def ellipse(breadth: float) -> shapely.Polygon:
    t = np.linspace(0, 2 * np.pi, 90, endpoint=False)
    return shapely.Polygon(np.column_stack([60 + 40 * np.cos(t), breadth / 2 * np.sin(t)]))


@pytest.mark.parametrize("breadth", [4, 20, 60])
def test_ellipses_are_curved_and_rhombi_are_rhombi(breadth: float) -> None:
    assert petal_shape(ellipse(breadth), CENTRE) == PetalShape.CURVED
    rhombus = shapely.Polygon([(20, 0), (65, breadth / 2), (100, 0), (65, -breadth / 2)])
    assert petal_shape(rhombus, CENTRE) == PetalShape.RHOMBUS
    kept = rhombus.intersection(shapely.box(30, -99, 200, 99))
    assert petal_shape(kept, CENTRE) == PetalShape.RHOMBUS


def test_the_papers_leaf_and_petal_are_curved() -> None:
    t = np.linspace(0, 1, 900, endpoint=False)
    leaf = Superellipse(a=0.2, b=10, length=40, width=12).at(t) + (40, 0)
    petal = CURVES["petal"](n=2, length=80).at(t)  # type: ignore[call-arg]
    for points in (leaf, petal):
        assert petal_shape(shapely.Polygon(points), CENTRE) == PetalShape.CURVED


def test_a_heart_is_curved_and_a_frill_wavy() -> None:
    heart = shapely.union_all(
        [shapely.Point(80, side * 9).buffer(11) for side in (-1, 1)]
        + [shapely.Polygon([(20, 0), (78, 19.9), (78, -19.9)])]
    )
    assert petal_shape(heart, CENTRE) == PetalShape.CURVED
    assert petal_shape(shapely.Polygon(FRILL), CENTRE) == PetalShape.WAVY
