"""A kink that only the seam explains is told of; the drawing's own turns are not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from batik_vector.certificate import Kind, certify
from batik_vector.certificate.drawing import edges
from tests.certificate.tiles import AREAS, LINES, accused, tile, vertex_moved

KINK = np.tan(np.arctan(0.1) - np.radians(1))
"""Slope of a border that arrives at the seam one degree too flat."""


def test_a_border_that_turns_by_one_degree() -> None:
    broken = vertex_moved(tile(), "wax", (70, 23), (0, 30 * (0.1 - KINK)))
    fault = accused(broken, Kind.TANGENT, (100, 26))
    # Edges of 30 mm that keep 0.02 mm may turn by 0.46° there; finer ones by less.
    assert 0.5 < fault.amount < 0.6
    assert 0.95 < accused(replace(broken, tolerance=0.001), Kind.TANGENT, (100, 26)).amount <= 1
    assert "turns by 1.00°" in fault.words
    assert [each.kind for each in certify(broken).faults] == [Kind.TANGENT]
    assert certify(broken).worst.turn == pytest.approx(fault.amount)


def test_a_line_that_turns_by_one_degree() -> None:
    slope = np.tan(np.arctan(0.2) + np.radians(1))
    broken = vertex_moved(tile(), "pen", (20, 64), (0, 20 * slope - 4))
    fault = accused(replace(broken, tolerance=0.001), Kind.TANGENT, (0, 60))
    assert fault.ink == "pen"
    assert 0.95 < fault.amount <= 1
    # It ends at its next vertices; edges of 20 mm that keep 0.02 mm may turn by 0.7° between them.
    assert 0.25 < accused(broken, Kind.TANGENT, (0, 60)).amount < 0.35


def test_a_corner_on_the_seam_is_the_drawings_own() -> None:
    leaf = [(-8, 40), (0, 37), (8, 42), (0, 45)]
    certificate = certify(tile(areas=[*AREAS, leaf]))
    assert certificate.faults == ()
    assert certificate.worst.corners == 2


def test_a_border_that_the_seam_mirrors_may_turn() -> None:
    roof = [(-20, 40), (0, 41), (20, 40), (20, 44), (0, 45), (-20, 44)]
    certificate = certify(tile(areas=[*AREAS, roof]))
    assert certificate.faults == ()
    assert certificate.worst.corners == 0


def test_a_curve_with_a_vertex_on_the_seam_may_turn_as_it_does_elsewhere() -> None:
    angles = np.linspace(0, 2 * np.pi, 90, endpoint=False) + 0.3
    disc = np.column_stack([np.cos(angles), np.sin(angles)]) * 12
    disc -= [disc[7, 0], -45]
    turn = certify(tile(areas=[*AREAS, np.round(disc, 3)], lines=LINES)).worst.turn
    assert turn == 0


def test_the_way_into_the_end_of_an_open_line_is_known() -> None:
    found = edges(np.array([(0, 0), (10, 0), (20, 10), (20, 30)], np.int64), np.array([0, 4]))
    assert np.degrees(found.turn_begin).tolist() == pytest.approx([np.inf, 45, 45])
    assert np.degrees(found.turn_end).tolist() == pytest.approx([45, 45, np.inf])
