"""Bodies of strokes: ends, joins and dashes cover what SVG says, also where a line runs back over itself."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from batik_vector.importing.pens import Cap, Join, Pen, bodies


@pytest.mark.parametrize(("join", "area"), [("mitre", 100.0), ("round", 100.0 + math.pi / 4)])
def test_a_straight_line_there_and_back_has_its_whole_body(join: Join, area: float) -> None:
    line = shapely.LineString([(30, 0), (100, 0), (0, 0), (30, 0)])
    (body,), _ = bodies(np.array([line], dtype=object), 1.0, Pen("flat", join, 4.0), 0.005)
    assert body.area == pytest.approx(area, rel=1e-3)


@pytest.mark.parametrize(
    ("places", "area"),
    [
        ([(0, 0), (10, 0), (10, 10), (0, 10), (0, 0)], 40.0),
        ([(0, 0), (10, 0), (10, 10), (20, 10), (10, 10)], 30.0 - 0.25),
        ([(0, 0), (20, 0), (0, 1)], 20.0 + 20.025 - 5.0),
    ],
)
def test_mitres_past_their_limit_are_bevelled(places: list[tuple[float, float]], area: float) -> None:
    line = np.array([shapely.LineString(places)], dtype=object)
    (body,), _ = bodies(line, 1.0, Pen("flat", "mitre", 4.0), 0.005)
    assert body.bounds[2] <= 20.1
    if len(places) > 3:
        assert body.area == pytest.approx(area, abs=0.3)


@pytest.mark.parametrize(
    ("cap", "dashes", "begin", "area"),
    [
        ("round", (0.0, 4.0), 0.0, 5 * math.pi / 4),
        ("square", (0.0, 4.0), 0.0, 5.0),
        ("flat", (0.0, 4.0), 0.0, 0.0),
        ("round", (0.0, 4.0), 0.1 + 0.2 - 0.3, 5 * math.pi / 4),
        ("round", (2.0, 2.0), 0.0, 5 * (2 + math.pi / 4)),
        # A dash that ends where the line begins, and one that begins where it ends, are not there.
        ("round", (2.0, 2.0), 2.0, 5 * (2 + math.pi / 4)),
        ("round", (4.0, 4.0, 0.0, 2.0), 1e-17, 2 * (4 + math.pi / 4) + 2 * math.pi / 4),
    ],
)
def test_dashes_of_no_length_are_dots(cap: Cap, dashes: tuple[float, ...], begin: float, area: float) -> None:
    line = np.array([shapely.LineString([(0, 0), (7, 0), (20, 0)])], dtype=object)
    shapes, _ = bodies(line, 1.0, Pen(cap, "round", 4.0, dashes, begin), 0.001)
    assert shapely.area(shapes).sum() == pytest.approx(area, rel=4e-3, abs=1e-4)
