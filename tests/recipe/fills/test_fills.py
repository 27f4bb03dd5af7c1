"""Every fill on random regions: nothing leaves them or comes nearer than the margin, nothing overlaps."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
import shapely

from batik_vector.errors import GeometryError, TooLargeError
from batik_vector.geometry.fills.insets import whole
from batik_vector.geometry.sampling import Geometries, Indices
from batik_vector.recipe.fills import (
    FILLS,
    CacahGori,
    Cecek,
    Contours,
    Fill,
    Follow,
    Galaran,
    Hatching,
    Herangan,
    Room,
    Rows,
    Sawut,
    Sisik,
    Ukel,
    VeinLines,
)
from tests.geometry.fills.regions import regions
from tests.thorough import examples, long

HAIR = 1e-3
"""A micrometre, in mm."""


def kinds() -> Iterator[Fill]:
    """Yield every fill, with everything that its rows can follow."""
    for cls in FILLS.values():
        if cls in (Galaran, Cecek) or "follow" in cls.__dataclass_fields__:
            yield from (cls(follow=each) for each in (Follow if cls is Galaran else Rows))  # type: ignore[call-arg]
        else:
            yield cls()
    yield Galaran(angle=33, spacing=1.3, width=0.5, margin=0)
    yield Contours(taper=0.8, rows=4)


ALL = list(kinds())
NAMES = [f"{fill.kind}-{getattr(fill, 'follow', '')}" for fill in ALL]


def laid(fill: Fill, shapes: Geometries, turns: int = 1) -> tuple[Geometries, Indices]:
    return fill.lay(Room(whole(shapes), np.zeros((len(shapes), 2)), turns, 0.02, 3))


def holds(fill: Fill, shapes: Geometries) -> None:
    """Assert what is true of every fill."""
    marks, region = laid(fill, shapes)
    assert len(marks) > 0
    assert shapely.is_valid(marks).all()
    assert (shapely.get_type_id(marks) == shapely.GeometryType.POLYGON).all()
    assert shapely.covers(shapes[region], marks).all()
    assert shapely.distance(marks, shapely.boundary(shapes)[region]).min() >= fill.margin - HAIR
    points, of = shapely.get_coordinates(marks, return_index=True)
    apart = shapely.set_coordinates(marks.copy(), points + np.outer(region[of] * 100.0, [1, 0]))
    a, b = shapely.STRtree(apart).query(apart, predicate="intersects")
    assert not (a < b).any()


@pytest.mark.parametrize("fill", ALL, ids=NAMES)
def test_marks_stay_within_keep_the_margin_and_never_overlap(fill: Fill) -> None:
    holds(fill, regions(0, 20))


@long
@pytest.mark.parametrize("fill", ALL, ids=NAMES)
def test_so_they_do_in_many_regions(fill: Fill) -> None:
    holds(fill, regions(1000, examples(60, 500), 8.0))


def nearest(marks: Geometries, region: Indices) -> np.ndarray:
    """Return how far the middle of each mark is from the nearest other of its region."""
    middle = shapely.centroid(marks)
    a, b = shapely.STRtree(middle).query(middle, predicate="dwithin", distance=10.0)
    near = np.full(len(marks), np.inf)
    met = (a != b) & (region[a] == region[b])
    np.minimum.at(near, a[met], shapely.distance(middle[a[met]], middle[b[met]]))
    return near


def test_dots_in_rows_stand_at_their_spacing() -> None:
    marks, region = laid(Cecek(spacing=1.7, angle=20), regions(40, 12))
    near = nearest(marks, region)
    assert np.median(near) == pytest.approx(1.7, rel=1e-9)
    assert near.min() >= 1.7 * (1 - 1e-9)


@pytest.mark.parametrize("follow", [Rows.CONTOUR, Rows.CENTRE, Rows.SCATTER])
def test_other_dots_are_never_nearer_by_more_than_a_twentieth(follow: Rows) -> None:
    marks, region = laid(Cecek(spacing=1.7, follow=follow), regions(40, 12))
    near = nearest(marks, region)
    # On small circles the chord is shorter than the arc that is shared out.
    assert np.quantile(near, 0.01) >= 0.95 * 1.7
    assert near.min() >= 0.88 * 1.7
    assert np.median(near) <= 1.3 * 1.7


def test_dots_along_a_straight_edge_stand_at_their_spacing() -> None:
    marks, _ = laid(Cecek(spacing=2, follow=Rows.CONTOUR, rows=1), np.array([shapely.box(0, 0, 200, 160)]))
    near = nearest(marks, np.zeros(len(marks), np.intp))
    # At each corner one may be left out.
    assert len(marks) == pytest.approx((2 * (200 + 160) - 8 * 1.1) / 2, abs=5)
    assert np.quantile(near, [0.02, 0.98]) == pytest.approx([2, 2], rel=0.05)


def test_parallel_lines_are_a_spacing_apart() -> None:
    marks, _ = laid(Galaran(spacing=3, width=1, margin=2), np.array([shapely.box(0, 0, 60, 40)]))
    low = np.sort(shapely.bounds(marks)[:, 1])
    assert np.diff(low) == pytest.approx(3, rel=1e-9)
    assert shapely.bounds(marks)[:, 2] == pytest.approx(58, abs=0.05)


def test_bands_are_a_spacing_apart_and_grow_thinner_where_asked() -> None:
    square = np.array([shapely.box(-50, -50, 50, 50)])
    even, _ = laid(Contours(spacing=4, width=1, margin=1), square)
    left = np.sort(shapely.bounds(even)[:, 0])
    assert np.diff(left) == pytest.approx(4, rel=0.05)
    thin, _ = laid(Contours(spacing=4, width=2, margin=1, taper=0.7, rows=3), square)
    breadth = shapely.area(thin) / shapely.length(thin) * 2
    assert breadth[1:] / breadth[:-1] == pytest.approx(0.7, rel=0.02)


def test_strokes_stand_square_to_the_edge_and_end_halfway() -> None:
    slim = np.array([shapely.box(0, 0, 60, 6)])
    marks, _ = laid(Sawut(spacing=1.5, width=0.5, margin=0.5, length=40), slim)
    low_x, low_y, high_x, high_y = shapely.bounds(marks).T
    upright = (high_x - low_x < 0.51) & (low_x > 6) & (high_x < 54)
    assert upright.sum() > 50
    assert (np.minimum(high_y[upright], 6 - low_y[upright]) < 3).all()


def test_nothing_is_drawn_in_what_is_too_slim() -> None:
    for fill in ALL:
        marks, _ = laid(fill, np.array([shapely.box(0, 0, 40, 2 * fill.margin + fill.width * 0.98)]))
        assert not len(marks)


def test_a_net_is_one_and_spirals_are_linked_two_and_two() -> None:
    disc = np.array([shapely.Point(0, 0).buffer(20, quad_segs=32)])
    assert len(laid(Hatching(), disc)[0]) == 1
    area = shapely.area(laid(Ukel(), disc)[0])
    linked = area > 1.5 * np.median(area) / 2
    assert linked.sum() > 12


@pytest.mark.parametrize("fill", [CacahGori(spacing=3), CacahGori(spacing=3, angle=25)], ids=str)
def test_crosses_in_rows_stand_at_their_spacing(fill: CacahGori) -> None:
    marks, region = laid(fill, regions(40, 12))
    assert np.median(nearest(marks, region)) == pytest.approx(3, rel=1e-9)
    assert nearest(marks, region).min() >= 3 * (1 - 1e-9)


@pytest.mark.parametrize("follow", [Rows.CONTOUR, Rows.CENTRE, Rows.SCATTER, Rows.AXIS])
def test_other_crosses_are_never_nearer_by_more_than_a_twentieth(follow: Rows) -> None:
    near = nearest(*laid(CacahGori(spacing=2.4, follow=follow), regions(40, 12)))
    # On small circles the chord is shorter than the arc that is shared out.
    assert np.quantile(near, 0.01) >= 0.95 * 2.4
    assert near.min() >= 0.88 * 2.4
    assert np.median(near) <= 1.3 * 2.4


def test_splinters_are_never_nearer_than_their_spacing() -> None:
    # The middle of a bent splinter is not that of its place.
    near = nearest(*laid(Herangan(spacing=2.6), regions(40, 12)))
    assert near.min() >= 0.9 * 2.6
    assert np.median(near) <= 1.3 * 2.6


def test_strokes_stand_at_their_spacing_along_a_straight_edge() -> None:
    marks, _ = laid(Sawut(spacing=1.6, length=3), np.array([shapely.box(0, 0, 160, 80)]))
    low_x, low_y, _, high_y = shapely.bounds(marks).T
    below = np.sort(low_x[(high_y - low_y > 2) & (high_y < 10) & (low_x > 6) & (low_x < 150)])
    assert len(below) > 80
    assert np.diff(below) == pytest.approx(1.6, rel=0.05)


def test_the_meshes_of_a_net_are_a_spacing_broad() -> None:
    net, _ = laid(Hatching(spacing=3, width=0.6, between=60), np.array([shapely.box(0, 0, 60, 50)]))
    meshes = shapely.area(shapely.polygons(shapely.get_rings(net[0])[1:]))
    side = (3 - 0.6) / np.sin(np.radians(60))
    assert np.median(meshes) == pytest.approx(side * (3 - 0.6), rel=0.01)


def test_scales_stand_at_their_spacing_in_rows_half_as_far() -> None:
    marks, _ = laid(Sisik(spacing=4, angle=0), np.array([shapely.box(0, 0, 60, 50)]))
    low_x, low_y, high_x, _ = shapely.bounds(marks).T
    whole_ones = high_x - low_x > 0.99 * (high_x - low_x).max()
    rows = np.rint(low_y[whole_ones] / 2).astype(int)
    places = low_x[whole_ones]
    for row in np.unique(rows)[1:-1]:
        assert np.diff(np.sort(places[rows == row])) == pytest.approx(4, rel=1e-6)
    assert np.diff(np.unique(np.round(low_y[whole_ones], 6))) == pytest.approx(2, rel=1e-3)


def test_pairs_of_spirals_stand_in_rows_a_spacing_apart() -> None:
    fill = Ukel(spacing=5)
    marks, _ = laid(fill, np.array([shapely.box(0, 0, 90, 70)]))
    area = shapely.area(marks)
    near = nearest(linked := marks[area > 0.9 * area.max()], np.zeros(len(linked), np.intp))
    row = 2 * fill.spacing - fill.width
    # Every other row is a quarter of a pair on; at the edge a neighbour may be missing.
    assert np.quantile(near, [0, 0.9]) == pytest.approx(np.hypot(row / 4, fill.spacing), rel=0.05)


def test_side_veins_leave_the_midrib_at_their_spacing() -> None:
    marks, _ = laid(VeinLines(spacing=3, width=0.5, angle=60), np.array([shapely.box(0, 0, 80, 24)]))
    cut = shapely.intersection(shapely.LineString([(10, 14), (60, 14)]), shapely.union_all(marks))
    middles = np.sort(shapely.get_coordinates(shapely.centroid(shapely.get_parts(cut)))[:, 0])
    assert len(middles) > 12
    assert np.diff(middles) == pytest.approx(3, rel=0.05)


def bent_leaf(turn: float) -> Geometries:
    t = np.linspace(0, 2 * np.pi, 240)[:-1]
    x, y = 24 * np.cos(t), 7 * np.sin(t) * np.abs(np.sin(t)) ** 0.4
    z = (x + 1j * (y + x * x / 70)) * np.exp(1j * np.radians(turn))
    return np.array([shapely.orient_polygons(shapely.Polygon(np.column_stack([z.real, z.imag])).buffer(0))])


@pytest.mark.parametrize("turn", [0, 50, 130])
def test_rows_along_a_bent_midrib_keep_their_spacing_whichever_way_it_lies(turn: float) -> None:
    leaf = bent_leaf(turn)
    lines, _ = laid(Galaran(follow=Follow.AXIS, spacing=1.8, width=0.5), leaf)
    assert len(lines) >= 5
    a, b = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=1.8)
    gaps = shapely.distance(lines[a[a != b]], lines[b[a != b]]) + 0.5
    assert gaps == pytest.approx(1.8, rel=0.05)
    # Bent with the leaf: a straight row of such length would be a rectangle.
    longest = lines[shapely.area(lines).argmax()]
    assert shapely.area(shapely.minimum_rotated_rectangle(longest)) > 3 * shapely.area(longest)
    dots, _ = laid(Cecek(follow=Rows.AXIS, spacing=1.8), leaf)
    near = nearest(dots, np.zeros(len(dots), np.intp))
    assert near.min() >= 0.95 * 1.8
    assert np.quantile(near, 0.95) <= 1.05 * 1.8


def test_a_straight_leaf_has_straight_rows() -> None:
    lines, _ = laid(Galaran(follow=Follow.AXIS, spacing=2), np.array([shapely.box(0, 0, 60, 12)]))
    low = np.sort(shapely.bounds(lines)[:, 1])
    assert np.diff(low) == pytest.approx(2, rel=1e-6)


def test_veins_hang_together_in_a_leaf() -> None:
    turn = np.linspace(0, 2 * np.pi, 200)[:-1]
    leaf = shapely.Polygon(
        np.column_stack([20 * np.cos(turn), 6 * np.sin(turn) * np.cos(turn / 2) ** 2 + 0.1])
    )
    marks, _ = laid(VeinLines(margin=0.4, width=0.4), np.array([shapely.orient_polygons(leaf.buffer(0))]))
    assert shapely.area(marks).max() > 0.7 * shapely.area(marks).sum()


def symmetric(marks: Geometries, image: Geometries) -> bool:
    return bool(shapely.union_all(marks).symmetric_difference(shapely.union_all(image)).area < 1e-4)


@pytest.mark.parametrize(
    "fill",
    [
        Cecek(),
        Cecek(follow=Rows.CONTOUR),
        Sawut(),
        Galaran(),
        Galaran(angle=90),
        Sisik(),
        Contours(),
        VeinLines(),
    ],
    ids=str,
)
def test_a_petal_with_an_axis_is_filled_alike_on_both_sides(fill: Fill) -> None:
    turn = np.linspace(-np.pi / 2, np.pi / 2, 201)[1:-1]
    corners = 30 * np.cos(turn)[:, None] ** 2 * np.column_stack([np.cos(turn), 0.8 * np.sin(turn)])
    petal = shapely.orient_polygons(shapely.Polygon(corners[corners[:, 0] > 1]))
    marks, _ = laid(fill, np.array([petal]))
    assert symmetric(marks, np.asarray(shapely.transform(marks, lambda xy: xy * [1, -1]), dtype=object))


@pytest.mark.parametrize("turns", [4, 6])
@pytest.mark.parametrize(
    "fill", [Cecek(follow=Rows.CONTOUR), Cecek(follow=Rows.CENTRE), Sawut(), Contours()], ids=str
)
def test_a_disc_is_filled_alike_under_the_turns_of_its_place(fill: Fill, turns: int) -> None:
    disc = np.array([shapely.Point(0, 0).buffer(13.3, quad_segs=48)])
    marks, _ = laid(fill, disc, turns)
    angle = 2 * np.pi / turns
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    assert symmetric(marks, np.asarray(shapely.transform(marks, lambda xy: xy @ turn), dtype=object))


def test_the_same_seed_tosses_the_same_and_another_otherwise() -> None:
    room = Room(whole(regions(3, 1)), np.zeros((len(regions(3, 1)), 2)), 1, 0.02, 5)
    first, again = Herangan().lay(room)[0], Herangan().lay(room)[0]
    assert shapely.to_wkb(first).tolist() == shapely.to_wkb(again).tolist()
    other = Herangan().lay(room._replace(seed=6))[0]
    assert shapely.to_wkb(first).tolist() != shapely.to_wkb(other).tolist()


def test_marks_that_would_touch_and_far_too_many_are_refused() -> None:
    with pytest.raises(GeometryError, match=r"spacing = 0\.5: expected more than 0\.8 mm with width = 0\.8"):
        Cecek(spacing=0.5)
    with pytest.raises(GeometryError, match=r"length = 0\.5: expected more than width = 0\.6"):
        Sawut(length=0.5)
    with pytest.raises(TooLargeError, match=r"spacing = 0\.05: about .* marks, past the limit of 400,000"):
        laid(Cecek(spacing=0.05, width=0.02), np.array([shapely.box(0, 0, 100, 100)]))
