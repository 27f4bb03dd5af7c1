"""Copies: what is one mark, moved, turned or mirrored, is found to be one; what is not is kept apart."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Geometries
from batik_vector.drafting.copies import found_copies, posed

quick = settings(max_examples=40, deadline=None, derandomize=True)
TOLERANCE = 0.02


def star(points: int, inner: float, outer: float) -> shapely.Polygon:
    angle = np.arange(2 * points) * np.pi / points
    radius = np.where(np.arange(2 * points) % 2, inner, outer)
    return shapely.Polygon(np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]))


LEAF = shapely.Polygon([(0, 0), (4, 1), (5, 3), (2, 2.5), (0.5, 2)])
DOT = shapely.Point(0, 0).buffer(2, quad_segs=24)
MARKS = {
    "leaf": LEAF,
    "star": star(5, 1.0, 2.5),
    "gear": star(16, 2.4, 2.6),
    "dot": DOT,
    "ring round a star": shapely.Point(0, 0).buffer(3).difference(star(5, 0.5, 1.0)),
    "thin triangle": shapely.Polygon([(0, 0), (9, 0.2), (0, 0.4)]),
}


def array(*shapes: shapely.Geometry) -> Geometries:
    found = np.empty(len(shapes), dtype=object)
    found[:] = shapes
    return found


def laid(shape: shapely.Geometry, turn: float, mirrored: bool, x: float, y: float) -> shapely.Geometry:
    found: shapely.Geometry = posed(turn, mirrored, (x, y)).apply(array(shape))[0]
    return found


poses = st.tuples(st.floats(-180, 180), st.booleans(), st.floats(-300, 300), st.floats(-300, 300))


@quick
@given(st.sampled_from(sorted(MARKS)), st.lists(poses, min_size=1, max_size=6))
def test_a_mark_is_known_however_it_lies(name: str, others: list[tuple[float, bool, float, float]]) -> None:
    shapes = array(MARKS[name], *(laid(MARKS[name], *pose) for pose in others))
    copies = found_copies(shapes, np.zeros(len(shapes), int), TOLERANCE)
    assert len(copies.heads) == 1
    # What is found draws each of them.
    at = shapely.centroid(shapes[0])
    head = posed(0, False, (-at.x, -at.y)).apply(shapes[:1])
    again = copies.maps().apply(head)
    assert shapely.hausdorff_distance(again, shapes).max() <= 2 * TOLERANCE


def test_marks_that_differ_are_kept_apart() -> None:
    shapes = array(*MARKS.values(), star(5, 1.05, 2.5), star(15, 2.4, 2.6))
    copies = found_copies(shapes, np.zeros(len(shapes), int), TOLERANCE)
    assert copies.kind.tolist() == list(range(len(shapes)))


def test_marks_of_two_inks_are_no_copies() -> None:
    copies = found_copies(array(DOT, DOT), np.array([0, 1]), TOLERANCE)
    assert copies.kind.tolist() == [0, 1]


@pytest.mark.parametrize("off", [0.0, 0.013])
def test_vertices_need_not_be_the_same(off: float) -> None:
    # As two curves are divided that a page cuts, and as decimals are rounded off.
    xy = shapely.get_coordinates(shapely.segmentize(LEAF, 0.3))[:-1]
    moved = shapely.Polygon(xy + np.where(np.arange(len(xy)) % 3 == 0, off, 0.0)[:, None])
    copies = found_copies(array(LEAF, moved), np.zeros(2, int), TOLERANCE)
    assert copies.kind.tolist() == [0, 0]


def test_two_hundred_dots_are_one_mark_that_lies_as_it_is() -> None:
    places = np.random.default_rng(3).uniform(0, 300, (200, 2))
    dots = array(*(laid(DOT, 0.0, False, x, y) for x, y in places.tolist()))
    copies = found_copies(dots, np.zeros(200, int), TOLERANCE)
    assert len(copies.heads) == 1
    assert not copies.turn.any()
    assert not copies.mirrored.any()
