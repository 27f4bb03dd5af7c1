"""Known L-systems have the lengths and areas that are published of them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely

from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.geometry.curves import LSystem, Origin, trace
from batik_vector.geometry.lsystems.catalogue import NAMED


def line_of(system: str, level: int) -> shapely.LineString:
    (strand,) = trace(LSystem(system=system, level=level), 1e-6).strands
    return shapely.LineString(strand)


@pytest.mark.parametrize("level", [0, 1, 2, 3, 4])
def test_the_snowflake_has_its_perimeter_and_area(level: int) -> None:
    (ring,) = trace(LSystem(system="koch-snowflake", level=level), 1e-6).rings
    side = 3**level  # of the triangle, in steps
    area = shapely.Polygon(ring)
    assert area.length == pytest.approx(3 * side * (4 / 3) ** level)
    triangle = math.sqrt(3) / 4 * side**2
    assert area.area == pytest.approx(triangle * (8 / 5 - 3 / 5 * (4 / 9) ** level))


@pytest.mark.parametrize("level", [0, 1, 2])
def test_the_quadratic_island_keeps_its_area(level: int) -> None:
    (ring,) = trace(LSystem(system="koch-island", level=level), 1e-6).rings
    assert shapely.Polygon(ring).area == pytest.approx(16**level)
    assert shapely.Polygon(ring).length == pytest.approx(4 * 8**level)


@pytest.mark.parametrize(
    ("system", "level", "length", "span"),
    [
        ("hilbert", 5, 4**5 - 1, 2**5 - 1),
        ("dragon", 10, 2**10, 2**5),
        ("levy", 8, 2**8, 2**4),
        ("gosper", 3, 7**3, math.sqrt(7) ** 3),
        ("sierpinski-arrowhead", 6, 3**6, 2**6),
        ("koch-curve", 4, 4**4, 3**4),
    ],
)
def test_lines_have_their_published_lengths_and_spans(
    system: str, level: int, length: float, span: float
) -> None:
    line = line_of(system, level)
    assert line.length == pytest.approx(length)
    ends = shapely.get_coordinates(line)[[0, -1]]
    assert math.dist(*ends) == pytest.approx(span)


def test_hilberts_curve_comes_to_every_place_once() -> None:
    (strand,) = trace(LSystem(system="hilbert", level=4), 1e-6).strands
    places = np.unique(np.rint(LSystem(system="hilbert", level=4).walk().points * 2), return_counts=True)
    assert len(places[0]) == 4**4
    assert (places[1] == 1).all()
    assert shapely.LineString(strand).is_simple


@pytest.mark.parametrize("system", ["kolam-snake", "kolam-anklets"])
def test_kolam_are_one_closed_line(system: str) -> None:
    for share in (0.0, 1.0):
        curve = LSystem(system=system, level=3, round=share)
        assert curve.closed
        (strand,) = trace(curve, 1e-3).strands
        assert strand[0] == pytest.approx(strand[-1])
        # Four-fold as it is drawn at the door, corner by corner, the one where it closes too.
        turned = strand @ np.array([[-1, 0], [0, -1]])
        assert shapely.hausdorff_distance(shapely.LineString(strand), shapely.LineString(turned)) < 0.05


@pytest.mark.parametrize("name", NAMED)
def test_every_known_system_draws_as_a_line_and_as_a_stroke(name: str) -> None:
    lines = trace(LSystem(system=name, round=0.5), 0.01)
    assert lines.strands
    stroke = LSystem(system=name, width=0.2)
    areas = trace(stroke, 0.01).areas
    assert areas is not None
    assert shapely.is_valid(areas).all()


def test_a_link_leads_from_nought_to_one() -> None:
    line = LSystem(axiom="XF", rules=NAMED["hilbert"].rules, level=2, origin=Origin.LINK)
    curve = replace(line, width=0.3)
    (points,) = trace(line, 0.01).strands
    assert points[[0, -1]] == pytest.approx(np.array([[0, 0], [1, 0]]), abs=1e-12)
    areas = curve.region(0.001)
    assert areas is not None
    low, high = shapely.total_bounds(areas)[[1, 3]]
    assert high - low == pytest.approx(0.75 + 0.3 / 4, abs=1e-3)


def test_what_stands_together_though_it_should_not_is_told() -> None:
    with pytest.raises(GeometryError, match='did you mean "dragon"'):
        LSystem(system="dragoon")
    with pytest.raises(GeometryError, match="needs a system or an axiom"):
        LSystem()
    with pytest.raises(GeometryError, match='beside system = "levy"'):
        LSystem(system="levy", axiom="F")
    with pytest.raises(GeometryError, match="ends where it begins"):
        LSystem(system="kolam-snake", origin=Origin.LINK)
    with pytest.raises(TooLargeError, match="about 10"):
        LSystem(system="dragon", level=60)
