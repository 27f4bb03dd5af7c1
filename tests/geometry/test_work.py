"""Foretold work: crossings are counted about right, and work past the limit is refused before it is done."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.errors import TooLargeError
from batik_vector.geometry import work


def chords(count: int) -> shapely.LineString:
    return shapely.LineString(np.random.default_rng(1).random((count, 2)))


@pytest.mark.parametrize("count", [50, 300, 1500])
def test_crossings_of_a_line_are_counted_about_right(count: int) -> None:
    line = chords(count)
    met = shapely.get_num_geometries(shapely.union_all([line]))
    true = (met - (count - 1)) / 2
    assert work.self_crossings(np.array([line])) == pytest.approx(true, rel=0.2)


def test_crossings_of_one_line_with_another_count_only_together() -> None:
    cross = shapely.linestrings([[(0, 0), (2, 2)], [(0, 2), (2, 0)]])
    assert work.self_crossings(cross) == 1
    assert work.self_crossings(cross, each=True) == 0


def test_a_tangle_is_refused_and_a_circle_of_as_many_vertices_is_not() -> None:
    tangle = np.array([chords(3000)])
    with pytest.raises(TooLargeError, match=r"cross about [\d,]+ times"):
        work.spend_on_lines(tangle)
    work.spend_on_lines(np.array([shapely.Point(0, 0).buffer(1, quad_segs=750).exterior]))


def test_an_account_adds_up_what_is_spent_inside_it() -> None:
    half = 0.6 * work.LIMIT
    work.spend(half)
    work.spend(half)
    with work.account():
        work.spend(half)
        with pytest.raises(TooLargeError):
            work.spend(half)
    work.spend(half)


def test_discs_that_all_lie_on_one_another_are_refused_and_those_apart_are_not() -> None:
    rng = np.random.default_rng(2)
    for spread, fits in ((40_000.0, True), (1.0, False)):
        centres = shapely.points(rng.random((30_000, 2)) * spread)
        discs = np.asarray(shapely.buffer(centres, 1.0), dtype=object)
        if fits:
            work.spend_on_shapes([discs])
        else:
            with pytest.raises(TooLargeError):
                work.spend_on_shapes([discs])
