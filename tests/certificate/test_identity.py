"""The field cut elsewhere is the tile, to a millionth of a square millimetre, or the place is told."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Cell
from batik_vector.certificate import Kind
from batik_vector.certificate.drawing import Frame, drawing
from batik_vector.certificate.identity import rolled_difference
from batik_vector.certificate.recut import elsewhere
from batik_vector.tiling.cloth.field import with_bleed
from tests.certificate.tiles import accused, tile, vertex_moved


@pytest.mark.parametrize("drop", [Fraction(0), Fraction(1, 2), Fraction(3, 8)])
def test_the_field_cut_elsewhere_is_the_tile(drop: Fraction) -> None:
    art = drawing(tile(drop))
    areas = art.inks[0].areas
    area, where = rolled_difference(areas, elsewhere(areas, art.frame), 1e-6)
    assert area < 1e-9
    assert where is None


def test_areas_that_are_drawn_twice_or_beyond_the_page_are_not_the_field_they_make() -> None:
    frame = Frame(Cell(10_000, 10_000), 1000, True)
    square = shapely.box(0, 2000, 3000, 5000)
    twice = np.array([square, square], dtype=object)
    area, _ = rolled_difference(twice, elsewhere(twice, frame), 1e-6)
    assert area == pytest.approx(9)
    over = np.array([shapely.box(8000, 2000, 11_000, 5000), shapely.box(0, 3000, 2000, 4000)], dtype=object)
    area, where = rolled_difference(over, elsewhere(over, frame), 1e-6)
    assert area > 0.9
    assert where is not None


def test_a_bleed_that_is_not_the_tile() -> None:
    broken = vertex_moved(with_bleed(tile(), 5), "wax", (105, 26.5), (0, 0.4))
    fault = accused(broken, Kind.IDENTITY, (102, 26.3))
    assert "bleed" in fault.words
    assert fault.amount > 0.1
