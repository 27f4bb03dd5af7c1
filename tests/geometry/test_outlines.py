"""Marks as arrays: what shapely holds, point by point."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import shapely

from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import MM, Outlines, of_polygons, of_polylines, to_polygons, to_polylines

COMB = shapely.Polygon(
    [(0, 0), (9, 0), (9, 9), (0, 9)], [[(1, 1), (1, 2), (2, 2)], [(3, 3), (3, 4), (4, 4), (4, 3)]]
)
SHAPES: list[list[Any]] = [
    [shapely.box(0, 0, 1, 2)],
    [COMB],
    [shapely.box(0, 0, 1, 2), COMB, shapely.box(-7, -3, 1, 2), COMB, COMB],
    [COMB, shapely.Polygon(), shapely.box(0, 0, 1, 2)],
]


@pytest.mark.parametrize("shapes", SHAPES, ids=len)
def test_polygons_come_ring_by_ring(shapes: list[Any]) -> None:
    found = of_polygons(np.array(shapes, object), MM)
    rings = [ring for shape in shapes for ring in ([shape.exterior, *shape.interiors] if shape else [])]
    assert np.diff(found.marks).tolist() == [len(shape.interiors) + 1 if shape else 0 for shape in shapes]
    parts = np.split(found.points / 1000, found.rings[1:-1])
    assert [part.tolist() for part in parts] == [np.array(ring.coords)[:-1].tolist() for ring in rings]
    assert found.closed.all()
    assert len(found.closed) == len(rings)
    kept = [shape for shape in shapes if shape]
    if len(kept) == len(shapes):
        assert (to_polygons(of_polygons(np.array(shapes, object))) == np.array(shapes, object)).all()


def test_polylines_come_whole() -> None:
    shapes = np.array(
        [shapely.LineString(points) for points in ([(0, 0), (1, 0)], [(0, 0), (1, 0), (1, 1), (0, 0)])],
        object,
    )
    found = of_polylines(shapes, MM)
    assert (found.closed.tolist(), found.rings.tolist(), found.marks.tolist()) == (
        [False, True],
        [0, 2, 5],
        [0, 1, 2],
    )
    assert (to_polylines(of_polylines(shapes)) == shapes).all()


@pytest.mark.parametrize("read", [of_polygons, of_polylines])
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_no_place_is_refused(read: Callable[[Any, float], Outlines], bad: float) -> None:
    sound = shapely.box(0, 0, 1, 1) if read is of_polygons else shapely.LineString([(0, 0), (1, 1)])
    spoilt = shapely.transform(sound, lambda xy: np.where(xy == [9, 1], bad, xy))
    with pytest.raises(GeometryError, match="not finite"):
        read(np.array([sound, spoilt], object), MM)


@pytest.mark.parametrize("where", [1e16, -1e16, 1e300])
def test_what_is_too_far_stays_far(where: float) -> None:
    shape = shapely.LineString([(0, 0), (where, 0)])
    far = int(of_polylines(np.array([shape], object), MM).points[1, 0])
    assert abs(far) > 10**15
    assert far * where > 0


def test_moving_and_flipping() -> None:
    found = of_polylines(np.array([shapely.LineString([(0, 0), (1, 2)])], object), MM)
    assert found.moved() is found
    assert found.moved(5, -7).points.tolist() == [[5, -7], [1005, 1993]]
    assert found.flipped(100, 5).points.tolist() == [[5, 100], [1005, -1900]]
