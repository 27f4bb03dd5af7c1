"""Images of regions: nothing torn, nothing lost, nothing invalid, to the tolerance."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.errors import TornRingError
from batik_vector.geometry.maps import (
    Affine,
    Bent,
    FlameMap,
    JuliaN,
    Linear,
    Sinusoidal,
    Spherical,
    Swirl,
    Variation,
)
from batik_vector.geometry.maps.images.areas import area_images
from batik_vector.geometry.maps.images.lines import line_images
from batik_vector.geometry.maps.images.result import Images
from tests.geometry.maps.images.measure import array_of, julian_area, outlines, stray
from tests.strategies import polygons, spiral
from tests.thorough import examples, long

TOLERANCE = 2e-3


def flame(*variations: Variation, shift: tuple[float, float] = (0.0, 0.0)) -> FlameMap:
    weight = 1 / len(variations)
    return FlameMap(tuple((weight, each) for each in variations), pre=Affine.translation(shift))


def assert_sound(images: Images) -> None:
    assert shapely.is_valid(images.geometries).all(), shapely.is_valid_reason(images.geometries)
    assert (shapely.get_type_id(images.geometries) == shapely.GeometryType.POLYGON).all()
    assert shapely.is_ccw(shapely.get_exterior_ring(images.geometries)).all()
    rings, owner = shapely.get_rings(images.geometries, return_index=True)
    assert not shapely.is_ccw(rings[1:][owner[1:] == owner[:-1]]).any()


julians = st.builds(
    JuliaN,
    st.sampled_from([2, 3, 4, 6, -3]),
    st.sampled_from([1.0, 1.7, 3.0, -1.5]),
    st.sampled_from(["root", "rotate"]),
)


@long
@settings(max_examples=examples(150, 1000), deadline=None)
@given(polygons(), julians)
def test_valid_in_valid_out_and_areas_agree(shape: shapely.Polygon, julian: JuliaN) -> None:
    try:
        images = area_images(flame(julian), array_of(shape), TOLERANCE)
    except TornRingError:
        assert julian.exponent < 0
        assert shape.intersects(shapely.Point(0, 0).buffer(1e-9))
        return
    assert_sound(images)
    near = shapely.Polygon(shape.exterior).distance(shapely.Point(0, 0))
    if julian.exponent < 0 and near < 1e-2:
        return  # images of astronomic size: dense sampling is no measure
    area, length = shapely.area(images.geometries).sum(), shapely.length(images.geometries).sum()
    expected = julian_area(shape, julian.power, julian.exponent, julian.rate)
    assert area == pytest.approx(expected, abs=TOLERANCE * length, rel=1e-4)


@long
@settings(max_examples=examples(15, 60), deadline=None)
@given(
    polygons(),
    st.builds(
        JuliaN,
        st.sampled_from([2, 3, 4, 6]),
        st.sampled_from([1.0, 1.7]),
        st.sampled_from(["root", "rotate"]),
    ),
)
def test_images_are_within_the_tolerance_of_dense_sampling(shape: shapely.Polygon, julian: JuliaN) -> None:
    images = area_images(flame(julian), array_of(shape), TOLERANCE)
    # The truth is a polyline too: it adds a little.
    assert max(stray(flame(julian), shape, images)) <= TOLERANCE * 1.02


def test_the_measure_can_fail() -> None:
    """Vertices mapped with atan2 and joined, as one would naively: torn, though every vertex is right."""
    shape, root = shapely.Point(-2, 0.1).buffer(1), flame(JuliaN(4, 1.0, "root"))
    z = outlines(shape)[0]
    w = np.abs(z) ** 0.25 * np.exp(1j * np.angle(z) / 4)
    naive = shapely.Polygon(np.column_stack([w.real, w.imag]))
    torn = Images(array_of(naive), np.zeros(1, np.intp), np.zeros(1, np.intp))
    there, _ = stray(root, shape, torn)
    assert np.abs(w**4 - z).max() < 1e-12
    assert there > 50 * TOLERANCE


@long
@settings(max_examples=examples(100, 300), deadline=None)
@given(polygons(), st.sampled_from([2, 3, 4, 5]))
def test_root_undone_is_the_region_and_no_step_leaps(shape: shapely.Polygon, power: int) -> None:
    """w^P1 lies on the source's edges, and each image edge stays there all along."""
    images = area_images(flame(JuliaN(power, 1.0, "root")), array_of(shape), TOLERANCE)
    edges = shape.boundary
    for image in images.geometries:
        for w in outlines(image):
            back = w**power
            assert shapely.distance(edges, shapely.points(back.real, back.imag)).max() < 1e-9
            middle = (w[1:] + w[:-1]) / 2
            # The inverse magnifies by at most P1·(|w| + ε)^(P1 − 1).
            allowed = TOLERANCE * power * (np.abs(middle) + TOLERANCE) ** (power - 1)
            off = shapely.distance(edges, shapely.points((middle**power).real, (middle**power).imag))
            assert (off <= allowed * 1.001 + 1e-9).all()


