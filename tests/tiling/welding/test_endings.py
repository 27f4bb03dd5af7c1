"""Where lines end on the seam: places from which all of them run one way."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Cell
from batik_vector.tiling.welding.endings import lone_ends

CELL = Cell(100, 80)
ALONG = [(20, 0), (50, 0)]
"""A line on the lower edge."""


@pytest.mark.parametrize(
    ("lines", "lone"),
    [
        ([ALONG], {(20, 0), (50, 0)}),
        # The image beyond a mirror lies on the line; one of the two is dropped later.
        ([ALONG, ALONG], {(20, 0), (50, 0)}),
        ([ALONG, ALONG[::-1]], {(20, 0), (50, 0)}),
        ([ALONG, [(30, 0), (50, 0)]], {(20, 0), (30, 0), (50, 0)}),
        ([ALONG, [(50, 80), (70, 60)]], {(20, 0)}),
        ([ALONG, [(50, 0), (70, 0)]], {(20, 0), (70, 0)}),
        ([[(10, 10), (10, 80)], [(10, 0), (10, 5)]], set()),
    ],
)
def test_lines_end_where_all_of_them_run_one_way(
    lines: list[list[tuple[int, int]]], lone: set[tuple[int, int]]
) -> None:
    found = lone_ends(np.array([shapely.LineString(line) for line in lines], dtype=object), CELL)
    assert found == lone
