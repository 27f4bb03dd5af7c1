"""Nothing is drawn twice, not even what rounding parted."""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.tiling.torus.torus import Window
from batik_vector.tiling.welding.duplicates import aligned, drawn_once

WINDOW = Window(0, 0, 10_000, 10_000)


def test_copies_that_rounding_parts_by_a_step_are_drawn_once() -> None:
    one = np.array([(100, 100), (2000, 700), (4000, 5000), (9000, 9000)])
    other = (one + [(0, 1), (-1, 0), (0, 0), (1, -1)])[::-1]
    lines = np.asarray([shapely.LineString(one), shapely.LineString(other)], dtype=object)
    once, names = drawn_once(aligned(lines, WINDOW), np.arange(2))
    assert len(once) == 1
    assert names.tolist() == [0]
    assert once[0].hausdorff_distance(lines[0]) <= 2
    # Without that both stay, and so do lines that stand farther apart.
    assert len(drawn_once(lines, np.arange(2))[0]) == 2
    apart = np.asarray([lines[0], shapely.LineString(one + [3, 0])], dtype=object)
    assert len(drawn_once(aligned(apart, WINDOW), np.arange(2))[0]) == 2


def test_ends_on_the_seam_stay_where_they_are() -> None:
    lines = np.asarray(
        [shapely.LineString([(0, 500), (4000, 900)]), shapely.LineString([(0, 501), (4000, 900)])],
        dtype=object,
    )
    assert shapely.equals_exact(aligned(lines, WINDOW), lines).all()
