from __future__ import annotations

import math
import time

import numpy as np
import pytest
import shapely

from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.geometry.coincidence import drawn_once
from batik_vector.geometry.ifs import Ifs, distinct
from batik_vector.geometry.maps import Affine, FlameMap, Geometries, JuliaN, Linear
from batik_vector.geometry.maps.affines import Affines
from tests.geometry.maps.images.measure import array_of, optimum, outlines

TOLERANCE = 1e-3


def layout(shift: tuple[float, float], level: int, power: int = 4, share: float = 1.0) -> Ifs:
    """The paper's F4: JuliaN after a shift."""
    julian = JuliaN(power, power * share)
    return Ifs((FlameMap(((1.0, julian),), pre=Affine.translation(shift)),), level)


def flower(petals: int, count: int = 240, size: float = 1.0) -> Geometries:
    t = np.linspace(0, 2 * math.pi, count, endpoint=False)
    radius = size * (1 + 0.25 * np.cos(petals * t))
    return array_of(shapely.Polygon(np.column_stack([radius * np.cos(t), radius * np.sin(t)])))


def images(ifs: Ifs) -> Affines:
    found = ifs.affine_images()
    assert found is not None
    return found


@pytest.mark.parametrize("shift", [(4 / 3, 4 / 3), (4 / 3, 0.0)], ids=["14b", "14c"])
def test_four_square_at_level_2_has_sixteen_images_on_nine_places(shift: tuple[float, float]) -> None:
    """Tian et al. 2019, Figure 14."""
    ifs = layout(shift, 2)
    assert ifs.image_count() == 16
    copies = images(ifs)
    assert len(copies) == 16
    for petals in (4, 8, 16):
        assert len(distinct(copies, flower(petals), TOLERANCE)) == 9
    assert len(distinct(copies, flower(5), TOLERANCE)) == 16
    side = 8 / 3 if shift[1] else math.sqrt(2) * 4 / 3
    places = np.array([(each.e, each.f) for each in distinct(copies, flower(8), TOLERANCE)])
    turned = places if shift[1] else places @ np.array([[1, 1], [-1, 1]]) / math.sqrt(2)
    grid = np.unique(np.round(turned / side, 9) + 0.0, axis=0)
    np.testing.assert_allclose(grid, [(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)])


def test_a_symmetry_must_hold_for_every_ink() -> None:
    """Two crossed bars of one ink are four-fold; of two inks they are not."""
    bars = array_of(shapely.box(-1, -0.1, 1, 0.1)), array_of(shapely.box(-0.1, -1, 0.1, 1))
    turns = [Affine.turn(90 * k) for k in range(4)]
    assert len(distinct(turns, np.concatenate(bars), TOLERANCE)) == 1
    assert len(distinct(turns, bars, TOLERANCE)) == 2


def test_symmetries_that_nearly_hold_do_not() -> None:
    square = flower(4)
    dented = array_of(square[0].difference(shapely.Point(1.25, 0).buffer(0.05)))
    turns = [Affine.turn(90 * k) for k in range(4)]
    assert len(distinct(turns, square, TOLERANCE)) == 1
    assert len(distinct(turns, dented, TOLERANCE)) == 4
    assert len(distinct([Affine(), Affine.scale(1.01)], square, TOLERANCE)) == 2
    assert len(distinct([Affine(), Affine.mirror(0.0)], square, TOLERANCE)) == 1


def test_a_part_upon_a_longer_part_is_not_the_same_drawing() -> None:
    lines = array_of(shapely.LineString([(-1, 0), (1, 0)]), shapely.LineString([(0, -1), (0, 1)]))
    marked = np.append(lines, array_of(shapely.LineString([(0.5, 0), (0.5, 0.2)])))
    assert len(distinct([Affine(), Affine.turn(90)], lines, TOLERANCE)) == 1
    assert len(distinct([Affine(), Affine.turn(90)], marked, TOLERANCE)) == 2


def test_levels_compose() -> None:
    two = images(layout((4 / 3, 0.2), 2))
    one = images(layout((4 / 3, 0.2), 1))
    expected = {tuple(np.round([m.a, m.b, m.e, m.f], 9) + 0.0) for m in (a @ b for a in one for b in one)}
    assert {tuple(np.round([m.a, m.b, m.e, m.f], 9) + 0.0) for m in two} == expected
    assert list(images(layout((4 / 3, 0.2), 0))) == [Affine()]
    assert images(layout((4 / 3, 0.2), 3)) == images(layout((4 / 3, 0.2), 3))


def test_many_levels_merge_as_they_grow() -> None:
    """4^12 is seventeen million copies; they stand on 13 × 13 places."""
    ifs = layout((4 / 3, 4 / 3), 12)
    assert ifs.image_count() == 4**12
    copies = images(ifs)
    assert len({(round(each.e, 6), round(each.f, 6)) for each in copies}) == 13 * 13
    assert len(distinct(copies, flower(8), TOLERANCE)) == 13 * 13


