"""The rosette group of figures: what was drawn with a group has it, and what breaks it breaks it."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Geometries, Ink, Layer
from batik_vector.certificate.symmetry.rosette import Rosette, found_rosette
from tests.thorough import examples, long

FLAG = shapely.Polygon([(8, 1), (30, 2), (34, 9), (20, 6), (9, 3)])
"""A petal without any symmetry, clear of the centre."""


def figure(*polygons: shapely.Polygon, ink: str = "ink") -> Layer:
    return Layer(Ink(ink, "#000000"), np.array(polygons, dtype=object))


def copies(order: int, mirrored: bool = False, petal: shapely.Polygon = FLAG) -> list[shapely.Polygon]:
    found = [shapely.affinity.rotate(petal, 360 * k / order, origin=(0, 0)) for k in range(order)]
    return (
        found + [shapely.affinity.scale(each, 1, -1, origin=(0, 0)) for each in found] if mirrored else found
    )


def about(layers: list[Layer], x: float, y: float, turn: float) -> list[Layer]:
    """Return layers turned and moved."""
    cos, sin = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    turned = np.array([[cos, sin], [-sin, cos]])

    def moved(marks: Geometries) -> Geometries:
        return np.asarray(shapely.transform(marks, lambda xy: xy @ turned + (x, y)), dtype=object)

    return [Layer(each.ink, moved(each.areas), moved(each.lines)) for each in layers]


@long
@settings(max_examples=examples(12, 300), deadline=None)
@given(
    st.integers(2, 40),
    st.booleans(),
    st.floats(0, 360),
    st.tuples(st.floats(-500, 500), st.floats(-500, 500)),
    st.tuples(st.floats(-0.2, 0.2), st.floats(-0.2, 0.2)),
)
def test_what_was_drawn_with_a_group_has_it(
    order: int, mirrored: bool, turn: float, place: tuple[float, float], off: tuple[float, float]
) -> None:
    layers = about([figure(*copies(order, mirrored))], *place, turn)
    found = found_rosette(layers, (place[0] + off[0], place[1] + off[1]))
    assert (found.order, found.mirrors) == (order, mirrored)
    assert found.centre == pytest.approx(place, abs=0.01)
    assert found.deviation <= 0.044
    if mirrored:
        assert found.axis is not None
        apart = (found.axis - turn) % (180 / order)
        assert min(apart, 180 / order - apart) < 0.05


@pytest.mark.parametrize("factor", [1.05, 0.95])
def test_one_petal_a_twentieth_longer_or_shorter_breaks_it(factor: float) -> None:
    petals = copies(8, petal=shapely.Polygon([(5, 0), (20, 4), (30, 0), (20, -4)]))
    petals[0] = shapely.affinity.scale(petals[0], factor, 1, origin=(5, 0))
    found = found_rosette([figure(*petals)], (0, 0))
    assert (found.name, found.kind) == ("D1", "reflection")


def test_inks_have_to_fit_as_well() -> None:
    petals = copies(8)
    found = found_rosette([figure(*petals[0::2], ink="one"), figure(*petals[1::2], ink="other")], (0, 0))
    assert found.name == "C4"


def test_lines_count() -> None:
    strokes = shapely.linestrings([[(3, 0), (30 + (k == 0), 0)] for k in range(6)])
    layer = Layer(
        Ink("pen", "#000000"),
        np.empty(0, dtype=object),
        np.array(
            [shapely.affinity.rotate(s, 60 * k, origin=(0, 0)) for k, s in enumerate(strokes)], dtype=object
        ),
    )
    assert found_rosette([layer], (0, 0)).name == "D1"
    assert found_rosette([Layer(layer.ink, layer.areas, layer.lines[1:])], (0, 0)).order == 1


def test_rings_and_discs_are_kept_by_any_turn() -> None:
    outer, inner = (shapely.Point(7, 7).buffer(radius, quad_segs=90).exterior for radius in (30, 20))
    found = found_rosette([figure(shapely.Polygon(outer, [inner]))], (7, 7))
    assert found.continuous
    assert (found.name, found.kind) == ("O(2)", "rotation by any angle")


def test_nothing_has_no_symmetry() -> None:
    assert found_rosette([], (1, 2)) == Rosette(1, False, (1, 2))
    assert found_rosette([figure(FLAG)], (20, 4)).kind == "none"
