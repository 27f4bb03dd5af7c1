"""Congruent work is done once, and comes out as if each copy had been worked on by itself."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.errors import TooLargeError
from batik_vector.tiling.torus import overlay
from batik_vector.tiling.welding.congruent import Copies, Stock
from batik_vector.tiling.welding.cuts import cut, touched
from batik_vector.tiling.welding.sheets import Laid
from batik_vector.tiling.welding.weld import unions, weld, welded

FLOWER = shapely.Point(0, 0).buffer(4_000, quad_segs=6)
LEAF = shapely.Polygon([(0, 0), (9_000, 1_000), (12_000, 5_000), (3_000, 4_000)])


def on_grid(shape: shapely.Polygon) -> shapely.Polygon:
    return shapely.transform(shape, np.rint)


def placed(shape: shapely.Polygon, *places: tuple[int, int]) -> np.ndarray:
    return np.array([shapely.affinity.translate(on_grid(shape), x, y) for x, y in places], dtype=object)


def test_copies_are_found_wherever_their_rings_begin() -> None:
    ring = np.array(on_grid(LEAF).exterior.coords)[:-1]
    turned = [shapely.Polygon(np.roll(ring, k, axis=0) + [k * 20_000, 7]) for k in range(4)]
    stock = Stock()
    copies = stock.taken_up(np.array(turned, dtype=object))
    assert len(stock.shapes) == 1
    assert all(shapely.equals(stock.geometries(copies), np.array(turned, dtype=object)))


def test_a_hole_makes_a_shape_another() -> None:
    outer, hole = shapely.box(0, 0, 90, 90), shapely.box(30, 30, 60, 60)
    stock = Stock()
    stock.taken_up(np.array([outer, outer.difference(hole), outer], dtype=object))
    assert len(stock.shapes) == 2


def test_marks_in_mm_come_to_the_grid_as_copies_and_the_torn_are_mended() -> None:
    sliver = shapely.Polygon([(0, 0), (10, 0.0004), (20, 0), (10, 0.0003)])
    thin = np.array([shapely.transform(sliver, lambda xy: xy * 1000)], dtype=object)
    marks = np.concatenate([placed(FLOWER, (0, 0), (50_000, 3)), thin])
    stock = Stock()
    copies, of = stock.settled(shapely.transform(marks, lambda xy: xy / 1000))
    assert set(of.tolist()) >= {0, 1}
    assert copies.kind[0] == copies.kind[1]
    assert (copies.shift[1] - copies.shift[0]).tolist() == [50_000, 3]
    assert shapely.is_valid(stock.geometries(copies)).all()


def counted(monkeypatch: pytest.MonkeyPatch, name: str) -> list[int]:
    """Return a list to which every call of a shapely function adds how many vertices it is given."""
    true, seen = getattr(shapely, name), list[int]()

    def call(first: np.ndarray, *rest: object, **named: object) -> object:
        seen.append(int(shapely.get_num_coordinates(first).sum()))
        return true(first, *rest, **named)

    monkeypatch.setattr(shapely, name, call)
    return seen


PLANE = ((10**8, 0), (0, 10**8))
"""A lattice so wide that nothing meets its own repeat."""

PAIR = [(0, 0), (5_000, 1_000)]
FAR = [(x * 40_000, y * 30_000) for x in range(20) for y in range(10)]


def test_pairs_that_lie_alike_are_welded_once(monkeypatch: pytest.MonkeyPatch) -> None:
    marks = np.concatenate([placed(FLOWER, *((x + a, y + b) for a, b in PAIR)) for x, y in FAR])
    expected = shapely.union_all(marks)
    united = counted(monkeypatch, "union_all")
    joined, first = welded(marks)
    assert united == [2 * len(FLOWER.exterior.coords)]
    assert len(joined) == len(FAR)
    assert first.tolist() == list(range(0, 2 * len(FAR), 2))
    assert shapely.union_all(joined).symmetric_difference(expected).area < shapely.length(joined).sum() / 2


def test_marks_that_lie_alike_under_their_cutters_are_cut_once(monkeypatch: pytest.MonkeyPatch) -> None:
    stock = Stock()
    beneath = stock.taken_up(placed(LEAF, *FAR))
    above = stock.taken_up(
        np.concatenate([placed(FLOWER, *((x + a, y + b) for x, y in FAR)) for a, b in PAIR])
    )
    cuts = counted(monkeypatch, "difference")
    left = cut(
        stock,
        Laid(beneath, np.zeros(len(beneath), np.intp)),
        Laid(above, np.ones(len(above), np.intp)),
        PLANE,
    )
    assert cuts == [len(LEAF.exterior.coords)]
    expected = LEAF.difference(shapely.union_all(placed(FLOWER, *PAIR))).area * len(FAR)
    assert shapely.area(stock.geometries(left.copies)).sum() == pytest.approx(expected, rel=1e-4)


places = st.tuples(st.integers(0, 12), st.integers(0, 12)).map(lambda p: (p[0] * 1_700, p[1] * 1_300))
layers = st.lists(
    st.tuples(st.sampled_from([FLOWER, LEAF]), places, st.integers(0, 3)), min_size=1, max_size=14
)


@settings(max_examples=60, deadline=None)
@given(layers, layers)
def test_cutting_leaves_what_a_plain_difference_leaves(
    beneath: list[tuple[shapely.Polygon, tuple[int, int], int]],
    above: list[tuple[shapely.Polygon, tuple[int, int], int]],
) -> None:
    stock = Stock()
    marks, cutters = (
        Laid(
            stock.taken_up(np.concatenate([placed(shape, at) for shape, at, _ in part])),
            np.array([sheet for _, _, sheet in part], np.intp),
        )
        for part in (beneath, above)
    )
    hit = touched(stock, marks, cutters, PLANE)
    left = cut(stock, marks, cutters, PLANE)
    whole, away = stock.geometries(marks.copies), stock.geometries(cutters.copies)
    for sheet in range(4):
        expected = [
            mark.difference(shapely.union_all(away[cutters.sheet > sheet]))
            for mark in whole[marks.sheet == sheet]
        ]
        area = shapely.area(stock.geometries(left.copies)[left.sheet == sheet]).sum()
        assert area == pytest.approx(sum(each.area for each in expected), abs=200_000)
        lost = [
            mark.area - each.area > 0
            for mark, each in zip(whole[marks.sheet == sheet], expected, strict=True)
        ]
        assert hit[marks.sheet == sheet].tolist() == lost


def test_only_marks_of_one_group_are_welded() -> None:
    stock = Stock()
    copies = stock.taken_up(placed(FLOWER, (0, 0), (1_000, 0), (2_000, 0)))
    joined, first = weld(stock, copies, np.array([5, 7, 5]))
    assert first.tolist() == [0, 1]
    assert len(joined) == 2


def test_groups_of_many_sizes_are_united_each_by_itself() -> None:
    groups = [placed(FLOWER, *((k * 3_000, 0) for k in range(size))) for size in (2, 3, 5, 2, 9)]
    for whole, group in zip(overlay.united(groups), groups, strict=True):
        assert whole.area == pytest.approx(shapely.union_all(group).area, rel=1e-4)


def test_nothing_at_all_is_no_trouble() -> None:
    stock = Stock()
    none = stock.taken_up(np.empty(0, dtype=object))
    laid = Laid(none, np.empty(0, np.intp))
    assert len(cut(stock, laid, laid, PLANE).sheet) == 0
    assert len(weld(stock, none)[0]) == 0
    assert len(stock.in_mm(Copies(none.kind, none.shift))) == 0


@pytest.mark.parametrize("lattice", [((20_000, 0), (0, 16_000)), ((20_000, 8_000), (0, 16_000))])
@pytest.mark.parametrize("away", [0, 1, -3])
def test_a_mark_is_cut_by_the_repeats_of_its_cutters(
    lattice: tuple[tuple[int, int], tuple[int, int]], away: int
) -> None:
    stock = Stock()
    (ax, ay), (_, by) = lattice
    beneath = Laid(stock.taken_up(placed(LEAF, (15_000, 13_000))), np.zeros(1, np.intp))
    place = (17_000 + away * ax, 14_000 + away * ay - 2 * by)
    above = Laid(stock.taken_up(placed(FLOWER, place)), np.ones(1, np.intp))
    left = cut(stock, beneath, above, lattice)
    repeats = [(place[0] + i * ax, place[1] + i * ay + j * by) for i in range(-6, 7) for j in range(-6, 7)]
    expected = placed(LEAF, (15_000, 13_000))[0].difference(shapely.union_all(placed(FLOWER, *repeats)))
    assert shapely.area(stock.geometries(left.copies)).sum() == pytest.approx(expected.area, rel=1e-3)
    assert touched(stock, beneath, above, lattice).all()


def test_unions_too_large_are_refused_before_they_are_in_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    """A recipe of sixteen thousand petals, twice over, came to 92 million vertices in one array."""
    stock = Stock()
    stock.add(np.array([shapely.Point(0, 0).buffer(9_000, quad_segs=2_500)], dtype=object))
    rows = np.zeros((3_000, 3), np.int64)
    rows[:, 1] = np.arange(3_000)
    monkeypatch.delattr(Stock, "geometries")
    with pytest.raises(TooLargeError, match="shapes of about 30,000,000 vertices"):
        unions(stock, rows, np.array([0, 1, 2_999, 3_000]), np.arange(3))
