"""What comes near, and what holds what: as shapely tells it pair by pair, of small shapes and large."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.geometry.nearness import MANY, boxes, held, nearer, on_lines, pairs_within
from batik_vector.geometry.sampling import Geometries, Points


def stars(seed: int, count: int, vertices: int) -> Geometries:
    """Return wavy shapes at random places, which often overlap."""
    rng = np.random.default_rng(seed)
    turn = np.linspace(0, 2 * np.pi, vertices, endpoint=False)
    middles, reach = rng.random((count, 2)) * 40, 2 + 2 * rng.random(count)
    waves = reach[:, None] * (1 + 0.3 * np.cos(5 * turn))
    rings = np.stack([waves * np.cos(turn), waves * np.sin(turn)], axis=-1) + middles[:, None]
    return np.asarray(shapely.polygons(rings), dtype=object)


def of_points(points: Points) -> Geometries:
    return np.asarray(shapely.points(points), dtype=object)


@pytest.mark.parametrize("vertices", [MANY // 4, 4 * MANY])
@pytest.mark.parametrize("distance", [0.0, 0.5, 3.0])
def test_pairs_that_come_nearer_are_those_that_are_measured_so(vertices: int, distance: float) -> None:
    a, b = stars(1, 300, vertices), stars(2, 300, vertices)
    gap = shapely.distance(stars(1, 300, vertices), b)
    expected = (gap < distance) | (gap <= 0)
    assert 0 < expected.sum() < len(a)
    assert (nearer(a, b, distance) == expected).all()
    assert (nearer(a, b, np.full(len(a), distance)) == expected).all()


@pytest.mark.parametrize("vertices", [8, 2 * MANY])
def test_what_is_exactly_as_far_as_asked_is_not_nearer(vertices: int) -> None:
    side = np.linspace(0, 1, vertices // 2)
    ring = np.column_stack([np.r_[0 * side, 1 + 0 * side], np.r_[side, side[::-1]]])
    left, right = (np.array([shapely.Polygon(ring + [x, 0])], dtype=object) for x in (0, 3))
    pair = left, right
    assert not nearer(*pair, 2.0)[0]
    assert nearer(*pair, np.nextafter(2.0, 3.0))[0]
    assert pairs_within(pair[0], pair[1], 2.0)[0].tolist() == [0]


def test_pairs_within_reach_are_those_that_all_with_all_would_show() -> None:
    small, large = stars(3, 80, 12), stars(4, 6, 500)
    one, other = pairs_within(small, large, 1.5)
    found = np.zeros((80, 6), bool)
    found[one, other] = True
    gap = shapely.distance(small[:, None], stars(4, 6, 500)[None, :])
    assert (found == (gap <= 1.5)).all()
    assert found.any()
    assert not found.all()


def test_points_are_held_by_what_they_lie_within_and_not_by_what_they_lie_on() -> None:
    areas: Geometries = np.array([*stars(5, 20, 200), shapely.box(100, 0, 101, 1)], dtype=object)
    points = np.vstack([np.random.default_rng(6).random((500, 2)) * 40, [[100.5, 0.5], [100, 0.5]]])
    one, other = held(points, areas)
    found = np.zeros((len(points), len(areas)), bool)
    found[one, other] = True
    assert (found == shapely.within(of_points(points)[:, None], areas[None, :])).all()
    assert found[500, 20]
    assert not found[501].any()


def test_points_on_lines_are_those_within_reach_of_any() -> None:
    lines = np.asarray(shapely.boundary(stars(7, 10, 300)), dtype=object)
    points = np.random.default_rng(8).random((400, 2)) * 40
    gap = shapely.distance(of_points(points)[:, None], lines[None, :]).min(axis=1)
    found = on_lines(points, lines, 0.8)
    assert (found == (gap <= 0.8)).all()
    assert found.any()
    assert not found.all()


def test_boxes_reach_out_on_all_sides() -> None:
    assert shapely.bounds(boxes(of_points(np.array([[1.0, 2.0]])), 0.5)).tolist() == [[0.5, 1.5, 1.5, 2.5]]
