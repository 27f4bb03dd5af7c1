"""Curves of one's own: any function of t in [0, 1], points, paths; nobody says where the corners are."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import shapely

from batik_vector.errors import GeometryError
from batik_vector.geometry.curves import Circle, Curve, PathCurve, PointsCurve, YAxis, trace


def area(curve: Curve, tolerance: float = 1e-4) -> float:
    (ring,) = trace(curve, tolerance).rings
    return float(shapely.Polygon(ring).area)


CIRCLES: dict[str, Callable[[Any], Any]] = {
    "points": lambda t: np.column_stack([np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)]),
    "x and y": lambda t: (np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)),
    "complex": lambda t: np.exp(2j * np.pi * t),
    "one by one": lambda t: (math.cos(2 * math.pi * t), math.sin(2 * math.pi * t)),
    "one by one, complex": lambda t: complex(math.cos(2 * math.pi * t), math.sin(2 * math.pi * t)),
    "with an if": lambda t: (math.cos(2 * math.pi * t) if t < 2 else 0, math.sin(2 * math.pi * t)),
}


@pytest.mark.parametrize("function", CIRCLES.values(), ids=CIRCLES)
def test_a_function_may_be_written_as_one_likes(function: Callable[[Any], Any]) -> None:
    curve = Curve.from_function(function)
    assert curve.closed
    assert len(curve.breaks()) == 0
    assert area(curve, 1e-3) == pytest.approx(math.pi, abs=8e-3)


def test_a_constant_stands_for_as_many() -> None:
    line = Curve.from_function(lambda t: (3 * t, 2))
    assert not line.closed
    assert trace(line, 1e-3).strands[0].tolist() == [[0, 2], [3, 2]]


def polygon(t: np.ndarray, sides: int) -> np.ndarray:
    """A regular polygon, as a function writes it that knows nothing of breaks."""
    turn = 2 * np.pi * t
    length = np.cos(np.pi / sides) / np.cos(turn % (2 * np.pi / sides) - np.pi / sides)
    return np.asarray(length * np.exp(1j * turn))


@pytest.mark.parametrize("sides", [3, 4, 5, 7, 12])
def test_corners_are_found(sides: int) -> None:
    curve = Curve.from_function(lambda t: polygon(t, sides))
    assert curve.breaks() == pytest.approx(np.arange(1, sides) / sides, abs=1e-9)
    assert area(curve) == pytest.approx(sides / 2 * math.sin(2 * math.pi / sides), rel=1e-9)
    assert len(trace(curve, 1e-3).rings[0]) == sides + 1


def test_cusps_are_found_and_tight_bends_are_none() -> None:
    cardioid = Curve.from_function(lambda t: (1 - np.cos(2 * np.pi * (t + 0.3))) * np.exp(2j * np.pi * t))
    assert cardioid.breaks() == pytest.approx([0.7], abs=1e-6)
    bent = Curve.from_function(lambda t: (np.cos(2 * np.pi * t), 0.002 * np.sin(2 * np.pi * t)))
    assert len(bent.breaks()) == 0


def test_corners_that_are_told_are_taken() -> None:
    given = Curve.from_function(CIRCLES["complex"], corners=[0.25, 0.5], closed=False)
    assert given.breaks().tolist() == [0.25, 0.5]
    assert not given.closed


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (lambda t: t, "the function of t gives no points, expected x and y, or a complex number"),
        (lambda t: None, "gives no points"),
        (lambda t: (t, t, t), "gives no points"),
        (5, "function = 5, expected a function"),
    ],
)
def test_what_is_no_curve_is_refused_when_it_is_made(function: Any, words: str) -> None:
    with pytest.raises(GeometryError, match=words):
        Curve.from_function(function)


def test_a_jump_is_told_when_it_is_traced() -> None:
    torn = Curve.from_function(lambda t: np.exp(2j * np.pi * t) + (t > 0.4))
    with pytest.raises(GeometryError, match=r"at\(t\) jumps from .* at t = 0\.4"):
        trace(torn, 1e-3)


def test_points_and_paths_are_values() -> None:
    square = [(0, 0), (2, 0), (2, 2), (0, 2)]
    assert Curve.from_points(square) == Curve.from_points(np.array(square, float))
    assert hash(Curve.from_points(square)) == hash(Curve.from_points(square))
    assert Curve.from_points(square) != Curve.from_points(square, smooth=True)
    assert area(Curve.from_points(square)) == 4
    assert Curve.from_path("M0 0H2V2H0Z") == Curve.from_path("m0 0h2v2h-2z")


def test_python_and_recipes_draw_the_same() -> None:
    d, leaf = "M1 2C3 4 5 4 6 2Z", ((0, 0), (1, 1), (3, 0), (1, -1))
    pairs = [
        (Curve.from_path(d, y="up", centre=(3, 2)), PathCurve(d, YAxis.UP, (3, 2))),
        (Curve.from_points(leaf, smooth=True, corners=[0]), PointsCurve(leaf, smooth=True, corners=(0,))),
    ]
    for one, other in pairs:
        assert np.array_equal(trace(one, 1e-3).rings[0], trace(other, 1e-3).rings[0])


def test_the_y_of_a_path_points_down_unless_told() -> None:
    down, up = PathCurve("M0 0L4 0L4 1Z"), PathCurve("M0 0L4 0L4 1Z", y=YAxis.UP, centre=(4, 1))
    assert trace(down, 1e-3).rings[0].tolist() == [[0, 0], [4, 0], [4, -1], [0, 0]]
    assert trace(up, 1e-3).rings[0].tolist() == [[-4, -1], [0, -1], [0, 0], [-4, -1]]
    with pytest.raises(GeometryError, match='unknown y "upp": did you mean "up"'):
        Curve.from_path("M0 0L4 0L4 1Z", y="upp")


def test_arcs_of_a_path_are_circles_to_a_ten_millionth() -> None:
    found = trace(Curve.from_path("M1 0A1 1 0 0 1 -1 0A1 1 0 0 1 1 0Z"), 1e-4).rings[0]
    known = trace(Circle(1.0), 1e-4).rings[0]
    assert np.abs(np.hypot(*found.T) - 1).max() < 1e-7
    assert len(found) < 1.2 * len(known)
