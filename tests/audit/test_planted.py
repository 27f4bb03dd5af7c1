"""Planted faults are found at their places, and nothing else is."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import affinity
from shapely.geometry.base import BaseGeometry

from batik_vector.audit import Finding, Kind, audit
from tests.audit.tiles import HEIGHT, MACHINE, WIDTH, petal, tile

CLEAN = [
    petal(20, 20, 24, 8, 30),
    petal(20, 70, 20, 5, 70),
    shapely.Point(95, 15).buffer(6, 32) - shapely.Point(96, 15).buffer(2, 32),
    shapely.box(85, 80, 100, 92),
]
"""Marks that keep every limit, and leave the middle of the tile bare."""

RIM = [petal(0, 45, 22, 6, 10), petal(60, 0, 18, 7, 80)]
"""Marks that lie across the seams."""

near = st.tuples(st.floats(44, 76), st.floats(38, 62), st.floats(0, 360))


def _placed(mark: BaseGeometry, at: tuple[float, float, float]) -> BaseGeometry:
    x, y, turn = at
    return affinity.translate(affinity.rotate(mark, turn, (0, 0)), x, y)


def _only(found: tuple[Finding, ...], kind: Kind) -> Finding:
    assert [each.kind for each in found] == [kind], [each.words for each in found]
    return found[0]


@pytest.mark.parametrize("drop", [Fraction(0), Fraction(1, 2)])
def test_a_clean_tile_has_no_findings(drop: Fraction) -> None:
    assert audit(tile([*CLEAN, *RIM], drop=drop), MACHINE).findings == ()


@settings(max_examples=12)
@given(near, st.floats(0.15, 0.9))
def test_a_narrow_line_is_found(at: tuple[float, float, float], breadth: float) -> None:
    line = _placed(shapely.box(-6, -breadth / 2, 6, breadth / 2), at)
    found = _only(audit(tile([*CLEAN, line]), MACHINE).findings, Kind.LINE)
    assert shapely.Point(found.where).distance(line) < 0.1
    assert found.value == pytest.approx(breadth, abs=0.005)


@settings(max_examples=12)
@given(near, st.floats(0.05, 0.55))
def test_a_narrow_gap_is_found(at: tuple[float, float, float], breadth: float) -> None:
    left, right = shapely.box(-7, -4, -breadth / 2, 4), shapely.box(breadth / 2, -4, 7, 4)
    found = _only(audit(tile([*CLEAN, _placed(left, at), _placed(right, at)]), MACHINE).findings, Kind.GAP)
    slit = _placed(shapely.box(-breadth / 2, -4, breadth / 2, 4), at)
    assert shapely.Point(found.where).distance(slit) < 0.1
    assert found.value == pytest.approx(breadth, abs=0.005)


@settings(max_examples=12)
@given(near, st.floats(0.1, 0.9), st.floats(0.5, 8))
def test_a_neck_is_found_however_short(at: tuple[float, float, float], breadth: float, length: float) -> None:
    discs = [shapely.Point(side * (4 + length / 2), 0).buffer(4, 32) for side in (-1, 1)]
    neck = shapely.box(-4 - length / 2, -breadth / 2, 4 + length / 2, breadth / 2)
    both = _placed(shapely.union_all([*discs, neck]), at)
    found = _only(audit(tile([*CLEAN, both]), MACHINE).findings, Kind.LINE)
    assert shapely.Point(found.where).distance(_placed(neck - shapely.union_all(discs), at)) < 0.1
    assert found.value == pytest.approx(breadth, abs=0.01)


@settings(max_examples=8)
@given(near, st.floats(0.03, 0.08))
def test_a_sliver_is_found(at: tuple[float, float, float], breadth: float) -> None:
    sliver = _placed(shapely.Polygon([(-3, 0), (3, -breadth / 2), (3, breadth / 2)]), at)
    found = _only(audit(tile([*CLEAN, sliver]), MACHINE).findings, Kind.SLIVER)
    assert shapely.Point(found.where).distance(sliver) < 0.1


@settings(max_examples=8)
@given(near, st.floats(0.2, 0.9))
def test_a_small_hole_is_found(at: tuple[float, float, float], breadth: float) -> None:
    hole = _placed(shapely.Point(1, 1).buffer(breadth / 2, 32), at)
    disc = _placed(shapely.Point(0, 0).buffer(6, 32), at)
    found = _only(audit(tile([*CLEAN, disc - hole]), MACHINE).findings, Kind.HOLE)
    assert shapely.Point(found.where).distance(hole) < 0.1
    assert found.value == pytest.approx(breadth, rel=0.01)


@settings(max_examples=8)
@given(near)
def test_an_open_path_is_found_at_its_end(at: tuple[float, float, float]) -> None:
    path = _placed(shapely.LineString([(-5, -3), (0, 3), (5, -3)]), at)
    ring = shapely.Point(95, 45).buffer(5).exterior
    found = _only(audit(tile(CLEAN, [path, ring]), MACHINE).findings, Kind.OPEN)
    assert shapely.Point(found.where).distance(path.boundary) < 0.1


@settings(max_examples=8)
@given(st.integers(44, 76), st.integers(38, 62), st.floats(0.3, 6))
def test_a_path_drawn_again_is_found_at_what_it_shares(x: int, y: int, shared: float) -> None:
    square = shapely.box(x - 5, y - 5, x + 5, y + 5).exterior
    other = shapely.box(x + 5, y, x + 9, y + shared).exterior
    (found,) = (
        each for each in audit(tile(CLEAN, [square, other]), MACHINE).findings if each.kind == Kind.DOUBLE
    )
    assert shapely.Point(found.where).distance(square & other) < 0.1
    assert found.value == pytest.approx(min(shared, 5), abs=0.002)


@settings(max_examples=10)
@given(st.floats(0, HEIGHT), st.floats(0, WIDTH), st.booleans(), st.booleans())
def test_the_seam_hides_nothing(y: float, x: float, upright: bool, halved: bool) -> None:
    left, right = shapely.box(-8, -3, -0.1, 3), shapely.box(0.1, -3, 8, 3)
    at = (x, 0.0, 90.0) if upright else (0.0, y, 0.0)
    drop = Fraction(1, 2) if halved else Fraction(0)
    found = _only(audit(tile([_placed(left, at), _placed(right, at)], drop=drop), MACHINE).findings, Kind.GAP)
    assert found.value == pytest.approx(0.2, abs=0.003)
    fx, fy = found.where
    assert min(fy, HEIGHT - fy) < 0.1 if upright else min(fx, WIDTH - fx) < 0.1


@settings(max_examples=15)
@given(near, st.floats(8, 30), st.floats(0.08, 0.5))
def test_a_petal_is_no_narrow_line_at_its_tips(
    at: tuple[float, float, float], length: float, plump: float
) -> None:
    x, y, turn = at
    breadth = max(1.2, plump * length)
    assert audit(tile([petal(x, y, length, breadth, turn)], tolerance=0.02), MACHINE).findings == ()


def test_touching_marks_leave_no_gap_where_they_touch() -> None:
    discs = [shapely.Point(50 + 10 * i, 50).buffer(5, 64) for i in range(2)]
    assert audit(tile(discs), MACHINE).findings == ()


def test_lines_are_as_broad_as_their_ink() -> None:
    lines = [shapely.Point(50, 50).buffer(10 + 2.5 * i, 32).exterior for i in range(2)]
    (narrow,) = audit(tile([], lines, width=0.4), MACHINE).findings
    assert (narrow.kind, narrow.value) == (Kind.LINE, 0.4)
    gap = _only(audit(tile([], lines, width=2.2), MACHINE).findings, Kind.GAP)
    assert gap.value == pytest.approx(0.3, abs=0.02)


def _coarse(x: float, y: float, radius: float) -> shapely.Polygon:
    """Return a disc drawn to 0.02 mm, with a vertex at the right."""
    angles = np.arange(count := math.ceil(math.pi / math.acos(1 - 0.02 / radius))) * 2 * math.pi / count
    return shapely.Polygon(np.round(np.column_stack([np.cos(angles), np.sin(angles)]) * radius + [x, y], 3))


@pytest.mark.parametrize(("radius", "share"), [(10, 0.96), (12, 0.97), (14, 0.97)])
def test_a_gap_that_runs_out_where_marks_touch_is_none_though_chords_let_it_swell(
    radius: float, share: float
) -> None:
    plate = shapely.box(30, 20, 95, 80) - _coarse(60, 50, radius)
    disc = _coarse(60 + radius - share * radius, 50, share * radius)
    assert audit(tile([plate, disc], tolerance=0.02), MACHINE).findings == ()