@long
@settings(max_examples=examples(100, 300), deadline=None)
@given(polygons(), st.sampled_from([2, 3, 4, 6]))
def test_root_has_as_many_images_as_the_winding_number_says(shape: shapely.Polygon, power: int) -> None:
    images = area_images(flame(JuliaN(power, 1.0, "root")), array_of(shape), TOLERANCE)
    filled = shapely.Polygon(shape.exterior)
    origin = shapely.Point(0, 0)
    if filled.exterior.distance(origin) < 1e-12 or not filled.contains(origin):
        assert len(images.geometries) == power
        assert (shapely.get_num_interior_rings(images.geometries) == len(shape.interiors)).all()
        assert sorted(images.branch) == list(range(power))
    else:
        winding = sum(shapely.Polygon(hole).contains_properly(origin) for hole in shape.interiors)
        (image,) = images.geometries
        assert len(image.interiors) == (len(shape.interiors) - winding) * power + winding
        if winding == 0 and all(hole.distance(origin) > 1e-12 for hole in shape.interiors):
            assert image.contains(origin)


@pytest.mark.parametrize("turns", [0.4, 0.97, 1.3, 2.6])
@pytest.mark.parametrize("start", [0.0, 100.0, 200.0])
def test_a_spiral_band_keeps_its_hole(turns: float, start: float) -> None:
    band = Affine.turn(start).apply(array_of(spiral(turns)))
    images = area_images(flame(JuliaN(3, 1.0, "root")), band, 1e-3)
    assert_sound(images)
    assert shapely.get_num_interior_rings(images.geometries).tolist() == [1, 1, 1]
    expected = julian_area(band[0], 3, 1 / 3, 1 / 3)
    assert shapely.area(images.geometries).sum() == pytest.approx(expected, rel=1e-3)


def petals() -> list[shapely.Polygon]:
    """A four-petal rose with its tips at 0."""
    t = np.linspace(-math.pi / 4, math.pi / 4, 60)
    r = np.cos(2 * t)
    r[0] = r[-1] = 0
    return [
        shapely.Polygon(np.column_stack([r * np.cos(t + a), r * np.sin(t + a)]))
        for a in np.arange(4) * math.pi / 2
    ]


def test_petals_with_their_tips_in_the_origin_have_petals_for_images() -> None:
    images = area_images(flame(JuliaN(3, 1.0, "root")), array_of(*petals()), 1e-3)
    assert_sound(images)
    assert len(images.geometries) == 12
    assert all((np.asarray(image.exterior.coords) == 0).all(axis=1).any() for image in images.geometries)
    assert shapely.union_all(images.geometries).area == pytest.approx(shapely.area(images.geometries).sum())


def test_petals_shifted_away_and_back_still_touch_the_origin() -> None:
    there, back = Affine.translation((4 / 3, -1 / 3)), Affine.translation((-4 / 3, 1 / 3))
    moved = there.apply(array_of(*petals()))
    images = area_images(FlameMap(((1.0, JuliaN(4, 1.0, "root")),), pre=back), moved, 1e-3)
    assert len(images.geometries) == 16
    assert shapely.is_valid(images.geometries).all()


@settings(max_examples=60, deadline=None)
@given(polygons(), st.sampled_from([2, 3, 4, 5]))
def test_rotate_at_dist_equal_power_is_turned_copies_exactly(shape: shapely.Polygon, power: int) -> None:
    julian = flame(JuliaN(power, float(power)), shift=(4 / 3, 4 / 3))
    branches = julian.affine_branches()
    assert branches is not None
    assert len(branches) == power
    images = area_images(julian, array_of(shape), TOLERANCE)
    for k in range(power):
        turned = Affine.turn(360 / power * k) @ Affine.translation((4 / 3, 4 / 3))
        expected = turned.at(shapely.get_coordinates(shapely.orient_polygons(shape)))
        np.testing.assert_allclose(shapely.get_coordinates(images.geometries[k]), expected, atol=1e-13)


@long
@settings(max_examples=examples(15, 60), deadline=None)
@given(polygons(), st.sampled_from([2, 3, 4, 5]), st.sampled_from(["root", "rotate"]))
def test_images_have_the_symmetry_of_the_branches(shape: shapely.Polygon, power: int, reading: str) -> None:
    images = area_images(flame(JuliaN(power, 0.618 * power, reading)), array_of(shape), TOLERANCE).geometries  # type: ignore[arg-type]
    corners = {complex(*point) for point in np.round(shapely.get_coordinates(images), 9) + 0.0}
    turned = shapely.get_coordinates(Affine.turn(360 / power).apply(images))
    exact = {complex(*point) for point in np.round(turned, 9) + 0.0}
    assert len(corners ^ exact) <= 0.02 * len(corners) + 2  # rounding at the ninth decimal
    if power in (2, 4):
        raw = {complex(*point) for point in shapely.get_coordinates(images) + 0.0}
        assert raw == {complex(*point) for point in turned + 0.0}


