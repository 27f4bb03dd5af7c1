"""Arcs keep to what they stand for: in vertices, between them, and at their ends."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from batik_vector.errors import GeometryError
from batik_vector.geometry.arc_fitting import LEAST_EDGES, PARTS, Arcs, fit_arcs
from batik_vector.geometry.outlines import Offsets, Steps

Lines = list[Steps]


def circle(radius: float, edges: int, x: float = 0, y: float = 0) -> Steps:
    """A ring in steps, its first point repeated."""
    turn = np.linspace(0, 2 * np.pi, edges + 1)
    ring = np.rint(np.c_[x + radius * np.cos(turn), y + radius * np.sin(turn)]).astype(np.int64)
    ring[-1] = ring[0]
    return np.asarray(ring)


def together(lines: Lines) -> tuple[Steps, Offsets]:
    return np.concatenate(lines), np.concatenate([[0], np.cumsum([len(line) for line in lines])])


def fitted(lines: Lines, tolerance: float, sampling: float) -> Arcs:
    return fit_arcs(*together(lines), tolerance, sampling)


def check_arcs(lines: Lines, tolerance: float, sampling: float) -> Arcs:
    """Hold the arcs of some polylines to all that is promised of them, by other means than theirs."""
    points, rings = together(lines)
    found = fit_arcs(points, rings, tolerance, sampling)
    assert {*rings[:-1], *(rings[1:] - 1)} <= {*found.nodes}
    assert (np.diff(found.nodes) > 0).all()
    for at in range(1, len(found.nodes)):
        first, last = found.nodes[at - 1], found.nodes[at]
        if not found.turns[at]:
            assert last == first + 1
            continue
        assert last - first >= LEAST_EDGES
        run = points[first : last + 1].astype(float)
        centre = run[0] + found.centres[at] / PARTS
        radius = np.hypot(*(run[0] - centre))
        # Both ends on one circle, as far as four decimals of a millimetre can say it.
        assert abs(np.hypot(*(run[-1] - centre)) - radius) < 0.2
        off = np.hypot(*(run - centre).T) - radius
        assert np.abs(off).max() <= tolerance + 0.2
        angle = np.unwrap(np.arctan2(*(run - centre).T[::-1])) * found.turns[at]
        assert (np.diff(angle) > 0).all()
        assert angle[-1] - angle[0] <= np.pi + 1e-3
        middles = (run[:-1] + run[1:]) / 2
        assert np.abs(np.hypot(*(middles - centre).T) - radius).max() <= tolerance + sampling + 0.2
    return found


def test_a_circle_is_three_arcs_and_its_centre_is_found() -> None:
    found = check_arcs([circle(20_000, 180, 50_000, 40_000)], 5, 5)
    assert (found.turns[1:] == 1).all()
    assert 2 <= len(found.nodes) - 1 <= 3
    points = circle(20_000, 180, 50_000, 40_000)
    centres = points[found.nodes[:-1]] + found.centres[1:] / PARTS
    assert np.abs(centres - [50_000, 40_000]).max() < 1


def test_the_other_way_round_it_turns_to_the_right() -> None:
    found = check_arcs([circle(20_000, 180)[::-1]], 5, 5)
    assert (found.turns[1:] == -1).all()


def test_what_is_straight_stays_straight() -> None:
    square = np.array([[0, 0], [9000, 0], [9000, 9000], [0, 9000], [0, 0]])
    line = np.array([[0, 0], [1000, 500], [2000, 1000], [3000, 1500], [4000, 2000]])
    found = check_arcs([square, line], 20, 20)
    assert not found.turns.any()
    assert len(found.nodes) == 10


def test_a_polygon_is_no_circle() -> None:
    # All its corners lie on one, but what is between does not.
    assert not check_arcs([circle(20_000, 12)], 20, 20).turns.any()


def test_rounded_corners_are_arcs_between_straight_sides() -> None:
    quarter = circle(5000, 80)[:21]
    corners = [quarter @ turn + shift for turn, shift in (
        (np.array([[1, 0], [0, 1]]), (40_000, 20_000)),
        (np.array([[0, 1], [-1, 0]]), (-40_000, 20_000)),
        (np.array([[-1, 0], [0, -1]]), (-40_000, -20_000)),
        (np.array([[0, -1], [1, 0]]), (40_000, -20_000)),
    )]  # fmt: skip
    ring = np.concatenate([*corners, corners[0][:1]])
    found = check_arcs([ring], 5, 5)
    assert found.turns[1:].tolist() == [1, 0] * 4


def test_equal_lines_get_equal_arcs() -> None:
    wave = np.linspace(0, 6, 400)
    line = np.rint(np.c_[wave * 9000, 5000 * np.sin(wave)]).astype(np.int64)
    found = check_arcs([line, line[:50] + 7, line], 10, 10)
    last = found.nodes >= len(line) + 50
    first = found.nodes < len(line)
    assert found.turns[last].tolist() == found.turns[first].tolist()
    assert found.centres[last].tolist() == found.centres[first].tolist()
    assert 3 < np.count_nonzero(found.turns[first]) < 20


def test_a_line_of_two_points_is_a_line() -> None:
    found = check_arcs([np.array([[0, 0], [5, 5]]), np.array([[0, 0], [1, 0], [0, 0]])], 20, 20)
    assert found.nodes.tolist() == [0, 1, 2, 3, 4]


@pytest.mark.parametrize("bad", [0, -1, float("nan"), float("inf")])
def test_no_tolerance_is_refused(bad: float) -> None:
    with pytest.raises(GeometryError):
        fitted([circle(1000, 9)], bad, 0)


@st.composite
def blobs(draw: st.DrawFn) -> Steps:
    """A closed wavy line, sampled evenly, finely or coarsely, now and then with corners."""
    edges = draw(st.integers(3, 200))
    turn = np.linspace(0, 2 * np.pi, edges + 1)
    waves = draw(st.lists(st.floats(-0.3, 0.3), min_size=1, max_size=5))
    radius = 1 + sum(size * np.cos((k + 2) * turn + size) for k, size in enumerate(waves))
    size = draw(st.sampled_from([50, 2000, 30_000, 900_000]))
    ring = np.rint(np.c_[radius * np.cos(turn), radius * np.sin(turn)] * size).astype(np.int64)
    ring[-1] = ring[0]
    keep = np.append(True, (ring[1:] != ring[:-1]).any(axis=1))
    ring = ring[keep]
    whole = draw(st.booleans()) or len(ring) < 3
    return np.asarray(ring if whole else ring[: draw(st.integers(2, len(ring)))])


@given(
    st.lists(blobs().filter(lambda line: len(line) > 1), min_size=1, max_size=4),
    st.sampled_from([1.0, 5.0, 20.0, 200.0]),
    st.sampled_from([0.0, 5.0, 20.0]),
)
def test_arcs_keep_to_what_they_stand_for(lines: Lines, tolerance: float, sampling: float) -> None:
    check_arcs(lines, tolerance, sampling)


@given(blobs().filter(lambda line: len(line) > 1))
def test_where_a_line_lies_changes_nothing(line: Steps) -> None:
    there = fitted([line + np.array([123_456, -654_321])], 20, 20)
    here = fitted([line], 20, 20)
    assert there.nodes.tolist() == here.nodes.tolist()
    assert there.centres.tolist() == here.centres.tolist()
