"""Merged cells cover what their cells cover, apart where only corners meet, and go on over their edges."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from batik_vector.errors import TooLargeError
from batik_vector.geometry import work
from batik_vector.geometry.generators.cells import merged
from batik_vector.geometry.maps.affine import Affine

SLOW = [HealthCheck.too_slow]
"""Others may be at work on the machine."""

GRIDS = arrays(np.bool_, st.tuples(st.integers(1, 7), st.integers(1, 7)))


def squares(cells: np.ndarray) -> shapely.Geometry:
    return shapely.union_all([shapely.box(x, y, x + 1, y + 1) for y, x in np.argwhere(cells)])


@settings(max_examples=60, deadline=None, derandomize=True, suppress_health_check=SLOW)
@given(GRIDS)
def test_sharp_cells_are_their_union(cells: np.ndarray) -> None:
    areas = merged(cells, 0.0, 0.01)
    assert shapely.is_valid(areas).all()
    assert shapely.area(shapely.symmetric_difference(squares(cells), shapely.union_all(areas))) < 1e-9
    # Cells that share sides are one, those that share a corner are not.
    shrunk = shapely.get_parts(shapely.buffer(squares(cells), -0.01, join_style="mitre"))
    assert len(areas) == (~shapely.is_empty(shrunk)).sum()


@settings(max_examples=40, deadline=None, derandomize=True, suppress_health_check=SLOW)
@given(GRIDS, st.floats(0.1, 1.0))
def test_round_ones_that_go_on_meet_at_their_edges(cells: np.ndarray, share: float) -> None:
    rows, columns = cells.shape
    areas = merged(cells, share, 0.002, periodic=True)
    field = merged(np.tile(cells, (3, 3)), share, 0.002, periodic=True)
    copies = [Affine.translation((x * columns, y * rows)).apply(areas) for x in range(3) for y in range(3)]
    whole = shapely.union_all(np.concatenate(copies)) if len(areas) else shapely.Polygon()
    assert shapely.area(shapely.symmetric_difference(whole, shapely.union_all(field))) < 1e-6


def test_a_round_cell_is_a_circle() -> None:
    (area,) = merged(np.ones((1, 1), bool), 1.0, 1e-4)
    assert area.area == pytest.approx(np.pi / 4, rel=1e-3)


def test_cells_with_too_many_corners_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    checks = np.indices((40, 40)).sum(axis=0) % 2 == 0
    assert len(merged(checks, 0.0, 0.01)) == 800
    monkeypatch.setattr(work, "LIMIT", 3200 * work.PER_CELL_CORNER - 1)
    with pytest.raises(TooLargeError, match="vertices to bend or overlay, more than fits"):
        merged(checks, 0.0, 0.01)
