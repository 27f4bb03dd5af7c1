"""Slits and strips along the seam are told of; a drawing's own are not."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork, Cell, Layer
from batik_vector.certificate import Kind, certify
from tests.certificate.test_crossings import shrunk
from tests.certificate.tiles import AREAS, LINES, PEN, WAX, accused, added, listed, marks, tile


def test_a_slit_that_neither_edge_shows() -> None:
    broken = shrunk(shrunk(tile(), 100, 0.006), 0, -0.006)
    fault = accused(broken, Kind.SLIVER, (0, 23))
    assert fault.amount == pytest.approx(0.012)
    assert "a slit of bare ground 0.012 mm wide" in fault.words
    assert [each.kind for each in certify(broken).faults] == [Kind.SLIVER]
    assert certify(broken).worst.slivers == pytest.approx(6, abs=0.01)


@pytest.mark.parametrize("x", [0.0, 0.1, 99.7])
def test_a_strip_of_ink_along_the_seam(x: float) -> None:
    broken = added(tile(), WAX, areas=[[(x, 40), (x + 0.01, 40), (x + 0.01, 55), (x, 55)]])
    fault = accused(broken, Kind.SLIVER, (x, 47.5))
    assert fault.amount == pytest.approx(0.01)
    assert "strip of ink" in fault.words


def test_a_strip_along_the_lower_edge() -> None:
    broken = added(tile(), WAX, areas=[[(10, 0.2), (25, 0.2), (25, 0.212), (10, 0.212)]])
    assert "along the lower edge" in accused(broken, Kind.SLIVER, (17, 0.2)).words


def test_two_lines_side_by_side_along_the_seam() -> None:
    broken = added(tile(), PEN, lines=[[(0.004, 40), (0.004, 55)], [(99.996, 41), (99.996, 52)]])
    fault = accused(broken, Kind.SLIVER, (0, 46))
    assert "two lines side by side" in fault.words


def test_two_lines_that_the_seam_does_not_part_are_the_drawings_own() -> None:
    """A curve that crosses an upright mirror at a right angle, near the lower edge, and its image."""
    across = [[(0, 0.2), (15, 0.2), (16, 5)], [(0, 0.2), (15, 0.21), (17, 6)]]
    assert certify(tile(lines=[*LINES, *across, [(-9, 0.2), (0, 0.2)]])).faults == ()


def test_a_strip_like_those_elsewhere_is_the_drawings_own() -> None:
    strips = [[(x, 40), (x + 0.01, 40), (x + 0.01, 55), (x, 55)] for x in (0.1, 20.1, 40.1)]
    assert certify(added(tile(), WAX, areas=strips)).faults == ()


def test_a_mark_that_reaches_over_the_seam_by_a_hair_is_no_strip() -> None:
    areas = [*AREAS, [(-0.01, 40), (9, 40), (9, 50), (-0.01, 50)]]
    assert certify(tile(areas=areas, lines=LINES)).faults == ()


def test_a_notch_beside_the_seam_in_ink_that_hangs_together_leaves_no_strip() -> None:
    """Ink of the field is looked at whole, and ends with the tile where nobody looks: no edge of it."""
    notch = [(10, 0.01), (10, 9), (14, 3), (14, 0.01)]
    areas = listed([shapely.Polygon([(0, 0), (60, 0), (60, 60), (0, 60)], [notch])])
    whole = Artwork("whole", Cell(60_000, 60_000), (Layer(WAX, areas),))
    assert certify(whole, symmetry=False).faults == ()


def test_slanting_needles_at_the_seam_are_the_drawings_own() -> None:
    needle = [(-3, 40), (3, 46), (3, 46.01), (-3, 40.01)]
    assert certify(tile(areas=[*AREAS, needle])).faults == ()


def test_a_sliver_is_told_once() -> None:
    bar = np.array([(10.0, 0.01), (30.0, 0.01), (30.0, 20.0), (10.0, 20.0)])
    rest = np.array([(10.0, 30.0), (30.0, 30.0), (30.0, 60.0), (10.0, 60.0)])
    torn = Artwork("torn", Cell(60_000, 60_000), (Layer(WAX, marks([bar, rest])),))
    found = [fault for fault in certify(torn, symmetry=False).faults if fault.kind is Kind.SLIVER]
    assert len(found) == 1
    assert found[0].where == pytest.approx((20.0, 0.005))
    assert certify(torn, symmetry=False).worst.slivers == pytest.approx(20.0)
