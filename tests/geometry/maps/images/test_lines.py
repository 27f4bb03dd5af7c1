from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.errors import TooLargeError, TornRingError
from batik_vector.geometry import work
from batik_vector.geometry.maps import FlameMap, JuliaN, Linear, Sinusoidal, Spherical, Swirl
from batik_vector.geometry.maps.images.lines import line_images
from tests.geometry.maps.images.measure import array_of, stray
from tests.strategies import polygons
from tests.thorough import rarely

TOLERANCE = 2e-3


def root(power: int = 4, dist: float = 1.0) -> FlameMap:
    return FlameMap(((1.0, JuliaN(power, dist, "root")),))


def wound(turns: int, count: int = 16) -> shapely.LineString:
    """A closed line that winds round the origin ``turns`` times."""
    t = np.linspace(0, 2 * math.pi, count * abs(turns) + 1)
    radius = 1 + 0.3 * np.cos(t)
    points = np.column_stack([radius * np.cos(turns * t), radius * np.sin(turns * t)])
    points[-1] = points[0]
    return shapely.LineString(points)


@pytest.mark.parametrize(
    ("power", "turns"), rarely(list(itertools.product([2, 3, 4, 6, -4], [1, -1, 2, -2, 3, 4])), 4)
)
def test_closed_lines_close_after_the_turns_they_need(power: int, turns: int) -> None:
    images = line_images(root(power, math.copysign(1.0, power)), array_of(wound(turns)), TOLERANCE)
    assert len(images.geometries) == math.gcd(turns, abs(power))
    assert shapely.is_closed(images.geometries).all()
    assert max(stray(root(power, math.copysign(1.0, power)), wound(turns), images)) <= TOLERANCE * 1.02


@settings(max_examples=40, deadline=None)
@given(polygons(), st.sampled_from([2, 3, 4, 5]), st.booleans())
def test_lines_are_within_the_tolerance(shape: shapely.Polygon, power: int, closed: bool) -> None:
    points = np.asarray(shape.exterior.coords)
    line = shapely.LineString(points if closed else points[:-1])
    images = line_images(root(power), array_of(line), TOLERANCE)
    assert max(stray(root(power), line, images)) <= TOLERANCE * 1.02
    if not closed and line.distance(shapely.Point(0, 0)) > 1e-12:
        assert len(images.geometries) == power


def test_a_line_through_the_origin_is_split_there() -> None:
    images = line_images(root(3), array_of(shapely.LineString([(-1, -0.3), (1, 0.3)])), TOLERANCE)
    assert len(images.geometries) == 6
    ends = [{tuple(image.coords[0]), tuple(image.coords[-1])} for image in images.geometries]
    assert all((0.0, 0.0) in both for both in ends)


def test_a_rose_drawn_as_one_line_is_split_into_its_petals() -> None:
    t = np.linspace(0, 2 * math.pi, 401)
    radius = np.cos(2 * (t + 0.1))
    rose = np.column_stack([radius * np.cos(t), radius * np.sin(t)])
    for whole in (math.pi / 4, 3 * math.pi / 4, 5 * math.pi / 4, 7 * math.pi / 4):
        at = int(np.argmin(np.abs(t - (whole - 0.1))))
        rose[at] = 0
    rose[-1] = rose[0]
    images = line_images(root(3), array_of(shapely.LineString(rose)), TOLERANCE)
    assert len(images.geometries) == 12
    assert shapely.is_closed(images.geometries).all()


def test_rotate_leaves_lines_through_the_origin_whole() -> None:
    map_ = FlameMap(((1.0, JuliaN(3, 1.8)),))
    line = shapely.LineString([(-1, 0), (1, 0.0)])
    images = line_images(map_, array_of(line), TOLERANCE)
    assert len(images.geometries) == 3
    np.testing.assert_allclose(shapely.length(images.geometries), 2.0)


@pytest.mark.parametrize("variation", [Spherical(), JuliaN(3, -1.0), JuliaN(-3, 1.0, "root")])
def test_lines_through_a_pole_are_refused(variation: Spherical | JuliaN) -> None:
    with pytest.raises(TornRingError, match="infinity"):
        line_images(FlameMap(((1.0, variation),)), array_of(shapely.LineString([(-1, 0), (1, 0)])), TOLERANCE)


def test_a_sum_with_root_refuses_a_closed_line_round_it() -> None:
    map_ = FlameMap(((0.5, Linear()), (0.5, JuliaN(3, 1.0, "root"))))
    with pytest.raises(TornRingError, match="sum"):
        line_images(map_, array_of(wound(1)), TOLERANCE)


@pytest.mark.parametrize("variation", [Swirl(), Sinusoidal()], ids=str)
def test_waves_do_not_hide_between_samples(variation: Swirl | Sinusoidal) -> None:
    """Long straight edges: their ends alone would show nothing."""
    map_ = FlameMap(((1.0, variation),))
    line = shapely.LineString([(-math.pi, 1.0), (math.pi, 1.0 + 1e-3), (0.0, 4.0)])
    images = line_images(map_, array_of(line), TOLERANCE)
    assert max(stray(map_, line, images, count=1500)) <= TOLERANCE * 1.05


def test_images_together_are_bounded_where_one_would_do(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(work, "LIMIT", 2_000.0)
    line_images(root(), array_of(wound(1)), TOLERANCE)
    rings = array_of(*[wound(1)] * 50)
    with pytest.raises(TooLargeError, match="to bend"), work.account():
        line_images(root(), rings, TOLERANCE)
