"""Landing: copies that are alike are alike to the bit, none moves farther than promised, none comes apart."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.maps.affines import Affines, turns
from batik_vector.geometry.sampling import Array, Geometries
from batik_vector.tiling.welding.congruent import polygons
from batik_vector.tiling.welding.copies_on_grid import Spread, joined, spreads
from batik_vector.units import STEPS_PER_MM

angle = np.linspace(0, 2 * np.pi, 41)[:-1]
PEAR = np.array(
    [shapely.Polygon(np.column_stack([np.cos(angle), (1 + 0.3 * np.cos(angle)) * np.sin(angle)]))],
    dtype=object,
)
SQUARE = np.array([shapely.box(-0.5, -0.5, 0.5, 0.5)], dtype=object)


def lattice(columns: int, rows: int, width: float, height: float) -> Affines:
    y, x = np.divmod(np.arange(columns * rows), columns)
    return Affines.translations(np.column_stack([(x + 0.5) * width / columns, (y + 0.5) * height / rows]))


def landed(maps: Affines, marks: Geometries, movable: bool = True) -> list[Array]:
    """The vertices of every copy in grid steps, in the order of the copies; one mark each."""
    found = spreads(maps, (lambda: [marks]) if movable else None)
    images = joined([each.images(each.first.apply(marks)) for each in found])
    geometries = images.geometries[np.lexsort((images.mark, images.copy))]
    return [shapely.get_coordinates(each) * STEPS_PER_MM for each in geometries]


def exact(maps: Affines, marks: Geometries) -> list[Array]:
    return [shapely.get_coordinates(each) * STEPS_PER_MM for each in maps.apply(marks)]


def shapes(copies: list[Array]) -> int:
    """How many of the copies are no translates of one another, rounded as the tile rounds them."""
    steps = [np.rint(each).astype(int) for each in copies]
    return len({(each - each.min(axis=0)).tobytes() for each in steps})


@pytest.mark.parametrize("turn", [0.0, 90.0, 17.0])
def test_the_copies_of_a_lattice_that_is_not_on_the_grid_are_exact_translates(turn: float) -> None:
    maps = lattice(33, 33, 1000.0, 997.0) @ Affine.turn(turn) @ Affine.scale(9.0)
    copies = landed(maps, PEAR)
    assert shapes(copies) == 1
    # As they lie they are not: what is asked for is no matter of course.
    assert shapes(exact(maps, PEAR)) > 100
    assert all(np.array_equal(each / STEPS_PER_MM, np.rint(each) / STEPS_PER_MM) for each in copies)


def test_no_vertex_moves_farther_than_the_grid_has_of_the_tolerance() -> None:
    maps = lattice(33, 29, 1000.0, 997.0) @ Affine.turn(17) @ Affine.scale(9.0)
    moved = [np.hypot(*(a - b).T).max() for a, b in zip(landed(maps, PEAR), exact(maps, PEAR), strict=True)]
    assert 1.0 < max(moved) < np.sqrt(2) + 1e-6


def test_quarter_turns_and_mirrors_are_exact() -> None:
    grid = turns([0, 90, 180, 270]).after(Affines.of([Affine(), Affine.mirror()]))
    maps = Affine.translation((160.0003, 71.0)) @ grid @ Affine.translation((80, 33)) @ Affine.scale(30.0)
    copies = [np.rint(each) for each in landed(maps, PEAR)]
    first = {tuple(xy) for xy in (copies[0] - np.rint(maps[0].at(np.zeros((1, 2))) * STEPS_PER_MM)).tolist()}
    for operation, own, whole in zip(grid, maps, copies, strict=True):
        middle = np.rint(own.at(np.zeros((1, 2))) * STEPS_PER_MM)
        assert {tuple(xy) for xy in (operation.inverse().at(whole - middle) + 0.0).tolist()} == first
        assert shapely.is_ccw(shapely.linearrings(whole))


def test_copies_that_share_edges_keep_them() -> None:
    # Thirds of a metre: moved each by itself the squares would part by a step.
    maps = lattice(3, 3, 1000.0, 1000.0) @ Affine.scale(1000 / 3)
    tiles = [shapely.Polygon(np.rint(each)) for each in landed(maps, SQUARE)]
    assert shapely.union_all(tiles).equals(shapely.box(0, 0, 1e6, 1e6))


def test_lines_that_meet_end_to_end_still_do() -> None:
    line = np.array([shapely.LineString([(-0.5, -0.5), (0.1, 0.2), (0.5, 0.5)])], dtype=object)
    maps = lattice(7, 7, 1000.0, 1000.0) @ Affine.scale(1000 / 7)
    ends = [np.rint(each[[0, -1]]) for each in landed(maps, line)]
    for i in range(7 * 6):
        if i % 7 < 6:
            assert ends[i][1].tolist() == ends[i + 8][0].tolist()


def test_what_is_not_to_be_moved_stays_where_it_is() -> None:
    maps = lattice(33, 33, 1000.0, 997.0) @ Affine.scale(9.0)
    moved = [np.abs(a - b).max() for a, b in zip(landed(maps, PEAR, False), exact(maps, PEAR), strict=True)]
    assert max(moved) < 0.5 + 1e-6


def work(found: list[Spread]) -> int:
    """How many shapes are made before they are copied."""
    return sum(len(each.first) for each in found)


def test_what_is_congruent_is_made_once() -> None:
    assert work(spreads(lattice(40, 40, 100.0, 90.0) @ Affine.turn(12))) == 1
    assert work(spreads(turns([15.0 * k for k in range(24)]) @ Affine.translation((9, 0)))) == 1
    sizes = Affines.scales(np.array([1.0, 2, 1, 2, 2, 1]), np.array([1.0, 2, -1, 2, 2, 1]))
    assert work(spreads(sizes)) == 2


number = st.floats(-3, 3).map(lambda x: round(x, 3))


@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    st.lists(
        st.tuples(number, number, st.integers(0, 7), st.sampled_from([1.0, 1.5])), min_size=1, max_size=9
    )
)
def test_every_copy_comes_in_its_place_and_order(poses: list[tuple[float, float, int, float]]) -> None:
    maps = Affines.of(
        [
            Affine.translation((9 * x, 9 * y)) @ Affine.turn(45 * k) @ Affine.scale(s, s if k % 2 else -s)
            for x, y, k, s in poses
        ]
    )
    for mine, true in zip(landed(maps, PEAR), exact(maps, PEAR), strict=True):
        assert np.abs(mine - true).max() < 1.001


def test_copies_on_the_grid_are_the_images() -> None:
    grid = turns([0, 90, 180, 270]).after(Affines.of([Affine(), Affine.mirror()]))
    maps = Affine.translation((160.0003, 71.0)) @ grid @ Affine.translation((80, 33)) @ Affine.scale(30.0)
    (found,) = spreads(maps, lambda: [PEAR])
    marks = found.first.apply(PEAR)
    copies, images = found.landed(marks), found.images(marks)
    assert copies is not None
    assert len(copies.areas.shapes) <= 8
    own = polygons(copies.areas)[np.argsort(copies.copy)]
    assert shapely.equals(own, images.geometries[np.argsort(images.copy)]).all()
