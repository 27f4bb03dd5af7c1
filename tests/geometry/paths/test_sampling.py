"""Outlines as polylines: within the tolerance, corners to the bit, several subpaths as each alone."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.errors import TooLargeError
from batik_vector.geometry.paths import sampling
from batik_vector.geometry.paths.data import parse_path
from batik_vector.geometry.paths.outline import CURVE, LINE, Outline
from batik_vector.geometry.paths.sampling import Polylines, sampled

coordinates = st.integers(-80, 80).map(lambda n: n / 8)
commands = st.lists(
    st.tuples(st.sampled_from("LCQ"), st.lists(coordinates, min_size=6, max_size=6)), min_size=1, max_size=6
)
TAKES = {"L": 2, "C": 6, "Q": 4}


def data(path: list[tuple[str, list[float]]], end: str = "Z") -> str:
    return "M1 2" + "".join(letter + " ".join(map(str, v[: TAKES[letter]])) for letter, v in path) + end


def truth(outline: Outline) -> np.ndarray:
    """The outline, evaluated as it says itself and not as it is sampled."""
    shut = outline.shut()
    pieces = int(((shut.kinds == LINE) | (shut.kinds == CURVE)).sum())
    return shut.at(np.linspace(0, 1, 400 * pieces + 1))


@settings(derandomize=True, max_examples=60, deadline=None)
@given(commands, st.sampled_from("Z "), st.sampled_from([0.3, 0.02, 1e-3]))
def test_no_chord_stands_farther_off_than_the_tolerance(
    path: list[tuple[str, list[float]]], end: str, tolerance: float
) -> None:
    outline = parse_path(data(path, end))
    lines = sampled(outline, tolerance)
    points = truth(outline)
    if not lines.lines().any():
        assert not np.ptp(points, axis=0).any()
        return
    (strand,) = lines.parts()
    line = shapely.LineString(strand)
    assert shapely.distance(shapely.points(points), line).max() <= tolerance * (1 + 1e-6)
    # And back: the drawing's vertices lie on the curve.
    true = shapely.LineString(points)
    assert shapely.distance(shapely.points(strand), true).max() < 0.02
    ends = outline.points[(outline.kinds == LINE) & (np.roll(outline.kinds, 1) == LINE)]
    have = {tuple(point) for point in strand.tolist()}
    assert all(tuple(point) in have for point in ends.tolist()), "the corners of straight lines"


def test_a_circle_has_the_vertices_that_it_needs() -> None:
    circle = parse_path("M5 0A5 5 0 0 1 -5 0A5 5 0 0 1 5 0Z")
    for tolerance in (1e-1, 1e-2, 1e-3):
        (ring,) = sampled(circle, tolerance).parts()
        least = math.pi / math.acos(1 - tolerance / 5)
        assert len(ring) - 1 < 1.35 * least + 2
        assert np.hypot(*ring.T) == pytest.approx(np.full(len(ring), 5), abs=1e-6)


def parts_alone(text: str, tolerance: float) -> list[np.ndarray]:
    return [part for each in text.split("|") for part in sampled(parse_path(each), tolerance).parts()]


def test_several_subpaths_are_sampled_as_each_alone() -> None:
    text = "M0 0C4 0 4 4 0 4Z|M9 9L8 8L7 9|M1 1Q2 2 3 1T5 1Z|M20 20A3 2 30 1 1 22 21Z|M0 9L1 9L1 9L0 9Z"
    together = sampled(parse_path(text.replace("|", "")), 1e-2)
    assert together.closed.tolist() == [True, False, True, True, True]
    assert together.bounding().tolist() == [True, False, True, True, False]
    for part, alone in zip(together.parts(), parts_alone(text, 1e-2), strict=True):
        assert np.array_equal(part, alone)


def test_a_closed_subpath_ends_in_the_point_it_began_in() -> None:
    for text in ("M0 0L3 0L3 3Z", "M0 0L3 0L3 3L0 0Z", "M.1 .1l.1 .2l.1 .1l-.2 -.3z", "M0 0L3 0L3 3L1e-7 0Z"):
        (ring,) = sampled(parse_path(text), 1e-3).parts()
        assert np.array_equal(ring[0], ring[-1])
        assert len(ring) == 4


@pytest.mark.parametrize("tolerance", [0.5, 5.0, 500.0])
def test_a_round_dot_keeps_a_shape_however_coarse_the_tolerance(tolerance: float) -> None:
    (ring,) = sampled(parse_path("M1 0A1 1 0 0 1 -1 0A1 1 0 0 1 1 0Z"), tolerance).parts()
    assert shapely.Polygon(ring).area > 0.8 * math.pi


def test_points_alone_are_told_from_lines() -> None:
    lines = sampled(parse_path("M1 1ZM0 0L1 0L1 1ZM2 2L2 2"), 1e-3)
    assert lines.lines().tolist() == [False, True, False]
    assert lines.bounding().tolist() == [False, True, False]


def test_a_tolerance_that_varies_over_the_plane_is_kept_place_by_place() -> None:
    outline = parse_path("M0 0C0 40 100 40 100 0")
    fine = sampled(outline, lambda points: np.where(points[:, 0] < 50, 1e-3, 1.0)).parts()[0]
    left = fine[:, 0] < 50
    assert left.sum() > 5 * (~left).sum()
    line = shapely.LineString(fine)
    points = truth(outline)
    off = shapely.distance(shapely.points(points[points[:, 0] < 49]), line)
    assert off.max() <= 1e-3


def test_what_needs_too_many_vertices_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sampling, "MAX_POINTS", 1000)
    with pytest.raises(TooLargeError, match=r"its curves would need .* vertices at this tolerance"):
        sampled(parse_path("M0 0C0 400 100 400 100 0" * 9), 1e-6)


def test_no_polylines_are_no_parts() -> None:
    nothing = Polylines(np.empty((0, 2)), np.zeros(1, np.intp), np.empty(0, bool))
    assert nothing.parts() == []
