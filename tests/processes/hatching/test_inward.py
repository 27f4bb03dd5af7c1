"""Rings drawn in by their edges, beside GEOS, which draws polygons in another way."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from batik_vector.geometry.outlines import Outlines, of_polygons
from batik_vector.processes.hatching.filling import hatched
from batik_vector.processes.hatching.inward import moved_in, round_one_place
from batik_vector.processes.hatching.options import ConcentricHatch, SpiralHatch
from batik_vector.processes.hatching.regions import Regions
from tests.thorough import examples, long

from .shapes import areas, lines, outlines, unpainted

DUMBBELL = shapely.union_all([shapely.box(0, 0, 9, 9), shapely.box(8, 4, 20, 5), shapely.box(19, 0, 29, 9)])


def flowers(count: int, mm: float = 3.0) -> NDArray[np.object_]:
    """Flowers in steps, no two alike, side by side."""
    angle = 2 * np.pi * np.arange(80) / 80
    k = np.arange(count)[:, None]
    radius = mm * 1000 * (1 + (0.1 + 0.2 * k / count) * np.cos((3 + k % 4) * angle + k))
    x = np.rint(radius * np.cos(angle) + 4 * mm * 1000 * k)
    return np.asarray(shapely.polygons(np.stack([x, np.rint(radius * np.sin(angle))], axis=-1)))


def rounded(shapes: NDArray[np.object_], distance: float) -> NDArray[np.object_]:
    """What lies so far within, its inner corners round as they truly are."""
    return np.asarray(shapely.buffer(shapes, -distance, quad_segs=64))


@long
@settings(max_examples=examples(40, 500), deadline=None, derandomize=True)
@given(areas(), st.floats(50, 2000))
def test_what_is_drawn_in_is_what_lies_within(shapes: NDArray[np.object_], distance: float) -> None:
    assume(len(shapes))
    regions = Regions.of(of_polygons(shapes))
    drawn = regions.drawn_in(distance)
    polygons = drawn.regions.polygons()
    assert shapely.is_valid(polygons).all()
    assert (shapely.area(polygons) > 0).all()
    found = shapely.union_all(polygons)
    true = shapely.union_all(rounded(shapes, distance))
    # GEOS takes small dents for straight, up to a hundredth of the distance.
    assert found.difference(true.buffer(0.02 * distance + 2)).is_empty
    # Corners that point inwards are cut off where their arcs have the middle, at needles 0.42 too far: so
    # narrow necks are shut.
    missed = true.difference(found.buffer(0.45 * distance + 2))
    assert missed.buffer(-0.45 * distance).is_empty


@long
@settings(max_examples=examples(30, 150), deadline=None, derandomize=True)
@given(areas(most=1), st.floats(100, 900), st.floats(100, 900))
def test_two_ways_in_are_one(shapes: NDArray[np.object_], one: float, other: float) -> None:
    assume(len(shapes))
    regions = Regions.of(of_polygons(shapes))
    twice = shapely.union_all(regions.drawn_in(one).regions.drawn_in(other).regions.polygons())
    once = shapely.union_all(rounded(shapes, one + other))
    assert twice.difference(once.buffer(0.02 * (one + other) + 2)).is_empty


@pytest.mark.parametrize("distance", [250.0, 500.0, 1000.0])
def test_flowers_are_drawn_in_as_by_geos(distance: float) -> None:
    shapes = flowers(60)
    drawn = Regions.of(of_polygons(shapes)).drawn_in(distance)
    by_geos = shapely.buffer(shapes, -distance, join_style="mitre", mitre_limit=1.05)
    area = np.bincount(drawn.parents, shapely.area(drawn.regions.polygons()), len(shapes))
    assert area == pytest.approx(shapely.area(by_geos), abs=0.3 * distance * distance)
    assert (drawn.corner >= 0).mean() > 0.9


def test_a_corner_passes_where_half_of_the_way_leads() -> None:
    # Both ends of the roof come to nothing: at half the way four corners, then two.
    box = Regions.of(outlines(shapely.Polygon([(0, 0), (8, 0), (8, 3), (7.9, 3.1), (4, 3.5), (0, 3)])))
    moved = moved_in(box.x, box.y, box.rings, 1000.0, 0.5)
    half = moved_in(box.x, box.y, box.rings, 500.0)
    assert moved.whole.all()
    passed = np.concatenate([moved.passed, moved.merged])
    assert sorted(np.rint(passed).tolist()) == sorted(np.rint(np.column_stack([half.x, half.y])).tolist())


def test_edges_go_in_the_order_in_which_they_come_to_nothing() -> None:
    # The short edge beside an inner corner goes first; the one after it then grows again.
    shape = shapely.Polygon([(0, 0), (20, 0), (20, 10), (12, 10), (11.7, 9.4), (11.2, 9.9), (0, 10)])
    drawn = Regions.of(outlines(shape)).drawn_in(1500.0)
    found = shapely.union_all(drawn.regions.polygons())
    true = rounded(np.array([shapely.transform(shape, lambda p: p * 1000)]), 1500.0)[0]
    assert found.symmetric_difference(true).area < 0.15 * 1500.0**2


@pytest.mark.parametrize(
    ("shape", "distance", "count"),
    [
        (shapely.box(0, 0, 10, 4), 2.1, 0),
        (shapely.box(0, 0, 10, 4), 1.9, 1),
        (shapely.Polygon([(0, 0), (30, 1), (0, 2)]), 0.9, 1),
        (shapely.Polygon([(0, 0), (30, 1), (0, 2)]), 1.0, 0),
        (DUMBBELL, 1, 2),
        (shapely.box(0, 0, 20, 20) - shapely.box(8, 8, 12, 12), 3.9, 1),
        (shapely.box(0, 0, 20, 20) - shapely.box(4, 9, 16, 11), 2.5, 2),
        (shapely.box(0, 0, 20, 20) - shapely.box(2, 2, 18, 18), 1.3, 0),
    ],
)
def test_regions_vanish_part_and_keep_their_holes(shape: BaseGeometry, distance: float, count: int) -> None:
    drawn = Regions.of(outlines(shape)).drawn_in(distance * 1000)
    assert len(drawn.regions) == count
    true = rounded(np.array([shapely.transform(shape, lambda p: p * 1000)]), distance * 1000)[0]
    found = shapely.union_all(drawn.regions.polygons())
    assert found.difference(true.buffer(20)).is_empty
    assert true.area - found.area <= 0.8 * (1000 * distance) ** 2


def test_which_way_rings_go_makes_no_difference() -> None:
    ring = shapely.box(0, 0, 20, 20) - shapely.box(8, 8, 12, 12)
    given_so = outlines(ring)
    back = Outlines(
        given_so.points[[3, 2, 1, 0, 7, 6, 5, 4]], given_so.rings, given_so.marks, given_so.closed
    )
    a, b = (
        shapely.union_all(Regions.of(each).drawn_in(700.0).regions.polygons()) for each in (given_so, back)
    )
    assert a.equals(b)


def test_rings_that_cross_themselves_are_not_taken_for_round() -> None:
    turn = np.radians(np.arange(0, 720, 144))
    rings = np.array([0, 5, 9])
    x = np.concatenate([[0, 4, 4, 0, 2], [0, 4, 4, 0]]).astype(float)
    y = np.concatenate([[0, 4, 0, 4, 9], [0, 0, 4, 4]]).astype(float)
    assert round_one_place(x, y, rings).tolist() == [False, True]
    back = round_one_place(np.cos(turn)[::-1].copy(), np.sin(turn)[::-1].copy(), np.array([0, 5]))
    assert back.tolist() == [False]


@pytest.mark.parametrize("spec", [ConcentricHatch(), SpiralHatch()])
def test_marks_that_are_all_different_are_hardly_ever_drawn_in_one_by_one(
    spec: ConcentricHatch | SpiralHatch, monkeypatch: pytest.MonkeyPatch
) -> None:
    buffered = list[int]()
    buffer = shapely.buffer

    def counted(given: NDArray[np.object_], *more: Any, **chosen: Any) -> NDArray[np.object_]:
        buffered.append(len(given))
        return np.asarray(buffer(given, *more, **chosen))

    monkeypatch.setattr(shapely, "buffer", counted)
    strokes = hatched(of_polygons(flowers(100)), spec, 0.5)
    monkeypatch.undo()
    rings = hatched(of_polygons(flowers(100)), ConcentricHatch(), 0.5).closed.sum()
    assert rings > 400
    assert sum(buffered) < rings / 4
    assert unpainted(flowers(100)[:20], hatched(of_polygons(flowers(100)[:20]), spec, 0.5), 0.5) < 0.005
    edges = shapely.MultiLineString(list(shapely.get_rings(flowers(100))))
    assert (shapely.distance(lines(strokes), edges) >= 0.99 * 250 - 1).all()
