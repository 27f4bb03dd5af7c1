from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.geometry.outlines import nothing
from batik_vector.processes.plotting.timing import DEVIATION, Pace, taken
from tests.processes.strokes import line, parts_of, strokes

PLACE = st.tuples(st.integers(0, 20_000), st.integers(0, 20_000))


def test_at_speed_at_once_it_is_way_over_speed() -> None:
    found = taken(
        strokes(line((0, 0), (30_000, 40_000)), line((30_000, 50_000), (30_000, 70_000))),
        Pace(10, 50, 0, 0.5),
    )
    assert (found.drawn, found.travelled, found.lifts) == (70.0, 10.0, 2)
    assert found.seconds == pytest.approx(7 + 0.2 + 1)


@pytest.mark.parametrize(
    ("length", "seconds"),
    [
        # 100 mm/s are reached in 0.1 s on 5 mm: two ramps, and the rest at speed.
        (100, 0.2 + 0.9),
        # A way too short for it: half of it uphill.
        (4, 2 * math.sqrt(4 / 1000)),
    ],
)
def test_a_way_from_rest_to_rest_is_a_trapezoid_or_a_triangle(length: int, seconds: float) -> None:
    assert taken(strokes(line((0, 0), (1000 * length, 0))), Pace(100, 100, 1000)).seconds == pytest.approx(
        seconds
    )


def test_a_corner_is_taken_at_the_speed_of_its_arc() -> None:
    corner = taken(strokes(line((0, 0), (50_000, 0), (50_000, 50_000))), Pace(100, 100, 1000)).seconds
    half = math.sqrt(0.5)
    square = 1000 * DEVIATION * half / (1 - half)
    # From the corner's speed to 100 mm/s and back to rest, both ways alike.
    ramps = (2 * 100 - math.sqrt(square)) / 1000
    level = 50 - (2 * 100**2 - square) / 2000
    assert corner == pytest.approx(2 * (ramps + level / 100))


def test_a_vertex_on_a_straight_way_costs_nothing() -> None:
    pace = Pace(100, 100, 1000)
    parted = strokes(line((0, 0), (10_000, 0), (10_500, 0), (50_000, 0)))
    assert taken(parted, pace).seconds == pytest.approx(
        taken(strokes(line((0, 0), (50_000, 0))), pace).seconds
    )


def _stepwise(points: Any, pace: Pace) -> float:
    """One stroke, planned forwards and backwards a segment at a time."""
    at = np.array(points, float) / 1000
    steps = np.diff(at, axis=0)
    length = np.hypot(*steps.T)
    speeds = [0.0]
    for one, other in pairwise(steps):
        cosine = -float(one @ other) / float(np.hypot(*one) * np.hypot(*other))
        sine = math.sqrt(max(0.0, (1 - cosine) / 2))
        free = pace.acceleration * DEVIATION * sine / max(1 - sine, 1e-12)
        speeds.append(min(pace.draw, math.sqrt(free)))
    speeds.append(0.0)
    for k in range(len(length)):
        speeds[k + 1] = min(speeds[k + 1], math.sqrt(speeds[k] ** 2 + 2 * pace.acceleration * length[k]))
    for k in reversed(range(len(length))):
        speeds[k] = min(speeds[k], math.sqrt(speeds[k + 1] ** 2 + 2 * pace.acceleration * length[k]))
    total = 0.0
    for k, way in enumerate(length.tolist()):
        u, v, a = speeds[k], speeds[k + 1], pace.acceleration
        top = min(pace.draw, math.sqrt((u * u + v * v) / 2 + a * way))
        total += (2 * top - u - v) / a + max(0.0, way - (2 * top * top - u * u - v * v) / (2 * a)) / pace.draw
    return total


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.lists(PLACE, min_size=2, max_size=8, unique=True), min_size=1, max_size=4),
    st.sampled_from([20, 500, 5000]),
)
def test_it_is_what_a_planner_of_one_segment_after_another_finds(parts: Any, acceleration: float) -> None:
    drawn = strokes(*(line(*points) for points in parts))
    pace = Pace(60, 1e12, acceleration)
    found = taken(drawn, pace)
    going = sum(
        2 * math.sqrt(math.dist(a[-1], b[0]) / 1000 / acceleration) for a, b in pairwise(parts_of(drawn))
    )
    assert found.seconds == pytest.approx(going + sum(_stepwise(p, pace) for p in parts), rel=1e-4, abs=1e-4)


def test_nothing_takes_no_time() -> None:
    assert taken(nothing(), Pace(1, 1)).seconds == 0
