"""Arrays of marks: back and forth, and many images at once."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.geometry.ragged import Ragged

HOLED = shapely.box(0, 0, 9, 9) - shapely.box(1, 1, 2, 2) - shapely.box(4, 4, 6, 5)
AREAS = np.array([shapely.box(0, 0, 1, 1), HOLED, shapely.Point(3, 3).buffer(1)], dtype=object)
LINES = np.array(
    [shapely.LineString([(0, 0), (1, 2), (3, 1)]), shapely.LineString([(1, 1), (0, 4)])], dtype=object
)


@pytest.mark.parametrize("marks", [AREAS, LINES], ids=["areas", "lines"])
def test_marks_come_back_as_they_were(marks: np.ndarray[tuple[int], np.dtype[np.object_]]) -> None:
    assert shapely.equals_exact(Ragged.of(marks).geometries(), marks, 0.0).all()


def test_mirror_images_keep_the_sense_of_their_rings() -> None:
    areas = shapely.orient_polygons(AREAS)
    marks = Ragged.of(areas)
    flip = np.array([[1.0, 1.0], [-1.0, 1.0]])
    images = marks.images(marks.points * flip[:, None], np.array([False, True])).reshape(2, -1)
    assert shapely.equals_exact(images[0], areas, 0.0).all()
    assert shapely.equals_exact(images[1], shapely.orient_polygons(images[1]), 0.0).all()
    assert shapely.get_num_interior_rings(images[1]).tolist() == [0, 2, 0]


def test_what_is_mixed_is_refused() -> None:
    with pytest.raises(ValueError, match="expected polygons"):
        Ragged.of(np.concatenate([AREAS, LINES]))
    with pytest.raises(ValueError, match="expected polygons"):
        Ragged.of(np.array([shapely.multipolygons(AREAS[:1])], dtype=object))
