"""Foretold work: crossings are counted about right, and work past the limit is refused before it is done."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

from batik_vector.errors import TooLargeError
from batik_vector.geometry import work


def chords(count: int) -> shapely.LineString:
    return shapely.LineString(np.random.default_rng(1).random((count, 2)))


@pytest.mark.parametrize("count", [50, 300, 900])
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


def test_an_account_inside_an_account_is_the_same() -> None:
    half = 0.6 * work.LIMIT
    with work.account():
        work.spend(half)
        with pytest.raises(TooLargeError), work.account():
            work.spend(half)


def strips(count: int) -> NDArray[np.object_]:
    """Thin strips across one another: united, they leave a hole wherever four of them meet."""
    lines = shapely.linestrings(np.random.default_rng(3).random((count, 2, 2)))
    return np.asarray(shapely.buffer(lines, 1e-5, quad_segs=2), dtype=object)


def discs(count: int, spread: float) -> NDArray[np.object_]:
    centres = shapely.points(np.random.default_rng(2).random((count, 2)) * spread)
    return np.asarray(shapely.buffer(centres, 1.0), dtype=object)


def test_strips_that_cross_are_refused_and_discs_are_not_whose_crossings_lie_inside_others() -> None:
    # As many crossings, about, of the same number of shapes.
    work.foretell_union([discs(2000, 8.0)])
    with pytest.raises(TooLargeError, match=r"cross about [\d,]+ times"):
        work.foretell_union([strips(2000)])


def test_discs_are_refused_where_far_too_many_lie_on_one_another_and_not_where_they_lie_apart() -> None:
    work.foretell_union([discs(30_000, 40_000.0)])
    with pytest.raises(TooLargeError):
        work.foretell_union([discs(30_000, 1.0)])


def test_what_is_foretold_is_not_spent(monkeypatch: pytest.MonkeyPatch) -> None:
    shapes = discs(400, 100.0)
    monkeypatch.setattr(work, "LIMIT", 2.0 * shapely.get_num_coordinates(shapes).sum())
    with work.account():
        for _ in range(5):
            work.foretell_union([shapes])


def test_a_union_costs_the_crossings_that_it_leaves(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(work, "SMALL", 500)
    shapes = strips(100)
    made = np.array([shapely.union_all(shapes)])
    vertices, left = (int(shapely.get_num_coordinates(each).sum()) for each in (shapes, made))
    monkeypatch.setattr(work, "LIMIT", vertices + work.PER_CROSSING * (left - vertices) * 0.9)
    work.spend_on_union(shapes, shapes)
    with pytest.raises(TooLargeError):
        work.spend_on_union(shapes, made)


@pytest.mark.parametrize("sizes", [[], [5], [3, 4, 5, 1], [20, 1, 1, 30], [1] * 25])
def test_batches_are_all_rows_in_order_and_hold_no_more_than_they_may(sizes: list[int]) -> None:
    rows = np.array(sizes, np.int64)
    found = [rows[each] for each in work.batches(rows, 10)]
    assert [size for each in found for size in each.tolist()] == sizes
    assert all(each.sum() <= 10 or len(each) == 1 for each in found)


def zigzag(turns: int, pitch: float) -> shapely.LineString:
    x = np.arange(2 * turns) * pitch / 2
    return shapely.LineString(np.column_stack([x, np.arange(2 * turns) % 2]))


def test_to_grow_strands_that_lie_close_costs_their_crossings(monkeypatch: pytest.MonkeyPatch) -> None:
    apart, dense = (np.array([zigzag(400, pitch)], dtype=object) for pitch in (4.0, 0.01))
    vertices = shapely.get_num_coordinates(apart).sum()
    monkeypatch.setattr(work, "LIMIT", 2 * work.PER_GROWN_VERTEX * vertices)
    work.spend_on_growth(apart, 0.2)
    work.spend_on_growth(dense, 0.001)
    with pytest.raises(TooLargeError, match="cross about"):
        work.spend_on_growth(dense, 0.2)
