"""Regions: what collapses on the way is nothing, and never an error."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.geometry.regions import FillRule, settle, without_repeats

SQUARE = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0), (0.0, 0.0)]
POINT = [(1.0, 1.0)] * 4


def test_a_ring_in_one_point_is_nothing() -> None:
    marks = np.array(
        [
            shapely.Polygon(SQUARE, [POINT, [(2, 2), (4, 2), (4, 2), (2, 4)]]),
            shapely.Polygon(POINT),
            shapely.MultiPolygon([shapely.Polygon(POINT), shapely.Polygon(SQUARE)]),
            shapely.LineString([(0, 0), (0, 0), (5, 0)]),
        ],
        dtype=object,
    )
    square, point, several, line = without_repeats(marks)
    assert [len(ring.coords) for ring in square.interiors] == [4]
    assert square.area == 79
    assert point.is_empty
    assert [part.area for part in several.geoms] == [81]
    assert list(line.coords) == [(0, 0), (5, 0)]


def test_nothing_has_no_repeats() -> None:
    assert len(without_repeats(np.empty(0, dtype=object))) == 0


@pytest.mark.parametrize("rule", list(FillRule))
@pytest.mark.parametrize("size", [1.0, 1e3, 1e6])
def test_a_ring_that_all_but_comes_back_encloses_what_it_would(rule: FillRule, size: float) -> None:
    back = np.nextafter(17.5, 18) * size
    ring = np.array([[17.5, 37.8], [20.1, 28.2], [14.9, 28.2], [17.5, 37.8], [17.5, 37.8]]) * size
    ring[3, 0] = back
    found = settle([ring], rule)
    assert shapely.area(found).sum() == pytest.approx(5.2 * 9.6 / 2 * size**2, rel=1e-9)


def test_a_curve_there_and_back_by_a_straight_line_may_enclose_next_to_nothing() -> None:
    """Rounding leaves faces thinner than a float's last bit, which overlap."""
    ring = [
        [0.06997829030274684, 1.983193125015159],
        [0.08869144713447649, 1.978721508918875],
        [0.14483091762966546, 1.965306660630021],
        [0.2383967017883137, 1.9429485801485986],
        [0.06997829030274685, 1.983193125015159],
        [0.06997829030274684, 1.983193125015159],
    ]
    found = settle([np.array(ring)], FillRule.EVENODD)
    assert shapely.area(found).sum() == pytest.approx(0.0, abs=1e-12)
