"""Needles thinner than the grid go, and nothing else does: not what covers the edges of the tile."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector import compile_recipe
from batik_vector.recipe.loading import load_recipe
from batik_vector.tiling.torus.torus import Window
from batik_vector.tiling.welding.needles import LONG, needled, without_needles
from batik_vector.units import STEPS_PER_MM
from tests.thorough import examples, long, slow

WINDOW = Window(0, 0, 100_000, 80_000)
SAMPLES = Path(__file__).resolve().parents[3] / "samples"
BODY = [(40_000, 20_000), (60_000, 20_000), (60_000, 40_000), (40_000, 40_000)]


def bare(*areas: shapely.Polygon) -> list[shapely.Polygon]:
    return list(without_needles(np.array(areas, dtype=object), WINDOW))


@pytest.mark.parametrize("tip", [4, 50, 5_000])
def test_a_spike_goes_and_the_body_stays(tip: int) -> None:
    spiked = shapely.Polygon([*BODY[:2], (60_000 + tip, 20_001), (60_000, 20_001), *BODY[2:]])
    (found,) = bare(spiked)
    assert found.equals(shapely.Polygon(BODY))


@pytest.mark.parametrize("width", [2, 20])
def test_a_tip_that_is_wider_stays(width: int) -> None:
    pointed = shapely.Polygon([*BODY[:2], (65_000, 20_000), (60_000, 20_000 + width), *BODY[2:]])
    assert bare(pointed) == [pointed]


def test_a_needle_with_vertices_on_its_sides_goes_from_tip_to_foot() -> None:
    sides = [(61_000, 20_000), (63_000, 20_000), (65_000, 20_000), (64_000, 20_001), (62_000, 20_001)]
    (found,) = bare(shapely.Polygon([*BODY[:2], *sides, (60_000, 20_001), *BODY[2:]]))
    assert found.equals(shapely.Polygon(BODY))


def test_a_slit_of_a_hole_that_touches_the_edge_is_closed() -> None:
    """As the sample five-circle has it: a pen took one side of the slit for drawn and ended on the seam."""
    outer = [(0, 0), (9_000, 0), (9_000, 9_000), (0, 9_000), (0, 4_000)]
    hole = [(0, 4_000), (106, 3_986), (2_000, 6_000), (3_000, 3_000), (485, 3_935)]
    (found,) = bare(shapely.Polygon(outer, [hole]))
    assert shapely.Polygon(found.interiors[0]).equals(shapely.Polygon(hole[1:]))
    assert found.exterior.equals(shapely.LinearRing(outer))


@pytest.mark.parametrize(
    "shape",
    [
        # The tip of a needle whose rest lies beyond the edge; and a needle flat on the edge.
        [(0, 4_000), (5_000, 4_001), (0, 4_001)],
        [(0, 0), (9_000, 0), (9_000, 3_000), (1, 3_000), (0, 9_000)],
    ],
)
def test_what_lies_along_an_edge_stays(shape: list[tuple[int, int]]) -> None:
    area = shapely.Polygon(shape)
    assert bare(area) == [area]


def test_what_would_cross_itself_stays() -> None:
    """The tip of a hole lies in the needle."""
    body = [(40_000, 10_000), (60_000, 10_000), (60_000, 20_000), (90_000, 30_000), (60_001, 20_001)]
    hole = [(60_002, 20_001), (57_002, 19_001), (57_000, 19_100)]
    area = shapely.Polygon([*body, (60_000, 40_000), (40_000, 40_000)], [hole])
    assert area.is_valid
    assert bare(area) == [area]
    assert bare(shapely.Polygon(area.exterior)) != [shapely.Polygon(area.exterior)]


@pytest.mark.parametrize(
    "needle",
    [
        [(40_000, 30_000), (50_000, 30_000), (49_000, 30_001)],
        # Each of its corners is the tip of a needle.
        [(30_000, 30_000), (30_900, 30_300), (30_449, 30_150), (30_897, 30_300)],
    ],
)
def test_a_ring_that_is_a_needle_stays(needle: list[tuple[int, int]]) -> None:
    assert bare(shapely.Polygon(needle)) == [shapely.Polygon(needle)]
    spiked = shapely.Polygon([(1, 1), (60_000, 1), (65_000, 2), (60_000, 2), (60_000, 60_000)], [needle])
    assert bare(spiked) == [shapely.Polygon([(1, 1), (60_000, 1), (60_000, 2), (60_000, 60_000)], [needle])]


@long
@settings(max_examples=examples(50, 500), derandomize=True, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_two_marks_that_cross_leave_nothing_but_needles_out(seed: int) -> None:
    chance = np.random.default_rng(seed)
    turns = np.sort(chance.uniform(0, 2 * np.pi, (2, 12)), axis=1)
    radii = chance.uniform(200, 20_000, (2, 12))
    xy = np.rint(np.stack([radii * np.cos(turns), radii * np.sin(turns)], axis=-1)) + 40_000
    one, other = (shapely.make_valid(shapely.Polygon(each)) for each in xy)
    left = shapely.set_precision(shapely.difference(one, other), 1.0)
    areas = np.array([each for each in shapely.get_parts(left) if each.geom_type == "Polygon"], dtype=object)
    found = without_needles(areas, WINDOW)
    assert shapely.is_valid(found).all()
    # No more than a step beside what was drawn, as broad as that is long.
    assert (shapely.area(shapely.symmetric_difference(areas, found)) <= shapely.length(areas)).all()
    wide = [~needled(np.array([each], dtype=object))[0] for each in areas]
    assert all(a.equals(b) for a, b, same in zip(areas, found, wide, strict=True) if same)


@slow
def test_no_needle_is_left_in_a_sample_that_had_hundreds() -> None:
    artwork = compile_recipe(load_recipe(SAMPLES / "five-circle.toml"))
    for layer in artwork.layers:
        steps = shapely.transform(layer.areas, lambda xy: np.rint(xy * STEPS_PER_MM))
        assert not needled(steps).any(), f"{layer.ink.name}: needles longer than {LONG:g} steps"
