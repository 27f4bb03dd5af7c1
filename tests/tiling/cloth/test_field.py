"""Larger pieces of the field than a tile: nothing is moved, and no seam is left."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Artwork, Cell, DropAxis, Ink, Layer, Overlap, violations
from batik_vector.errors import SeamError, TooLargeError
from batik_vector.geometry.outlines import MM, of_polygons
from batik_vector.tiling.cloth.chains import Copies, chains_of
from batik_vector.tiling.cloth.field import collected, repeated, with_bleed
from batik_vector.tiling.cloth.rings import cycles, rings_of, whole
from batik_vector.tiling.torus.torus import Window, clip_areas, to_mm, to_step_grid, wrap

from .test_yardage import CORNERS, Shapes, shapes, tile

GRID = 5
WINDOW = Window(0, 0, 40_000, 40_000)


def on_cells(cells: list[int]) -> Artwork:
    """A tile of squares, 10 mm each: those of a grid of five by five whose numbers are given."""
    squares = [
        shapely.box(10 * (n % GRID), 10 * (n // GRID), 10 * (n % GRID) + 10, 10 * (n // GRID) + 10)
        for n in cells
    ]
    # Simplified, a corner of one may lie on an edge of another.
    parts = shapely.get_parts(shapely.simplify(shapely.union_all(squares), 0))
    return tile(*parts, size=(50_000, 50_000), names=("m.square",) * len(parts))


@settings(max_examples=50, deadline=None, derandomize=True)
@given(st.lists(st.integers(0, GRID * GRID - 1), min_size=1, unique=True), st.integers(0, 4), st.booleans())
def test_squares_on_a_grid_are_welded_as_geos_welds_them(cells: list[int], slip: int, upright: bool) -> None:
    """Squares touch in edges and in points, close to rings and to endless nets: every case there is."""
    axis = DropAxis.COLUMN if upright else DropAxis.ROW
    artwork = on_cells(cells)
    artwork = replace(artwork, cell=Cell(50_000, 50_000, Fraction(slip, 5), axis))
    field = repeated(artwork, 3, 2)
    assert violations(field) == []
    window = shapely.box(0, 0, 150, 100)
    (ax, ay), (bx, by) = np.array(artwork.cell.lattice) / 1000
    copies = [
        shapely.transform(area, lambda xy, i=i, j=j: xy + [i * ax + j * bx, i * ay + j * by])  # type: ignore[misc]
        for area in artwork.layers[0].areas
        for i in range(-4, 8)
        for j in range(-8, 9)
    ]
    expected = shapely.get_parts(shapely.intersection(shapely.union_all(copies), window))
    expected = expected[shapely.area(expected) > 0]
    found = field.layers[0].areas
    assert len(found) == len(expected)
    simple = shapely.normalize(shapely.simplify(np.concatenate([found, expected]), 0))
    assert {area.wkt for area in simple[: len(found)]} == {area.wkt for area in simple[len(found) :]}


def test_straight_edges_over_seams_have_no_vertex_there() -> None:
    field = repeated(tile(shapely.box(0, 10, 40, 20)), 3, 1)
    assert shapely.get_num_coordinates(field.layers[0].areas).tolist() == [5]


def test_what_no_seam_cuts_is_the_same_bits() -> None:
    field = repeated(CORNERS, 2, 2)
    bled = with_bleed(CORNERS, 9.0)
    assert violations(field) == violations(bled) == []
    assert (bled.bleed, bled.cell) == (9.0, CORNERS.cell)
    middle = next(area for area in field.layers[0].areas if shapely.area(area) > 199)
    quarter = {(round(x, 3), round(y, 3)) for x, y in shapely.get_coordinates(CORNERS.layers[0].areas)}
    for x, y in shapely.get_coordinates(middle):
        assert (round(x % 40, 3), round(y % 40, 3)) in quarter or x == 40 or y == 40


def overlay(*areas: shapely.Geometry, names: tuple[str, ...]) -> Artwork:
    """A tile of marks that stay single, cut at the seams."""
    marks, codes = wrap(
        to_step_grid(shapes(*areas)), np.arange(len(areas)), ((40_000, 0), (0, 40_000)), WINDOW
    )
    pieces, codes = clip_areas(marks, codes, WINDOW)
    layer = Layer(
        Ink("wax", "#ffffff", overlap=Overlap.OVERLAY),
        np.asarray(to_mm(np.asarray(shapely.orient_polygons(pieces)))),
        area_names=tuple(names[code] for code in codes),
    )
    return Artwork("t", Cell(40_000, 40_000), (layer,))


def test_marks_of_an_overlay_that_cross_at_the_seam_go_straight_on() -> None:
    rising = shapely.Polygon([(30, 10), (32, 10), (52, 30), (50, 30)])
    falling = shapely.transform(rising, lambda xy: xy * [1, -1] + [0, 40])
    field = repeated(overlay(rising, falling, names=("m.bar", "m.bar")), 3, 1).layers[0]
    full = [area for area in field.areas if area.area == pytest.approx(rising.area, abs=0.01)]
    assert len(full) == 4
    assert all(len(shapely.remove_repeated_points(area).exterior.coords) <= 7 for area in full)
    assert all(
        shapely.area(shapely.convex_hull(area)) == pytest.approx(rising.area, abs=0.01) for area in full
    )


def test_an_overlay_larger_than_its_tile_is_sound() -> None:
    star = shapely.union_all([shapely.box(-50, 15, 70, 25), shapely.box(5, -40, 15, 70)])
    field = repeated(overlay(star, shapely.box(3, 3, 60, 9), names=("m.star", "m.bar")), 2, 2)
    assert violations(field) == []
    covered = shapely.union_all(field.layers[0].areas).area
    tiled = shapely.union_all(overlay(star, shapely.box(3, 3, 60, 9), names=("a", "b")).layers[0].areas).area
    assert covered == pytest.approx(4 * tiled, abs=1e-6)


def test_areas_that_lie_over_one_another_are_united_where_a_seam_cuts_them() -> None:
    """Drawings from elsewhere are not in normal form."""
    left = [shapely.box(0, 10, 12, 20), shapely.box(0, 10, 6, 20)]
    field = repeated(tile(shapely.box(30, 10, 40, 20), *left), 2, 1)
    assert sorted(round(area.area) for area in field.layers[0].areas) == [100, 120, 220]


def test_edges_that_do_not_close_are_told() -> None:
    outlines = of_polygons(shapes(shapely.box(0, 0, 10, 10)), MM)
    chains = chains_of(outlines, ((), (0,)))
    some = np.arange(len(chains))[:1]
    open_ = Copies(chains, some, np.zeros((1, 2), np.int64), some)
    with pytest.raises(SeamError, match="do not close"):
        rings_of(open_)


def test_rings_far_from_the_origin_keep_their_sides() -> None:
    annulus = shapely.difference(shapely.box(0, 0, 30, 30), shapely.box(10, 10, 20, 20))
    chains = chains_of(of_polygons(shapes(annulus), MM), ((), ()))
    for far in (0, 10**8, -(10**9)):
        shift = np.full((len(chains), 2), far)
        rings = rings_of(Copies(chains, np.arange(len(chains)), shift, chains.mark))
        made = whole(rings)
        assert np.diff(made.marks).tolist() == [2]
        assert made.points[:4].tolist() != made.points[4:].tolist()
        assert np.ptp(made.points[: made.rings[1]], axis=0).tolist() == [30_000, 30_000]


@given(st.permutations(range(40)))
def test_cycles_are_followed(follower: list[int]) -> None:
    label, rank = cycles(np.array(follower))
    for start in range(40):
        seen, at = [start], follower[start]
        while at != start:
            seen.append(at)
            at = follower[at]
        assert label[start] == min(seen)
        assert seen[-int(rank[start]) % len(seen)] == min(seen)


def test_fields_past_the_limit_are_refused() -> None:
    with pytest.raises(TooLargeError, match="ask for fewer repeats"):
        repeated(CORNERS, 10_000, 10_000)


def test_an_artwork_is_a_page_in_one_piece() -> None:
    again = collected(CORNERS)
    assert again.cell == CORNERS.cell
    same: Shapes = again.layers[0].areas
    assert shapely.equals_exact(same, CORNERS.layers[0].areas).all()
