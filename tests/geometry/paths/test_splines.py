"""Curves through points: they run through them, bend without a step, and turn sharply where told."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.errors import GeometryError
from batik_vector.geometry.paths.outline import CURVE, Outline
from batik_vector.geometry.paths.splines import through

points = st.lists(st.tuples(st.integers(-40, 40), st.integers(-40, 40)), min_size=4, max_size=9, unique=True)


def cubics(outline: Outline) -> np.ndarray:
    end = np.flatnonzero(outline.kinds == CURVE)
    return np.asarray(outline.points[end[:, None] + np.array([-3, -2, -1, 0])])


def bends(control: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Signed curvature where cubics begin and where they end."""

    def curvature(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
        first, second = 3 * (b - a), 6 * (a - 2 * b + c)
        cross = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
        return np.asarray(cross / np.hypot(*first.T) ** 3)

    a, b, c, d = np.moveaxis(control, 1, 0)
    return curvature(a, b, c), -curvature(d, c, b)


@settings(derandomize=True, max_examples=60, deadline=None)
@given(points, st.booleans())
def test_a_smooth_curve_runs_through_its_points_and_bends_without_a_step(
    given_points: list[tuple[int, int]], closed: bool
) -> None:
    places = np.array(given_points, float)
    control = cubics(through(places, True, closed))
    assert len(control) == len(places) - (not closed)
    assert np.array_equal(control[:, 0], places[: len(control)])
    assert np.array_equal(control[:-1, 3], control[1:, 0])
    begin, end = bends(control)
    arriving, leaving = (control[:, 3] - control[:, 2]), (control[:, 1] - control[:, 0])
    if closed:
        leaving, begin = np.roll(leaving, -1, axis=0), np.roll(begin, -1)
    else:
        arriving, leaving, begin, end = arriving[:-1], leaving[1:], begin[1:], end[:-1]
    going = np.minimum(np.hypot(*arriving.T), np.hypot(*leaving.T)) > 1e-3
    cross = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
    assert np.abs(cross[going]).max(initial=0) < 1e-8
    assert end[going] == pytest.approx(begin[going], rel=1e-6, abs=1e-6)


@pytest.mark.parametrize(("count", "off"), [(3, 0.13), (4, 0.03), (8, 2e-3), (16, 1e-4)])
def test_a_circle_through_few_points_is_round(count: int, off: float) -> None:
    angle = np.arange(count) * 2 * math.pi / count
    outline = through(np.column_stack([np.cos(angle), np.sin(angle)]), True, True)
    assert np.abs(np.hypot(*outline.at(np.linspace(0, 1, 999)).T) - 1).max() < off


def test_three_points_make_a_parabola() -> None:
    x, y = through([(0, 0), (1, 1), (2, 0)], True, False).at(np.linspace(0, 1, 99)).T
    assert y == pytest.approx(x * (2 - x))


def test_corners_part_a_smooth_curve_into_curves_of_their_own() -> None:
    leaf = [(0, 0), (1, 0.5), (2, 0.4), (4, 0), (2, -0.4), (1, -0.5)]
    control = cubics(through(leaf, True, True, [0, 3]))
    upper = cubics(through(leaf[:4], True, False))
    assert control[:3] == pytest.approx(upper)
    turned = cubics(through(leaf[2:] + leaf[:2], True, True, [4, 1]))
    assert sorted(turned.reshape(-1, 8).tolist()) == sorted(control.reshape(-1, 8).tolist())


def test_between_two_corners_that_are_neighbours_the_line_is_straight() -> None:
    outline = through([(0, 0), (4, 0), (4, 4), (2, 5), (0, 4)], True, True, [0, 1, 2, 4])
    assert len(cubics(outline)) == 2
    assert outline.at(np.array([0.1]))[0, 1] == 0


def test_points_that_repeat_the_one_before_count_once() -> None:
    plain = [(0, 0), (3, 1), (4, 4), (1, 3)]
    doubled = [(0, 0), (0, 0), (3, 1), (4, 4), (4, 4), (4, 4), (1, 3), (0, 0)]
    for smooth in (False, True):
        assert through(plain, smooth, True) == through(doubled, smooth, True)
    assert through(plain, True, True, [2]) == through(doubled, True, True, [4])


REFUSED: dict[str, tuple[Any, str]] = {
    "one": ([(1, 2)], "points = a list of 1, of which 1 differ .* expected at least 3 for a closed curve"),
    "the same twice": ([(1, 2), (1, 2), (1, 2)], "a list of 3, of which 1 differ"),
    "there and back": ([(0, 0), (1, 1), (0, 0)], "of which 2 differ"),
    "none": ([], "a list of 0, of which 0"),
    "no number": ([(0, 0), (1, math.nan), (2, 0)], r"points = \(1, nan\) in place 1, expected finite"),
    "infinity": (np.array([[0, 0], [1, 1], [math.inf, 2]]), r"points = \(inf, 2\) in place 2"),
    "numbers": ([1, 2, 3], r"an array of shape \(3,\), expected pairs"),
    "triples": ([(1, 2, 3)] * 3, r"an array of shape \(3, 3\), expected pairs"),
    "words": ("abc", 'points = "abc", expected a list of pairs of numbers'),
}


@pytest.mark.parametrize(("wrong", "words"), REFUSED.values(), ids=REFUSED)
def test_what_makes_no_curve_is_refused(wrong: Any, words: str) -> None:
    with pytest.raises(GeometryError, match=words):
        through(wrong, True, True)


@pytest.mark.parametrize("corner", [3, -4])
def test_a_corner_is_one_of_the_points(corner: int) -> None:
    with pytest.raises(GeometryError, match=rf"corners = {corner} in place 1, expected 0 to 2"):
        through([(0, 0), (1, 0), (1, 1)], True, True, [0, corner])
