"""Continuations: both halves of a circle that an edge cuts know its tangent there."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.geometry.continuations import ends_of, known_at
from batik_vector.geometry.known import BREAK, SMOOTH, Known
from batik_vector.geometry.outlines import MM, Outlines, of_polygons

EDGES = (0, 60_000), (0, 50_000)
SHIFTS = np.array([(0, 0), (60_000, 0), (-60_000, 0)])


def cut(*shapes: shapely.Geometry) -> Outlines:
    """Shapes on both sides of the right edge, the halves beyond it moved to the left one."""
    sides = [shapely.box(0, 0, 60, 50), shapely.box(60, 0, 120, 50)]
    left, right = ([shapely.intersection(shape, side) for shape in shapes] for side in sides)
    parts = np.array([*left, *(shapely.affinity.translate(half, -60) for half in right)], object)
    return of_polygons(np.asarray(shapely.orient_polygons(parts[~shapely.is_empty(parts)]), object), MM)


def known_of(outlines: Outlines) -> Known:
    own = ends_of(outlines, EDGES)
    known = known_at(own, own, SHIFTS, len(outlines.points), 0.02)
    assert known is not None
    return known


def directions(outlines: Outlines, known: Known, edge: int) -> list[float]:
    """Directions in degrees, from 0 to 180, told at an edge."""
    here = np.flatnonzero(outlines.points[:, 0] == edge)
    told = np.concatenate([known.arriving[here], known.leaving[here]])
    return sorted(np.degrees(told[np.isfinite(told)]) % 180)


@pytest.mark.parametrize("centre", [55.0, 60.3, 66.66])
@pytest.mark.parametrize("turn", [0.0, 0.01, 0.03])
def test_a_circle_keeps_its_tangent(centre: float, turn: float) -> None:
    angle = np.linspace(0, 2 * np.pi, 72, endpoint=False) + turn
    outlines = cut(shapely.Polygon(np.column_stack([centre + 20 * np.cos(angle), 25 + 20 * np.sin(angle)])))
    half = np.degrees(np.arccos((60 - centre) / 20))
    expected = sorted([(90 + half) % 180, (90 - half) % 180])
    near, far = (directions(outlines, known_of(outlines), edge) for edge in (60_000, 0))
    # Vertices are rounded, and the chord is passed somewhere between two of them.
    assert near == pytest.approx(expected, abs=0.2)
    assert far == pytest.approx(near, abs=1e-9)


def test_a_corner_on_the_edge_and_what_only_touches_it_are_told_nothing() -> None:
    tip = cut(
        shapely.Polygon([(50, 10), (60, 20), (50, 30)]), shapely.Polygon([(60, 20), (70, 26), (70, 14)])
    )
    own = ends_of(tip, EDGES)
    assert known_at(own, own, SHIFTS, len(tip.points), 0.02) is None
    disc = cut(shapely.Point(50, 25).buffer(10))
    own = ends_of(disc, EDGES)
    assert known_at(own, own, SHIFTS, len(disc.points), 0.02) is None


def test_a_shallow_bay_stays_as_it_is() -> None:
    bay = shapely.Polygon([(40, 10), (60, 10), (59.99, 10.5), (60, 11), (60, 40), (40, 40)])
    outlines = cut(bay)
    bottom = np.flatnonzero((outlines.points == (59_990, 10_500)).all(axis=1))
    assert known_of(outlines).joint[bottom].tolist() == [BREAK]


def test_straight_borders_go_straight_on() -> None:
    outlines = cut(shapely.Polygon([(50, 10), (70, 15), (70, 25), (50, 20)]))
    slope = np.degrees(np.arctan2(5, 20))
    for edge in (0, 60_000):
        assert directions(outlines, known_of(outlines), edge) == pytest.approx([slope, slope], abs=0.01)
    assert (known_of(outlines).joint != SMOOTH).any()
