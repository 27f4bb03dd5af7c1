"""Of marks that coincide the first is drawn, whatever the order in which they are compared."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.geometry import coincidence
from batik_vector.geometry.coincidence import drawn_once


def same(
    one: shapely.Polygon | shapely.LineString, other: shapely.Polygon | shapely.LineString, reach: float
) -> bool:
    edges = [shapely.boundary(each) if isinstance(each, shapely.Polygon) else each for each in (one, other)]
    return all(
        bool(shapely.dwithin(edges[a], shapely.points(shapely.get_coordinates(edges[1 - a])), reach).all())
        for a in (0, 1)
    )


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("at_once", [7, 50_000])
def test_marks_are_compared_with_those_that_are_drawn(
    monkeypatch: pytest.MonkeyPatch, seed: int, at_once: int
) -> None:
    monkeypatch.setattr(coincidence, "AT_ONCE", at_once)
    chance = np.random.default_rng(seed)
    # Chains of marks a little apart: the first is like the second and that like the third, not the first.
    places = chance.choice([0.0, 5.0, 10.0], (120, 2)) + chance.choice([0.0, 0.006, 0.012, 0.018], (120, 2))
    squares = shapely.box(places[:, 0], places[:, 1], places[:, 0] + 1, places[:, 1] + 1)
    frames = shapely.difference(squares, shapely.buffer(shapely.centroid(squares), 0.2))
    lines = shapely.boundary(squares)
    kind = chance.integers(0, 3, 120)
    marks = np.where(kind == 0, squares, np.where(kind == 1, frames, lines))
    drawn: list[int] = []
    for number, mark in enumerate(marks):
        like = [each for each in drawn if marks[each].geom_type == mark.geom_type]
        if not any(same(marks[each], mark, 0.01) for each in like):
            drawn.append(number)
    assert drawn_once(marks, 0.01).tolist() == drawn
    assert len(drawn) < 110
