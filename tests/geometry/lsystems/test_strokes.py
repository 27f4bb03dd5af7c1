"""Strokes on a lattice and off it cover what a pen of their breadth covers, and nothing crosses."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.errors import TooLargeError
from batik_vector.geometry import work
from batik_vector.geometry.curves import LSystem
from batik_vector.geometry.lsystems.contours import bodies
from batik_vector.geometry.lsystems.lattice import on_lattice
from batik_vector.geometry.sampling import Geometries
from tests.thorough import rarely

TOLERANCE = 1e-3


def drawn(curve: LSystem) -> shapely.Geometry:
    walk = curve.walk()
    parts = np.split(walk.points, walk.offsets[1:-1])
    return shapely.MultiLineString([np.column_stack([p.real, p.imag]) for p in parts])


def apart(areas: Geometries, other: shapely.Geometry) -> float:
    return float(shapely.area(shapely.symmetric_difference(shapely.union_all(areas), other)))


def region(curve: LSystem, tolerance: float = TOLERANCE) -> Geometries:
    areas = curve.region(tolerance)
    assert areas is not None
    return areas


@pytest.mark.parametrize(
    ("system", "level", "width"),
    rarely(
        [
            ("hilbert", 4, 0.5),
            ("dragon", 8, 0.3),
            ("levy", 8, 0.3),
            ("gosper", 3, 0.25),
            ("koch-snowflake", 3, 0.3),
            ("sierpinski-arrowhead", 5, 0.4),
            ("kolam-snake", 2, 0.6),
            ("koch-island", 2, 0.5),
        ],
        3,
    ),
)
def test_strokes_on_a_lattice_are_the_bodies_of_their_lines(system: str, level: int, width: float) -> None:
    curve = LSystem(system=system, level=level, width=width)
    walk = curve.walk()
    areas = on_lattice(walk.points, walk.offsets, width, TOLERANCE)
    assert areas is not None
    assert shapely.is_valid(areas).all()
    pen = shapely.buffer(drawn(curve), width / 2, quad_segs=32)
    assert apart(areas, pen) < 5 * TOLERANCE * pen.length
    assert len(areas) == 1
    assert shapely.get_num_interior_rings(areas[0]) == shapely.get_num_interior_rings(pen)
    # No chord of a round end stands off by more, and no edge of a straight side at all.
    assert shapely.hausdorff_distance(shapely.boundary(areas[0]), shapely.boundary(pen), 0.5) < 2 * TOLERANCE


def test_strokes_that_do_not_meet_are_areas_of_their_own_with_their_holes() -> None:
    islands = LSystem(axiom="F+F+F+F+ffffF+F+F+F", width=0.2)
    walk = islands.walk()
    areas = on_lattice(walk.points, walk.offsets, 0.2, TOLERANCE)
    assert areas is not None
    assert [shapely.get_num_interior_rings(each) for each in areas] == [1, 1]


@pytest.mark.parametrize("width", [0.9, 0.99, 1.5])
def test_strokes_that_touch_one_another_are_no_lattice(width: float) -> None:
    for system in ("gosper", "hilbert"):
        walk = LSystem(system=system, level=2, width=width).walk()
        found = on_lattice(walk.points, walk.offsets, width, TOLERANCE)
        assert (found is None) == (system == "gosper" or width > 0.98)


@pytest.mark.parametrize("system", ["plant-fern", "plant-weed", "dragon", "kolam-snake"])
def test_strokes_of_any_line_are_its_body(system: str) -> None:
    curve = LSystem(system=system, level=3, width=0.25)
    walk = curve.walk()
    areas = bodies(walk.points, walk.offsets, 0.25 * walk.widths, TOLERANCE)
    pen = shapely.buffer(drawn(curve), 0.125, quad_segs=32)
    assert shapely.is_valid(areas).all()
    assert apart(areas, pen) < 5 * TOLERANCE * pen.length


def test_tapering_strokes_are_as_broad_as_they_say() -> None:
    (area,) = region(LSystem(axiom="FF", width=1, taper=0.5))
    half = np.pi / 2
    assert area.area == pytest.approx(2 * 0.75 + half * (0.25 + 0.0625), rel=5e-3)
    assert shapely.bounds(area)[[0, 2]] == pytest.approx([-1.5, 1.25], abs=2 * TOLERANCE)


def test_round_corners_are_arcs_that_keep_the_tolerance() -> None:
    circle = LSystem(axiom="F+F+F+F", round=1, width=0.2)
    (area,) = region(circle)
    ring = np.pi * (0.6**2 - 0.4**2)
    assert area.area == pytest.approx(ring, rel=1e-2)
    (coarse,) = region(circle, 20 * TOLERANCE)
    assert shapely.get_num_coordinates(coarse) < shapely.get_num_coordinates(area)


def test_strokes_that_cross_too_often_are_refused_before_they_are_welded(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(work, "LIMIT", 400_000.0)
    monkeypatch.setattr("batik_vector.geometry.lsystems.contours.welded", None)
    with pytest.raises(TooLargeError, match=r"cross about .* times to bend or overlay"):
        region(LSystem(system="plant-weed", level=6, width=0.3, taper=0.9), 0.01)
