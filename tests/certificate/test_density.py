"""Striping is measured exactly, and blurred as the eye does at arm's length."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from batik_vector.artwork import Artwork, Cell, DropAxis, Layer
from batik_vector.certificate import certify
from batik_vector.certificate.density import BINS, BLUR_MM, profile
from batik_vector.certificate.drawing import drawing
from tests.certificate.tiles import PEN, WAX, marks, strokes, tile


def bars(count: int, width: float, cell: Cell) -> Artwork:
    step = cell.width / count
    shapes = [
        [(i * step, 0), (i * step + width, 0), (i * step + width, cell.height), (i * step, cell.height)]
        for i in range(count)
    ]
    return Artwork("bars", cell, (Layer(WAX, marks(shapes)),))


CELL = Cell(200_000, 100_000)


def test_profiles_add_up_to_what_is_covered() -> None:
    art = drawing(tile())
    for ink, layer in zip(art, tile().layers, strict=True):
        covered = sum(area.area for area in layer.areas)
        covered += sum(line.length for line in layer.lines) * ink.ink.width
        for axis in (0, 1):
            found = profile(ink, art.frame, axis)
            assert found.mean() == pytest.approx(covered / 8000)
            assert found.min() >= -1e-12


def test_broad_bars_are_stripes_and_fine_ones_are_texture() -> None:
    broad = certify(bars(2, 50, CELL), symmetry=False).worst
    fine = certify(bars(40, 2.5, CELL), symmetry=False).worst
    # A square wave of period 100 mm stays as it is: from nothing to twice the mean.
    assert broad.columns == pytest.approx(200, abs=1)
    assert fine.columns < 1
    assert broad.rows == pytest.approx(0, abs=1e-6)


def test_the_blur_is_the_stated_one() -> None:
    period = 25.0
    found = certify(bars(8, period / 2, CELL), symmetry=False).worst.columns
    first = 800 / np.pi * np.exp(-2 * (np.pi * BLUR_MM / period) ** 2)
    third = 800 / np.pi / 3 * np.exp(-2 * (np.pi * BLUR_MM * 3 / period) ** 2)
    assert found == pytest.approx(first - third, rel=0.01)


def test_rows_of_a_half_drop_stand_against_each_other() -> None:
    band = [(0, 0), (100, 0), (100, 40), (0, 40)]
    straight = Artwork("band", Cell(100_000, 80_000), (Layer(WAX, marks([band])),))
    dropped = replace(straight, cell=Cell(100_000, 80_000, Fraction(1, 2), DropAxis.COLUMN))
    assert certify(straight, symmetry=False).worst.rows > 190
    assert certify(dropped, symmetry=False).worst.rows == pytest.approx(0, abs=1e-6)


def test_lines_count_with_their_breadth() -> None:
    line = Artwork("line", CELL, (Layer(PEN, lines=strokes([[(50, 0), (50, 100)]])),))
    art = drawing(line)
    found = profile(art.inks[0], art.frame, 0)
    assert found.max() == pytest.approx(PEN.width / (200 / BINS))
    assert np.count_nonzero(found) == 1
