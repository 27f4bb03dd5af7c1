"""What is drawn twice is told of, across the seam too."""

from __future__ import annotations

import pytest

from batik_vector.certificate import Kind, certify
from tests.certificate.tiles import LINES, OVERLAY, PEN, WAX, accused, added, tile


def test_a_line_along_both_edges_of_a_seam() -> None:
    broken = added(tile(), PEN, lines=[[(0, 40), (0, 50)], [(100, 42), (100, 50)]])
    fault = accused(broken, Kind.DOUBLE, (0, 46))
    assert fault.amount == pytest.approx(8)
    assert certify(broken).worst.doubled_length == pytest.approx(8)


def test_a_line_along_both_edges_with_a_drop() -> None:
    from fractions import Fraction

    lines = [[(0, 40), (0, 50)], [(100, 62), (100, 70)]]
    broken = added(tile(Fraction(1, 4)), PEN, lines=lines)
    assert accused(broken, Kind.DOUBLE, (0, 46)).amount == pytest.approx(8)


def test_a_stretch_that_two_lines_share_inside() -> None:
    broken = added(tile(), PEN, lines=[[(40, 10), (50, 15)], [(44, 12), (60, 20)]])
    fault = accused(broken, Kind.DOUBLE, (47, 13.5))
    assert fault.amount == pytest.approx(6 * 1.25**0.5)


def test_a_line_drawn_again_a_hair_beside() -> None:
    again = [(40, 10.0034567), (50, 15.003)]
    broken = added(tile(), PEN, lines=[again, [(40, 10), (45, 12.5), (50, 15)]])
    assert accused(broken, Kind.DOUBLE, (47.5, 13.75)).amount == pytest.approx(10 * 1.25**0.5, rel=0.01)


def test_lines_that_cross_touch_or_run_apart_are_not_doubled() -> None:
    lines = [
        *LINES,
        [(40, 10), (50, 15)],
        [(40, 15), (50, 10)],
        [(50, 15), (60, 20)],
        [(40, 10.1), (50, 15.1)],
        # It touches the first at a slant so small that it stays near it for a while.
        [(42, 11), (50, 15.03)],
    ]
    assert certify(tile(lines=lines)).worst.doubled_length == 0


def test_an_area_over_another_of_its_ink() -> None:
    broken = added(tile(), WAX, areas=[[(75, 45), (85, 45), (85, 55), (75, 55)]])
    fault = accused(broken, Kind.DOUBLE, (77.5, 47.5))
    assert fault.amount == pytest.approx(25)
    assert certify(broken).worst.doubled_area == pytest.approx(25)


def test_an_overlay_may_overlap_but_not_repeat_a_mark() -> None:
    square, other = [(10, 40), (20, 40), (20, 50), (10, 50)], [(15, 45), (25, 45), (25, 55), (15, 55)]
    assert certify(added(tile(), OVERLAY_INK, areas=[square, other])).faults == ()
    broken = added(tile(), OVERLAY_INK, areas=[square, other, square])
    assert accused(broken, Kind.DOUBLE, (15, 45)).amount == pytest.approx(100)


def test_neighbours_that_overlap_by_rounding_are_let_pass() -> None:
    areas = [[(10, 40), (20.0004, 40), (20.0004, 50), (10, 50)], [(20, 40), (30, 40), (30, 50), (20, 50)]]
    assert certify(added(tile(), WAX, areas=areas)).faults == ()


OVERLAY_INK = type(OVERLAY)("top", "#ffffff", overlap=OVERLAY.overlap)
