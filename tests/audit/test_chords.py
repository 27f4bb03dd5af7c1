"""Chords are held against GEOS' distances, contours against areas."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import affinity

from batik_vector.audit import Kind, audit
from batik_vector.audit.drawn import drawn
from batik_vector.audit.measured import measured
from batik_vector.machines import Limits, Machine
from tests.audit.tiles import HEIGHT, WIDTH, petal, tile
from tests.strategies import rings

GAP = Machine(limits=Limits(narrowest_gap=2.0))


@settings(max_examples=20)
@given(rings(5.0), rings(5.0), st.floats(0, 6.283), st.floats(0.05, 1.8))
def test_the_gap_between_two_marks_is_their_distance(
    one: np.ndarray[tuple[int, int], np.dtype[np.float64]],
    other: np.ndarray[tuple[int, int], np.dtype[np.float64]],
    way: float,
    apart: float,
) -> None:
    first, second = (shapely.convex_hull(shapely.Polygon(ring)) for ring in (one, other))
    step = np.array([np.cos(way), np.sin(way)])
    # Brought up along the way until the distance is as asked.
    low, high = 0.0, 30.0
    for _ in range(50):
        middle = (low + high) / 2
        near = shapely.distance(first, affinity.translate(second, *(middle * step))) < apart
        low, high = (middle, high) if near else (low, middle)
    marks = [affinity.translate(each, 60, 50) for each in (first, affinity.translate(second, *(high * step)))]
    worst = audit(tile(marks, tolerance=0.001), GAP).findings[0]
    assert worst.kind == Kind.GAP
    assert worst.value == pytest.approx(shapely.distance(*marks), abs=0.003)
    between = shapely.shortest_line(*marks)
    places = [shapely.Point(each.where) for each in audit(tile(marks, tolerance=0.001), GAP).findings]
    assert min(each.distance(between) for each in places) < 0.1 or worst.value == pytest.approx(
        between.length, abs=0.003
    )


@settings(max_examples=20)
@given(st.floats(0, WIDTH), st.floats(0, HEIGHT), st.floats(0, 360), st.sampled_from(["0", "1/2", "1/4"]))
def test_a_mark_is_one_contour_wherever_the_page_cuts_it(x: float, y: float, turn: float, drop: str) -> None:
    mark = petal(x, y, 40, 16, turn) - shapely.Point(x, y).buffer(3)
    frame, (ink,) = drawn(tile([mark], drop=Fraction(drop)))
    found = measured(ink, frame, 0.01)
    assert found.contours.closed.all()
    assert not found.contours.shift.any()
    outer, hole = sorted(found.area / frame.per_mm**2, reverse=True)
    assert outer + hole == pytest.approx(mark.area, rel=1e-3)
    assert hole == pytest.approx(-shapely.Point(0, 0).buffer(3).area, rel=1e-3)


def test_a_band_round_the_torus_closes_with_a_period() -> None:
    frame, (ink,) = drawn(tile([shapely.box(-5, 40, WIDTH + 5, 50)]))
    assert len(ink.contours) == 2
    assert ink.contours.closed.all()
    shifts = np.abs(ink.contours.shift) / frame.per_mm
    assert shifts == pytest.approx(np.array([[WIDTH, 0], [WIDTH, 0]]))
    least = Machine(limits=Limits(narrowest_line=12.0))
    (found,) = audit(tile([shapely.box(-5, 40, WIDTH + 5, 50)]), least).findings
    assert found.kind == Kind.LINE
    assert found.value == pytest.approx(10.0)


@pytest.mark.parametrize("teeth", [4, 40])
def test_every_tooth_of_a_comb_has_its_gap(teeth: int) -> None:
    tooth = 100 / teeth
    comb = [shapely.box(10, 20, 110, 25)]
    comb += [shapely.box(10 + i * tooth, 24, 10 + (i + 1) * tooth - 0.4, 40) for i in range(teeth)]
    found = audit(tile([shapely.union_all(comb)]), Machine(limits=Limits(narrowest_gap=0.6))).findings
    assert len(found) == teeth - 1
    assert {round(each.value, 3) for each in found} == {0.4}
