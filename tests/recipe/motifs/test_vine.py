"""Vines: stems of one breadth along any curve, what grows on them in turn, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from batik_vector.errors import GeometryError
from batik_vector.geometry.curves import (
    Circle,
    Curve,
    Hypocycloid,
    Segment,
    Spiral,
    Star,
    Superellipse,
    Wave,
    trace,
)
from batik_vector.recipe.figures import draw
from batik_vector.recipe.motifs.vine import Stem, Vine

TOLERANCE = 1e-4
CURVES = [
    Circle(1.0),
    Superellipse(0.5, 0.5, 1.0, 1.0),
    Star(5, 1.0, 0.5),
    Spiral(1.6),
    Wave(),
    Segment(),
    Hypocycloid(5, 1),
]


def stem_of(vine: Vine) -> shapely.Geometry:
    (figure,) = [figure for figure in draw(vine, TOLERANCE) if figure.element.name == "stem"]
    return shapely.union_all(figure.areas)


@pytest.mark.parametrize("curve", CURVES, ids=lambda curve: type(curve).__name__)
def test_a_stem_is_as_broad_as_asked_all_along(curve: Curve) -> None:
    count, width = 20, 0.08
    stem = stem_of(Vine(curve=curve, count=count, stem=Stem(width=width)))
    (strand,) = trace(curve, 1e-4).strands
    line = shapely.LineString(strand)
    pen = shapely.buffer(line, width * line.length / count, quad_segs=32)
    assert shapely.symmetric_difference(stem, pen).area < 0.02 * pen.area


def test_a_closed_stem_is_a_ring_and_an_open_one_is_not() -> None:
    ring, line = stem_of(Vine(curve=Circle())), stem_of(Vine(curve=Spiral(1.6), count=12))
    assert shapely.get_num_interior_rings(ring) == 1
    assert shapely.get_num_interior_rings(line) == 0


def test_round_a_circle_leaves_stand_at_even_steps_left_and_right_in_turn() -> None:
    vine = Vine(curve=Circle(1.0), count=8, grows=("leaf",))
    (leaves,) = [figure for figure in draw(vine, TOLERANCE) if figure.element.name == "leaf"]
    middle = shapely.get_coordinates(shapely.centroid(leaves.areas))
    angles = np.degrees(np.arctan2(middle[:, 1], middle[:, 0])) % 360
    left = np.hypot(*middle.T) < 1
    assert left.sum() == 4
    for side in (left, ~left):
        steps = np.diff(np.sort(angles[side]))
        assert steps == pytest.approx(np.full(3, 90.0), abs=0.1)


def test_a_vine_along_a_wave_goes_on_from_copy_to_copy() -> None:
    stem = stem_of(Vine(curve=Wave(), count=6, stem=Stem(width=0.05)))
    both = shapely.union(stem, shapely.transform(stem, lambda xy: xy + [1.0, 0.0]))
    about = shapely.box(0.9, -1, 1.1, 1)
    joint = shapely.intersection(both, about)
    line = shapely.LineString(Wave(waves=2, length=2.0).at(np.linspace(0, 1, 4000)))
    length = shapely.LineString(trace(Wave(), 1e-4).strands[0]).length
    pen = shapely.intersection(
        shapely.buffer(line, 0.05 * length / 6, quad_segs=32), shapely.box(0.9, -1, 1.1, 1)
    )
    assert shapely.symmetric_difference(joint, pen).area < 0.01 * pen.area


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ({"grows": ("leaf", "tendrill")}, r'grows\[1\]: .*"tendrill".*did you mean "tendril"'),
        ({"grows": ()}, r"grows = \[\], expected what grows"),
        ({"curve": Circle(), "count": 7}, "count = 7: .*expected an even number or alternate = false"),
        ({"curve": Hypocycloid(96, 40), "count": 398}, "count = 398 on 8 lines, expected at most 250"),
    ],
)
def test_what_cannot_grow_is_refused(said: dict[str, object], words: str) -> None:
    with pytest.raises(GeometryError, match=words):
        Vine(**said)  # type: ignore[arg-type]
