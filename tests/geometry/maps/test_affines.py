"""Many maps at once do what each of them does alone."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from batik_vector.errors import GeometryError
from batik_vector.geometry.maps.affine import IDENTITY, Affine
from batik_vector.geometry.maps.affines import Affines, turns

MAPS = [
    Affine.turn(30) @ Affine.scale(2.0, 0.5),
    Affine.mirror(20) @ Affine.translation((1.0, 2.0)),
    Affine(1.0, 0.3, -0.2, 0.9, 4.0, -1.0),
]
HOLED = np.array(
    [shapely.box(0, 0, 3, 2).difference(shapely.box(1, 0.5, 2, 1.5)), shapely.Point(5, 5).buffer(1)],
    dtype=object,
)
LINES = np.array(
    [shapely.LineString([(0, 0), (1, 2), (3, 1)]), shapely.LineString([(1, 1), (0, 4)])], dtype=object
)


def test_they_are_the_maps_they_are_made_of() -> None:
    maps = Affines.of(MAPS)
    assert list(maps) == MAPS
    assert maps[1] == MAPS[1]
    assert list(maps[1:]) == MAPS[1:]
    assert Affines.of(maps) is maps
    assert list(turns([0, 90, 33])) == [Affine.turn(0), Affine.turn(90), Affine.turn(33)]
    assert maps.stretches.tolist() == [each.stretch for each in MAPS]
    assert maps.determinants.tolist() == [each.determinant for each in MAPS]
    assert maps == Affines.of(list(MAPS))
    assert hash(maps) == hash(Affines.of(list(MAPS)))
    assert maps != maps[:2]


def test_they_compose_to_the_bit_as_single_maps_do() -> None:
    maps, other = Affines.of(MAPS), Affine.turn(77) @ Affine.translation((0.1, 3.0))
    assert list(maps @ other) == [each @ other for each in MAPS]
    assert list(other @ maps) == [other @ each for each in MAPS]
    assert list(maps @ maps) == [each @ each for each in MAPS]
    assert list(maps.after(maps)) == [last @ first for last in MAPS for first in MAPS]


@pytest.mark.parametrize("marks", [HOLED, LINES], ids=["areas", "lines"])
def test_marks_are_carried_to_the_bit_as_by_single_maps(
    marks: np.ndarray[tuple[int], np.dtype[np.object_]],
) -> None:
    images = Affines.of(MAPS).apply(marks)
    alone = np.concatenate([each.apply(marks) for each in MAPS])
    assert shapely.equals_exact(images, alone, 0.0).all()
    assert len(Affines.of(MAPS).apply(marks[:0])) == 0
    assert Affines.of([IDENTITY]).apply(marks) is marks


def test_what_no_single_map_does_they_refuse() -> None:
    with pytest.raises(GeometryError, match="flattens the plane"):
        Affines.of([*MAPS, Affine(1, 1, 1, 1)]).apply(HOLED)
    with pytest.raises(GeometryError, match=r"finite numbers, not \(1.0, 0.0, 0.0, 1.0, inf, 0.0\)"):
        Affines.translations(np.array([[0.0, 1.0], [math.inf, 0.0]]))
