"""Cubics kept inside a box: with as little change as will do."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.geometry.inside import Box, kept_inside
from batik_vector.geometry.outlines import Steps
from tests.thorough import examples, long

BOX: Box = (0, 0, 1000, 800)
places = st.tuples(st.integers(0, 1000), st.integers(0, 800))
handles = st.tuples(st.integers(-60, 1060), st.integers(-60, 860))


def drawn(cubic: Steps) -> np.ndarray:
    u = np.linspace(0, 1, 2001)[:, None]
    v = 1 - u
    p = cubic.astype(float)
    return np.asarray(v**3 * p[0] + 3 * v * v * u * p[1] + 3 * v * u * u * p[2] + u**3 * p[3])


def over(points: np.ndarray) -> float:
    return float(np.maximum(-points, points - [1000, 800]).max())


def kept(*points: tuple[int, int]) -> Steps:
    found: Steps = kept_inside(np.array([points], np.int64), BOX)[0]
    return found


@long
@settings(max_examples=examples(60, 3000), deadline=None, derandomize=True)
@given(places, handles, handles, places)
def test_no_curve_leaves_and_ends_stay(
    p0: tuple[int, int], p1: tuple[int, int], p2: tuple[int, int], p3: tuple[int, int]
) -> None:
    asked, found = np.array([p0, p1, p2, p3]), kept(p0, p1, p2, p3)
    assert (found[[0, 3]] == asked[[0, 3]]).all()
    assert over(drawn(found)) <= 1e-6
    touching = any(x in (0, 1000) or y in (0, 800) for x, y in (p0, p3))
    if touching:
        assert over(found) <= 0
    if over(drawn(asked)) <= 0 and not touching:
        assert np.array_equal(found, asked)


def test_a_hair_over_the_edge_moves_the_curve_by_a_hair() -> None:
    arch = np.array([(100, 700), (300, 840), (500, 840), (700, 700)])
    assert 0 < over(drawn(arch)) < 6
    found = kept_inside(arch[None], BOX)[0]
    assert np.abs(drawn(found) - drawn(arch)).max() < 8
    # A handle is shortened where that will do, so that its node stays smooth.
    long = kept((0, 500), (-3, 700), (90, 801), (100, 650))
    assert long.tolist() == [[0, 500], [0, 700], [90, 800], [100, 650]]


def test_what_ends_outside_is_left_alone() -> None:
    outside = np.array([[(-5, 0), (-50, 10), (-50, 20), (0, 30)]], np.int64)
    assert np.array_equal(kept_inside(outside, BOX), outside)
    assert kept_inside(outside[:0], BOX).shape == (0, 4, 2)