def test_a_thousand_levels_are_refused_at_once() -> None:
    start = time.perf_counter()
    with pytest.raises(TooLargeError, match=r"about 10\^602 copies"):
        layout((4 / 3, 4 / 3), 1000).affine_images()
    with pytest.raises(TooLargeError, match=r"about 10\^602 copies"):
        layout((4 / 3, 4 / 3), 1000, share=0.618).areas(flower(8), TOLERANCE)
    assert time.perf_counter() - start < 0.5
    with pytest.raises(GeometryError, match="level = -1"):
        layout((0.0, 0.0), -1)


def test_bent_maps_have_no_affine_images() -> None:
    assert layout((4 / 3, 0.0), 2, share=0.618).affine_images() is None


@pytest.mark.parametrize("shift", [(4 / 3, 4 / 3), (4 / 3, 0.0)])
@pytest.mark.parametrize("level", [1, 2, 3])
def test_bent_layouts_keep_tolerance_and_economy(shift: tuple[float, float], level: int) -> None:
    ifs = layout(shift, level, share=0.618)
    motif = flower(8, 3000)
    copies, source = ifs.areas(motif, TOLERANCE)
    assert shapely.is_valid(copies).all()
    assert (source == 0).all()
    # Each copy on its own, mapped point by point: an independent truth.
    truth = [shapely.get_coordinates(motif)[:: 3 if level < 3 else 10]]
    for _ in range(level):
        truth = [ifs.maps[0].at(points, k) for points in truth for k in range(4)]
    boundaries = shapely.STRtree(shapely.boundary(copies))
    stray = boundaries.query_nearest(
        shapely.points(np.concatenate(truth)), return_distance=True, all_matches=False
    )[1]
    # The truth's chords and the copies merged add their share.
    assert stray.max() <= TOLERANCE * 1.05
    fine, _ = ifs.areas(motif, TOLERANCE / 60)
    assert len(fine) == len(copies)
    least = sum(optimum(z, TOLERANCE) for shape in fine for z in outlines(shape))
    assert shapely.get_num_coordinates(copies).sum() <= 1.4 * least


def test_bent_copies_that_coincide_are_drawn_once() -> None:
    """About the centre, a four-fold flower has the same image on each of four branches."""
    ifs = layout((0.0, 0.0), 3, share=0.618)
    copies, _ = ifs.areas(flower(4), TOLERANCE)
    assert ifs.image_count() == 64
    assert len(copies) == 1
    lines, _ = ifs.lines(shapely.boundary(flower(4)), TOLERANCE)
    assert len(lines) == 1
    several, source = ifs.areas(np.append(flower(4), flower(4, size=0.5)), TOLERANCE)
    assert sorted(source) == [0, 1]
    assert len(several) == 2


def test_drawn_once_keeps_what_differs() -> None:
    line = shapely.LineString([(0, 0), (1, 1)])
    other = shapely.LineString([(0, 1), (1, 0)])
    box = shapely.box(0, 0, 1, 1)
    shapes = array_of(line, other, box, box.boundary, shapely.reverse(line), box, shapely.box(0, 0, 1, 1.01))
    assert drawn_once(shapes, TOLERANCE).tolist() == [0, 1, 2, 3, 6]


def test_systems_of_several_maps() -> None:
    maps = tuple(
        FlameMap(((0.5, Linear()),), pre=Affine.translation(shift))
        for shift in ((0.0, 0.0), (1.0, 0.0), (0.5, 1.0))
    )
    triangle = array_of(shapely.Polygon([(0, 0), (1, 0), (0.5, 1)]))
    gasket = Ifs(maps, 5)
    assert gasket.image_count() == 3**5
    copies = images(gasket)
    area = sum(each.apply(triangle)[0].area for each in copies)
    assert len(copies) == 3**5
    assert area == pytest.approx(0.5 * (3 / 4) ** 5)


def test_stretch_bounds_what_a_small_error_becomes() -> None:
    ifs = layout((4 / 3, 0.4), 2, share=0.618)
    points = np.random.default_rng(2).uniform(-1, 1, (200, 2))
    moved = points + 1e-7 * np.array([0.6, 0.8])
    worst = np.zeros(len(points))
    flame = ifs.maps[0]
    for first in range(4):
        for second in range(4):
            ends = [flame.at(flame.at(each, first), second) for each in (points, moved)]
            worst = np.maximum(worst, np.linalg.norm(ends[1] - ends[0], axis=1) / 1e-7)
    assert (worst <= ifs.stretch(points) * 1.001).all()
    assert (ifs.stretch(points) <= worst * 4).all()


def test_marks_too_small_to_be_told_apart_are_refused_before_all_are_compared() -> None:
    """Contours of contours are crumbs, hundreds of thousands of them at one place."""
    x, y = np.random.default_rng(0).uniform(0, 1e-3, (2, 5_000))
    crumbs = shapely.box(x, y, x + 1e-4, y + 1e-4)
    with pytest.raises(TooLargeError, match=r"5,000 shapes meet about 25,000,000 times"):
        drawn_once(crumbs, 0.01)
    assert drawn_once(crumbs[:100], 0.01).tolist() == [0]
    assert len(drawn_once(crumbs, 1e-9)) == 5_000