OTHERS = [
    flame(Swirl(), shift=(0.6, 0.4)),
    flame(Bent(), shift=(0.2, 0.1)),
    flame(Spherical(), shift=(2.5, 0.3)),
    flame(Linear(), JuliaN(3, 1.0, "root"), shift=(2.5, 0.3)),
    flame(Linear(), JuliaN(3, 1.8), shift=(0.3, 0.3)),
    flame(Linear(), Swirl(), shift=(0.3, 0.3)),
]


@pytest.mark.parametrize("map_", OTHERS, ids=lambda m: "+".join(v.name for _, v in m.terms))
@long
@settings(max_examples=examples(15, 60), deadline=None)
@given(shape=polygons(st.just("inside")))
def test_other_maps_against_dense_sampling(map_: FlameMap, shape: shapely.Polygon) -> None:
    images = area_images(map_, array_of(shape), TOLERANCE)
    assert_sound(images)
    there, back = stray(map_, shape, images)
    assert there <= TOLERANCE * 1.05
    if len(map_.terms) == 1:
        assert back <= TOLERANCE * 1.05


@pytest.mark.parametrize(
    "map_", [flame(Sinusoidal()), flame(JuliaN(4, 3.0, "literal"))], ids=["sinusoidal", "literal"]
)
@long
@settings(max_examples=examples(15, 60), deadline=None)
@given(shape=polygons(), size=st.sampled_from([0.5, 2.0, 4.0]))
def test_folded_regions_cover_their_points(map_: FlameMap, shape: shapely.Polygon, size: float) -> None:
    shape = Affine.scale(size).apply(array_of(shape))[0]
    images = area_images(map_, array_of(shape), TOLERANCE)
    assert_sound(images)
    box = shapely.bounds(shape)
    random = np.random.default_rng(1).uniform(box[:2], box[2:], (400, 2))
    inside = random[shapely.contains_xy(shape, random)]
    points = shapely.points(map_.at(inside))
    whole = shapely.union_all(images.geometries)
    assert shapely.distance(whole, points).max(initial=0) <= TOLERANCE * 1.01
    # And nothing else: fewer than a handful of the image's own points have no source nearby.
    assert whole.area <= shape.area * float(map_.stretch(inside).max(initial=1.0)) ** 2 * 1.5 + 1e-2


def test_sinusoidal_folds_a_square_onto_itself() -> None:
    images = area_images(flame(Sinusoidal()), array_of(shapely.box(-7, -7, 7, 7)), 1e-3)
    (image,) = images.geometries
    assert (
        image.equals_exact(shapely.box(-1, -1, 1, 1).normalize(), 1e-6)
        or image.symmetric_difference(shapely.box(-1, -1, 1, 1)).area < 1e-5
    )


def test_poles_are_refused_by_name() -> None:
    disk = array_of(shapely.Point(0, 0).buffer(1))
    corner = array_of(shapely.box(0, 0, 1, 1))
    for map_ in (flame(Spherical()), flame(JuliaN(3, -1.0)), flame(JuliaN(3, -1.0, "root"))):
        for shape in (disk, corner):
            with pytest.raises(TornRingError, match="goes to infinity"):
                area_images(map_, shape, TOLERANCE)


def test_a_ring_about_a_pole_is_turned_inside_out() -> None:
    ring = array_of(shapely.Point(0, 0).buffer(2, 64).difference(shapely.Point(0, 0).buffer(0.5, 64)))
    for map_ in (flame(Spherical()), flame(JuliaN(3, -3.0)), flame(JuliaN(-3, 3.0, "root"))):
        images = area_images(map_, ring, 1e-3)
        assert_sound(images)
        for image in images.geometries:
            assert image.area == pytest.approx(math.pi * (4 - 0.25), rel=5e-3)
            assert len(image.interiors) == 1


def test_a_sum_with_root_refuses_what_winds_round_it() -> None:
    map_ = flame(Linear(), JuliaN(3, 1.0, "root"))
    with pytest.raises(TornRingError, match=r"julian \(root\)"):
        area_images(map_, array_of(shapely.Point(0, 0).buffer(1)), TOLERANCE)


def test_no_regions_have_no_images() -> None:
    empty = np.empty(0, dtype=object)
    for map_ in (*OTHERS, flame(Sinusoidal()), flame(JuliaN(4, 1.0, "root"))):
        assert len(area_images(map_, empty, TOLERANCE).geometries) == 0
        assert len(line_images(map_, empty, TOLERANCE).geometries) == 0
